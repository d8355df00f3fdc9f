"""Donors on slots: boxes agree, frames keep their width, solids stay solids."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.articulation.types import Grip
from artgen.assembly.fit import BoxMap, box_map, fitted, frame_borders, moved_piece
from artgen.assembly.piece import Piece, body_boxes, body_volumes, joined
from artgen.core.mesh import TriMesh
from artgen.geometry.convex import as_box, convexity_gap
from artgen.geometry.solid import hull, slab
from artgen.geometry.unwrap import metric_uv

SLOT = np.array([[1.0, -0.52, 0.2], [1.9, -0.5, 0.6]])
GRID = 1.1e-7
"""m; vertices are rounded to 1e-7 m."""


def piece_of(lower, upper) -> Piece:
    mesh = slab(lower, upper).trimesh()
    uv = metric_uv(mesh.vertices, mesh.faces, grain=None, place=0)
    return Piece(
        mesh=TriMesh(vertices=mesh.vertices, faces=mesh.faces, uv=uv),
        densities=(600.0,),
        collision=(mesh,),
    )


def framed(width=0.06) -> Piece:
    """A door of 0.4 x 0.7 m: stiles, rails, a panel."""
    x, z, w = 0.4, 0.7, width
    boards = [
        ((0, 0, 0), (w, 0.02, z)), ((x - w, 0, 0), (x, 0.02, z)),
        ((w, 0, 0), (x - w, 0.02, w)), ((w, 0, z - w), (x - w, 0.02, z)),
        ((w, 0.006, w), (x - w, 0.014, z - w)),
    ]  # fmt: skip
    return joined([piece_of(low, high) for low, high in boards])


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_box_of_a_fitted_body_is_the_slot(mirrored):
    door = framed()
    body = fitted(door, box_map(door, SLOT, mirrored=mirrored))
    assert np.abs(body.bounds - SLOT).max() < GRID
    assert (body_volumes(body.mesh) > 0.0).all()
    assert len(body.densities) == 5


def test_frames_keep_their_width_and_the_middle_takes_what_is_left():
    door = framed()
    assert np.abs(frame_borders(door)[:, [0, 2]] - 0.06).max() < 1e-12
    boxes = body_boxes(fitted(door, box_map(door, SLOT, mirrored=False)).mesh)
    sizes = boxes[:, 1] - boxes[:, 0]
    assert np.abs(sizes[:2, 0] - 0.06).max() < 2 * GRID
    assert np.abs(sizes[2:4, 2] - 0.06).max() < 2 * GRID
    assert np.abs(sizes[4, [0, 2]] - (0.9 - 0.12, 0.4 - 0.12)).max() < 2 * GRID


def test_a_frame_that_would_leave_no_middle_is_scaled():
    door = framed(width=0.1)
    small = np.array([[0.0, 0.0, 0.0], [0.2, 0.02, 0.7]])
    sizes = np.diff(body_boxes(fitted(door, box_map(door, small, mirrored=False)).mesh), axis=1)
    assert sizes[0, 0, 0] == pytest.approx(0.05, abs=2 * GRID)


def test_a_mirrored_door_is_the_mirror_image():
    door = framed()
    lopsided = joined([door, piece_of((0.33, -0.002, 0.3), (0.39, 0.0, 0.36))])
    one, other = (
        fitted(lopsided, box_map(lopsided, SLOT, mirrored=m)).mesh.vertices for m in (False, True)
    )
    assert np.abs(one[:, 0] + other[:, 0] - SLOT[:, 0].sum()).max() < 2 * GRID
    assert np.abs(one[:, 1:] - other[:, 1:]).max() < GRID


def test_collision_boxes_stay_boxes_and_hulls_stay_convex():
    door = framed()
    wedge = hull([(0, 0, 0), (0.4, 0, 0), (0.2, 0.02, 0.7), (0.05, 0.02, 0.1), (0.1, 0, 0.69)])
    piece = replace(door, collision=(*door.collision[:1], wedge.trimesh()))
    box, other = fitted(piece, box_map(piece, SLOT, mirrored=True)).collision
    assert as_box(box) is not None
    assert convexity_gap(other) < 1e-6
    assert (body_volumes(TriMesh(vertices=box.vertices, faces=box.faces)) > 0.0).all()


def test_grips_go_where_the_surface_goes():
    grip = Grip(name="g", kind="edge", position=(0.39, 0.0, 0.35), outward=(1.0, 0.0, 0.0),
                pull=(0.0, -1.0, 0.0))  # fmt: skip
    piece = replace(piece_of((0, 0, 0), (0.4, 0.02, 0.7)), grips=(grip,))
    how = BoxMap(source=piece.bounds, target=SLOT, borders=np.zeros((2, 3)), mirrored=True)
    moved = fitted(piece, how).grips[0]
    assert np.allclose(moved.position, (1.0 + 0.9 * 0.01 / 0.4, -0.52, 0.4), atol=1e-9)
    assert moved.outward == (-1.0, 0.0, 0.0)
    assert moved.pull == (0.0, -1.0, 0.0)


def test_a_scaled_handle_keeps_its_shape_and_its_texture_in_metres():
    piece = piece_of((0, 0, 0), (0.1, 0.03, 0.02))
    matrix = np.diag([1.5, 1.5, 1.5, 1.0])
    moved = moved_piece(piece, matrix)
    assert np.allclose(np.diff(moved.bounds, axis=0), (0.15, 0.045, 0.03))
    assert np.allclose(moved.mesh.uv, np.asarray(piece.mesh.uv) * 1.5)
