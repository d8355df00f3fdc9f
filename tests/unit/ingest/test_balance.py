"""Springs for what stays where it is put: what they leave, friction must be able to hold."""

import numpy as np
import pytest

from artgen.ingest.balance import ANGLES, balancing, weight_torque

DOOR = np.array([0.0, -0.02, 0.35])
"""m; the center of a drop door above its hinge, a little before it (it opens towards -y)."""


def net(upper: float) -> tuple[np.ndarray, np.ndarray, float]:
    angles = np.linspace(0.0, upper, ANGLES)
    torque = weight_torque((1.0, 0.0, 0.0), DOOR, 8.0, angles)
    found = balancing(torque, angles)
    assert found is not None
    spring, left = found
    return torque, torque + spring.stiffness * (spring.reference - angles), left


def test_weight_pulls_a_door_that_leans_forward_open() -> None:
    """About +x a door with its center before the pin opens by its weight: m g times 20 mm."""
    torque = weight_torque((1.0, 0.0, 0.0), DOOR, 8.0, np.zeros(1))
    assert torque[0] == pytest.approx(8.0 * 9.81 * 0.02, rel=1e-3)


@pytest.mark.parametrize("upper", [0.8, 1.2, 1.55])
def test_a_spring_leaves_what_it_says_and_little_of_the_weight(upper: float) -> None:
    """A sine over a quarter turn is 0.21 of its height above its chord; half of that is left."""
    torque, rest, left = net(upper)
    assert np.abs(rest).max() == pytest.approx(left, rel=1e-9)
    assert left <= 0.12 * np.abs(torque).max()


def test_no_spring_where_weight_pulls_less_the_farther_it_is_open() -> None:
    """Only a spring that pushes harder the farther it is stretched would help."""
    angles = np.linspace(0.0, 1.5, ANGLES)
    assert balancing(np.cos(angles), angles) is None
