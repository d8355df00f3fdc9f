"""What the terminal says of the result."""

import math
from pathlib import Path

import pytest
import torch

from artgen.articulation.types import JointType
from artgen.core.errors import ModelError
from model.reconstruct.assemble import Assembled
from model.reconstruct.cli import Reconstruct, ordered, part_lines, way_of
from model.training.distributed import device_named
from tests.unit.model.reconstruct.scenes import stated


@pytest.mark.parametrize(
    ("kind", "upper", "expected"),
    [("revolute", math.pi / 2.0, "turns by 90 degrees"), ("prismatic", 0.35, "slides by 0.35 m")],
)
def test_ways_are_told_in_words(kind: JointType, upper: float, expected: str) -> None:
    assert way_of(stated("door", kind, axis=(0.0, 0.0, 1.0), upper=upper)) == expected


def test_every_part_has_a_line(perfect: Assembled) -> None:
    base, door, drawer = part_lines(perfect.object)
    assert base.startswith("base: 0.6 x ")
    assert door.endswith("turns by 90 degrees on base")
    assert drawer.endswith("slides by 0.35 m on base")


def test_a_gpu_that_is_not_there_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    cameras = tmp_path / "cameras.json"
    asked = {device: ordered(Reconstruct(images=tmp_path, cameras=cameras, device=device)).device
             for device in ("auto", "cuda")}  # fmt: skip
    assert device_named(asked["auto"]).type == "cpu"
    with pytest.raises(ModelError, match="sees no GPU"):
        device_named(asked["cuda"])
