"""Principal axes: R diag(moments) R^T is the tensor, and quaternions are rotations."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from artgen.articulation.types import Mass, Vector
from artgen.core.rotation import axis_angle_matrix
from artgen.export.principal import (
    matrix_from_quaternion,
    principal_axes,
    quaternion_from_matrix,
    rotation_between,
)
from tests.strategies import axes, masses

EPS = float(np.finfo(float).eps)


@given(masses())
@settings(deadline=None)
def test_axes_and_moments_give_the_tensor_back(mass: Mass) -> None:
    """A Jacobi rotation costs some 4 eps of the norm; about 15 of them act before convergence."""
    moments, rotation = principal_axes(mass.inertia)
    scale = float(np.abs(mass.inertia).max())
    assert_allclose((rotation * moments) @ rotation.T, mass.inertia, rtol=0, atol=60 * EPS * scale)
    assert_allclose(rotation.T @ rotation, np.eye(3), rtol=0, atol=60 * EPS)
    assert np.linalg.det(rotation) > 0


@given(st.tuples(*[st.floats(1e-6, 1e3)] * 3))
def test_a_diagonal_tensor_keeps_its_axes(diagonal: tuple[float, float, float]) -> None:
    moments, rotation = principal_axes(np.diag(diagonal))
    assert_array_equal(moments, diagonal)
    assert_array_equal(rotation, np.eye(3))


@given(axes(), st.floats(-math.pi, math.pi))
@settings(deadline=None)
def test_quaternion_and_matrix_are_inverse(axis: Vector, angle: float) -> None:
    """Dividing by the largest component (>= 1/2) at most doubles the matrix's few eps."""
    matrix = axis_angle_matrix(axis, angle)
    quaternion = quaternion_from_matrix(matrix)
    assert quaternion[0] >= 0
    assert_allclose(matrix_from_quaternion(quaternion), matrix, rtol=0, atol=20 * EPS)


@given(st.sampled_from(np.eye(3).tolist()), axes())
@settings(deadline=None)
def test_the_rotation_takes_start_to_end(start: Vector, end: Vector) -> None:
    """Half turns are exact, the rest divides by 1 + cos >= 1: a few eps. The textbook form fails
    for `end` 1e-7 from opposite, where 1 + cos keeps one digit."""
    turned = matrix_from_quaternion(rotation_between(np.array(start), np.array(end))) @ start
    assert_allclose(turned, end, rtol=0, atol=10 * EPS)
