"""Meeting: which pieces of different parts share room at which poses, as MuJoCo judges it."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import inverted
from artgen.validate.physics import quiet

TOUCH = 5e-5
"""m; half of the depth that the validator lets pieces share."""
SAME = 1e-7
"""m or 1; poses nearer than this to each other are one."""
MEMORY = 1 << 28
"""Bytes for contacts: some 500,000 of them."""
Pose = Mapping[str, Floats]
"""Part name to its (4, 4) motion from rest."""
Place = tuple[str, int]
"""A part and the number of one of its pieces."""
Meetings = Mapping[tuple[Place, Place], Sequence[Floats]]
"""Two pieces of different parts to the (4, 4) poses `first_from_second` at which they meet; the
poses of one course follow each other."""


def meetings(pieces: Mapping[str, Sequence[TriMesh]], poses: Sequence[Pose]) -> Meetings:
    """Every pair of pieces that meets deeper than `TOUCH` at one of the poses."""
    places = [(name, k) for name, own in pieces.items() for k in range(len(own))]
    model = _model(pieces)
    data = mujoco.MjData(model)
    found: dict[tuple[Place, Place], dict[tuple[int, ...], Floats]] = {}
    for pose in poses:
        data.qpos[:] = np.concatenate([_coordinates(pose[name]) for name in pieces])
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        deep = data.contact.dist < -TOUCH if data.ncon else np.zeros(0, bool)
        pairs = {(min(a, b), max(a, b)) for a, b in data.contact.geom[deep].tolist()}
        for one, other in sorted(pairs):
            first, second = places[one], places[other]
            relative = inverted(pose[first[0]]) @ pose[second[0]]
            key = tuple(np.round(relative[:3] / SAME).astype(np.int64).ravel().tolist())
            found.setdefault((first, second), {}).setdefault(key, relative)
    return {pair: list(own.values()) for pair, own in found.items()}


def _model(pieces: Mapping[str, Sequence[TriMesh]]) -> mujoco.MjModel:
    """One free body a part, its pieces in order."""
    quiet()
    spec = mujoco.MjSpec()
    spec.memory = MEMORY
    for name, own in pieces.items():
        body = spec.worldbody.add_body(name=name)
        body.add_freejoint()
        body.explicitinertial = True
        body.mass, body.inertia = 1.0, np.ones(3)
        for number, mesh in enumerate(own):
            label = f"{name}/{number}"
            added = spec.add_mesh(name=label)
            added.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX
            added.uservert, added.userface = mesh.vertices.ravel(), np.asarray(mesh.faces).ravel()
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=label)
    return spec.compile()


def _coordinates(pose: Floats) -> Floats:
    """(7,) position and quaternion of a (4, 4) pose."""
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(pose[:3, :3]).ravel())
    return np.concatenate([pose[:3, 3], quaternion])
