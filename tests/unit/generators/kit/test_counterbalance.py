"""The spring is the best line under the weight's curve."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.articulation.types import Body
from artgen.generators.kit.counterbalance import counterbalance, net_torque, weighed
from artgen.geometry.solid import box


def slab_door(height: float, thickness: float, ahead: float) -> tuple[Body, ...]:
    """A uniform board standing on the pivot, its middle `ahead` m in front of it."""
    solid = box((0.6, thickness, height), at=(0.0, -ahead, 0.0))
    return (Body(solid=solid, surface="front", density=300.0),)


doors = st.builds(slab_door, st.floats(0.4, 0.9), st.floats(0.03, 0.08), st.floats(-0.01, 0.05))


@settings(deadline=None, max_examples=60)
@given(doors, st.floats(1.3, math.pi / 2.0))
def test_what_is_left_is_equal_at_both_ends_and_opposite_between(
    bodies: tuple[Body, ...], upper: float
) -> None:
    """Chebyshev: a line is nearest to a concave curve when the error touches -e, +e, -e."""
    spring, left = counterbalance(bodies, pivot=(0.0, 0.0, 0.0), upper=upper)
    q = np.linspace(0.0, upper, 2001)
    pull = net_torque(bodies, pivot=(0.0, 0.0, 0.0), spring=spring, q=q)
    assert pull[0] == pytest.approx(-left, rel=1e-9)
    assert pull[-1] == pytest.approx(-left, rel=1e-9)
    # 2001 samples miss the crest by half a step at most: curvature 1 * (8e-4)^2 / 8 of ~ 10 left.
    assert pull.max() == pytest.approx(left, rel=1e-5)


@given(doors)
def test_a_door_weighs_what_its_bodies_weigh(bodies: tuple[Body, ...]) -> None:
    mass, center = weighed(bodies)
    assert mass == pytest.approx(300.0 * bodies[0].solid.volume, rel=1e-12)
    assert center == pytest.approx(bodies[0].solid.bounds.mean(axis=0), abs=1e-12)
