"""Where parts are at a state: products of joint motions, all in the object frame.

Every part frame coincides with the object frame at rest, so the pose of a part is the product of
the motions of the joints above it (product of exponentials; Murray, Li, Sastry 1994, section 3.2).
"""

from collections.abc import Sequence

import numpy as np

from artgen.articulation.types import Joint, State
from artgen.core.errors import KinematicError
from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import rigid


def joint_motion(joint: Joint, q: float) -> Floats:
    """(4, 4) motion of the child relative to its parent at `q`, in the object frame at rest."""
    if joint.type == "prismatic":
        return rigid(np.eye(3), np.multiply(q, joint.axis))
    rotation = axis_angle_matrix(joint.axis, q)
    origin = np.asarray(joint.origin)
    return rigid(rotation, origin - rotation @ origin)


def joint_motions(joint: Joint, q: Floats) -> Floats:
    """(K, 4, 4) motions of the child relative to its parent at each of (K,) values."""
    poses = np.tile(np.eye(4), (len(q), 1, 1))
    if joint.type == "prismatic":
        poses[:, :3, 3] = q[:, None] * joint.axis
        return poses
    x, y, z = joint.axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    half = np.sin(q / 2.0)[:, None, None]
    turns = np.eye(3) + np.sin(q)[:, None, None] * cross + 2.0 * half * half * (cross @ cross)
    origin = np.asarray(joint.origin)
    poses[:, :3, :3], poses[:, :3, 3] = turns, origin - turns @ origin
    return poses


def resolved(joints: Sequence[Joint], state: State) -> dict[str, float]:
    """q of every joint: named ones as given, mimics from their leader, all others at rest.

    Raises:
        KinematicError: the state names a joint that does not exist.
    """
    if unknown := sorted(set(state) - {joint.name for joint in joints}):
        known = ", ".join(joint.name for joint in joints)
        raise KinematicError(f"the state names unknown joints {unknown}; known: {known}")
    q = {joint.name: float(state.get(joint.name, 0.0)) for joint in joints}
    for joint in joints:
        if joint.mimic is not None:
            q[joint.name] = joint.mimic.multiplier * q[joint.mimic.joint] + joint.mimic.offset
    return q


def forward_kinematics(base: str, joints: Sequence[Joint], state: State) -> dict[str, Floats]:
    """Part name to (4, 4) `object_from_rest`: maps a part's points at rest to where they are
    now."""
    q = resolved(joints, state)
    poses = {base: np.eye(4)}
    for joint in joints:
        poses[joint.child] = poses[joint.parent] @ joint_motion(joint, q[joint.name])
    return poses
