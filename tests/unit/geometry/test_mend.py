"""Flat triangles go, the solid stays."""

import numpy as np
import pytest

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints
from artgen.geometry.measure import moments, open_edges
from artgen.geometry.mend import without_crumbs, without_flat_triangles
from artgen.geometry.solid import box, union

TETRAHEDRON = np.array([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1)])


def with_flat_triangle(middle: float) -> tuple[Floats, Ints]:
    """A tetrahedron whose edge 0-1 carries a fifth vertex, on one side by a flat triangle."""
    vertices = np.concatenate([TETRAHEDRON, [(middle, 0.0, 0.0)]])
    faces = [(0, 2, 1), (0, 1, 4), (0, 4, 3), (4, 1, 3), (0, 3, 2), (1, 2, 3)]
    return vertices, np.array(faces, np.int32)


def areas(vertices: Floats, faces: Ints) -> Floats:
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0)


@pytest.mark.parametrize("middle", [0.05, 0.0001, 0.0999999])
def test_a_flat_triangle_is_flipped_away(middle: float) -> None:
    """The bug: a laptop's base came out of rounding with two triangles of no area."""
    vertices, faces = with_flat_triangle(middle)
    assert open_edges(faces) == 0
    assert areas(vertices, faces).min() == 0.0
    mended, kept = without_flat_triangles(vertices, faces)
    assert open_edges(kept) == 0
    assert areas(mended, kept).min() > 1e-14
    assert set(map(tuple, mended.tolist())) <= set(map(tuple, vertices.tolist()))
    # Ten tetrahedra of at most 1e-3 m3, an ulp each: 1e-18 m3.
    assert moments(mended[kept]).volume == pytest.approx(0.1**3 / 6.0, abs=1e-18)


def test_a_sound_surface_is_left_alone() -> None:
    faces = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)], np.int32)
    vertices, kept = without_flat_triangles(TETRAHEDRON, faces)
    assert vertices is TETRAHEDRON
    assert kept is faces


def test_an_open_surface_is_refused() -> None:
    vertices, faces = with_flat_triangle(0.05)
    with pytest.raises(GeometryError, match="cannot be mended"):
        without_flat_triangles(vertices, faces[:-1])


def test_crumbs_are_dropped_and_nothing_else() -> None:
    """Beside a box with a cavity, which is no crumb: a grain of 1 mm, a sliver of 1e-13 m3."""
    body = box((0.1, 0.1, 0.1)) - box((0.05, 0.05, 0.05)).at(z=0.02)
    grain = box((1e-3, 1e-3, 1e-3)).at(x=0.2)
    sliver = box((1e-3, 1e-4, 1e-6)).at(x=0.3)
    sound, crumbed = union([body, grain]).trimesh(), union([body, grain, sliver]).trimesh()
    vertices, faces = without_crumbs(crumbed.vertices, crumbed.faces)
    assert (len(vertices), len(faces)) == (len(sound.vertices), len(sound.faces))
    assert vertices[:, 0].max() < 0.25
    same = without_crumbs(sound.vertices, sound.faces)
    assert same[0] is sound.vertices
    assert same[1] is sound.faces
    alone = sliver.trimesh()
    assert without_crumbs(alone.vertices, alone.faces)[1] is alone.faces
