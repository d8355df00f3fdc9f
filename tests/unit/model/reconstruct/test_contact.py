"""Contact pieces are convex, lie inside their part, and leave its hollows open."""

import numpy as np
import pytest

from artgen.geometry.solid import Solid, cylinder, slab, union
from model.reconstruct.contact import contact_pieces, points_inside
from tests.unit.model.reconstruct.perfect import open_box

TRAY = open_box(np.zeros(3), np.array([0.5, 0.4, 0.2]), 0.01, open_to=2, side=1)
TURNED = TRAY.turned("z", 0.5).turned("x", 0.3)


@pytest.mark.parametrize("solid", [TRAY, TURNED], ids=["straight", "turned"])
def test_boxes_lie_inside_and_apart(solid: Solid) -> None:
    """Also where the part stands slanted: boxes are inset by 0.02 mm, turning costs 1e-16."""
    pieces = contact_pieces(solid, slanted=10)
    for k, piece in enumerate(pieces):
        assert (piece - solid).volume <= 1e-12
        for other in pieces[k + 1 :]:
            assert (piece & other).volume <= 1e-15


@pytest.mark.parametrize("solid", [TRAY, TURNED], ids=["straight", "turned"])
def test_the_boxes_of_a_tray_are_its_walls(solid: Solid) -> None:
    """All but the insets of 0.02 mm on walls of 10 mm: 0.4 % of a wall, and edges."""
    pieces = contact_pieces(solid, slanted=10)
    assert 0.99 <= sum(piece.volume for piece in pieces) / solid.volume <= 1.0
    assert len(pieces) <= 6


def test_a_convex_part_is_stood_for_by_its_hull() -> None:
    bar = cylinder(0.02, 0.3)
    (piece,) = contact_pieces(bar, slanted=10)
    assert abs(piece.volume / bar.volume - 1.0) <= 1e-9


def test_points_inside_agree_with_a_formula() -> None:
    """Two boxes; a point within 1e-6 of a face would be undecided, and none is drawn
    there."""
    one, other = slab((0.0, 0.0, 0.0), (0.4, 0.3, 0.2)), slab((0.1, 0.1, 0.5), (0.6, 0.2, 0.7))
    places = [np.linspace(-0.05, 0.65, 15) + 0.0013 * (k + 1) for k in range(3)]
    found = points_inside(union([one, other]).trimesh(), places)
    grid = np.stack(np.meshgrid(*places, indexing="ij"), axis=-1)
    expected = np.zeros(found.shape, bool)
    for solid in (one, other):
        lower, upper = solid.bounds
        expected |= ((grid > lower) & (grid < upper)).all(axis=-1)
    assert np.array_equal(found, expected)
