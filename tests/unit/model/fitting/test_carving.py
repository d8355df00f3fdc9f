"""The box of a visual hull holds the object, and little more where views are many."""

import dataclasses

import pytest
import torch

from artgen.core.errors import ModelError
from model.fitting.carving import SIDE, hull_bounds
from tests.unit.model.fit_scenes import EYES, drawer, photographs


def test_the_hull_holds_the_object_and_not_the_sky() -> None:
    """All corners of the closed cabinet lie inside; the hull of five views ends within a fifth of a
    radius of it. In the second state, the drawer sticks out 0.28 further."""
    articulation, field = drawer()
    images = photographs(articulation, field, 40)
    half = articulation.size_BP3[0, :2] / 2.0
    center = articulation.center_BP3[0, :2]
    low, high = (center - half).amin(dim=0), (center + half).amax(dim=0)
    bounds = hull_bounds(images)
    step = 2.0 / (SIDE - 1)
    assert (bounds[0] <= low + step).all()
    assert (bounds[1] >= high - step).all()
    assert (bounds[0] >= low - 0.25).all()
    assert (bounds[1] <= high + 0.25).all()
    opened = hull_bounds(images, state=1)
    assert (bounds[0, 1] - opened[0, 1]).item() == pytest.approx(0.28, abs=0.15)


def test_masks_that_do_not_meet_are_told() -> None:
    articulation, field = drawer()
    images = photographs(articulation, field, 16)
    alpha = torch.zeros_like(images.alpha_BTVHW)
    alpha[:, :, 0, :3, :3] = 1.0
    blind = dataclasses.replace(images, alpha_BTVHW=alpha)
    with pytest.raises(ModelError, match=f"foreground of all {len(EYES)} views"):
        hull_bounds(blind)
