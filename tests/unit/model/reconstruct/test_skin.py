"""Texels ask the field where the surface is, and the nearest of the surface in cuts."""

import dataclasses

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.solid import slab
from model.reconstruct.shapes import ROUND, boxed, shape_of
from model.reconstruct.skin import moved_color, nearest_part, part_color
from tests.unit.model.reconstruct.perfect import COLORS, part

BLOCK = part(1, slab((0.0, 0.0, 0.0), (0.4, 0.4, 0.4)))
ON, DEEP = np.array([[0.01, 0.0, 0.0]]), np.array([[0.2, 0.2, 0.2]])


def by_place(points: Floats) -> Floats:
    """A field whose color is the place."""
    return points.clip(0.0, 1.0)


def test_points_on_the_surface_have_the_color_of_the_field() -> None:
    color = part_color(dataclasses.replace(BLOCK, shade=by_place), 0.02)
    assert np.array_equal(color(ON), ON)
    assert np.allclose(color(DEEP), COLORS[1], atol=1e-12)


def test_a_box_that_stands_for_a_field_has_its_colors_everywhere() -> None:
    color = part_color(boxed(dataclasses.replace(BLOCK, shade=by_place)), 0.02)
    assert np.array_equal(color(DEEP), DEEP)


def test_pieces_of_one_part_keep_their_own_colors() -> None:
    other = part(2, slab((1.0, 0.0, 0.0), (1.4, 0.4, 0.4)))
    color = nearest_part([BLOCK, other], 0.02)
    points = np.array([[0.1, 0.1, 0.4], [1.2, 0.1, 0.4]])
    assert np.allclose(color(points), [COLORS[1], COLORS[2]], atol=1e-12)


def test_a_moved_part_takes_its_colors_along() -> None:
    shift = np.array([0.0, 0.0, 0.3])
    assert np.allclose(moved_color(by_place, shift)(ON + shift), ON, atol=1e-15)


def test_a_boxed_part_fills_its_box_with_round_edges() -> None:
    """Edges of radius r on a free length a take (12 - 3 pi) a r^2, the corners (8 - 4 pi / 3) r^3.
    Three facets for each quarter of a circle take 0.0354 r^2 more of an edge, and of the corners
    less than of the edges, as r < a."""
    side = 0.4
    r = ROUND * side / 2.0
    a = side - 2.0 * r
    taken = (12.0 - 3.0 * np.pi) * a * r**2 + (8.0 - 4.0 * np.pi / 3.0) * r**3
    facets = 12.0 * 0.0354 * r**2 * a
    found = shape_of(boxed(BLOCK), tolerance=1e-4, triangles=1000).solid
    assert np.abs(found.bounds - BLOCK.box).max() <= 1e-12
    assert taken <= side**3 - found.volume <= taken + 2.0 * facets
