"""Collision pieces: convex, covering, and leaving hollows open."""

import manifold3d as m3
import numpy as np
import pytest

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.convex import convexity_gap
from artgen.geometry.distance import inside_bodies
from artgen.geometry.solid import box
from artgen.ingest.meshes.cuts import clipped
from artgen.ingest.meshes.pieces import convex_pieces
from tests.unit.ingest.meshes.made import bodies_from

GAP = 1e-5
"""m; the validator's bound of convexity."""


def tray(wall: float = 0.01) -> Floats:
    """A closed box without its lid, walls of some thickness."""
    hollow = box((0.4 - 2 * wall, 0.3 - 2 * wall, 0.2), at=(0.0, 0.0, wall))
    return (box((0.4, 0.3, 0.2)) - hollow).trimesh().triangles


def open_sheets() -> Floats:
    """A box's sides and bottom as sheets without thickness."""
    triangles = box((0.4, 0.3, 0.2)).trimesh().triangles
    top = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])[:, 2] > 0
    return triangles[~top]


def holds(pieces: tuple[TriMesh, ...], point: Floats) -> bool:
    return any(bool(inside_bodies(piece, np.array([point]))[0]) for piece in pieces)


@pytest.mark.parametrize("corners", [tray(), open_sheets()], ids=["solid", "sheets"])
def test_a_tray_stays_open_and_its_walls_stand(corners: Floats) -> None:
    pieces = convex_pieces({"part": bodies_from(corners)}, most=24)["part"]
    assert len(pieces) == 5
    assert not holds(pieces, np.array([0.0, 0.0, 0.1]))
    assert not holds(pieces, np.array([0.15, 0.1, 0.15]))
    assert holds(pieces, np.array([0.0, 0.0, 0.0005]))
    assert holds(pieces, np.array([0.1995, 0.0, 0.1]))
    assert max(convexity_gap(piece) for piece in pieces) <= GAP


@pytest.mark.parametrize("sides", [1, 2])
def test_a_frame_of_open_surfaces_stays_open(sides: int) -> None:
    """The front flange of an oven: a flat sheet with a hole, or its front and back without rims."""
    frame = (box((0.6, 0.1, 0.5)) - box((0.5, 0.2, 0.4), at=(0.0, 0.0, 0.05))).trimesh().triangles
    normal = np.cross(frame[:, 1] - frame[:, 0], frame[:, 2] - frame[:, 0])
    sheet = frame[normal[:, 1] < -1e-9]
    behind = np.where(np.arange(3) == 1, sheet + 0.008, sheet)[:, ::-1]
    sheet = sheet if sides == 1 else np.concatenate([sheet, behind])
    pieces = convex_pieces({"part": bodies_from(sheet)}, most=24)["part"]
    assert 4 <= len(pieces) <= 8
    assert not holds(pieces, np.array([0.0, -0.0495, 0.25]))
    assert holds(pieces, np.array([0.28, -0.0495, 0.25]))


def test_pieces_of_a_solid_cover_it() -> None:
    solid = m3.Manifold(m3.Mesh64(*_arrays(tray())))
    pieces = convex_pieces({"part": bodies_from(tray())}, most=24)["part"]
    hulls = [m3.Manifold.hull_points(np.array(piece.vertices)) for piece in pieces]
    left = solid - m3.Manifold.batch_boolean(hulls, m3.OpType.Add)
    # Rounding to 1e-7 m moves faces of 0.1 m2 each by half as much: 1e-8 m3 in all.
    assert left.volume() <= 1e-8


def test_a_box_is_one_piece_and_one_inside_it_none() -> None:
    corners = np.concatenate([
        box((1.0, 1.0, 1.0)).trimesh().triangles,
        box((0.1, 0.1, 0.1), at=(0.0, 0.0, 0.5)).trimesh().triangles,
    ])  # fmt: skip
    pieces = convex_pieces({"part": bodies_from(corners)}, most=24)["part"]
    assert len(pieces) == 1


def test_pieces_of_a_part_make_room_for_another_inside_its_hollow() -> None:
    """A deep cup and a peg that stands in it without touching."""
    cup = (box((0.1, 0.1, 0.2)) - box((0.09, 0.09, 0.2), at=(0.0, 0.0, 0.01))).trimesh().triangles
    peg = box((0.08, 0.08, 0.15), at=(0.0, 0.0, 0.02)).trimesh().triangles
    parts = {"cup": bodies_from(cup), "peg": bodies_from(peg)}
    found = convex_pieces(parts, most=16)
    hulls = {name: m3.Manifold.batch_boolean(
        [m3.Manifold.hull_points(np.array(piece.vertices)) for piece in own], m3.OpType.Add)
        for name, own in found.items()}  # fmt: skip
    assert (hulls["cup"] ^ hulls["peg"]).volume() == 0.0


def test_a_lone_triangle_gets_a_piece_with_a_volume() -> None:
    corners = np.array([[[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.0, 0.2, 0.1]]])
    (piece,) = convex_pieces({"part": bodies_from(corners)}, most=24)["part"]
    assert m3.Manifold.hull_points(np.array(piece.vertices)).volume() > 0.0


@pytest.mark.parametrize("place", [0.0, 0.013, 0.1])
def test_clipping_keeps_the_area_and_crosses_nothing(place: float) -> None:
    """Areas of the two sides sum to the whole: a few hundred roundings of 1e-16."""
    corners = tray()
    above, below = clipped(corners, corners[..., 2] - place)
    assert _area(above) + _area(below) == pytest.approx(_area(corners), rel=1e-12)
    assert above[..., 2].min() >= place - 1e-15
    assert below[..., 2].max(initial=-1.0) <= place + 1e-15


def _area(corners: Floats) -> float:
    edges = corners[:, 1:] - corners[:, :1]
    return float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2.0)


def _arrays(corners: Floats) -> tuple[Floats, Floats]:
    points, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    return points, index.reshape(-1, 3).astype(np.uint64)
