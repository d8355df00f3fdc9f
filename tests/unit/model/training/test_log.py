"""The record of a run, as one reads it after the run was killed and resumed."""

from pathlib import Path

import numpy as np
from PIL import Image
from tensorboard.backend.event_processing.event_accumulator import (  # type: ignore[import-untyped]
    EventAccumulator,
)

from model.training.log import TrainLog, read_lines


def written(folder: Path, *, step: int, until: int) -> None:
    log = TrainLog(folder, step=step)
    for number in range(step + 1, until + 1):
        log.write(number, {"total": 1.0 / number})
    log.close()


def test_a_resumed_log_has_each_step_once(tmp_path: Path) -> None:
    written(tmp_path, step=0, until=5)
    with (tmp_path / "log.jsonl").open("a") as stream:
        stream.write('{"step": 6, "to')  # Killed within a line.
    written(tmp_path, step=3, until=7)
    lines = read_lines(tmp_path / "log.jsonl")
    assert lines == [{"step": step, "total": 1.0 / step} for step in range(1, 8)]


def test_tensorboard_shows_the_same_curve(tmp_path: Path) -> None:
    written(tmp_path, step=0, until=4)
    curves = EventAccumulator(str(tmp_path / "tensorboard"))
    curves.Reload()
    points = [(event.step, event.value) for event in curves.Scalars("total")]
    assert points == [(step, float(np.float32(1.0 / step))) for step in range(1, 5)]


def test_pictures_are_kept_to_the_pixel(tmp_path: Path) -> None:
    image = np.arange(36, dtype=np.uint8).reshape(3, 4, 3)
    log = TrainLog(tmp_path, step=0)
    log.picture(12, image)
    log.close()
    with Image.open(tmp_path / "pictures" / "step_00000012.png") as found:
        assert np.array_equal(np.asarray(found), image)


def test_no_log_has_no_lines(tmp_path: Path) -> None:
    assert read_lines(tmp_path / "log.jsonl") == []
