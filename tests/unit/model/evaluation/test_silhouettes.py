"""Masks by rays: a plain projection of a box says the same."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from artgen.articulation.targets import FIXED, PRISMATIC
from model.evaluation.boxes import corners
from model.evaluation.matching import by_nearness, by_order
from model.evaluation.reshape import placed, taken
from model.evaluation.silhouettes import cameras, mask_scores, masks, placed_triangles
from tests.unit.model.evaluation.layouts import DOOR, cabinet, with_box_meshes

PIXELS = 48


def test_the_truth_covers_itself() -> None:
    truth = with_box_meshes(cabinet())
    found = mask_scores(truth, truth, {"order": by_order(3, 3)}, pixels=PIXELS)["order"]
    assert (found.base, found.moving, found.composite) == (1.0, 1.0, 1.0)


def test_a_box_covers_the_hull_of_its_projected_corners() -> None:
    """Pixel centers within the hull of the eight corners; the caster's float32 rays may miss those
    on the outline, at most one in twenty of a mask this small."""
    layout = cabinet()
    for camera in cameras(layout, PIXELS):
        seen = masks(placed_triangles(layout, 0.0), camera)[2]
        plane = ConvexHull(camera.project(corners(np.array(DOOR)))[:, :2]).equations
        grid = np.stack(np.meshgrid(*[np.arange(PIXELS) + 0.5] * 2), axis=-1)
        inside = (grid @ plane[:, :2].T + plane[:, 2] <= 0.0).all(axis=-1)
        assert (seen ^ inside).sum() <= 0.05 * inside.sum()
        assert inside.sum() > 20


def test_parts_are_seen_through_each_other() -> None:
    """A drawer inside the base has a mask of its own, however the base hides it."""
    layout = cabinet()
    seen = masks(placed_triangles(layout, 0.0), cameras(layout, PIXELS)[3])
    assert seen[1].any()
    assert (seen[1] <= seen[0]).mean() > 0.95


def test_a_missing_part_counts_nothing_and_a_shifted_one_less() -> None:
    truth = cabinet()
    fewer = taken(truth, [0, 1])
    matchings = {"nearest": by_nearness(fewer.centers, truth.centers)}
    found = mask_scores(fewer, truth, matchings, pixels=PIXELS)["nearest"]
    assert found.base == 1.0
    assert found.moving == pytest.approx(0.5, abs=1e-12)
    away = mask_scores(
        placed(truth, shift=(9.0, 0.0, 0.0)), truth, {"order": by_order(3, 3)}, pixels=PIXELS
    )
    assert away["order"].composite == 0.0


def test_the_base_is_the_base_alone() -> None:
    """A fixed part that is not it, such as a handle, is seen in the whole object only."""
    truth = cabinet(types=np.array([FIXED, PRISMATIC, FIXED]))
    boxes = truth.boxes.copy()
    boxes[2] += (0.0, -9.0, 0.0)
    guess = cabinet(types=truth.types, boxes=boxes)
    found = mask_scores(guess, truth, {"order": by_order(3, 3)}, pixels=PIXELS)["order"]
    assert (found.base, found.moving) == (1.0, 1.0)
    assert found.composite is not None
    assert found.composite < 1.0
