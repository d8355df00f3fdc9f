"""What the terminal says of the result."""

import math

import pytest

from artgen.articulation.types import JointType
from model.reconstruct.assemble import Assembled
from model.reconstruct.cli import part_lines, way_of
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
