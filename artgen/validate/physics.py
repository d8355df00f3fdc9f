"""MuJoCo with the settings under which its answers can be trusted."""

from collections.abc import Mapping
from pathlib import Path

import mujoco

TOLERANCE = 1e-12
"""The default of 1e-8 leaves 1.4 rad on a light handle of a free heavy base, and saves no time."""


def compiled(path: Path) -> mujoco.MjModel:
    """The model in a MJCF or URDF file, with every part a body of its own.

    Three defaults of MuJoCo would falsify a validation: its asset cache returns the previous
    content of a rewritten mesh file; it merges static bodies into the world; it resets a diverged
    state to rest. Visual meshes and textures cannot act on dynamics and take 90 % of the compile
    time, so they are left out; the mesh level reads them.

    Raises:
        ValueError: MuJoCo refuses the file.
    """
    mujoco.mj_setCacheCapacity(mujoco.mj_getCache(), 0)
    _log_nowhere()
    spec = mujoco.MjSpec.from_file(str(path))
    spec.compiler.fusestatic = False
    spec.discard_visual()
    for exclude in list(spec.excludes):
        spec.delete(exclude)
    model = spec.compile()
    model.opt.tolerance = TOLERANCE
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_FILTERPARENT
    return model


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
