"""Motions of one joint that are known in closed form, and MuJoCo's error on them.

- Pendulum from rest at 120 degrees: theta(t) = 2 asin(k cd(w t, k^2)) with k = sin(theta0 / 2) and
  w^2 = m g l / I; cd = cn / dn of Jacobi's elliptic functions (DLMF 22.19.2).
- Drawer that slides against Coulomb friction: a parabola until it stands.
- Door with a closer and a damper: the damped oscillator, slack and stiff.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np
from scipy.special import ellipj

from artgen.core.mesh import Floats
from artgen.simulation.effects import Task, needed_effects
from artgen.simulation.paths import joint_path
from artgen.simulation_study.measured import Measured, timed

INTEGRATORS: Mapping[str, int] = {
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "discrete": mujoco.mjtIntegrator.mjINT_DISCRETE,
}
STEPS = (5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4)
"""s."""
GRAVITY = 9.81


@dataclass(frozen=True, kw_only=True, eq=False)
class Motion:
    """A joint's motion, simulated and exact.

    Attributes:
        mjcf: the scene; its only joint has one degree of freedom.
        exact: (N,) times in s to (N,) positions in rad or m.
        start, velocity: at time 0.
        seconds: how long it is followed.
        unit: of the error.
    """

    name: str
    mjcf: str
    exact: Callable[[Floats], Floats]
    start: float
    velocity: float = 0.0
    seconds: float
    unit: str

    def model(self, integrator: str, step: float) -> mujoco.MjModel:
        """The scene with an integrator and a time step, s."""
        model = mujoco.MjModel.from_xml_string(self.mjcf)
        model.opt.integrator = INTEGRATORS[integrator]
        model.opt.timestep = step
        model.opt.tolerance = 1e-12
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
        return model

    def task(self) -> Task:
        """Nothing is in the way."""
        return Task(
            name=self.name,
            start=np.array([self.start]),
            velocity=np.array([self.velocity]),
            clear=True,
        )

    def error(self, path: Floats, step: float) -> float:
        """Largest distance of an (N,) path from the exact one; infinite where it diverges."""
        times = step * np.arange(1, len(path) + 1)
        apart = np.abs(path - self.exact(times))
        return float(apart.max()) if np.isfinite(apart).all() else math.inf


def pendulum(*, angle: float = math.radians(120.0), seconds: float = 5.0) -> Motion:
    """A bar that swings from rest at `angle`, rad, without losses."""
    mass, arm, inertia = 2.0, 0.3, 0.02
    pulsation = math.sqrt(mass * GRAVITY * arm / (inertia + mass * arm**2))
    modulus = math.sin(angle / 2.0)

    def exact(times: Floats) -> Floats:
        _, cosine, delta, _ = ellipj(pulsation * times, modulus**2)
        return np.asarray(2.0 * np.arcsin(modulus * cosine / delta))

    inertial = f'pos="0 0 {-arm}" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"'
    return Motion(
        name="pendulum",
        mjcf=_scene('type="hinge" axis="0 1 0"', inertial),
        exact=exact,
        start=angle,
        seconds=seconds,
        unit="rad",
    )


def friction_drawer() -> Motion:
    """A drawer of 3 kg pushed open at 0.6 m/s that friction of 6 N stops after 90 mm."""
    mass, force, speed = 3.0, 6.0, 0.6
    slowing = force / mass

    def exact(times: Floats) -> Floats:
        moving = np.minimum(times, speed / slowing)
        return np.asarray(speed * moving - slowing * moving**2 / 2.0)

    return Motion(
        name="friction drawer",
        mjcf=_scene(
            f'type="slide" axis="0 1 0" frictionloss="{force}"',
            f'pos="0 0 0" mass="{mass}" diaginertia="0.1 0.1 0.1"',
        ),
        exact=exact,
        start=0.0,
        velocity=speed,
        seconds=0.6,
        unit="m",
    )


def sprung_door(*, stiffness: float, damping: float, name: str) -> Motion:
    """A door of 2 kg m2 that a closer of `stiffness` N m/rad pulls shut against `damping`
    N m s/rad, from 1.2 rad."""
    inertia, start = 2.0, 1.2
    decay = damping / (2.0 * inertia)
    pulsation = math.sqrt(stiffness / inertia - decay**2)

    def exact(times: Floats) -> Floats:
        wave = np.cos(pulsation * times) + decay / pulsation * np.sin(pulsation * times)
        return np.asarray(start * np.exp(-decay * times) * wave)

    return Motion(
        name=name,
        mjcf=_scene(
            f'type="hinge" axis="0 0 1" stiffness="{stiffness}" damping="{damping}"',
            f'pos="0 0 0" mass="20" diaginertia="{inertia} {inertia} {inertia}"',
        ),
        exact=exact,
        start=start,
        seconds=2.0,
        unit="rad",
    )


def motions() -> tuple[Motion, ...]:
    """All closed forms of the study."""
    return (
        pendulum(),
        friction_drawer(),
        sprung_door(stiffness=20.0, damping=4.0, name="damped and sprung door"),
        sprung_door(stiffness=2e4, damping=4.0, name="stiff closer"),
    )


def integrator_rows() -> Iterator[Measured]:
    """Every motion with every integrator and time step."""
    for motion in motions():
        for integrator in INTEGRATORS:
            for step in STEPS:
                yield measured(motion, integrator, step)


def measured(motion: Motion, integrator: str, step: float) -> Measured:
    """Error and price of one combination."""
    model = motion.model(integrator, step)
    steps = round(motion.seconds / step)
    effects = needed_effects(model, motion.task())
    path, cpu_ms = timed(lambda: joint_path(model, motion.task(), effects, steps=steps))
    return Measured(
        scene=motion.name,
        setting=integrator,
        step=step,
        error=motion.error(path[:, 0], step),
        unit=motion.unit,
        cpu_ms=cpu_ms,
    )


def observed_order(motion: Motion, integrator: str, steps: tuple[float, float]) -> float:
    """Slope of log error over log step between two time steps."""
    coarse, fine = (measured(motion, integrator, step).error for step in steps)
    return math.log(coarse / fine) / math.log(steps[0] / steps[1])


def _scene(joint: str, inertial: str) -> str:
    return (
        f'<mujoco><option gravity="0 0 {-GRAVITY}"/><worldbody><body><joint {joint}/>'
        f"<inertial {inertial}/></body></worldbody></mujoco>"
    )
