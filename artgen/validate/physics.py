"""MuJoCo with the settings under which its answers can be trusted."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import mujoco

TOLERANCE = 1e-12
"""The default of 1e-8 leaves 0.6 rad on a light handle of a free heavy base, and saves no time."""


def read_spec(path: Path) -> mujoco.MjSpec:
    """What MuJoCo reads from a MJCF or URDF file; ValueError where it refuses.

    Its asset cache returns the previous content of a rewritten mesh file, so it is switched off.
    """
    quiet()
    return mujoco.MjSpec.from_file(str(path))


def compiled(path: Path) -> mujoco.MjModel:
    """The model in a MJCF or URDF file, as `compiled_spec` makes it; ValueError where refused."""
    return compiled_spec(read_spec(path))


def compiled_spec(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """The model of a spec, with every part a body of its own.

    Defaults of MuJoCo would falsify a validation: it merges static bodies into the world; it resets
    a diverged state to rest. Visual meshes and textures cannot act on dynamics and take 90 % of the
    compile time, so they are left out; the mesh level reads them.

    Raises:
        ValueError: MuJoCo refuses the model.
    """
    spec.compiler.fusestatic = False
    spec.discard_visual()
    for exclude in list(spec.excludes):
        spec.delete(exclude)
    model = spec.compile()
    model.opt.tolerance = TOLERANCE
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_FILTERPARENT
    return model


def quiet() -> None:
    """Switch off the asset cache and the log of MuJoCo."""
    mujoco.mj_setCacheCapacity(mujoco.mj_getCache(), 0)
    _log_nowhere()


def _log_nowhere() -> None:
    """MuJoCo would append warnings to MUJOCO_LOG.TXT in the working directory; we count them."""
    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.logto_console = False
    config.set()


def body_names(model: mujoco.MjModel) -> list[str]:
    """Names by body number; the world comes first."""
    return [str(model.body(i).name) for i in range(model.nbody)]


def set_state(model: mujoco.MjModel, data: mujoco.MjData, q: Mapping[str, float]) -> None:
    """Put the joints at `q` (rad or m) and update poses alone."""
    for name, value in q.items():
        data.qpos[model.jnt_qposadr[model.joint(name).id]] = value
    mujoco.mj_kinematics(model, data)


@contextmanager
def simulating(model: mujoco.MjModel, *, off: int = 0, on: int = 0) -> Iterator[None]:
    """Effects of `mjtDisableBit` switched off, and extras of `mjtEnableBit` on, for a while; step
    and integrator may be changed meanwhile and come back too."""
    option = model.opt
    before = option.disableflags, option.enableflags, option.integrator, option.timestep
    option.disableflags |= off
    option.enableflags |= on
    try:
        yield
    finally:
        option.disableflags, option.enableflags, option.integrator, option.timestep = before


COARSE = 0.005
"""s; for questions that creep, sag and arrival answer: friction is met to 1.5 mm. Constraints
that are stiffer than two steps are softened to two steps by MuJoCo (`refsafe`)."""


def coarse_step(model: mujoco.MjModel) -> float:
    """The step of `COARSE`, or the model's own where springs need it or it is coarser."""
    return (
        float(model.opt.timestep)
        if model.jnt_stiffness.any() or model.tendon_stiffness.any()
        else max(COARSE, float(model.opt.timestep))
    )


def warnings_of(data: mujoco.MjData) -> list[str]:
    """Names of what MuJoCo warned of while it simulated."""
    counts = [warning.number for warning in data.warning]
    return [mujoco.mjtWarning(k).name for k, count in enumerate(counts) if count > 0]
