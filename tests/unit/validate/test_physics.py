"""MuJoCo's traps stay disarmed, and what is left out of the model does not matter."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from artgen.export.layout import MJCF, URDF
from artgen.validate.bounds import shipped_bounds
from artgen.validate.dynamics import drift_bound
from artgen.validate.physics import body_names, compiled, set_state
from tests.unit.validate.cabinet import cupboard, write_quick_bundle

TETRA = "v 0 0 0\nv {s} 0 0\nv 0 {s} 0\nv 0 0 {s}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_quick_bundle(cupboard(), tmp_path_factory.mktemp("physics") / "bundle")


def test_a_rewritten_mesh_is_read_anew(tmp_path: Path) -> None:
    """The bug: MuJoCo's asset cache returned the old mesh of a rewritten file in 28 of 30 tries."""
    model = tmp_path / "m.xml"
    model.write_text(
        '<mujoco><asset><mesh name="s" file="s.obj"/></asset><worldbody><body>'
        '<freejoint/><geom type="mesh" mesh="s"/></body></worldbody></mujoco>'
    )
    for side in (0.1, 0.2, 0.1, 0.2, 0.1):
        (tmp_path / "s.obj").write_text(TETRA.format(s=side))
        # Density 1000 over side^3 / 6; float32 vertices.
        assert compiled(model).body_mass[1] == pytest.approx(1000 * side**3 / 6, rel=1e-6)


def test_every_part_is_a_body(bundle: Path) -> None:
    """MuJoCo would merge the base into the world."""
    for file in (MJCF, URDF):
        assert set(body_names(compiled(bundle / file))) == {"world", "base", "door", "drawer"}


def test_leaving_visual_meshes_out_changes_no_dynamics(bundle: Path) -> None:
    """They have no mass and no contact: mass matrix, forces and motion are equal bit for bit."""
    full = mujoco.MjSpec.from_file(str(bundle / MJCF)).compile()
    lean = compiled(bundle / MJCF)
    assert full.nmesh > lean.nmesh
    full.opt.disableflags = lean.opt.disableflags
    for q in ({"hinge": 0.0, "slide": 0.0}, {"hinge": 1.1, "slide": 0.2}):
        answers = []
        for model in (full, lean):
            data = mujoco.MjData(model)
            set_state(model, data, q)
            mujoco.mj_forward(model, data)
            mujoco.mj_step(model, data, nstep=50)
            answers.append((data.M.copy(), data.qfrc_bias.copy(), data.qpos.copy(), data.ncon))
        for one, other in zip(*answers, strict=True):
            np.testing.assert_array_equal(one, other)


def test_parents_and_children_may_collide(bundle: Path) -> None:
    """A drawer pushed 20 mm into its carcass touches it, also where the base is free."""
    model = compiled(bundle / MJCF)
    data = mujoco.MjData(model)
    set_state(model, data, {"slide": -0.04, "hinge": 0.0})
    mujoco.mj_collision(model, data)
    assert data.ncon > 0
    assert model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_FILTERPARENT


def test_a_diverged_state_is_not_reset(
    bundle: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By default it would end "at rest at q = 0"; nor is a log left in the working directory."""
    monkeypatch.chdir(tmp_path)
    model = compiled(bundle / MJCF)
    data = mujoco.MjData(model)
    data.qvel[0] = np.inf
    mujoco.mj_step(model, data)
    assert not np.isfinite(data.qpos).all()
    assert sum(warning.number for warning in data.warning) > 0
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("pull", [0.1, 0.4])
def test_the_drift_bound_holds_what_friction_holds(pull: float) -> None:
    """A slide on a slope: creep under half of the friction force stays below the derived bound and
    above a hundredth of it, so the bound is not idle; without friction the slide leaves it."""
    text = (
        '<mujoco><option gravity="{g} 0 0" integrator="implicitfast"/><worldbody><body>'
        '<joint name="j" type="slide" axis="1 0 0" frictionloss="{f}"/>'
        '<geom size=".1" mass="1"/></body></worldbody></mujoco>'
    )
    for friction, held in ((2.0 * pull, True), (0.0, False)):
        model = mujoco.MjModel.from_xml_string(text.format(g=pull, f=friction))
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        bound = drift_bound(model, data, shipped_bounds())[0]
        mujoco.mj_step(model, data, nstep=round(2.0 / model.opt.timestep))
        assert (abs(data.qpos[0]) <= bound) == held
        assert abs(data.qpos[0]) > bound / 100.0


def test_the_drift_bound_holds_what_a_stop_holds() -> None:
    """A lid of 0.25 m that lies on its stop sags by 1 to 3 mrad with MuJoCo's default softness."""
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><compiler autolimits="true" angle="radian"/><worldbody><body>'
        '<joint name="j" type="hinge" axis="0 1 0" range="-1.5 0"/>'
        '<geom type="box" size=".125 .1 .005" pos=".125 0 0" mass="1"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    bound = drift_bound(model, data, shipped_bounds())[0]
    mujoco.mj_step(model, data, nstep=1000)
    assert bound / 10.0 < abs(data.qpos[0]) <= bound
