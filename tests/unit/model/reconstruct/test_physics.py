"""Friction holds what gravity pulls at; the effort moves it."""

import math

import numpy as np
import pytest

from artgen.articulation.types import Joint, Limit
from artgen.core.conventions import GRAVITY
from artgen.geometry.solid import slab
from model.reconstruct.physics import EFFORT, HOLD, LEAST, QUICKEST, RUB, forces, weights

LID = slab((-0.2, -0.3, 0.3), (0.2, 0.0, 0.32))
DENSITY = 300.0
MASS = DENSITY * 0.4 * 0.3 * 0.02
HEAVY = weights({"base": slab((-0.2, -0.3, 0.0), (0.2, 0.0, 0.3)), "lid": LID}, DENSITY)


def hinge(axis: tuple[float, float, float], upper: float) -> Joint:
    """At the lid's back edge."""
    return Joint(
        name="hinge",
        type="revolute",
        parent="base",
        child="lid",
        axis=axis,
        origin=(0.0, 0.0, 0.31),
        limit=Limit(lower=0.0, upper=upper),
        friction=0.0,
        damping=0.0,
        effort=1.0,
    )


def test_a_part_weighs_its_volume() -> None:
    assert math.isclose(HEAVY["lid"].mass, MASS, rel_tol=1e-12)
    assert np.abs(HEAVY["lid"].center - (0.0, -0.15, 0.31)).max() <= 1e-15


def test_a_lid_is_held_at_its_hardest_angle() -> None:
    """It pulls most when level: m g times half its depth."""
    joint = hinge((-1.0, 0.0, 0.0), 1.8)
    found = forces(joint, [joint], HEAVY, "base")
    assert math.isclose(found.friction, HOLD * MASS * GRAVITY * 0.15, rel_tol=1e-12)
    assert found.effort == EFFORT * found.friction


def test_a_door_on_upright_hinges_only_rubs() -> None:
    joint = hinge((0.0, 0.0, 1.0), 1.5)
    found = forces(joint, [joint], HEAVY, "base")
    assert math.isclose(found.friction, RUB * MASS * GRAVITY * 0.15, rel_tol=1e-12)


@pytest.mark.parametrize(("axis", "share"), [((0.0, 0.0, 1.0), HOLD), ((1.0, 0.0, 0.0), RUB)])
def test_a_slide_carries_its_weight_if_it_rises(
    axis: tuple[float, float, float], share: float
) -> None:
    joint = Joint(**{**vars(hinge(axis, 0.2)), "type": "prismatic", "origin": (0.0, 0.0, 0.0)})
    found = forces(joint, [joint], HEAVY, "base")
    assert math.isclose(found.friction, share * MASS * GRAVITY, rel_tol=1e-12)


def test_a_light_dial_is_damped_no_more_than_its_inertia_bears() -> None:
    """A cube of 24 mm about its own middle: m a2 / 6."""
    heavy = weights({"base": LID, "lid": slab((0.0, 0.0, 0.0), (0.024, 0.024, 0.024))}, DENSITY)
    joint = Joint(**{**vars(hinge((0.0, 1.0, 0.0), 4.0)), "origin": (0.012, 0.0, 0.012)})
    inertia = DENSITY * 0.024**3 * 0.024**2 / 6.0
    assert math.isclose(
        forces(joint, [joint], heavy, "base").damping, QUICKEST * inertia, rel_tol=1e-9
    )


def test_what_a_part_carries_counts() -> None:
    joint = hinge((-1.0, 0.0, 0.0), 1.0)
    knob = Joint(
        **{**vars(hinge((0.0, 0.0, 1.0), 1.0)), "name": "turn", "parent": "lid", "child": "knob"}
    )
    heavy = {**HEAVY, **weights({"knob": slab((-0.02, -0.3, 0.32), (0.02, -0.26, 0.36))}, DENSITY)}
    alone = forces(joint, [joint], heavy, "base").friction
    both = forces(joint, [joint, knob], heavy, "base").friction
    assert both > alone
    assert forces(knob, [joint, knob], heavy, "base").friction >= LEAST
