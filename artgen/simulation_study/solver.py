"""The constraint solver: kind, iterations, tolerance against the scene solved to the end."""

from collections.abc import Iterator, Mapping
from functools import partial

import mujoco
import numpy as np

from artgen.core.mesh import Floats
from artgen.simulation.effects import Task
from artgen.simulation.paths import ALL, joint_path
from artgen.simulation_study.measured import Measured, timed

SOLVERS: Mapping[str, int] = {
    "PGS": mujoco.mjtSolver.mjSOL_PGS,
    "CG": mujoco.mjtSolver.mjSOL_CG,
    "Newton": mujoco.mjtSolver.mjSOL_NEWTON,
}
ITERATIONS = (1, 2, 5, 20, 100)
TOLERANCES = (1e-6, 1e-8, 1e-12)
STEP = 2e-3
SECONDS = 1.0

THROWN = """
<mujoco><worldbody>
  <geom type="plane" size="5 5 0.1"/>
  <body pos="0 0 0.305"><freejoint/>
    <geom type="box" size="0.3 0.25 0.3" density="300"/>
    <body pos="0 -0.25 0"><joint type="slide" axis="0 -1 0" range="0 0.4" frictionloss="4"
      damping="2"/><geom type="box" pos="0 0.2 0" size="0.2 0.2 0.08" density="200"
      contype="0" conaffinity="0"/></body>
  </body>
</worldbody></mujoco>
"""
"""A chest dropped by 5 mm and pushed across the floor, its drawer flying open against its stop."""

LIGHT_ON_HEAVY = """
<mujoco><worldbody>
  <geom type="plane" size="5 5 0.1"/>
  <body pos="0 0 0.201"><freejoint/>
    <geom type="box" size="0.2 0.2 0.2" mass="50"/>
    <body pos="0 -0.2 0.1"><joint type="hinge" axis="1 0 0" range="-1.57 1.57"
      frictionloss="1e-9"/><geom type="capsule" fromto="0 -0.05 -0.05 0 -0.05 0.05" size="0.005"
      mass="1e-6" contype="0" conaffinity="0"/></body>
  </body>
</worldbody></mujoco>
"""
"""A bail of one milligram on a free base of 50 kg: what a loose tolerance forgets."""


def solver_rows() -> Iterator[Measured]:
    """Both scenes with every solver, iterations and tolerance."""
    scenes = {"thrown chest": (THROWN, 1.5), "light bail, heavy base": (LIGHT_ON_HEAVY, 0.0)}
    for name, (mjcf, speed) in scenes.items():
        truth = _path(_model(mjcf, "Newton", 1000, 1e-15), speed)
        for solver in SOLVERS:
            for tolerance in TOLERANCES:
                for iterations in ITERATIONS:
                    model = _model(mjcf, solver, iterations, tolerance)
                    path, cpu_ms = timed(partial(_path, model, speed))
                    yield Measured(
                        scene=name,
                        setting=f"{solver}, tolerance {tolerance:g}",
                        step=float(iterations),
                        error=float(np.abs(path - truth).max()),
                        unit="rad or m",
                        cpu_ms=cpu_ms,
                    )


def _model(mjcf: str, solver: str, iterations: int, tolerance: float) -> mujoco.MjModel:
    model = mujoco.MjModel.from_xml_string(mjcf)
    model.opt.timestep = STEP
    model.opt.solver = SOLVERS[solver]
    model.opt.iterations = iterations
    model.opt.tolerance = tolerance
    return model


def _path(model: mujoco.MjModel, speed: float) -> Floats:
    """(N, 1) of the last joint: what hangs on the free base."""
    velocity = np.zeros(model.nv)
    velocity[1], velocity[-1] = -speed, 2.0 * speed
    start = np.array(model.qpos0)
    start[-1] += 0.3 if speed == 0.0 else 0.0
    task = Task(name="contact", start=start, velocity=velocity)
    return joint_path(model, task, ALL, steps=round(SECONDS / STEP))[:, -1:]
