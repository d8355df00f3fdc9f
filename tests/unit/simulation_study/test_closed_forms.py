"""Integrators converge to closed forms at their own order."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from artgen.simulation_study.closed_forms import (
    GRAVITY,
    friction_drawer,
    measured,
    motions,
    observed_order,
    pendulum,
    sprung_door,
)

DOOR = sprung_door(stiffness=20.0, damping=4.0, name="door")


@pytest.mark.parametrize("integrator", ["Euler", "implicit", "implicitfast", "discrete"])
@pytest.mark.parametrize("motion", [pendulum(), DOOR], ids=lambda motion: motion.name)
def test_single_step_integrators_are_of_first_order(motion, integrator: str) -> None:
    # error = c h + O(h^2): halving from 2 ms leaves less than a twentieth of the slope to h^2.
    assert observed_order(motion, integrator, (2e-3, 1e-3)) == pytest.approx(1.0, abs=0.05)


def test_runge_kutta_is_of_fourth_order() -> None:
    assert observed_order(DOOR, "RK4", (2e-2, 1e-2)) == pytest.approx(4.0, abs=0.2)
    assert observed_order(pendulum(), "RK4", (5e-3, 2e-3)) > 3.5


def test_friction_is_of_first_order_until_the_soft_constraint_shows() -> None:
    drawer = friction_drawer()
    assert observed_order(drawer, "Euler", (2e-2, 5e-3)) == pytest.approx(1.0, abs=0.05)
    floor = [measured(drawer, "RK4", step).error for step in (1e-2, 1e-3, 1e-4)]
    # A smaller step does not bring the fourth order back: the constraint itself is soft.
    assert floor[0] / floor[-1] < 2.0


def test_the_closed_forms_solve_their_equations() -> None:
    """Against scipy's own integrator at 1e-12, which knows nothing of elliptic functions."""
    pulsation = 2.0 * GRAVITY * 0.3 / (0.02 + 2.0 * 0.09)
    times = np.linspace(0.0, 5.0, 51)
    swing = solve_ivp(
        lambda _, y: (y[1], -pulsation * math.sin(y[0])),
        (0.0, 5.0),
        (math.radians(120.0), 0.0),
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
        method="DOP853",
    )
    # Errors of 1e-12 a step grow along the orbit at most linearly over some 1e3 steps.
    np.testing.assert_allclose(pendulum().exact(times), swing.y[0], rtol=0, atol=1e-8)
    door = solve_ivp(
        lambda _, y: (y[1], -10.0 * y[0] - 2.0 * y[1]),
        (0.0, 2.0),
        (1.2, 0.0),
        t_eval=times[times <= 2.0],
        rtol=1e-12,
        atol=1e-12,
        method="DOP853",
    )
    np.testing.assert_allclose(DOOR.exact(times[times <= 2.0]), door.y[0], rtol=0, atol=1e-9)


def test_every_motion_starts_where_it_says() -> None:
    for motion in motions():
        assert motion.exact(np.zeros(1))[0] == pytest.approx(motion.start, abs=1e-15)
