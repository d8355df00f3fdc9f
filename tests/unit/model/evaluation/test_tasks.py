"""One object at a time: what a damaged or missing file costs."""

import dataclasses
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from model.evaluation import tasks
from model.evaluation.adapters.formats import Place, places
from model.evaluation.records import record_path
from model.evaluation.score import Protocol
from model.evaluation.tasks import Task, scored, work
from tests.unit.model.evaluation.adapters.outputs import (
    write_box,
    write_singapo,
    write_urdf,
    write_urdformer,
)
from tests.unit.model.evaluation.layouts import BASE

QUICK = Protocol(points=100, part_points=100, mask_pixels=8)


@pytest.fixture
def task(tmp_path: Path) -> Task:
    """A URDF against SINGAPO's tree, both of the cabinet."""
    write_singapo(tmp_path / "truth" / "x")
    write_urdf(tmp_path / "guess" / "x")
    true, predicted = (places(tmp_path / own)["x"] for own in ("truth", "guess"))
    return Task(
        name="x",
        predicted=predicted,
        true=true,
        protocol=QUICK,
        gated=False,
        folder=tmp_path / "out",
    )


def images_of(place: Place) -> Path:
    folder = place.path.parent / "images"
    folder.mkdir(exist_ok=True)
    return folder


def write_image(path: Path, *, alpha: bool, side: int = 16) -> None:
    """Gray, its left half in front where it has alpha."""
    rgba = np.full((side, side, 4), 128, np.uint8)
    rgba[:, :, 3] = np.where(np.arange(side) < side // 2, 255, 0)
    Image.fromarray(rgba if alpha else rgba[..., :3]).save(path)


def test_a_lost_object_counts_with_the_worst_value(
    task: Task, monkeypatch: pytest.MonkeyPatch
) -> None:
    def run_in_processes(waiting: list[Task], *_: object, lost: object, **__: object) -> object:
        return [lost(own, "it ran out of memory") for own in waiting]  # type: ignore[operator]

    monkeypatch.setattr(tasks, "run_in_processes", run_in_processes)
    (record,) = scored([task], workers=1)
    assert record.failure == "it ran out of memory"
    assert (record.parts, record.category) == (4, "StorageFurniture")
    assert record.metrics["joints.nearest.type_right"] == [0.0, 0.0]
    assert not record_path(task.folder, "x").exists()  # The next run tries again.

    task.true.path.write_text("{}", encoding="utf-8")
    (record,) = scored([task], workers=1)
    assert record.parts == 0
    assert not record.metrics


def test_a_damaged_truth_is_left_out(task: Task) -> None:
    task.true.path.write_text("[]", encoding="utf-8")
    record = work(task)
    assert record.failure is not None
    assert "the true object is damaged" in record.failure
    assert not record.metrics


def test_a_truth_without_a_size_is_left_out(task: Task, tmp_path: Path) -> None:
    (tmp_path / "flat").mkdir()
    file = tmp_path / "flat" / "object.json"
    file.write_text(
        '{"diffuse_tree": [{"id": 0, "parent": -1, "name": "base", "joint": {"type": "fixed"}, '
        '"aabb": {"center": [0, 0, 0], "size": [0, 0, 0]}}]}',
        encoding="utf-8",
    )
    record = work(dataclasses.replace(task, true=Place("x", "singapo", file)))
    assert record.failure is not None
    assert "all boxes are one point" in record.failure


def test_numbers_that_cannot_be_scored_are_the_worst(
    task: Task, monkeypatch: pytest.MonkeyPatch
) -> None:
    def score(*_: object, **__: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr(tasks, "score", score)
    record = work(task)
    assert record.failure is not None
    assert "mobility.urdf is read and cannot be scored: ZeroDivisionError" in record.failure
    assert record.metrics["parts.count_right"] == [0.0]


@pytest.mark.parametrize(
    ("data", "why"), [(b"", "cannot identify"), (b"\x89PNG\r\n\x1a\n\0\0", "")]
)
def test_an_image_that_is_none_shares_no_pixel(task: Task, data: bytes, why: str) -> None:
    assert task.predicted is not None
    for name in ("0.png", "1.png"):
        write_image(images_of(task.true) / name, alpha=True)
    write_image(images_of(task.predicted) / "0.png", alpha=True)
    (images_of(task.predicted) / "1.png").write_bytes(data)
    record = work(task)
    assert record.failure is None
    assert record.metrics["images.mask_iou"] == [1.0, 0.0]
    assert record.metrics["images.psnr"] == [100.0]
    assert why in record.reasons["images/1.png"]


def test_an_image_of_another_size_shares_no_pixel(task: Task) -> None:
    assert task.predicted is not None
    write_image(images_of(task.true) / "0.png", alpha=True)
    write_image(images_of(task.predicted) / "0.png", alpha=True, side=8)
    record = work(task)
    assert record.metrics["images.mask_iou"] == [0.0]
    assert "8 x 8 px is compared with one of 16 x 16" in record.reasons["images/0.png"]


def test_a_true_image_that_is_none_is_left_out(task: Task) -> None:
    assert task.predicted is not None
    (images_of(task.true) / "0.png").write_bytes(b"none")
    write_image(images_of(task.predicted) / "0.png", alpha=True)
    record = work(task)
    assert "images.mask_iou" not in record.metrics
    assert "cannot be read" in record.reasons["true images/0.png"]


def test_images_without_alpha_have_no_masks(task: Task) -> None:
    assert task.predicted is not None
    for place in (task.true, task.predicted):
        write_image(images_of(place) / "0.png", alpha=False)
    record = work(task)
    assert record.metrics["images.psnr"] == [100.0]
    assert not {"images.mask_iou", "images.psnr_foreground"} & set(record.metrics)


def test_a_missing_prediction_is_asked_what_the_others_are(task: Task) -> None:
    """No gates without --gates, no masks without pixels, no images without true ones."""
    absent = dataclasses.replace(task, predicted=None)
    beginnings = ("gates.", "masks.", "images.")
    found = work(dataclasses.replace(absent, protocol=dataclasses.replace(QUICK, mask_pixels=0)))
    assert not any(name.startswith(beginnings) for name in found.metrics)
    write_image(images_of(task.true) / "0.png", alpha=True)
    found = work(dataclasses.replace(absent, gated=True))
    for name in ("gates.passed", "masks.nearest.moving", "images.mask_iou"):
        assert found.metrics[name] == [0.0]
    assert "images.new_state.mask_iou" not in found.metrics


def test_a_record_depends_on_meshes_wherever_a_format_has_them(task: Task, tmp_path: Path) -> None:
    file = write_urdformer(tmp_path / "urdformer")
    own = dataclasses.replace(task, predicted=Place("x", "urdformer", file))
    before = own.key
    assert own.key == before
    write_box(tmp_path / "urdformer" / "meshes" / "cabinet.obj", BASE)
    assert own.key != before


def test_a_file_that_vanishes_or_may_not_be_read_is_told_by_its_reader(
    task: Task, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Hashing it before anything is scored must not end the run."""

    def refused(path: Path) -> str:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(tasks, "file_hash", refused)
    assert len(task.key) == 64
    assert task.predicted is not None
    shutil.rmtree(task.predicted.path.parent)
    assert work(task).failure is not None
