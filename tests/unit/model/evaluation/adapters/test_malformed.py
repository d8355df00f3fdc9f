"""No file of a stranger ends a run: each costs its own object, which says why."""

import shutil
from pathlib import Path

import pytest

from model.evaluation.adapters.formats import Place, places
from model.evaluation.score import Protocol
from model.evaluation.tasks import Task, work
from tests.unit.model.evaluation.adapters.malformed import (
    NOT_JSON,
    SPOILED,
    STATED,
    WRITERS,
    Spoil,
    put,
    replaced,
    stated_changed,
    text_changed,
)
from tests.unit.model.evaluation.adapters.outputs import write_singapo

QUICK = Protocol(points=100, part_points=100, mask_pixels=8)
CASES = [
    pytest.param(format_, spoil, id=f"{format_}: {name}")
    for format_, own in SPOILED.items()
    for name, spoil in {
        **{f"the file is {name}": replaced(STATED[format_], d) for name, d in NOT_JSON.items()},
        **own,
    }.items()
]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One sound output of every format, in folders of their names."""
    folder = tmp_path_factory.mktemp("whole")
    for format_, write in WRITERS.items():
        write(folder / format_)
    (folder / "dta" / "init_p10_motion.json").unlink()
    return folder


def task_of(folder: Path, format_: str, whole: Path, spoil: Spoil) -> Task:
    """A spoiled copy of an output, to be scored against SINGAPO's cabinet."""
    shutil.copytree(whole / format_, folder / "guess" / "x")
    spoil(folder / "guess" / "x")
    write_singapo(folder / "truth")
    (predicted,) = places(folder / "guess", format_).values()
    true = Place("x", "singapo", folder / "truth" / "object.json")
    return Task(
        name="x", predicted=predicted, true=true, protocol=QUICK, gated=False, folder=folder / "out"
    )


@pytest.mark.parametrize(("format_", "spoil"), CASES)
def test_a_bad_file_costs_its_own_object(
    tmp_path: Path, whole: Path, format_: str, spoil: Spoil
) -> None:
    record = work(task_of(tmp_path, format_, whole, spoil))
    assert record.failure is not None
    assert "\n" not in record.failure
    assert record.metrics["singapo.honest.nearest.rs_dgiou"] == [2.0]
    assert record.metrics["joints.nearest.type_right"] == [0.0, 0.0]
    assert (tmp_path / "out" / "x.json").is_file()


@pytest.mark.parametrize("format_", WRITERS)
def test_the_sound_files_are_scored(tmp_path: Path, whole: Path, format_: str) -> None:
    record = work(task_of(tmp_path, format_, whole, lambda _: None))
    assert record.failure is None
    assert record.metrics["singapo.honest.nearest.rs_dgiou"][0] < 2.0


@pytest.mark.parametrize(
    ("format_", "spoil"),
    [
        ("urdf", text_changed(STATED["urdf"], '<axis xyz="', '<axis xyz="0 0 0" also="')),
        ("singapo", stated_changed(STATED["singapo"], put("diffuse_tree", 1, "joint", "axis",
                                                          "direction", value=[0, 0, 0]))),
        ("bundle", stated_changed(STATED["bundle"], put("joints", 0, "axis",
                                                        value=[float("nan")] * 3))),
    ],
)  # fmt: skip
def test_an_axis_without_a_direction_brings_no_angle(
    tmp_path: Path, whole: Path, format_: str, spoil: Spoil
) -> None:
    record = work(task_of(tmp_path, format_, whole, spoil))
    assert record.failure is None
    assert any(row.found and row.axis_deg is None for row in record.joints)
