"""What of a surface lies in a box, triangle by triangle: right for surfaces that cross themselves,
too, which booleans take amiss.
"""

import numpy as np

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.distance import turns_about

CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
TOUCH = 1e-9
"""m; what reaches no farther into a box only touches it: faces in the plane of its sides."""
PROBE = 1e-6
"""m; so far within a box it is looked whether its corners lie inside of a surface, which may run
along its sides."""
INSIDE = 0.5
"""Turns of a surface about a point from which the point counts as inside."""


def points_within(mesh: TriMesh, cell: Floats) -> Floats:
    """(N, 3) points whose hull holds all that a closed surface encloses within a (2, 3) box: the
    corners of what of the surface lies there, and those of the box that lie inside."""
    corners = np.where(CORNERS == 0, cell[0], cell[1]).astype(float)
    probes = corners + PROBE * (1.0 - 2.0 * CORNERS)
    inside = corners[np.abs(turns_about(probes, mesh.triangles)) > INSIDE]
    return np.concatenate([clipped(mesh.triangles, cell).reshape(-1, 3), inside])


def clipped(triangles: Floats, cell: Floats) -> Floats:
    """(M, 3, 3) triangles that make up what of (N, 3, 3) triangles lies within a (2, 3) box, less
    what only touches its sides."""
    for axis in range(3):
        for end, sign in ((0, 1.0), (1, -1.0)):
            triangles = _beyond(triangles, axis, float(cell[end, axis]), sign)
    return triangles


def _beyond(triangles: Floats, axis: int, height: float, sign: float) -> Floats:
    """Triangles on the side of a plane across an axis to which `sign` points, cut at the plane."""
    above = sign * (triangles[:, :, axis] - height)
    triangles = triangles[reaching := (above > TOUCH).any(axis=1)]
    beyond = above[reaching] > 0.0
    count = beyond.sum(axis=1)
    one, two = count == 1, count == 2
    a, b, c = _led_by(triangles[one], beyond[one]).transpose(1, 0, 2)
    tips = np.stack([a, _at(a, b, axis, height), _at(a, c, axis, height)], axis=1)
    a, b, c = _led_by(triangles[two], ~beyond[two]).transpose(1, 0, 2)
    near, far = _at(b, a, axis, height), _at(c, a, axis, height)
    return np.concatenate(
        [
            triangles[count == 3],
            tips,
            np.stack([near, b, c], axis=1),
            np.stack([near, c, far], axis=1),
        ]
    )


def _led_by(triangles: Floats, marked: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> Floats:
    """Triangles turned so that their only marked corner comes first."""
    order = (np.argmax(marked, axis=1)[:, None] + np.arange(3)) % 3
    return np.asarray(np.take_along_axis(triangles, order[:, :, None], axis=1))


def _at(first: Floats, second: Floats, axis: int, height: float) -> Floats:
    """Where edges meet a plane across an axis."""
    share = (height - first[:, axis]) / (second[:, axis] - first[:, axis])
    found = first + share[:, None] * (second - first)
    found[:, axis] = height
    return np.asarray(found)
