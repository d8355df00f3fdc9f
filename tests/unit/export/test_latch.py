"""A latch in MJCF: a closed form, and what a simulator does with it where it is hard."""

import dataclasses
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.articulation.types import Joint, Latch, Limit
from artgen.core.errors import KinematicError
from artgen.export.layout import MJCF
from artgen.simulation.effects import Effect, Task, needed_effects, only
from tests import exported
from tests.strategies import chest, hinge

LID = hinge("hinge", "base", "lid", axis=(-1.0, 0.0, 0.0), friction=0.0, damping=0.0)


def model_with(latch: Latch | None, folder: Path, **changes: object) -> mujoco.MjModel:
    """The chest with a latch on its lid, as MuJoCo reads it."""
    joint = dataclasses.replace(LID, latch=latch, **changes)  # type: ignore[arg-type]
    obj = dataclasses.replace(chest(), joints=(joint,))
    return exported.mujoco_model(exported.write_without_blender(obj, folder), MJCF)


def latch_force(model: mujoco.MjModel, q: float) -> float:
    data = mujoco.MjData(model)
    data.qpos[0] = q
    mujoco.mj_forward(model, data)
    return float(data.qfrc_passive[0])


@given(share=st.floats(0.0, 3.0))
def test_force_falls_evenly_to_nothing(share: float, latched_lid: mujoco.MjModel) -> None:
    """-force (1 - q / reach), and nothing beyond the reach."""
    expected = -3.0 * max(0.0, 1.0 - share)
    assert latch_force(latched_lid, share * 0.04) == pytest.approx(expected, abs=1e-12)


@pytest.fixture(scope="module")
def latched_lid(tmp_path_factory: pytest.TempPathFactory) -> mujoco.MjModel:
    return model_with(Latch(force=3.0, reach=0.04), tmp_path_factory.mktemp("lid"))


def opens_under(model: mujoco.MjModel, force: float) -> bool:
    """Whether a push carries the lid beyond the reach of its latch within a second."""
    data = mujoco.MjData(model)
    data.qfrc_applied[0] = force
    mujoco.mj_step(model, data, nstep=round(1.0 / model.opt.timestep))
    return bool(data.qpos[0] > 0.05)


def test_it_breaks_away_at_weight_plus_force(latched_lid: mujoco.MjModel, tmp_path: Path) -> None:
    """At rest the lid's weight and the latch hold; 1 % more than both opens it, 1 % less does
    not."""
    data = mujoco.MjData(latched_lid)
    mujoco.mj_forward(latched_lid, data)
    weight = float(data.qfrc_bias[0])
    assert weight > 0.0
    assert opens_under(latched_lid, 1.01 * (weight + 3.0))
    assert not opens_under(latched_lid, 0.99 * (weight + 3.0))
    assert opens_under(model_with(None, tmp_path), 1.01 * weight)


@pytest.mark.parametrize("inertia", [1.0, 1e-2, 1e-4])
def test_a_light_flap_on_a_strong_magnet_comes_to_rest(inertia: float, tmp_path: Path) -> None:
    """Force / (reach x inertia) up to (2.7 kHz)^2 at steps of 2 ms: thrown shut, it stays shut
    within the softness of its stop, and neither rings nor gains energy."""
    model = model_with(Latch(force=3.0, reach=0.004), tmp_path, damping=1e-3)
    model.dof_armature[0] = 0.0
    model.body_inertia[-1] *= inertia
    model.body_mass[-1] *= inertia
    data = mujoco.MjData(model)
    data.qpos[0], data.qvel[0] = 0.1, -1.0
    mujoco.mj_step(model, data, nstep=1000)
    assert abs(data.qpos[0]) < 2e-3
    assert abs(data.qvel[0]) < 1e-6
    assert not any(warning.number for warning in data.warning)


def test_the_latch_is_an_effect_where_there_is_one(
    latched_lid: mujoco.MjModel, tmp_path: Path
) -> None:
    """Settling: the latch presses the lid on its stop, and nothing else but weight does."""
    plain = model_with(None, tmp_path)
    for model, there in ((latched_lid, True), (plain, False)):
        effects = needed_effects(model, Task(name="settling", start=np.zeros(1), clear=True))
        assert (Effect.LATCH in effects.needed) == there
        assert Effect.SPRING not in effects.needed
        with only(model, effects):
            assert (latch_force(model, 0.0) != 0.0) == there
    assert latch_force(latched_lid, 0.0) == pytest.approx(-3.0)


def test_a_latch_needs_a_closed_end() -> None:
    for limit, kind in ((Limit(lower=-0.1, upper=1.0), "revolute"), (None, "continuous")):
        with pytest.raises(KinematicError, match="hinge: a latch holds a closed end"):
            Joint(
                name="hinge", type=kind, parent="base", child="lid", axis=(1.0, 0.0, 0.0),  # type: ignore[arg-type]
                limit=limit, friction=0.1, damping=0.1, effort=5.0,
                latch=Latch(force=1.0, reach=0.1),
            )  # fmt: skip
