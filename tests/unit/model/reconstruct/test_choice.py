"""The network is shown views as its training draws them, as far apart as can be."""

import dataclasses
import math
import re
from pathlib import Path

import numpy as np
import pytest

from artgen.core.camera import orbit_direction
from model.data.config import DataConfig
from model.reconstruct.assemble import Assembled
from model.reconstruct.capture import Capture, read_capture
from model.reconstruct.choice import (
    MOST_TRIED,
    chosen_views,
    strangeness_deg,
    view_directions,
    widest,
)
from model.reconstruct.rig import read_rig
from tests.unit.model.reconstruct.perfect import sphere
from tests.unit.model.reconstruct.studio import AZIMUTHS

FRONT = DataConfig(views=2, azimuth_deg=80.0)


def direction(azimuth: float, elevation: float = 20.0) -> np.ndarray:  # type: ignore[type-arg]
    return orbit_direction(math.radians(azimuth), math.radians(elevation))


def test_directions_are_those_of_the_cameras(perfect: Assembled, capture: Capture) -> None:
    """The studio aims at the middle of what moves, some 0.1 m from the sphere's: 6 degrees at
    1.5 m."""
    for ways in view_directions(capture, sphere(perfect)):
        cosines = [way @ direction(azimuth) for way, azimuth in zip(ways, AZIMUTHS, strict=True)]
        assert min(map(float, cosines)) >= math.cos(math.radians(6.0))


def test_views_from_behind_are_left_out(perfect: Assembled, capture: Capture) -> None:
    """Of -50, 10, 60 and 170 degrees, the outer two before the object."""
    choice = chosen_views(capture, sphere(perfect), FRONT)
    assert (choice.views, choice.told) == ((0, 2), ())
    assert set(choice.others) == {(0, 1), (1, 2)}


def test_a_state_listed_backwards_changes_nothing(
    photographs: Path, perfect: Assembled, capture: Capture
) -> None:
    """Views were paired by their place in the file: a camera behind the object was averaged with
    one before it, and both counted as seen from the side."""
    rig = read_rig(photographs / "cameras.json", photographs)
    backwards = dataclasses.replace(rig, shots=(*rig.shots[:4], *rig.shots[:3:-1]))
    found = read_capture(photographs, backwards)
    assert found.files == capture.files
    assert np.array_equal(found.rgba, capture.rgba)
    assert np.array_equal(found.camera_from_world, capture.camera_from_world)
    assert chosen_views(found, sphere(perfect), FRONT) == chosen_views(
        capture, sphere(perfect), FRONT
    )


def permuted(capture: Capture, order: list[int]) -> Capture:
    """The second state in another order, paired wrongly on purpose."""
    cameras = capture.camera_from_world.copy()
    cameras[1] = cameras[1, order]
    return dataclasses.replace(capture, camera_from_world=cameras)


def test_a_view_is_as_strange_as_in_its_strangest_state(
    perfect: Assembled, capture: Capture
) -> None:
    """The third view of the second state is taken from behind, so neither it nor the fourth can be
    shown; of opposite cameras no mean is taken."""
    choice = chosen_views(permuted(capture, [0, 1, 3, 2]), sphere(perfect), FRONT)
    assert (choice.views, choice.others, choice.told) == ((0, 1), (), ())
    opposite = capture.camera_from_world.copy()
    opposite[1] = opposite[1] @ np.diag([-1.0, -1.0, 1.0, 1.0])
    turned = dataclasses.replace(capture, camera_from_world=opposite)
    about = dataclasses.replace(sphere(perfect), center=np.zeros(3))
    ways = view_directions(turned, about)
    # Half a turn about z and no shift: opposite in x and y but for roundings.
    assert np.abs(ways[0, :, :2] + ways[1, :, :2]).max() <= 1e-12
    assert np.isfinite(ways).all()
    assert len(chosen_views(turned, about, FRONT).views) == 2


def test_states_seen_from_elsewhere_are_told(perfect: Assembled, capture: Capture) -> None:
    """-50 and 10 degrees, 20 high, are 56 degrees apart along the great circle; the studio's aim
    adds up to 6 (see above)."""
    moved = permuted(capture, [1, 0, 2, 3])
    (told,) = chosen_views(moved, sphere(perfect), FRONT).told
    found = re.search(r"state_1/view_(\d).png was taken (\d+) degrees from \S+view_(\d).png", told)
    assert found is not None
    assert found[1] == found[3]
    assert abs(float(found[2]) - 56.0) <= 6.0
    anywhere = dataclasses.replace(FRONT, same_cameras=False)
    assert chosen_views(moved, sphere(perfect), anywhere).told == ()


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
    ways = np.array([[direction(a) for a in (-60.0, -50.0, 0.0, 5.0, 55.0)]])
    assert widest(ways, [0, 1, 2, 3, 4], 3)[0] == (0, 2, 4)
    assert widest(ways, [1, 2, 3], 1)[0] == (2,)


def test_many_views_are_thinned_before_they_are_compared() -> None:
    ways = np.array([[direction(a) for a in np.linspace(-70.0, 70.0, 60)]])
    found = widest(ways, list(range(60)), 8)
    assert len(found) <= MOST_TRIED
    assert all(len(set(views)) == 8 for views in found)
