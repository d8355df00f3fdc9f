"""Principal axes of inertia, in plain float64 arithmetic that every machine repeats bit for bit."""

import math

import numpy as np

from artgen.core.mesh import Floats

SWEEPS = 12
"""Cyclic Jacobi converges quadratically; symmetric 3 x 3 matrices need at most 6 or 7 sweeps."""


def principal_axes(inertia: Floats) -> tuple[Floats, Floats]:
    """(3,) moments and (3, 3) rotation R with inertia = R diag(moments) R^T, det R = 1.

    Jacobi rotations (Golub and Van Loan, section 8.5) instead of LAPACK: a diagonal tensor keeps
    its axes, and the result does not depend on which BLAS kernel a processor gets.
    """
    a = [[float(inertia[i][j]) for j in range(3)] for i in range(3)]
    r = [[1.0 if i == j else 0.0 for j in range(3)] for i in range(3)]
    for _ in range(SWEEPS):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            _rotate(a, r, p, q)
    return np.array([a[0][0], a[1][1], a[2][2]]), np.array(r)


def _rotate(a: list[list[float]], r: list[list[float]], p: int, q: int) -> None:
    """Turn the plane (p, q) so that a[p][q] vanishes; changes both matrices."""
    if a[p][q] == 0.0:
        return
    theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q])
    t = math.copysign(1.0, theta) / (abs(theta) + math.sqrt(theta * theta + 1.0))
    c = 1.0 / math.sqrt(t * t + 1.0)
    s = t * c
    for k in range(3):
        a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
    for k in range(3):
        a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
        r[k][p], r[k][q] = c * r[k][p] - s * r[k][q], s * r[k][p] + c * r[k][q]
    a[p][q] = a[q][p] = 0.0


def quaternion_from_matrix(rotation: Floats) -> Floats:
    """(4,) unit quaternion w, x, y, z with w >= 0 (Shepperd 1978: divides by the largest)."""
    m = np.asarray(rotation, float)
    squares = np.array(
        [
            1.0 + m[0, 0] + m[1, 1] + m[2, 2],
            1.0 + m[0, 0] - m[1, 1] - m[2, 2],
            1.0 - m[0, 0] + m[1, 1] - m[2, 2],
            1.0 - m[0, 0] - m[1, 1] + m[2, 2],
        ]
    )
    products = np.array(
        [
            [squares[0], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], squares[1], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
            [m[0, 2] - m[2, 0], m[0, 1] + m[1, 0], squares[2], m[1, 2] + m[2, 1]],
            [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], squares[3]],
        ]
    )
    row = products[int(np.argmax(squares))]
    unit = row / math.sqrt(float(np.sum(row * row)))
    return np.asarray(unit if unit[0] >= 0.0 else -unit)


def matrix_from_quaternion(quaternion: Floats) -> Floats:
    """(3, 3) rotation of a quaternion w, x, y, z of any length but zero."""
    w, x, y, z = np.asarray(quaternion, float) / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def rotation_between(start: Floats, end: Floats) -> Floats:
    """(4,) quaternion that takes the coordinate axis `start` to the unit vector `end`.

    Behind `start` the least rotation loses its digits (1 + cos cancels), so an exact half turn goes
    first.
    """
    if float(np.dot(start, end)) < 0.0:
        half_turn = np.array([0.0, *np.roll(start, 1)])
        return product(rotation_between(-start, end), half_turn)
    raw = np.array([1.0 + float(np.dot(start, end)), *np.cross(start, end)])
    return np.asarray(raw / math.sqrt(float(np.sum(raw * raw))))


def product(left: Floats, right: Floats) -> Floats:
    """(4,) quaternion of `right`, then `left`."""
    a, u, b, v = left[0], left[1:], right[0], right[1:]
    return np.array([a * b - float(np.dot(u, v)), *(a * v + b * u + np.cross(u, v))])
