"""The shading model agrees with closed forms where there are some."""

import math
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

from artgen.core.errors import RenderError
from artgen.core.surface import SurfaceSpec
from artgen.export.glb_content import Skin
from artgen.geometry.solid import box, cylinder
from artgen.imaging import Singles
from artgen.render_job import Environment, LightRig, Sky
from renders.fast.backend import FastBackend
from renders.fast.filtered import (
    HEIGHT,
    Blur,
    basis,
    directions,
    solid_angles,
    split_sum,
    white_wall,
)
from renders.glb import Appearance, Look, surfaces_by_name
from tests.unit.renders.fast.made import DARK, EVEN, SIZE, camera, drawn, lamp, matte, shot, skin

MIDDLE = (slice(SIZE // 2 - 2, SIZE // 2 + 2),) * 2


@pytest.fixture(scope="module")
def backend() -> FastBackend:
    return FastBackend()


def seen(image: Singles) -> Singles:
    """(N, 3) fully covered pixels."""
    return image[image[..., 3] == 1.0][:, :3]


def test_a_convex_body_in_a_furnace_shows_its_albedo(backend: FastBackend) -> None:
    """Under even light of radiance 1 a matte body shows its albedo everywhere. Half floats of the
    grid round by 5e-4; a cell at a corner may see part of the body itself, of which light between
    surfaces returns the most."""
    ball = skin(cylinder(0.4, 0.8, segments=48), "ball", "gray")
    view = camera(ball.vertices, azimuth=30, elevation=30)
    (image,) = drawn(backend, [ball], [matte("gray", 0.5)], view)
    values = seen(image)
    assert len(values) > 400
    assert np.abs(np.median(values) - 0.5) < 0.005
    assert values.max() < 0.5 * (1 + 1e-3)
    assert values.min() > 0.45


def test_a_mirror_in_a_furnace_is_lost(backend: FastBackend) -> None:
    """A smooth white metal mirrors light of radiance 1 as 1: the table of the split sum is good to
    1 %, and near edges the grid takes the block's own cells for something in the way."""
    block = skin(box((0.5, 0.5, 0.5)), "block", "metal")
    metal = SurfaceSpec(name="metal", recipe="plain", color=(1.0,) * 3, roughness=0.2, metallic=1.0)
    (image,) = drawn(backend, [block], [metal], camera(block.vertices, azimuth=40, elevation=30))
    values = seen(image)
    assert abs(np.median(values) - 1.0) < 0.03
    assert 0.9 < values.min() <= values.max() < 1.01


def test_a_softbox_lights_a_wall_by_its_form_factor(backend: FastBackend) -> None:
    """A square of side 2 s at distance d in front of a point has form factor
    4 / pi * A * atan(A), A = s / hypot(s, d) (Howell's catalog, B-4, four times). The disk of its
    area has 1 / (pi + 1) where this is 0.239: 1 % more, and ours hang farther away."""
    wall = skin(box((0.4, 0.05, 0.4), at=(0.0, 0.0, -0.2)), "wall", "white")
    distance, side = 1.0, 1.0
    light = lamp((0.0, -0.025 - distance, 0.0), (0.0, -0.025, 0.0), side)
    rig = LightRig(name="one", lights=(light,), sky=DARK)
    (image,) = drawn(backend, [wall], [matte("white", 0.8)], camera(wall.vertices), rig=rig)
    reach = (side / 2) / math.hypot(side / 2, distance)
    expected = 0.8 * 4.0 / math.pi * reach * math.atan(reach)
    assert image[MIDDLE][..., :3] == pytest.approx(expected, rel=0.015)


def test_a_softbox_does_not_shine_backward(backend: FastBackend) -> None:
    wall = skin(box((0.4, 0.05, 0.4), at=(0.0, 0.0, -0.2)), "wall", "white")
    rig = LightRig(name="one", lights=(lamp((0.0, -1.0, 0.0), (0.0, -2.0, 0.0), 1.0),), sky=DARK)
    (image,) = drawn(backend, [wall], [matte("white", 0.8)], camera(wall.vertices), rig=rig)
    assert not image[..., :3].any()


def test_a_clear_pane_passes_what_fresnel_leaves(backend: FastBackend) -> None:
    """Both faces at right angles leave (1 - 0.04)^2 at an index of 1.5, dimmed by the tint at each;
    alpha is the rest. The view is off by up to 0.02 rad, which changes Fresnel's share by 1e-5."""
    pane = skin(box((0.5, 0.01, 0.5)), "pane", "glass")
    tint = (0.9, 0.8, 0.7)
    glass = SurfaceSpec(name="glass", recipe="plain", color=tint, transmission=1.0, roughness=0.0)
    (image,) = drawn(backend, [pane], [glass], camera(pane.vertices))
    passed = np.mean([(0.96 * t) for t in tint]) ** 2
    assert image[MIDDLE][..., 3] == pytest.approx(1.0 - passed, abs=2e-3)


def test_a_wall_behind_glass_is_dimmed_by_it(backend: FastBackend) -> None:
    """Under a dark sky a glowing wall shows 0.5; through a pane of two faces, 0.96^2 of that."""
    wall = skin(box((0.5, 0.05, 0.5), at=(0.0, 0.2, 0.0)), "wall", "glow")
    pane = skin(box((0.5, 0.01, 0.5)), "pane", "glass")
    glow = SurfaceSpec(name="glow", recipe="plain", color=(0.25,) * 3, emission=2.0)
    glass = SurfaceSpec(
        name="glass", recipe="plain", color=(1.0,) * 3, transmission=1.0, roughness=0.0
    )
    rig = LightRig(name="dark", lights=(), sky=DARK)
    shots = (shot(), shot(part="wall"))
    both, bare = drawn(
        backend, [wall, pane], [glow, glass], camera(pane.vertices), rig=rig, shots=shots
    )
    assert bare[MIDDLE][..., :3] == pytest.approx(0.5, abs=1e-3)
    assert both[MIDDLE][..., :3] == pytest.approx(0.5 * 0.96**2, abs=1e-3)
    assert (both[MIDDLE][..., 3] == 1.0).all()


def test_a_roof_darkens_what_is_under_it(backend: FastBackend) -> None:
    floor = skin(box((1.0, 1.0, 0.05)), "floor", "white")
    roof = skin(box((1.0, 1.0, 0.05), at=(0.0, 0.0, 0.3)), "roof", "white")
    view = camera(np.concatenate([floor.vertices, roof.vertices]), elevation=12)
    shots = (shot(part="floor"), shot())
    alone, under = drawn(backend, [floor, roof], [matte("white", 0.2)], view, shots=shots)
    floor_front = alone[..., 3] == 1.0
    top = floor_front & (np.abs(alone[..., 0] - 0.2) < 0.02)
    rows = np.nonzero(top.any(axis=1))[0]
    row = rows[len(rows) // 2]
    assert under[row, SIZE // 2, 0] < 0.6 * alone[row, SIZE // 2, 0]


def test_a_window_shows_what_the_whole_image_shows_there(backend: FastBackend) -> None:
    """Projections differ by roundings of float32, so a few points on edges may change hands."""
    block = skin(box((0.5, 0.3, 0.4)), "block", "gray")
    view = camera(block.vertices, azimuth=30, elevation=20)
    left, top, right, bottom = window = (11, 13, 40, 37)
    whole, cut = drawn(
        backend, [block], [matte("gray", 0.5)], view, shots=(shot(), shot(box=window))
    )
    gap = np.abs(whole[top:bottom, left:right] - cut)[1:-1, 1:-1]
    assert (gap > 1e-4).mean() < 0.02


def test_the_split_sum_keeps_energy() -> None:
    """A white metal reflects all but what scattering twice would return: nothing is lost at
    roughness 0, and of single scattering the most at 1, where Heitz (2014) has 0.34 at grazing and
    0.6 lost at most."""
    table = split_sum()
    total = table.sum(axis=-1)
    assert total.max() < 1.01
    assert (total[0] > 0.98).all()
    assert total.min() > 0.3


def test_blur_keeps_even_light_and_spreads_a_spot() -> None:
    blur, even = Blur(), np.ones((HEIGHT, 2 * HEIGHT, 3))
    assert np.allclose(blur(even), 1.0, atol=1e-5)
    spot = np.zeros((HEIGHT, 2 * HEIGHT, 3))
    spot[20, 37] = 1.0
    peaks = blur(spot).max(axis=(1, 2, 3))
    assert (np.diff(peaks) < 0).all()


def test_a_white_wall_under_a_cosine_sky_is_known() -> None:
    """Radiance 1 + z seen by a wall that faces n: 1 + 2/3 n_z; midpoint sums are good to 1e-3."""
    toward = directions(HEIGHT)
    factors = white_wall(1.0 + toward[..., 2:] * np.ones(3))
    for normal in ([0, 0, 1.0], [0, 0.6, -0.8], [1.0, 0, 0]):
        shown = basis(np.array(normal)) @ factors
        assert shown == pytest.approx(1.0 + 2.0 / 3.0 * normal[2], abs=1e-3)


def test_solid_angles_fill_the_sphere() -> None:
    assert 2 * HEIGHT * solid_angles(HEIGHT).sum() == pytest.approx(4.0 * math.pi)


def test_more_sky_is_brighter(backend: FastBackend) -> None:
    """Light is additive, and without bumps or color images nothing else depends on it."""
    block = skin(box((0.5, 0.3, 0.4)), "block", "gray")
    view = camera(block.vertices, azimuth=30, elevation=20)
    half = Sky(nadir=(0.5,) * 3, horizon=(0.5,) * 3, zenith=(0.5,) * 3)
    dim, bright = (
        drawn(
            backend, [block], [matte("gray", 0.5)], view, rig=LightRig(name="s", lights=(), sky=s)
        )
        for s in (half, EVEN)
    )
    assert np.allclose(2.0 * dim[0][..., :3], bright[0][..., :3], atol=1e-4)


def test_a_part_that_the_glb_lacks_is_told(backend: FastBackend) -> None:
    block = skin(box((0.5, 0.3, 0.4)), "block", "gray")
    with pytest.raises(RenderError, match="shows no part lid"):
        drawn(
            backend,
            [block],
            [matte("gray", 0.5)],
            camera(block.vertices),
            shots=(shot(part="lid"),),
        )


def test_a_surface_that_the_manifest_lacks_is_told() -> None:
    block = skin(box((0.5, 0.3, 0.4)), "block", "gray")
    appearance = Appearance(skins=(block,), looks={"gray": Look()})
    assert set(surfaces_by_name([matte("gray", 0.5)], appearance)) == {"gray"}
    with pytest.raises(RenderError, match="uses surfaces gray, the manifest states white"):
        surfaces_by_name([matte("white", 0.5)], appearance)


def test_a_part_of_no_size_is_drawn_as_nothing(backend: FastBackend) -> None:
    """Its grid, its clip planes and its points still are numbers."""
    block = skin(box((0.5, 0.3, 0.4)), "block", "gray")
    speck = Skin(
        part="speck",
        surface="gray",
        vertices=np.zeros((3, 3)),
        normals=np.tile([0.0, 0.0, 1.0], (3, 1)),
        uv=np.zeros((3, 2)),
        faces=np.array([[0, 1, 2]], np.int32),
    )
    shots = (shot(), shot(part="speck"), shot(part="block"))
    both, alone, without = drawn(
        backend, [block, speck], [matte("gray", 0.5)], camera(block.vertices), shots=shots
    )
    assert not alone.any()
    assert np.array_equal(both[..., 3], without[..., 3])


def test_an_environment_lights_from_where_its_file_says(
    backend: FastBackend, tmp_path: Path
) -> None:
    """Radiance 1 from the half of the sphere on the +x side, in an image whose columns run from
    the back by -x, the front and +x to the back: a wall to that side shows its albedo, one away
    shows nothing, and one to the front half of it. Degree 2 of the expansion misses 3 % at most."""
    image = np.zeros((32, 64, 3), np.float32)
    image[:, 32:] = 1.0
    path = tmp_path / "half.exr"
    out = oiio.ImageOutput.create(str(path))
    out.open(str(path), oiio.ImageSpec(64, 32, 3, "float"))
    out.write_image(image)
    out.close()
    rig = LightRig(name="half", lights=(), sky=DARK, environment=Environment(file=str(path)))
    wall = skin(box((0.5, 0.5, 0.5), at=(0.0, 0.0, -0.25)), "wall", "white")
    shown = [
        drawn(backend, [wall], [matte("white", 0.5)], camera(wall.vertices, azimuth=turn), rig=rig)[
            0
        ][MIDDLE][..., 0].mean()
        for turn in (90, 0, -90)
    ]
    assert shown == pytest.approx([0.5, 0.25, 0.0], abs=0.03)


def test_an_environment_that_is_missing_is_told(backend: FastBackend, tmp_path: Path) -> None:
    wall = skin(box((0.5, 0.5, 0.5)), "wall", "white")
    lost = Environment(file=str(tmp_path / "lost.exr"))
    rig = LightRig(name="lost", lights=(), sky=DARK, environment=lost)
    with pytest.raises(RenderError, match=r"lost\.exr is no equirectangular RGB image"):
        drawn(backend, [wall], [matte("white", 0.5)], camera(wall.vertices), rig=rig)


def test_more_lights_than_the_shaders_hold_are_told(backend: FastBackend) -> None:
    wall = skin(box((0.5, 0.5, 0.5)), "wall", "white")
    rig = LightRig(name="many", lights=(lamp((0, -2, 0), (0, 0, 0), 1.0),) * 17, sky=DARK)
    with pytest.raises(RenderError, match="has 17 lights, the fast backend holds 16"):
        drawn(backend, [wall], [matte("white", 0.5)], camera(wall.vertices), rig=rig)
