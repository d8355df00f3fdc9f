"""The network is shown views as its training draws them, as far apart as can be."""

import dataclasses
import math

import numpy as np
import pytest

from artgen.core.camera import orbit_direction
from model.data.config import DataConfig
from model.reconstruct.assemble import Assembled
from model.reconstruct.capture import Capture
from model.reconstruct.choice import (
    MOST_TRIED,
    chosen_views,
    strangeness_deg,
    view_directions,
    widest,
)
from tests.unit.model.reconstruct.studio import AZIMUTHS
from tests.unit.model.reconstruct.test_sight import sphere

FRONT = DataConfig(views=2, azimuth_deg=80.0)


def direction(azimuth: float, elevation: float = 20.0) -> np.ndarray:  # type: ignore[type-arg]
    return orbit_direction(math.radians(azimuth), math.radians(elevation))


def test_directions_are_those_of_the_cameras(perfect: Assembled, capture: Capture) -> None:
    """The studio aims at the middle of what moves, some 0.1 m from the sphere's: 6 degrees at
    1.5 m."""
    ways = view_directions(capture, sphere(perfect))
    cosines = [float(way @ direction(azimuth)) for way, azimuth in zip(ways, AZIMUTHS, strict=True)]
    assert min(cosines) >= math.cos(math.radians(6.0))


def test_views_from_behind_are_left_out(perfect: Assembled, capture: Capture) -> None:
    """Of -50, 10, 60 and 170 degrees, the outer two before the object."""
    choice = chosen_views(capture, sphere(perfect), FRONT)
    assert (choice.views, choice.told) == ((0, 2), ())
    assert set(choice.others) == {(0, 1), (1, 2)}


def test_too_few_known_views_are_told(perfect: Assembled, capture: Capture) -> None:
    choice = chosen_views(capture, sphere(perfect), dataclasses.replace(FRONT, views=4))
    assert choice.views == (0, 1, 2, 3)
    (told,) = choice.told
    assert "up to 80 degrees from the front" in told
    assert "view 3" in told


@pytest.mark.parametrize(
    ("azimuth", "elevation", "expected"),
    [(0.0, 20.0, 0.0), (-95.0, 20.0, 15.0), (180.0, 20.0, 100.0), (10.0, 75.0, 15.0)],
)
def test_strangeness_is_the_angle_beyond_what_training_draws(
    azimuth: float, elevation: float, expected: float
) -> None:
    """A few roundings of 1e-16 through arctangents, in degrees."""
    assert abs(strangeness_deg(direction(azimuth, elevation), FRONT) - expected) <= 1e-9


def test_the_widest_set_has_its_closest_pair_farthest_apart() -> None:
    ways = np.array([direction(a) for a in (-60.0, -50.0, 0.0, 5.0, 55.0)])
    assert widest(ways, [0, 1, 2, 3, 4], 3)[0] == (0, 2, 4)
    assert widest(ways, [1, 2, 3], 1)[0] == (2,)


def test_many_views_are_thinned_before_they_are_compared() -> None:
    ways = np.array([direction(a) for a in np.linspace(-70.0, 70.0, 60)])
    found = widest(ways, list(range(60)), 8)
    assert len(found) <= MOST_TRIED
    assert all(len(set(views)) == 8 for views in found)
