"""Handles on fitted fronts: never stretched, turned where they lay otherwise, on the face of the
front, on the side away from the hinge."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from artgen.assembly.fit import moved_piece
from artgen.assembly.piece import Piece
from artgen.assembly.source import Member, Side
from artgen.assembly.uv_fix import areas
from artgen.core.mesh import Floats, TriMesh

Lie = Literal["x", "z", "round"]
LONG = 1.3
"""A handle lies along its longer side if that is so many times the other."""
SCALES = (0.6, 1.6)
"""Least and greatest scale of a handle."""
MARGIN = 0.006
"""m; between a handle and the sides of its front."""
FOOT = 0.0006
"""m; what of a handle lies this near to its rear rests on the front."""
RESTS = 0.7
"""Least share of its foot that lies on the face of the front: all posts of a bar, not one."""
ON_FACE = 0.0035
"""m; a post may bridge a groove."""
FREE = 0.045
"""m; from the free side of a front to the middle of a handle, where nothing else tells."""
EVEN = 0.06
"""A handle may be turned by 90 degrees where it is symmetric: the middle of its surface lies within
this share of its width and height from the middle of its box."""


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where a handle goes on a front: its middle in x and z, m, and along what it lies."""

    x: float
    z: float
    lie: Lie


def lie_of(box: Floats) -> Lie:
    """Along what a handle lies."""
    width, _, height = np.diff(box, axis=0)[0]
    if width > LONG * height:
        return "x"
    return "z" if height > LONG * width else "round"


def turns_over(handle: Piece) -> bool:
    """Whether a handle looks the same turned by 90 degrees: a cup does not, a bar does."""
    box, triangles = handle.bounds, handle.mesh.triangles
    middle = np.average(triangles.mean(axis=1), axis=0, weights=areas(triangles))
    off, size = np.abs(middle - box.mean(axis=0)), np.diff(box, axis=0)[0]
    return bool((off <= EVEN * size)[[0, 2]].all())


def place_of(slot: Member, donor: Member, front: Floats) -> Place:
    """Where a handle goes on a slot's front (2, 3): where the slot's own was; else where the
    donor's was on its own front, as far from the free side, at the same share of the height."""
    if slot.handle is not None:
        box = slot.handle.bounds
        return Place(x=float(box[:, 0].mean()), z=float(box[:, 2].mean()), lie=lie_of(box))
    if donor.handle is None:
        return _usual_place(slot.side, front)
    box, own = donor.handle.bounds, donor.body.bounds
    share = (box.mean(axis=0) - own[0]) / (own[1] - own[0])
    x = _beside(box[:, 0].mean(), own[:, 0], front[:, 0], donor.side, slot.side, float(share[0]))
    z = front[0, 2] + share[2] * (front[1, 2] - front[0, 2])
    lie = lie_of(box)
    if slot.label != donor.label and lie != "round":
        lie = "x" if slot.side == "out" else "z"
    return Place(x=x, z=float(z), lie=lie)


def places_on(place: Place, side: Side, front: Floats, borders: Floats) -> Iterator[Place]:
    """A place and, where it may lie over a recess, the middle of the frame beside it: the stile
    away from the hinge, the upper rail of what slides out."""
    yield place
    stile, rail = borders[:, 0].max() / 2.0, borders[1, 2] / 2.0
    if side == "left" and stile > 0.0:
        yield replace(place, x=float(front[1, 0] - stile), lie="z")
    elif side == "right" and stile > 0.0:
        yield replace(place, x=float(front[0, 0] + stile), lie="z")
    elif rail > 0.0:
        yield replace(place, z=float(front[1, 2] - rail), lie="x")


