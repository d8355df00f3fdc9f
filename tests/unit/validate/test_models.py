"""Compiled models: mass properties are read as the compiler keeps them."""

import mujoco
import numpy as np
import pytest

from artgen.core.rotation import axis_angle_matrix
from artgen.validate.models import compiled_mass


@pytest.mark.parametrize("angle", [0.0, 1e-9, 3e-8, 9e-7, 1e-5, 0.3])
def test_a_tensor_turned_by_little_is_read_with_its_turn(angle: float) -> None:
    """MuJoCo's kinematics takes axes that are turned by less than 1e-6 for those of the body."""
    turn = axis_angle_matrix((0.0, 0.0, 1.0), angle)
    tensor = turn @ np.diag([0.8, 0.5, 0.4]) @ turn.T
    xx, yy, zz, xy, xz, yz = tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    full = " ".join(repr(float(entry)) for entry in (xx, yy, zz, xy, xz, yz))
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><body name="part" pos="1 2 3" euler="10 20 30">'
        f'<inertial pos="0 0 0" mass="1" fullinertia="{full}"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    body = model.body("part").id
    posed = data.xmat[body].reshape(3, 3)
    # The eigensolver and three products of matrices of order 1 cost some ulp of 1 each.
    found = compiled_mass(model, data, [body])[2]
    np.testing.assert_allclose(found, posed @ tensor @ posed.T, rtol=0, atol=2e-14)
