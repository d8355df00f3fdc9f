import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from artgen.core.mesh import TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.textures import TextureSet
from artgen.textures.atlas import GUTTER, LINEAR, bake_color, sample_tile, srgb_from_linear
from artgen.textures.raster import touched_texels

SIZE = 16


def quad(atlas, meters, slot=0):
    """Two triangles over a rectangle (left, bottom, right, top) of the atlas and of the surface."""

    def corners(rectangle):
        left, bottom, right, top = rectangle
        a, b, c, d = (left, bottom), (right, bottom), (right, top), (left, top)
        return [[a, b, c], [a, c, d]]

    return TriMesh(
        vertices=[(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
        faces=[(0, 1, 2), (0, 2, 3)],
        uv=corners(meters),
        atlas=corners(atlas),
        slot=[slot, slot],
    )


def checker():
    """4 x 4 fields of 2 x 2 texels, each field of another gray; row 0 is the upper edge."""
    fields = np.arange(16, dtype=np.uint8).reshape(4, 4) * 15 + 10
    return np.repeat(np.repeat(fields, 2, axis=0), 2, axis=1)[..., None].repeat(3, axis=2)


def test_a_checker_through_a_chart_comes_out_where_it_belongs():
    """The whole tile lies on the left half of the atlas, so a texel of the atlas is one of the
    tile; the tile's upper edge is up."""
    spec = SurfaceSpec(name="c", recipe="plain", tile=(0.08, 0.16))
    baked = bake_color(
        [quad((0.0, 0.0, 0.5, 0.5), (0.0, 0.0, 0.08, 0.16))],
        [spec],
        [TextureSet(color=checker())],
        size=SIZE,
    )
    assert np.array_equal(baked[8:, :8], checker())


def test_tiles_repeat_and_turn():
    """Two tiles along u, beginning half a tile in."""
    spec = SurfaceSpec(name="c", recipe="plain", tile=(0.1, 0.1))
    image = checker()
    baked = bake_color(
        [quad((0.0, 0.0, 1.0, 0.5), (0.05, 0.0, 0.25, 0.1))],
        [spec],
        [TextureSet(color=image)],
        size=SIZE,
    )
    assert np.array_equal(baked[8:], np.hstack([image[:, 4:], image, image[:, :4]]))


def test_gutters_repeat_the_border_and_the_rest_is_the_mean():
    """Two charts of one size in opposite corners, black and white."""
    colors = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    surfaces = [SurfaceSpec(name=str(c), recipe="plain", color=c) for c in colors]
    charts = (0.0, 0.0, 0.25, 0.25), (0.75, 0.75, 1.0, 1.0)
    meshes = [quad(chart, (0, 0, 1, 1), slot) for slot, chart in enumerate(charts)]
    baked = bake_color(meshes, surfaces, [TextureSet(), TextureSet()], size=32)[..., 0]
    expected = np.full((32, 32), srgb_from_linear(np.array([0.5]))[0])
    away = np.maximum(np.arange(32) - 7, 0)  # texels beyond the chart's last one
    near = np.hypot(away[:, None], away[None, :]) <= GUTTER
    expected[near[::-1]] = 0
    expected[near[:, ::-1]] = 255
    assert np.array_equal(baked, expected)


def test_each_surface_shows_on_its_own_triangles():
    red, blue = (
        SurfaceSpec(name=name, recipe="plain", color=color)
        for name, color in (("r", (1, 0, 0)), ("b", (0, 0, 1)))
    )
    halves = (0.0, 0.0, 0.5, 1.0), (0.5, 0.0, 1.0, 1.0)
    meshes = [quad(half, (0, 0, 1, 1), slot) for slot, half in enumerate(halves)]
    baked = bake_color(meshes, [red, blue], [TextureSet(), TextureSet()], size=SIZE)
    assert (baked[:, :8] == (255, 0, 0)).all()
    assert (baked[:, 8:] == (0, 0, 255)).all()


def test_occlusion_darkens_color_but_not_glow():
    spec = SurfaceSpec(name="s", recipe="plain", color=(0.5, 0.5, 0.5), emission=0.5)
    glow = np.full((4, 4, 3), 188, np.uint8)
    shade = np.linspace(0.0, 1.0, SIZE * SIZE).reshape(SIZE, SIZE)
    baked = bake_color([quad((0, 0, 1, 1), (0, 0, 1, 1))], [spec], [TextureSet(emission=glow)],
                       size=SIZE, occlusion=shade)  # fmt: skip
    expected = srgb_from_linear(0.5 * shade[..., None] + 0.5 * LINEAR[glow[0, 0]])
    assert np.array_equal(baked, expected)


def test_fine_images_are_averaged_before_they_are_read():
    """A checker of single texels read at every eighth place would be black or white; it is gray."""
    fine = (
        (np.indices((64, 64)).sum(axis=0) % 2 * 255).astype(np.uint8)[..., None].repeat(3, axis=2)
    )
    place = np.random.default_rng(5).random((50, 2))
    light = sample_tile(fine, place, tile=(1.0, 1.0), spacing=8.0 / 64.0)
    assert light == pytest.approx(0.5, abs=1e-12)


@settings(deadline=None, max_examples=60)
@given(arrays(np.int64, (6, 3, 2), elements=st.integers(0, 64)))
def test_texels_belong_to_triangles_that_hold_their_centers(lattice):
    """Against every center tested by signed areas; corners lie on quarters of a texel, so all
    products are exact. A center on an edge may count as inside or not."""
    corners = lattice / 64.0
    texels = touched_texels(corners, SIZE)
    assert len(set(texels.index.tolist())) == len(texels.index)
    centers = np.stack([texels.index % SIZE + 0.5, SIZE - texels.index // SIZE - 0.5], axis=1)
    within, held = _holds(corners[:, None] * SIZE, _centers()[None])
    found = np.zeros(SIZE * SIZE, bool)
    found[texels.index] = True
    assert found[within.any(axis=0)].all()
    inside = held[texels.triangle, texels.index]
    assert inside[within.any(axis=0)[texels.index]].all()
    points = (texels.weights[:, :, None] * corners[texels.triangle] * SIZE).sum(axis=1)
    # weights of slivers as thin as 1/64 texel keep 1e-16 * (16 texels / 2^-12 texel2) * 16 < 1e-10
    assert np.abs(points - centers)[inside].max(initial=0.0) < 1e-9


@settings(deadline=None, max_examples=60)
@given(arrays(np.float64, (4, 3, 2), elements=st.floats(0.0, 1.0, width=32)))
def test_every_triangle_touches_a_texel_however_thin(corners):
    """Each alone: its corners' texels are all among those touched, and weights stay on it."""
    for corner in corners:
        texels = touched_texels(corner[None], SIZE)
        touched = set(texels.index.tolist())
        column = np.minimum(corner[:, 0] * SIZE, SIZE - 1).astype(int)
        row = np.minimum((1.0 - corner[:, 1]) * SIZE, SIZE - 1).astype(int)
        inner = (np.modf(corner * SIZE)[0] != 0.0).all(axis=1)  # on a border either side will do
        assert set((row * SIZE + column)[inner].tolist()) <= touched
        assert (texels.weights >= 0.0).all()
        assert texels.weights.sum(axis=1) == pytest.approx(1.0, abs=1e-12)


def _centers():
    row, column = np.divmod(np.arange(SIZE * SIZE), SIZE)
    return np.stack([column + 0.5, SIZE - row - 0.5], axis=1)


def _holds(corners, points):
    """(F, N) whether triangles (F, 1, 3, 2) hold points (1, N, 2), without and with their edges;
    a triangle without area holds none."""
    sides = []
    for k in range(3):
        a, b = corners[..., k, :], corners[..., (k + 1) % 3, :]
        edge, way = b - a, points - a
        sides.append(edge[..., 0] * way[..., 1] - edge[..., 1] * way[..., 0])
    turn = np.stack(sides)
    sign = np.sign(turn.sum(axis=0))
    return (turn * sign > 0.0).all(axis=0), (turn * sign >= 0.0).all(axis=0) & (sign != 0.0)