def _usual_place(side: Side, front: Floats) -> Place:
    """The middle of a drawer; at half the height near the free side of a door; near the edge that
    comes forward of a flap."""
    x, z = front[:, 0].mean(), front[:, 2].mean()
    inset = min(FREE, 0.2 * float(front[1, 0] - front[0, 0]))
    if side == "left":
        return Place(x=float(front[1, 0] - inset), z=float(z), lie="z")
    if side == "right":
        return Place(x=float(front[0, 0] + inset), z=float(z), lie="z")
    drop = min(FREE, 0.2 * float(front[1, 2] - front[0, 2]))
    heights = {"bottom": front[1, 2] - drop, "top": front[0, 2] + drop}
    return Place(x=float(x), z=float(heights.get(side, z)), lie="x")


def _beside(x: float, own: Floats, front: Floats, donor: Side, slot: Side, share: float) -> float:
    """x as far from the free side of a hinged front as on the donor's; else the same share."""
    if slot not in ("left", "right") or donor not in ("left", "right"):
        return float(front[0] + share * (front[1] - front[0]))
    inward = float(own[1] - x) if donor == "left" else float(x - own[0])
    return float(front[1] - inward) if slot == "left" else float(front[0] + inward)


def mounted(handle: Piece, place: Place, front: TriMesh, *, scale: float) -> Piece | None:
    """The handle on a front: turned, scaled, moved inside the front's sides, its rear on the face.

    None where it does not fit or its foot would hang in the air.
    """
    box, room = handle.bounds, front.bounds
    turn = np.eye(3)
    lie = lie_of(box)
    if "round" not in (lie, place.lie) and lie != place.lie and turns_over(handle):
        turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    size = np.abs(turn @ np.diff(box, axis=0)[0])
    free = np.diff(room, axis=0)[0] - 2.0 * MARGIN
    scale = float(np.clip(scale, *SCALES))
    with np.errstate(divide="ignore"):  # A sheet seen edge-on has no width.
        scale = min(scale, float((free / size)[[0, 2]].min()))
    if scale < SCALES[0]:
        return None
    half = scale * size / 2.0
    middle = np.clip(
        [place.x, place.z],
        room[0, [0, 2]] + MARGIN + half[[0, 2]],
        room[1, [0, 2]] - MARGIN - half[[0, 2]],
    )
    anchor = np.array([box[:, 0].mean(), box[1, 1], box[:, 2].mean()])
    matrix = np.eye(4)
    matrix[:3, :3] = scale * turn
    matrix[:3, 3] = (middle[0], 0.0, middle[1]) - scale * turn @ anchor
    placed = moved_piece(handle, matrix)
    vertices = placed.mesh.vertices
    foot = vertices[vertices[:, 1] > vertices[:, 1].max() - FOOT]
    depth = face_depth(front, foot[:, [0, 2]])
    if not np.isfinite(depth).any():
        return None
    face = float(depth.min())
    if float((depth <= face + ON_FACE).mean()) < RESTS:
        return None
    matrix = np.eye(4)
    matrix[1, 3] = face
    return moved_piece(placed, matrix)


def face_depth(front: TriMesh, points: Floats) -> Floats:
    """(N,) y of a front's face at (N, 2) places in x and z; inf where there is none."""
    corners = front.triangles
    a, b, c = corners[:, :, [0, 2]].transpose(1, 0, 2)
    turn = _cross(b - a, c - a)
    seen = turn > 1e-14  # Winding that looks toward -y is positive in (x, z).
    a, b, c, y = a[seen], b[seen], c[seen], corners[seen, :, 1]
    depth = np.full(len(points), np.inf)
    for index, point in enumerate(points):
        weights = (
            np.stack(
                [
                    _cross(b - point, c - point),
                    _cross(c - point, a - point),
                    _cross(a - point, b - point),
                ]
            )
            / turn[seen]
        )
        inside = (weights >= -1e-9).all(axis=0)
        depth[index] = (weights[:, inside] * y[inside].T).sum(axis=0).min(initial=np.inf)
    return depth


def _cross(one: Floats, other: Floats) -> Floats:
    return np.asarray(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
