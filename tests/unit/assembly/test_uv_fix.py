"""Texture keeps its density and its grain when what it lies on is scaled."""

import numpy as np
import pytest

from artgen.assembly.texels import density, ratios
from artgen.assembly.uv_fix import charts, fixed_uv, gradients, quarter_turned
from artgen.core.mesh import TriMesh
from artgen.geometry.solid import cylinder, slab
from artgen.geometry.unwrap import metric_uv

ROUNDING = 2e-5
"""UV are rounded to 1e-6 m: over sides of 0.1 m and more twice 1e-5 of a gradient."""


def board(size=(0.4, 0.02, 0.6), grain=2) -> TriMesh:
    mesh = slab(-np.array(size) / 2.0, np.array(size) / 2.0).trimesh()
    uv = metric_uv(mesh.vertices, mesh.faces, grain=grain, place=3)
    return TriMesh(vertices=mesh.vertices, faces=mesh.faces, uv=uv)


def moved(mesh: TriMesh, vertices, *, mirrored=False) -> TriMesh:
    """The mesh after a move, corrected; faces turned where it mirrors."""
    faces = mesh.faces[:, [0, 2, 1]] if mirrored else mesh.faces
    uv = mesh.uv[:, [0, 2, 1]] if mirrored else mesh.uv
    before = TriMesh(vertices=mesh.vertices, faces=faces, uv=uv)
    fixed = fixed_uv(before, vertices, mirrored=mirrored)
    return TriMesh(vertices=vertices, faces=faces, uv=fixed)


def handed(mesh: TriMesh):
    """(F,) +1 where (u, v, normal) is right-handed."""
    u, v = gradients(mesh.triangles, mesh.uv).transpose(1, 0, 2)
    normals = np.cross(*(mesh.triangles[:, k] - mesh.triangles[:, 0] for k in (1, 2)))
    return np.sign(np.einsum("ij,ij->i", np.cross(u, v), normals))


@pytest.mark.parametrize("scale", [(2.0, 1.0, 0.5), (0.5, 3.0, 1.7), (1.0, 1.0, 1.0)])
def test_density_and_stretch_survive_unequal_scales(scale):
    mesh = board()
    after = moved(mesh, mesh.vertices * scale)
    assert np.abs(density(after) - 1.0).max() < ROUNDING * 10  # The board's thin sides are 0.01 m.
    assert np.abs(ratios(after) - 1.0).max() < ROUNDING * 20


def test_left_as_they_were_texture_is_stretched():
    """The control: without the correction the two measures tell."""
    mesh = board()
    left = TriMesh(vertices=mesh.vertices * (2.0, 1.0, 0.5), faces=mesh.faces, uv=mesh.uv)
    assert ratios(left).max() == pytest.approx(4.0, rel=1e-4)
    assert density(left).max() == pytest.approx(np.sqrt(2.0), rel=1e-4)


def test_grain_runs_where_it_ran():
    mesh = board()
    after = moved(mesh, mesh.vertices * (3.0, 1.0, 0.4))
    front = np.flatnonzero((after.triangles[:, :, 1] < 0.0).all(axis=1))
    u = gradients(after.triangles[front], after.uv[front])[:, 0]
    assert np.abs(u - (0.0, 0.0, 1.0)).max() < ROUNDING


@pytest.mark.parametrize("mirrored", [False, True])
def test_images_are_not_reversed(mirrored):
    mesh = board()
    assert (handed(mesh) > 0).all()
    flip = (-1.5, 1.0, 0.8) if mirrored else (1.5, 1.0, 0.8)
    after = moved(mesh, mesh.vertices * flip, mirrored=mirrored)
    assert (handed(after) > 0).all()
    assert np.abs(density(after) - 1.0).max() < ROUNDING * 10


def test_a_chart_that_bends_keeps_its_mean_density():
    """A round bar's side is one chart: where each facet is stretched otherwise, the mean holds."""
    solid = cylinder(0.1, 0.5, segments=48).trimesh()
    angle = np.arctan2(solid.vertices[:, 1], solid.vertices[:, 0])[solid.faces]
    side = np.abs(np.ptp(solid.triangles[:, :, 2], axis=1)) > 0.1
    angle = np.where(np.ptp(angle, axis=1, keepdims=True) > np.pi, angle % (2 * np.pi), angle)
    uv = np.stack([0.1 * angle, solid.triangles[:, :, 2]], axis=-1)
    mesh = TriMesh(vertices=solid.vertices, faces=solid.faces[side], uv=uv[side])
    after = moved(mesh, mesh.vertices * (1.6, 1.6, 0.7))
    assert np.average(density(after)) == pytest.approx(np.average(density(mesh)), rel=1e-3)
    assert np.abs(ratios(after) - 1.0).max() < 1e-3


def test_charts_end_at_edges_and_at_seams():
    mesh = board()
    assert charts(mesh).max() + 1 == 6
    shifted = np.array(mesh.uv)
    shifted[0] += 0.5
    cut = TriMesh(vertices=mesh.vertices, faces=mesh.faces, uv=shifted)
    assert charts(cut).max() + 1 == 7


def test_a_quarter_turn_exchanges_the_ways_of_u_and_v_and_keeps_images_right():
    mesh = board()
    faces = np.ones(len(mesh.faces), bool)
    turned = TriMesh(vertices=mesh.vertices, faces=mesh.faces, uv=quarter_turned(mesh, faces))
    before, after = gradients(mesh.triangles, mesh.uv), gradients(turned.triangles, turned.uv)
    assert np.abs(after[:, 0] - before[:, 1]).max() < 1e-9
    assert (handed(turned) > 0).all()
