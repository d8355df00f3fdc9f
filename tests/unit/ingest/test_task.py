"""One object of a run: what cannot be used is one line, and nothing else is touched."""

import dataclasses
import json
import re
from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.ingest.found import Found, found_folders, named
from artgen.ingest.options import Options
from artgen.ingest.run import ingest_all, kept_outcome, record_path, write_record
from artgen.ingest.task import IngestTask, Kind, Outcome, category_name, ingest, verdict
from artgen.pipeline import Toolbox
from artgen.progress import silent
from artgen.run_folder import RunFolder
from artgen.validate.report import Finding, Report
from tests.unit.ingest.folders import cabinet


def task_at(path: Path) -> IngestTask:
    return IngestTask(kind="partnet", path=path, asset_id="pm_x", options=Options())


def told(path: Path, out: Path) -> str:
    """The line of a refusal; the Blender of these tools is never started."""
    outcome = ingest(task_at(path), Toolbox(RunFolder(out), "none"))
    assert outcome.status == "refused"
    assert "\n" not in outcome.message
    return outcome.message


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("mobility_v2.json", None, "mobility_v2.json missing"),
        ("mobility_v2.json", "{" * 9, "cannot be read"),
        ("mobility_v2.json", json.dumps([{"id": 10**400, "parent": -1, "joint": "free"}]), ""),
        ("mobility_v2.json", '[{"id": 0, "parent": -1, "joint": "free", "parts": 7}]', ""),
        ("result.json", '[{"children": 5}]', ""),
        ("meta.json", "\x00\xff", "cannot be read"),
        ("result.json", "[{}]", "no mesh that can be used"),
    ],
)
def test_damaged_folders_cost_one_line(
    name: str, text: str | None, expected: str, tmp_path: Path
) -> None:
    root = cabinet().write(tmp_path / "1")
    if text is None:
        (root / name).unlink()
    else:
        (root / name).write_text(text)
    assert expected in told(root, tmp_path / "out")


def test_an_entity_bomb_beside_good_json_is_not_opened(tmp_path: Path) -> None:
    """The URDF is a cross-check only; the folder is built from its JSON. Here all meshes are gone,
    so that the run ends before Blender is asked."""
    root = cabinet().write(tmp_path / "1")
    entities = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 30))
    (root / "mobility.urdf").write_text(f'<!DOCTYPE r [<!ENTITY e0 "x">{entities}]><r>&e29;</r>')
    for path in (root / "textured_objs").glob("*.obj"):
        path.unlink()
    assert "no mesh" in told(root, tmp_path / "out")


def test_nothing_is_written_outside_the_output(tmp_path: Path) -> None:
    """A hostile id and stems that climb: the only new files are below the output folder."""
    root = cabinet().write(tmp_path / "in" / "1")
    (root / "meta.json").write_text('{"anno_id": "../../evil", "model_cat": "../up"}')
    result = root / "result.json"
    result.write_text(result.read_text().replace("original-6", "../../../etc/passwd"))
    before = {path for path in tmp_path.rglob("*")}
    told(root, tmp_path / "out")
    new = {path for path in tmp_path.rglob("*")} - before
    assert all(path.is_relative_to(tmp_path / "out") for path in new)


@pytest.mark.parametrize(
    ("word", "name"),
    [("StorageFurniture", "storage_furniture"), ("USB", "usb"), ("../up", "up"),
     ("шкаф", "unknown"),
     ("Trash Can", "trash_can"), ("", "unknown"), ("WashingMachine", "washing_machine")],
)  # fmt: skip
def test_categories_become_names_of_ours(word: str, name: str) -> None:
    assert category_name(word) == name


def finding(check: str) -> Finding:
    return Finding(check=check, part="p", value=1.0, bound="0", cause="c", remedy="r")


@pytest.mark.parametrize(
    ("checks", "status"),
    [((), "valid"), (("motion.collision", "semantics.hinge"), "flawed"),
     (("motion.collision", "mesh.closed"), "refused"), (("compile.file",), "refused")],
)  # fmt: skip
def test_how_the_source_is_does_not_refuse_it_what_simulators_need_does(
    checks: tuple[str, ...], status: str
) -> None:
    report = Report(
        asset="a", format="bundle", findings=tuple(finding(c) for c in checks), skipped=()
    )
    assert verdict(report)[0] == status


