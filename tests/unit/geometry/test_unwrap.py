"""Two UV sets: meters on the surface, and an atlas that covers nothing twice."""

import manifold3d as m3
import numpy as np
from numpy.testing import assert_allclose

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid, box, chamfered_box, cylinder, union, wire
from artgen.geometry.unwrap import atlas_uv, flat_uv, metric_uv, texel_density
from tests.texels import shared_area

GRID = 512


def texels(triangle: Floats) -> set[tuple[int, int]]:
    """Texel centers strictly inside a UV triangle: the slow, plain definition."""
    a, b, c = triangle * GRID
    low, high = np.floor(triangle.min(0) * GRID).astype(int), np.ceil(triangle.max(0) * GRID)
    found = set()
    for i in range(low[0], int(high[0]) + 1):
        for j in range(low[1], int(high[1]) + 1):
            p = np.array([i + 0.5, j + 0.5])
            sides = [
                (q[0] - o[0]) * (p[1] - o[1]) - (q[1] - o[1]) * (p[0] - o[0])
                for o, q in ((a, b), (b, c), (c, a))
            ]
            # 1e-5 of rounding on UV is 5e-3 of a texel; over an edge of some texels it shifts the
            # doubled area by less than 0.05.
            if min(sides) > 0.05 or max(sides) < -0.05:
                found.add((i, j))
    return found


def arrays(solid: Solid) -> tuple:
    mesh = solid.trimesh()
    return mesh.vertices, mesh.faces


def test_the_atlas_lies_in_the_square_and_overlaps_nowhere() -> None:
    shapes = [
        box((0.4, 0.3, 0.02)) - box((0.2, 0.1, 0.02)),
        cylinder(0.05, 0.3),
        union([chamfered_box((0.02, 0.02, 0.01), 0.002, at=(0.03 * k, 0, 0)) for k in range(9)]),
        wire([(0, 0, 0), (0.3, 0, 0), (0.3, 0.2, 0.1)], 0.01),
    ]
    placed = atlas_uv([arrays(s) for s in shapes], resolution=GRID)
    assert min(uv.min() for uv in placed) >= 0.0
    assert max(uv.max() for uv in placed) <= 1.0
    taken: set[tuple[int, int]] = set()
    for uv in placed:
        for triangle in uv:
            mine = texels(triangle)
            assert not mine & taken
            taken |= mine
    assert len(taken) > 0.3 * GRID * GRID


def test_the_atlas_is_the_same_twice_and_keeps_density() -> None:
    parts = [arrays(box((0.4, 0.3, 0.02))), arrays(box((0.1, 0.1, 0.5)))]
    first, second = atlas_uv(parts, resolution=GRID), atlas_uv(parts, resolution=GRID)
    for one, two in zip(first, second, strict=True):
        assert (one == two).all()
    density = np.concatenate(
        [texel_density(v[f], uv) for (v, f), uv in zip(parts, first, strict=True)]
    )
    # xatlas rounds charts up to whole texels: 0.02 m of 0.5 m on 512 texels is 10 texels, 20 %.
    assert density.max() / density.min() < 1.25


def test_metric_uv_has_true_lengths_with_the_grain_along_the_long_side() -> None:
    vertices, faces = arrays(box((0.8, 0.3, 0.02)))
    uv = metric_uv(vertices, faces, grain=None, place=0)
    assert_allclose(texel_density(vertices[faces], uv), 1.0, atol=1e-4)
    corners = vertices[faces]
    top = (corners[..., 2] > 0.019).all(axis=1)
    assert_allclose(np.ptp(uv[top][..., 0]), 0.8, atol=2e-6)
    assert_allclose(np.ptp(uv[top][..., 1]), 0.3, atol=2e-6)


def test_metric_uv_mirrors_nothing() -> None:
    """(u, v, normal) is right-handed on every face, so writing would read the right way round."""
    vertices, faces = arrays(box((0.8, 0.3, 0.2)))
    uv = metric_uv(vertices, faces, grain=1, place=3)
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0).all()


def test_a_decal_reads_metres_from_its_corner() -> None:
    vertices, faces = arrays(box((0.3, 0.2, 0.01)))
    uv = flat_uv(vertices, faces, origin=(-0.15, -0.1, 0.01), right=(1, 0, 0), up=(0, 1, 0))
    assert_allclose(uv.reshape(-1, 2).min(axis=0), 0.0, atol=1e-6)
    assert_allclose(uv.reshape(-1, 2).max(axis=0), (0.3, 0.2), atol=1e-6)


def test_a_helix_does_not_lie_over_itself_on_the_atlas() -> None:
    """A ribbon of three turns, whose faces all look up and join: one chart would cover itself."""
    turn = np.linspace(0.0, 6.0 * np.pi, 97)
    inner, outer = (
        np.stack([r * np.cos(turn), r * np.sin(turn), 0.002 * turn], axis=1) for r in (0.02, 0.03)
    )
    k = np.arange(96)
    faces = np.concatenate(
        [np.stack([k, k + 97, k + 98], axis=1), np.stack([k, k + 98, k + 1], axis=1)]
    )
    (atlas,) = atlas_uv([(np.concatenate([inner, outer]), faces)], resolution=512)
    a, b = atlas[:, 1] - atlas[:, 0], atlas[:, 2] - atlas[:, 0]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2.0
    union = m3.CrossSection(list(atlas), m3.FillRule.NonZero).area()
    assert area.sum() > 0.05
    assert union > (1.0 - 2e-3) * area.sum()


def test_two_faces_that_meet_in_a_corner_do_not_lie_over_each_other() -> None:
    """Both face up, so they would be one chart, and the upper one would cover the lower one."""
    vertices = np.array(
        [(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.1, 0.0, 0.02), (0.0, 0.1, 0.02)]
    )
    faces = np.array([(0, 1, 2), (0, 3, 4)], np.int32)
    (atlas,) = atlas_uv([(vertices, faces)], resolution=256)
    # Corners are rounded to 1e-6 of the atlas, whose edges are 1 long.
    assert shared_area(atlas) < 1e-5
