"""Skies and rooms against closed forms: walls, the sun, power, exposure, what is written."""

import math
from pathlib import Path

import numpy as np
import OpenImageIO as oiio
import pytest

from artgen.core.camera import orbit_direction
from artgen.core.stream import Stream
from renders.environments import HEIGHT, exposed, mean_sky, wall_radiance, written
from renders.fast.filtered import directions, solid_angles
from renders.lights import MAPS, WHITE, light_rig
from renders.settings import LightScheme
from renders.skies import GROUND, Weather, sky_map, sunlight
from renders.softboxes import Panel, room_map

UP = np.array([[0.0, 0.0, 1.0]])
WEATHER = Weather(azimuth=0.6, elevation=0.7, turbidity=3.0)
SCHEMES = LightScheme.__args__  # type: ignore[attr-defined]


def test_a_wall_under_an_even_surrounding_shows_its_radiance() -> None:
    even = np.full((HEIGHT, 2 * HEIGHT, 3), 0.7)
    normals = np.array([UP[0], [0, -1, 0], [0.6, 0.0, -0.8]])
    # Midpoints of 1.4 degrees integrate a cosine to their square over 24: 2.5e-5; a kink, at the
    # wall's own horizon, to about ten times that.
    np.testing.assert_allclose(wall_radiance(even, normals), 0.7, rtol=3e-4)


def test_a_level_wall_under_half_a_surrounding_sees_all_of_it() -> None:
    half = np.zeros((HEIGHT, 2 * HEIGHT, 3))
    half[: HEIGHT // 2] = 1.0
    np.testing.assert_allclose(wall_radiance(half, UP), 1.0, rtol=3e-4)
    # An upright wall sees half of that half space's cosine.
    np.testing.assert_allclose(wall_radiance(half, np.array([[0, -1.0, 0]])), 0.5, rtol=3e-4)


def test_the_sun_stands_where_it_is_told_and_keeps_its_power_at_any_resolution() -> None:
    sun = orbit_direction(WEATHER.azimuth, WEATHER.elevation)
    for height in (64, 128, 256):
        sky = sky_map(WEATHER, height)
        row, column = np.unravel_index(sky[..., 1].argmax(), sky.shape[:2])
        away = math.acos(min(1.0, float(directions(height)[row, column] @ sun)))
        assert away <= math.pi / height  # within a pixel's diagonal
        near = directions(height) @ sun > math.cos(math.radians(4.0))
        held = (solid_angles(height)[:, None] * near)[..., None] * sky
        # The disc's own power, and 15 square degrees of bright sky around it.
        assert 1.0 <= held.sum((0, 1))[1] / sunlight(WEATHER)[1] <= 1.12


def test_daylight_has_the_strength_of_daylight() -> None:
    noon = sky_map(Weather(azimuth=0.0, elevation=math.radians(60), turbidity=2.5), HEIGHT)
    level = math.pi * wall_radiance(noon, UP)[0, 1]
    assert 90.0 < level < 120.0  # klx; a clear noon measures about 100


def test_the_ground_reflects_what_falls_on_it() -> None:
    sky = sky_map(WEATHER, HEIGHT)
    np.testing.assert_allclose(sky[-1, 0], GROUND * wall_radiance(sky, UP)[0], rtol=3e-3)


def test_an_overcast_zenith_is_three_times_its_horizon() -> None:
    sky = sky_map(Weather(azimuth=0, elevation=1, turbidity=3, overcast=True), 256)
    assert sky[0, 0, 1] / sky[127, 0, 1] == pytest.approx(3.0, rel=0.02)


def test_a_panel_is_as_wide_as_stated_and_bars_divide_a_window() -> None:
    panel = Panel(azimuth=0.0, elevation=0.0, size=(1.0, 0.6), radiance=5.0, edge=0.01)
    room = room_map((panel,), walls=0.0, floor=0.0, height=512)
    lit = float((solid_angles(512)[:, None] * room[..., 1] / 5.0).sum())
    # Solid angle of a rectangle a x b at distance 1 (half sides 0.5 and 0.3).
    a, b = 0.5, 0.3
    exact = 4 * math.asin(a * b / math.sqrt((1 + a * a) * (1 + b * b)))
    assert lit == pytest.approx(exact, rel=0.01)
    barred = Panel(azimuth=0.0, elevation=0.0, size=(1.0, 0.6), radiance=5.0, panes=(2, 2))
    window = room_map((barred,), walls=0.0, floor=0.0, height=512)
    assert window[256, 512, 1] < 0.5 < window[240, 480, 1]


def test_exposure_puts_the_brightest_wall_at_white() -> None:
    for scheme in MAPS:
        rng = np.random.default_rng(3)
        _, radiance = MAPS[scheme](lambda low, high, rng=rng: float(rng.uniform(low, high)))
        shown = exposed(radiance, 0.9)
        turns = np.linspace(0, 2 * math.pi, 17)
        level = np.stack([np.sin(turns), -np.cos(turns), 0 * turns], axis=-1)
        walls = wall_radiance(shown, np.concatenate([level, UP]))[:, 1]
        assert walls.max() == pytest.approx(0.9, rel=1e-9)


def test_a_map_is_written_once_and_read_back_whole(tmp_path: Path) -> None:
    radiance = sky_map(WEATHER, 32)
    one, other = written(radiance, tmp_path), written(radiance, tmp_path)
    assert one == other
    assert len(list(tmp_path.iterdir())) == 1
    pixels = oiio.ImageBuf(one.environment.file).get_pixels(oiio.FLOAT)
    assert np.array_equal(pixels, radiance.astype(np.float32))


def test_the_mean_sky_tells_below_level_and_above() -> None:
    room = np.zeros((64, 128, 3))
    room[:18], room[46:] = 3.0, 1.0
    sky = mean_sky(room)
    assert sky.zenith[1] > 2.9
    assert sky.horizon == (0.0, 0.0, 0.0)
    assert sky.nadir[1] > 0.95


@pytest.mark.parametrize("scheme", SCHEMES)
def test_every_scheme_draws_the_same_light_again_and_another_for_another_seed(
    scheme: str, tmp_path: Path
) -> None:
    def drawn(seed: int) -> object:
        return light_rig(scheme, Stream(seed, "l"), center=np.zeros(3), radius=0.5, folder=tmp_path)

    assert drawn(1) == drawn(1)
    assert drawn(1) != drawn(2)
    assert 0.7 <= WHITE[0] <= WHITE[1] <= 1.2
