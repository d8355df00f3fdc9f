"""Contact pieces are convex, lie inside their part, and leave its hollows open."""

import numpy as np
import pytest

from artgen.geometry.solid import Solid, cylinder, slab, union
from model.reconstruct.contact import contact_pieces, kernel, points_inside
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


def frame(thick: float) -> Solid:
    """Four rods of three sides around an opening of 0.8 x 2.2 m, slender and slanted inward."""
    upright = cylinder(thick, 2.2, segments=3)
    across = cylinder(thick, 0.8, segments=3).turned("y", np.pi / 2.0)
    return union(
        [upright.at(x=-0.4), upright.at(x=0.4), across.at(z=-1.1), across.at(z=1.1)]
    ).turned("z", 0.3)


@pytest.mark.parametrize("thick", [0.02, 0.0005], ids=["boxes", "cube"])
def test_contact_of_a_frame_leaves_its_opening_open(thick: float) -> None:
    """Its hull would close it. Boxes may stick out by 2 mm3 (edges of 0.1 mm), the smallest cube
    has 4e-5 m a side; the opening begins 2 rods from the middles."""
    solid = frame(thick)
    opening = slab((-0.4 + 2 * thick, -0.5, -1.05), (0.4 - 2 * thick, 0.5, 1.05)).turned("z", 0.3)
    pieces = contact_pieces(solid, slanted=10)
    assert pieces
    for piece in pieces:
        assert (piece & opening).volume <= 1e-12
        assert (piece - solid).volume <= 2e-9
    assert (solid.hull() & opening).volume > 1e-3


def test_a_kernel_lies_inside() -> None:
    for solid in (TRAY, TURNED, frame(0.02), frame(0.0005)):
        cube = kernel(solid)
        assert cube.volume > 0.0
        assert (cube - solid).volume <= 1e-6 * cube.volume


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
