"""What a scene calls for: on where it acts, off where it cannot, and the promise measured."""

from collections.abc import Mapping

import mujoco
import numpy as np
import pytest

from artgen.simulation.effects import PROMISE, Effect, Task, needed_effects, only
from artgen.simulation.paths import ALL, agreement, joint_path, path_difference, price_of_dropping

LOAD = 'pos="0.2 0 0" mass="2" diaginertia="0.02 0.02 0.02"'


BOX = '<geom type="box" size=".1 .1 .1"/>'


def scene(joint: str, *, floor: str = "") -> mujoco.MjModel:
    """One body on one joint; with a floor the body is a box that may meet it."""
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody>{floor}<body><joint {joint}/><inertial {LOAD}/>"
        f"{BOX if floor else ''}</body></worldbody></mujoco>"
    )
    model.opt.tolerance = 1e-12
    return model


VERTICAL = 'type="hinge" axis="0 0 1"'
LEVEL = 'type="hinge" axis="0 1 0"'
FLOOR = '<geom type="plane" size="1 1 .1" pos="0 0 -0.1"/>'

CALLING: Mapping[Effect, tuple[mujoco.MjModel, Task]] = {
    Effect.GRAVITY: (scene(LEVEL), Task(name="swing", start=np.array([0.3]))),
    Effect.LIMIT: (
        scene(f'{LEVEL} range="-0.1 0.4" limited="true"'),
        Task(name="fall", start=np.array([0.2])),
    ),
    Effect.FRICTION: (
        scene(f'{VERTICAL} frictionloss="0.3"'),
        Task(name="push", start=np.zeros(1), velocity=np.ones(1)),
    ),
    Effect.DAMPING: (
        scene(f'{VERTICAL} damping="0.3"'),
        Task(name="push", start=np.zeros(1), velocity=np.ones(1)),
    ),
    Effect.SPRING: (
        scene(f'{VERTICAL} stiffness="2" springref="0"'),
        Task(name="release", start=np.array([0.4])),
    ),
    Effect.CONTACT: (
        scene('type="slide" axis="0 0 1"', floor=FLOOR),
        Task(name="drop", start=np.array([0.05])),
    ),
    Effect.EQUALITY: (
        mujoco.MjModel.from_xml_string(
            f"<mujoco><worldbody><body><joint name='a' {VERTICAL}/><inertial {LOAD}/></body>"
            f"<body><joint name='b' {VERTICAL}/><inertial {LOAD}/></body></worldbody>"
            "<equality><joint joint1='a' joint2='b'/></equality></mujoco>"
        ),
        Task(name="push one", start=np.zeros(2), velocity=np.array([0.0, 1.0])),
    ),
}
STILL: Mapping[Effect, tuple[mujoco.MjModel, Task]] = {
    Effect.GRAVITY: (
        scene(f'{VERTICAL} damping="0.1"'),
        Task(name="push", start=np.zeros(1), velocity=np.ones(1)),
    ),
    Effect.LIMIT: (
        scene(f'{VERTICAL} range="0 1" limited="true"'),
        Task(name="settle", start=np.zeros(1)),
    ),
    Effect.FRICTION: (
        scene(f'{VERTICAL} frictionloss="0.3"'),
        Task(name="settle", start=np.zeros(1)),
    ),
    Effect.DAMPING: (scene(f'{VERTICAL} damping="1"'), Task(name="settle", start=np.zeros(1))),
    Effect.SPRING: (
        scene(f'{VERTICAL} stiffness="2" springref="0"'),
        Task(name="settle", start=np.zeros(1)),
    ),
    Effect.CONTACT: (
        scene(VERTICAL, floor=FLOOR.replace("-0.1", "-0.3")),
        Task(name="swing clear", start=np.zeros(1), velocity=np.ones(1), clear=True),
    ),
    Effect.EQUALITY: (CALLING[Effect.EQUALITY][0], Task(name="settle", start=np.zeros(2))),
}


@pytest.mark.parametrize("effect", CALLING)
def test_an_effect_that_acts_is_on_and_dropping_it_shows(effect: Effect) -> None:
    model, task = CALLING[effect]
    assert effect in needed_effects(model, task).needed
    # Any of these motions goes wrong by far more than the promise within a second.
    assert price_of_dropping(model, task, seconds=1.0)[effect] > 100 * PROMISE


@pytest.mark.parametrize("effect", STILL)
def test_an_effect_that_cannot_act_is_off_and_not_one_bit_differs(effect: Effect) -> None:
    model, task = STILL[effect]
    effects = needed_effects(model, task)
    assert effect not in effects.needed
    lean = joint_path(model, task, effects, steps=500)
    assert np.array_equal(lean, joint_path(model, task, ALL, steps=500))


def test_a_joint_far_from_what_moves_calls_for_nothing() -> None:
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody><body><joint {VERTICAL} damping='1'/><inertial {LOAD}/></body>"
        f"<body><joint {VERTICAL}/><inertial {LOAD}/></body></worldbody></mujoco>"
    )
    pushed = np.array([0.0, 1.0])
    task = Task(name="push the free one", start=np.zeros(2), velocity=pushed)
    assert Effect.DAMPING not in needed_effects(model, task).needed
    task = Task(name="push the damped one", start=np.zeros(2), velocity=pushed[::-1])
    assert Effect.DAMPING in needed_effects(model, task).needed


def test_energy_checks_leave_losses_off_by_definition() -> None:
    model = scene(f'{LEVEL} damping="1" frictionloss="1"')
    task = Task(name="energy", start=np.array([0.3]), lossless=True)
    assert needed_effects(model, task).needed == {Effect.GRAVITY}


def test_flags_are_put_back_even_after_a_fault() -> None:
    model, task = CALLING[Effect.GRAVITY]
    before = model.opt.disableflags

    def fail() -> None:
        with only(model, needed_effects(model, task)):
            assert model.opt.disableflags != before
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    assert model.opt.disableflags == before


def test_every_effect_is_decided_once_with_a_reason() -> None:
    for model, task in (*CALLING.values(), *STILL.values()):
        told = needed_effects(model, task).told
        assert list(told) == [effect.value for effect in Effect]
        assert all(text.startswith(("on: ", "off: ")) and len(text) > 8 for text in told.values())


def test_a_path_that_diverges_agrees_with_nothing() -> None:
    model, task = CALLING[Effect.GRAVITY]
    path = np.zeros((3, 1))
    assert path_difference(model, path, path) == 0.0
    assert path_difference(model, path, np.full((3, 1), np.nan)) == np.inf
    assert agreement(model, task, seconds=0.5).holds


def test_a_light_knob_on_a_heavy_door_is_held_by_its_friction() -> None:
    """A load of 1e-9 of the door's weight turned a knob of 1e-8 kg m2 by 4e-6 rad in two seconds
    while its friction was left off."""
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody><body><joint {VERTICAL} frictionloss='1'/>"
        "<inertial pos='0.5 0 0' mass='100' diaginertia='9 9 9'/>"
        "<body pos='1 0 0'><joint type='hinge' axis='0 1 0' frictionloss='0.01'/>"
        "<inertial pos='2e-6 0 0' mass='0.001' diaginertia='1e-8 1e-8 1e-8'/></body>"
        "</body></worldbody></mujoco>"
    )
    effects = needed_effects(model, Task(name="settle", start=np.zeros(2), clear=True))
    assert Effect.FRICTION in effects.needed
    data = mujoco.MjData(model)
    with only(model, effects):
        mujoco.mj_step(model, data, nstep=1000)
    assert np.abs(data.qpos).max() <= 1e-6
