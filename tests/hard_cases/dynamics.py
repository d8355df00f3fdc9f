"""Hard cases of simulation."""

import math

import numpy as np

from artgen.simulation_study.closed_forms import GRAVITY, pendulum
from tests.hard_cases.case import HardCase
from tests.hard_cases.scenes import (
    SPECULATIVE,
    bail_on_base,
    chain,
    hinge,
    sag,
    sheet,
    stack,
    stepped,
    warned,
)


def light_on_heavy(tolerance: float = 1e-12) -> float:
    """rad between a bail on a free base and one on a fixed base, worst over mass ratios."""
    worst = 0.0
    for ratio in (1e2, 1e4, 1e6, 1e8, 1e9):
        free, fixed = (
            stepped(bail_on_base(ratio, free=on), seconds=2.0, q=[0.5], tolerance=tolerance)[2]
            for on in (True, False)
        )
        worst = max(worst, float(np.abs(free[:, -1] - fixed[:, -1]).max()))
    return worst


def heavy_on_light(ratio: float = 100.0, solref: float = 0.004) -> float:
    """m by which the upper cube sinks in two seconds."""
    path = stepped(stack(ratio, solref), seconds=2.0, integrator="implicitfast")[2]
    return float(0.3 - path[-1, 9])


def thin_sheets(enable: int = SPECULATIVE) -> float:
    """m by which a thrown cube's middle comes nearer to the sheet than its half height."""
    worst = 0.0
    for thickness in (1e-3, 1e-4):
        for speed in (1.0, 5.0, 20.0):
            for step in (1e-3, 2e-3, 5e-3):
                path = stepped(
                    sheet(thickness),
                    seconds=0.5,
                    step=step,
                    integrator="implicitfast",
                    velocity=[0, 0, -speed, 0, 0, 0],
                    enable=enable,
                )[2]
                worst = max(worst, 0.025 + thickness / 2 - float(path[:, 2].min()))
    return worst


def needle_inertia() -> float:
    """Relative change of the energy of a tumbling body over 10 s, worst over inertia ratios."""
    worst = 0.0
    for ratio in (1e2, 1e6, 1e9, 1e12):
        mjcf = (
            '<mujoco><option gravity="0 0 0"/><worldbody><body><freejoint/><inertial pos="0 0 0" '
            f'mass="1" diaginertia="1 1 {1 / ratio!r}"/></body></worldbody></mujoco>'
        )
        energy = stepped(mjcf, seconds=10.0, velocity=[0, 0, 0, 1, 2, 3], every=50)[3]
        worst = max(worst, float(np.abs(energy / energy[0] - 1.0).max()))
    return worst


def stiff_spring(pulsation_steps: float = 0.5, integrator: str = "implicitfast") -> float:
    """rad of amplitude above the start's 0.1 rad."""
    path, _ = _sprung(pulsation_steps, integrator)
    return float(np.abs(path).max()) - 0.1


def _sprung(pulsation_steps: float, integrator: str) -> tuple[np.ndarray, bool]:
    step, inertia = 2e-3, 0.01
    stiffness = (pulsation_steps / step) ** 2 * inertia
    _, data, path, _ = stepped(
        hinge(inertia, f'stiffness="{stiffness}"'),
        seconds=4.0,
        integrator=integrator,
        q=[0.1],
    )
    return path, warned(data)


def strong_damper() -> float:
    """Relative error of where a damped wheel comes to rest, worst over dampers up to 1e6 I / dt."""
    step, inertia, worst = 2e-3, 0.01, 0.0
    for ratio in (0.5, 4.0, 1e2, 1e6):
        damping = ratio * inertia / step
        path = stepped(
            hinge(inertia, f'damping="{damping}"'),
            seconds=2.0,
            integrator="implicitfast",
            velocity=[1.0],
        )[2]
        worst = max(worst, abs(float(path[-1, 0]) * damping / inertia - 1.0))
    return worst


def damper_explodes_under_runge_kutta() -> bool:
    damping = 4.0 * 0.01 / 2e-3
    _, data, _, _ = stepped(hinge(0.01, f'damping="{damping}"'), seconds=2.0, velocity=[1.0])
    return warned(data)


def undamped_chain() -> float:
    """Energy that a chain of 8 gains over 1e5 steps, as a share of what it could fall."""
    _, _, _, energy = stepped(chain(8), seconds=100.0, step=1e-3, q=[0.5] * 8, every=100)
    return float((energy - energy[0]).max()) / _drop(8)


def damped_chains() -> float:
    """Energy that damped chains of 8, 16 and 32 gain over 1e5 steps, as a share."""
    worst = -math.inf
    for links in (8, 16, 32):
        _, _, _, energy = stepped(
            chain(links, 0.002), seconds=100.0, step=1e-3, q=[0.5] * links, every=500
        )
        worst = max(worst, float(np.diff(energy).max()) / _drop(links))
    return worst


def long_chain_explodes() -> bool:
    _, data, _, _ = stepped(
        chain(32), seconds=2.0, step=1e-3, integrator="implicitfast", q=[0.5] * 32, every=100
    )
    return warned(data)


def _drop(links: int) -> float:
    """J that a chain's bars could fall at most."""
    return 0.5 * links * GRAVITY * 0.1 * links


def million_steps() -> float:
    """Energy drift of a pendulum over a million steps, as a share of its range."""
    motion = pendulum()
    _, _, _, energy = stepped(motion.mjcf, seconds=2000.0, q=[1.0], every=1000)
    return float(np.abs(energy - energy[0]).max()) / (2 * 2.0 * GRAVITY * 0.3)


