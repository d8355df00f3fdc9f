"""Handles lie on the face, within their front, and never stretched."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.assembly.handles import Place, face_depth, lie_of, mounted, turns_over
from artgen.assembly.piece import Piece, joined
from artgen.core.mesh import TriMesh
from tests.unit.assembly.test_fit import framed, piece_of

FRONT = framed()


def bar(length=0.16) -> Piece:
    return piece_of((0.0, -0.03, 0.0), (length, 0.0, 0.012))


def sizes(piece):
    return np.diff(piece.bounds, axis=0)[0]


def test_the_face_of_a_front_is_where_it_is():
    depth = face_depth(FRONT.mesh, np.array([[0.03, 0.3], [0.2, 0.35], [0.9, 0.3]]))
    assert np.allclose(depth, (0.0, 0.006, np.inf))


def test_a_bar_is_turned_onto_a_stile():
    place = Place(x=0.37, z=0.3, lie="z")
    found = mounted(bar(), place, FRONT.mesh, scale=1.0)
    assert lie_of(found.bounds) == "z"
    assert np.allclose(sizes(found), (0.012, 0.03, 0.16), atol=2e-7)
    assert found.bounds[1, 1] == pytest.approx(0.0, abs=1e-7)
    assert np.allclose(found.bounds.mean(axis=0)[[0, 2]], (0.37, 0.3), atol=2e-7)


def test_scales_are_equal_and_bounded():
    for scale, expected in ((0.8, 0.8), (5.0, 1.6), (0.1, 0.6)):
        found = mounted(bar(), Place(x=0.2, z=0.67, lie="x"), FRONT.mesh, scale=scale)
        assert np.allclose(sizes(found) / sizes(bar()), expected, atol=1e-4)


def test_a_handle_stays_within_the_sides_of_its_front():
    found = mounted(bar(), Place(x=0.0, z=0.69, lie="x"), FRONT.mesh, scale=1.0)
    assert (found.bounds[0, [0, 2]] > 0.0).all()


def test_a_handle_wider_than_its_front_is_refused():
    assert mounted(bar(0.9), Place(x=0.2, z=0.67, lie="x"), FRONT.mesh, scale=1.0) is None


def test_a_bar_across_a_stile_and_a_recess_is_refused():
    """One end of its rear would lie on the stile, all the rest 6 mm before the panel."""
    assert mounted(bar(), Place(x=0.2, z=0.35, lie="x"), FRONT.mesh, scale=1.0) is not None
    assert mounted(bar(), Place(x=0.13, z=0.35, lie="x"), FRONT.mesh, scale=1.0) is None


def test_what_is_not_symmetric_is_not_turned():
    cup = joined([bar(), piece_of((0.0, -0.01, 0.012), (0.16, 0.0, 0.05))])
    assert turns_over(bar())
    assert not turns_over(cup)


def test_a_handle_that_is_a_sheet_seen_edge_on_is_put_up_like_any_other():
    """One side of a bar that stands upright; its width of zero was divided by."""
    upright = piece_of((0.0, -0.03, 0.0), (0.012, 0.0, 0.16))
    flat = (upright.mesh.triangles[:, :, 0] == 0.0).all(axis=1)
    used, index = np.unique(upright.mesh.faces[flat], return_inverse=True)
    side = TriMesh(
        vertices=upright.mesh.vertices[used],
        faces=index.reshape(-1, 3),
        uv=np.zeros((len(index) // 3, 3, 2)),
    )
    sheet = replace(upright, mesh=side, shells={0: 0.004})
    assert turns_over(sheet)
    found = mounted(sheet, Place(x=0.37, z=0.3, lie="z"), FRONT.mesh, scale=1.0)
    assert np.allclose(sizes(found), (0.0, 0.03, 0.16), atol=2e-7)
