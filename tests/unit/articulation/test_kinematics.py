"""Laws of motion: inverses, composition, mimics."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from artgen.articulation.kinematics import forward_kinematics, joint_motion, resolved
from artgen.articulation.types import Joint, Limit, Mimic
from artgen.core.errors import KinematicError
from artgen.core.rotation import axis_angle_matrix, quaternion
from artgen.core.transform import apply, inverted, look_at, rigid
from tests.strategies import axes, joints, states, trees, vectors

ANGLES = st.one_of(st.floats(-7, 7), st.floats(-1e-7, 1e-7), st.just(math.pi))


@given(axes(), ANGLES)
def test_rotations_are_orthogonal_and_agree_with_quaternions(axis, angle) -> None:
    """Rodrigues' form sums three terms of size <= 2: 1e-14 is 45 roundings."""
    matrix = axis_angle_matrix(axis, angle)
    assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-14)
    assert_allclose(np.linalg.det(matrix), 1.0, atol=1e-14)
    w, x, y, z = quaternion(axis, angle)
    same = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    assert_allclose(matrix, same, atol=1e-14)


@given(joints(name="j", parent="a", child="b"), ANGLES, vectors())
def test_moving_a_point_and_moving_it_back_is_the_identity(joint, q, point) -> None:
    """Coordinates stay below 2 + 2 * 2 m; 1e-13 is 100 roundings of that."""
    there = apply(joint_motion(joint, q), point)
    back = apply(joint_motion(joint, -q), there)
    assert_allclose(back, point, atol=1e-13)
    assert_allclose(apply(inverted(joint_motion(joint, q)), there), point, atol=1e-13)


@given(joints(name="j", parent="a", child="b"), ANGLES)
def test_points_of_the_axis_stay_where_they_are(joint, q) -> None:
    if joint.type == "prismatic":
        return
    on_axis = np.add(joint.origin, np.multiply(0.7, joint.axis))
    assert_allclose(apply(joint_motion(joint, q), on_axis), on_axis, atol=1e-13)


@given(st.data(), trees())
def test_a_part_moves_with_its_parent(data, tree) -> None:
    """Relative to its parent, a part moves by its own joint alone."""
    state = data.draw(states(tree))
    poses = forward_kinematics("part_0", tree, state)
    q = resolved(tree, state)
    for joint in tree:
        relative = inverted(poses[joint.parent]) @ poses[joint.child]
        # Up to 4 products of matrices with entries below 10.
        assert_allclose(relative, joint_motion(joint, q[joint.name]), atol=1e-11)


def test_a_mimic_follows_its_leader() -> None:
    common = {"type": "prismatic", "parent": "base", "axis": (1.0, 0.0, 0.0)}
    free = {"limit": Limit(lower=0, upper=1), "friction": 0.0, "damping": 0.0, "effort": 1.0}
    leader = Joint(name="a", child="p", **common, **free)
    follower = Joint(
        name="b", child="q", mimic=Mimic(joint="a", multiplier=-2.0, offset=0.5), **common, **free
    )
    assert resolved([leader, follower], {"a": 0.25}) == {"a": 0.25, "b": 0.0}


def test_an_unknown_joint_in_a_state_is_named() -> None:
    with pytest.raises(KinematicError, match=r"unknown joints \['hinges'\]"):
        resolved([], {"hinges": 1.0})


@given(vectors(), vectors())
def test_a_camera_looks_at_its_target(eye, target) -> None:
    if np.linalg.norm(np.subtract(eye, target)[:2]) < 1e-3:
        return
    world_from_camera = look_at(eye, target)
    seen = apply(inverted(world_from_camera), target)
    distance = np.linalg.norm(np.subtract(target, eye))
    assert_allclose(seen, (0, 0, distance), atol=1e-11)
    rotation = world_from_camera[:3, :3]
    assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert rotation[2, 1] <= 0.0  # Image down is world down.


def test_rigid_holds_what_it_was_given() -> None:
    assert_allclose(rigid(np.eye(3), (1, 2, 3))[:3, 3], (1, 2, 3))