def far_limits() -> float:
    """rad by which 0.5 N m press a wheel beyond stops at pi, 6.5 and 20 rad."""
    worst = 0.0
    for stop in (math.pi, 6.5, 20.0):
        path = stepped(
            hinge(
                0.02,
                f'limited="true" range="{-stop!r} {stop!r}" stiffness="0.5" '
                f'springref="{stop + 1.0!r}"',
            ),
            seconds=60.0,
            integrator="implicitfast",
            every=100,
        )[2]
        worst = max(worst, abs(float(path[-1, 0]) - stop))
    return worst


CASES = (
    HardCase(
        name="light bail on a heavy free base, mass ratios 1e2 to 1e9",
        reason="a bucket's handle; a solver that stops early forgets the light body",
        error=light_on_heavy,
        bound=sag(GRAVITY) / 0.1,
        unit="rad",
        derived="the free base settles into the floor by the sag of its contact, which turns a "
        "bail of 0.1 m by sag / 0.1 m at most; the fixed one does not settle",
        outside="with MuJoCo's default tolerance of 1e-8 the bail is off by up to 0.6 rad, without "
        "a warning; validation sets 1e-12",
        seen=lambda: light_on_heavy(1e-8) > 10 * sag(GRAVITY) / 0.1,
    ),
    HardCase(
        name="50 kg on a cube up to 100 times lighter",
        reason="an appliance that stands on a shelf",
        error=heavy_on_light,
        bound=sag(GRAVITY * 101, 0.004),
        unit="m",
        derived="the light cube carries 101 times its weight, so its contact sags as under 101 g",
        outside="at 1000 : 1 and the default solref the light cube is crushed by 0.2 m, its own "
        "size; validation settles assets on a fixed base and never stacks them",
        seen=lambda: heavy_on_light(1000.0, 0.02) > 0.1,
    ),
    HardCase(
        name="sheets of 1 and 0.1 mm hit at 1 to 20 m/s",
        reason="thin panels; between two steps the cube is on either side of the sheet",
        error=thin_sheets,
        bound=0.025,
        unit="m",
        derived="a contact that is made before the impact holds: the cube's middle, half of 5 cm "
        "away, never reaches the sheet",
        outside="without MuJoCo's speculative contacts the cube passes at 5 m/s",
        seen=lambda: thin_sheets(0) > 0.1,
    ),
    HardCase(
        name="inertia ratios up to 1e12",
        reason="rods and needles; Euler's equations are stiff",
        error=needle_inertia,
        bound=5000 * (math.sqrt(14.0) * 2e-3) ** 5 / 120,
        unit="relative energy",
        derived="5000 steps of a fourth-order method whose error a step is (w dt)^5 / 120",
        outside="validation reports ratios above 1e6: a tensor that no household part has",
    ),
    HardCase(
        name="springs up to w dt = 0.5",
        reason="door closers and latches against the time step",
        error=stiff_spring,
        bound=0.1 * (1.0 / math.sqrt(1.0 - 0.5**2 / 4.0) - 1.0) + 1e-9,
        unit="rad",
        derived="semi-implicit Euler keeps q^2 + p^2 - h q p with p = v / w and h = w dt, an "
        "ellipse that reaches 1 / sqrt(1 - h^2 / 4) of its start",
        outside="from w dt = 2 on the motion diverges; MuJoCo warns, and settling reports it",
        seen=lambda: _sprung(2.5, "implicitfast")[1],
    ),
    HardCase(
        name="dampers up to 1e6 I / dt",
        reason="soft-close slides",
        error=strong_damper,
        bound=1e-6,
        unit="relative",
        derived="implicit damping conserves b q + I v exactly; what is left of v after 1000 steps "
        "is (1 + b dt / I)^-1000",
        outside="RK4 diverges from b dt / I = 2.8 on, with a warning; energy checks, which use it, "
        "leave damping off",
        seen=damper_explodes_under_runge_kutta,
    ),
    HardCase(
        name="undamped chain of 8 over 1e5 steps",
        reason="a desk lamp, many times over",
        error=undamped_chain,
        bound=1e-5,
        unit="share of its drop",
        derived="RK4 loses energy where it errs; a gain is bounded by its local error, below 1e-10 "
        "a step at 1 ms",
        outside="Euler, implicitfast and discrete gain up to 0.2 of the drop: energy is judged by "
        "RK4 alone",
    ),
    HardCase(
        name="damped chains of 8, 16 and 32 over 1e5 steps",
        reason="cables, blinds, cranes",
        error=damped_chains,
        bound=1e-6,
        unit="share of the drop",
        derived="friction only takes energy; between samples RK4's local error alone may raise it",
        outside="32 links under implicitfast diverge within a second, with a warning",
        seen=long_chain_explodes,
    ),
    HardCase(
        name="a million steps",
        reason="long episodes of training",
        error=million_steps,
        bound=1e6 * (7.0 * 2e-3) ** 5 / 120,
        unit="share of the range",
        derived="a million steps of RK4's local error (w dt)^5 / 120 with w = 7 rad/s at 2 ms",
        outside="Euler keeps 0.5 % and does not drift; at 10 ms RK4 loses 0.3 % and goes on losing",
    ),
    HardCase(
        name="stops at pi, 6.5 and 20 rad",
        reason="knobs and lids that turn far; angles must not wrap",
        error=far_limits,
        bound=sag(0.5 * 1.0 / 0.02),
        unit="rad",
        derived="a torque of 0.5 N m on 0.02 kg m2 presses the stop in by the sag of 25 rad/s2",
        outside="a revolute joint that turns further than 2 pi is reported: it is continuous",
    ),
)