def outcome(status: str) -> Outcome:
    return Outcome(asset_id="pm_x", source="s", status=status, category="cabinet")


def test_a_run_goes_on_past_refusals_and_reports_each(tmp_path: Path) -> None:
    """No object here needs a process: their places tell already."""
    (tmp_path / "a.zip").write_bytes(b"PK")
    found = found_folders([tmp_path / "a.zip", tmp_path / "nowhere"])
    folder = RunFolder(tmp_path / "out")
    outcomes = ingest_all(folder, "partnet", found, Options(), workers=1, show=silent)
    assert [o.status for o in outcomes] == ["refused", "refused"]


def test_finished_objects_are_kept_and_refused_ones_tried_again(tmp_path: Path) -> None:
    folder, task = RunFolder(tmp_path / "out"), task_at(tmp_path / "1")
    assert kept_outcome(folder, task, "hash") is None
    write_record(folder, task, outcome("refused"), "hash")
    assert kept_outcome(folder, task, "hash") is None
    write_record(folder, task, outcome("flawed"), "hash")
    assert kept_outcome(folder, task, "hash") is None, "its bundle is not there"
    home = folder.assets / "cabinet" / "pm_x"
    home.mkdir(parents=True)
    (home / "manifest.json").write_text("{}")
    assert kept_outcome(folder, task, "hash") == outcome("flawed")
    with pytest.raises(UsageError, match="other settings"):
        kept_outcome(folder, task, "other")
    with pytest.raises(UsageError, match="was ingested from root None"):
        kept_outcome(folder, dataclasses.replace(task, root=tmp_path), "hash")
    record_path(folder, "pm_x").write_text("{")
    assert kept_outcome(folder, task, "hash") is None


@pytest.mark.parametrize("kind", ["partnet", "urdf"])
def test_an_object_is_the_same_however_its_place_is_spelled(
    kind: Kind, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Found: a folder named once relatively and once absolutely was refused as another place."""
    folder, source = RunFolder(tmp_path / "out"), tmp_path / "in" / "1"
    cabinet().write(source)
    (tmp_path / "link").symlink_to(tmp_path / "in")
    (folder.assets / "cabinet" / "pm_x").mkdir(parents=True)
    (folder.assets / "cabinet" / "pm_x" / "manifest.json").write_text("{}")
    monkeypatch.chdir(tmp_path / "in")
    inner = "mobility.urdf" if kind == "urdf" else ""
    spelled = [Path("1") / inner, source / inner, tmp_path / "link" / "1" / inner]
    spelled.append(source / ".." / "1" / inner)
    tasks = [dataclasses.replace(task_at(path), kind=kind) for path in spelled]
    if kind == "urdf":
        tasks += [dataclasses.replace(task, root=task.path.parent) for task in tasks]
    for first in tasks:
        write_record(folder, first, outcome("valid"), "hash")
        assert all(kept_outcome(folder, other, "hash") == outcome("valid") for other in tasks)
    names = {named([Found(path=task.path)], kind)[0][0] for task in tasks}
    assert names == {"urdf_1_mobility" if kind == "urdf" else "pm_1"}
    if kind == "partnet":
        assert len(found_folders(spelled)) == 1
    cabinet().write(tmp_path / "copy" / "1")
    with pytest.raises(UsageError, match=rf"was ingested from path {re.escape(str(source))}"):
        kept_outcome(
            folder, dataclasses.replace(tasks[0], path=tmp_path / "copy" / "1" / inner), "hash"
        )


def test_what_was_made_of_another_annotation_is_not_kept_in_silence(tmp_path: Path) -> None:
    """A folder that was mended came out of the next run as it had been."""
    folder, task = RunFolder(tmp_path / "out"), task_at(cabinet().write(tmp_path / "1"))
    home = folder.assets / "cabinet" / "pm_x"
    home.mkdir(parents=True)
    (home / "manifest.json").write_text("{}")
    write_record(folder, task, outcome("valid"), "hash")
    assert kept_outcome(folder, task, "hash") == outcome("valid")
    annotation = task.path / "mobility_v2.json"
    annotation.write_text(annotation.read_text() + "\n")
    with pytest.raises(UsageError, match=rf"has changed since.*remove {home}"):
        kept_outcome(folder, task, "hash")
