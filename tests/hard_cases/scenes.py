"""Small MuJoCo scenes, stepped with the settings that validation uses."""

from collections.abc import Sequence

import mujoco
import numpy as np

from artgen.core.mesh import Floats
from artgen.simulation_study.closed_forms import INTEGRATORS

SPECULATIVE = int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)


def stepped(
    mjcf: str,
    *,
    seconds: float,
    step: float = 2e-3,
    integrator: str = "RK4",
    q: Sequence[float] = (),
    velocity: Sequence[float] = (),
    every: int = 1,
    enable: int = 0,
    tolerance: float = 1e-12,
) -> tuple[mujoco.MjModel, mujoco.MjData, Floats, Floats]:
    """Model, data at the end, (N, nq) positions and (N,) energies in J, every few steps.

    `q` and `velocity` fill the last coordinates; what comes before them keeps its default.
    """
    model = mujoco.MjModel.from_xml_string(mjcf)
    model.opt.timestep = step
    model.opt.integrator = INTEGRATORS[integrator]
    model.opt.tolerance = tolerance
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY) | enable
    data = mujoco.MjData(model)
    data.qpos[model.nq - len(q) :] = q
    data.qvel[model.nv - len(velocity) :] = velocity
    mujoco.mj_forward(model, data)
    positions, energies = [data.qpos.copy()], [data.energy.sum()]
    for _ in range(round(seconds / step) // every):
        mujoco.mj_step(model, data, every)
        positions.append(data.qpos.copy())
        energies.append(data.energy.sum())
    return model, data, np.array(positions), np.array(energies)


def warned(data: mujoco.MjData) -> bool:
    """Whether MuJoCo counted a warning, or left a number that is not finite."""
    counted = any(warning.number > 0 for warning in data.warning)
    return counted or not np.isfinite(data.qpos).all()


def hinge(inertia: float = 0.01, attributes: str = "") -> str:
    """A wheel on a vertical axis."""
    return (
        f'<mujoco><compiler angle="radian"/><worldbody><body><joint axis="0 0 1" {attributes}/>'
        f'<inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/></body>'
        "</worldbody></mujoco>"
    )


def chain(links: int, damping: float = 0.0) -> str:
    """Bars of 0.1 m and 0.5 kg hung on each other."""
    link = (
        '<body pos="0 0 {place}"><joint axis="0 1 0" damping="{damping}"/>'
        '<inertial pos="0 0 -0.05" mass="0.5" diaginertia="4e-4 4e-4 4e-4"/>'
    )
    bodies = "".join(
        link.format(place=-0.1 if number else 0.0, damping=damping) for number in range(links)
    )
    return f"<mujoco><worldbody>{bodies}{'</body>' * links}</worldbody></mujoco>"


def bail_on_base(ratio: float, *, free: bool) -> str:
    """A bail that swings on a base of 50 kg, `ratio` times as heavy, that stands on the floor."""
    mass = 50.0 / ratio
    return (
        '<mujoco><worldbody><geom type="plane" size="5 5 .1"/><body pos="0 0 0.2">'
        f'{"<freejoint/>" if free else ""}<geom type="box" size=".2 .2 .2" mass="50"/>'
        '<body pos="0 -0.2 0.1"><joint axis="1 0 0"/>'
        f'<inertial pos="0 0 -0.1" mass="{mass!r}" '
        f'diaginertia="{mass * 1e-3!r} {mass * 1e-3!r} {mass * 1e-3!r}"/>'
        "</body></body></worldbody></mujoco>"
    )


def stack(ratio: float, solref: float) -> str:
    """A cube of 50 kg on one that is `ratio` times lighter."""
    geom = f'type="box" size=".1 .1 .1" solref="{solref} 1"'
    return (
        f'<mujoco><worldbody><geom type="plane" size="5 5 .1" solref="{solref} 1"/>'
        f'<body pos="0 0 0.1"><freejoint/><geom {geom} mass="{50.0 / ratio}"/></body>'
        f'<body pos="0 0 0.3"><freejoint/><geom {geom} mass="50"/></body></worldbody></mujoco>'
    )


def sheet(thickness: float) -> str:
    """A cube of 5 cm above a fixed sheet."""
    return (
        '<mujoco><option gravity="0 0 0"/><worldbody>'
        f'<body><geom type="box" size=".5 .5 {thickness / 2}"/></body>'
        '<body pos="0 0 0.2"><freejoint/><geom type="box" size=".025 .025 .025" density="500"/>'
        "</body></worldbody></mujoco>"
    )


def sag(acceleration: float, solref: float = 0.02) -> float:
    """m by which a soft constraint of time constant `solref` (damping ratio 1, default impedance
    0.9 to 0.95) gives way under what would accelerate it so (MuJoCo manual, Computation)."""
    softest, stiffest = 0.9, 0.95
    return (1 - softest) / softest * acceleration * (stiffest * solref) ** 2 / softest
