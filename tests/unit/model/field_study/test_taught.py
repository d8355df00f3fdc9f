"""Planes that are taught come nearer to the scene, and the same way twice."""

import pytest
import torch

from artgen.core.stream import Stream
from model.field_study import taught as module
from model.field_study.measure import surface_points
from model.field_study.scene import boards
from model.field_study.taught import Taught


def test_teaching_brings_distances_near(monkeypatch: pytest.MonkeyPatch) -> None:
    """To less than a third of the ball's error in 25 steps."""
    monkeypatch.setattr(module, "BATCH", 256)
    field, slots = boards(), torch.arange(3)
    points = surface_points(field, Stream(0, "surface"), count=256)
    errors = []
    for steps in (1, 25):
        student = Taught(field, 16, steps, Stream(0, "student"))
        with torch.no_grad():
            found = student.field().distances(points, slots)
        errors.append((found - field.distances(points, slots)).abs().mean().item())
    assert errors[1] < errors[0] / 3
    again = Taught(field, 16, 25, Stream(0, "student"))
    assert torch.equal(again.planes, student.planes)


def test_points_of_the_surface_lie_on_it() -> None:
    """The nearest of 32 times as many even draws in a box of about 1 by 1 by 1 whose boards have
    some four square radii of surface: within 1 / 32 / (2 * 4) of it at the median; thrice that."""
    field = boards()
    points = surface_points(field, Stream(0, "surface"), count=256)
    distances = field.distances(points, torch.arange(3)).abs()
    assert distances.max() < 3 / 256
