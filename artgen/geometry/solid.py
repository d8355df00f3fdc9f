"""An algebra of solids on manifold3d: values in, values out, float64 throughout.

`box`, `slab`, `prism`, `cylinder`, `cone`, `tube`, `revolve`, `wire` and `hull` make solids; `|`,
`-`, `&` combine them; `at`, `turned`, `mirrored` place them. Lengths in m, angles in rad."""

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Literal

import manifold3d as m3
import numpy as np
from numpy.typing import ArrayLike

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.profile import arc_segments, circle

Axis = Literal["x", "y", "z"]
AXES: dict[Axis, int] = {"x": 0, "y": 1, "z": 2}


class Solid:
    """A closed, outward, non-empty region of space."""

    __slots__ = ("_manifold",)

    def __init__(self, manifold: m3.Manifold) -> None:
        if manifold.status() != m3.Error.NoError:
            raise GeometryError(
                f"manifold3d reports {manifold.status().name}; the shape is not closed"
            )
        self._manifold = manifold

    @property
    def manifold(self) -> m3.Manifold:
        """The wrapped value, for geometry modules."""
        return self._manifold

    def __or__(self, other: "Solid") -> "Solid":
        return Solid(self._manifold + other._manifold)

    def __sub__(self, other: "Solid") -> "Solid":
        return Solid(self._manifold - other._manifold)

    def __and__(self, other: "Solid") -> "Solid":
        return Solid(self._manifold ^ other._manifold)

    def at(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Solid":
        """Moved by (x, y, z) m."""
        return Solid(self._manifold.translate((x, y, z)))

    def turned(
        self, axis: Axis, angle: float, *, about: Sequence[float] = (0.0, 0.0, 0.0)
    ) -> "Solid":
        """Turned by `angle` rad about the axis through `about`, right-handed."""
        return self.transformed(rotation_about(axis, angle, about))

    def transformed(self, a_from_b: ArrayLike) -> "Solid":
        """Moved by a (4, 4) affine matrix."""
        return Solid(self._manifold.transform(np.asarray(a_from_b, float)[:3]))

    def mirrored(self, axis: Axis) -> "Solid":
        """Mirrored in the plane through zero across `axis`; stays outward."""
        normal = [0.0, 0.0, 0.0]
        normal[AXES[axis]] = 1.0
        return Solid(self._manifold.mirror(normal))

    def hull(self) -> "Solid":
        """The smallest convex solid around this one."""
        return Solid(self._manifold.hull())

    @property
    def is_empty(self) -> bool:
        """True when a boolean left nothing."""
        return bool(self._manifold.is_empty())

    @property
    def volume(self) -> float:
        """m3."""
        return float(self._manifold.volume())

    @property
    def bounds(self) -> Floats:
        """(2, 3) lower then upper corner, m."""
        return np.array(self._manifold.bounding_box()).reshape(2, 3)

    @property
    def extent(self) -> Floats:
        """(3,) upper minus lower, m."""
        lower, upper = self.bounds
        return np.asarray(upper - lower)

    def pieces(self) -> list["Solid"]:
        """Connected components."""
        return [Solid(piece) for piece in self._manifold.decompose()]

    def trimesh(self) -> TriMesh:
        """Triangles in float64, no UV."""
        mesh = self._manifold.to_mesh64()
        return TriMesh(
            vertices=np.asarray(mesh.vert_properties)[:, :3], faces=np.asarray(mesh.tri_verts)
        )


def rotation_about(axis: Axis, angle: float, about: Sequence[float]) -> Floats:
    """(4, 4) right-handed rotation about the axis through a point."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(4)
    cos, sin = math.cos(angle), math.sin(angle)
    matrix[i, i] = matrix[j, j] = cos
    matrix[i, j], matrix[j, i] = -sin, sin
    point = np.asarray(about, float)
    matrix[:3, 3] = point - matrix[:3, :3] @ point
    return matrix


def box(size: Sequence[float], *, at: Sequence[float] = (0.0, 0.0, 0.0)) -> Solid:
    """A cuboid centered in x and y above `at`, its bottom at `at`."""
    sx, sy, sz = (float(v) for v in size)
    x, y, z = (float(v) for v in at)
    return slab((x - sx / 2, y - sy / 2, z), (x + sx / 2, y + sy / 2, z + sz))


def slab(lower: Sequence[float], upper: Sequence[float]) -> Solid:
    """The cuboid between two corners."""
    low, high = np.asarray(lower, float), np.asarray(upper, float)
    if not (high > low).all():
        raise GeometryError(
            f"a slab from {low.tolist()} to {high.tolist()} is empty; "
            "upper must exceed lower on each axis"
        )
    return Solid(m3.Manifold.cube(high - low).translate(low))


def prism(outline: ArrayLike, height: float, *, holes: Iterable[ArrayLike] = ()) -> Solid:
    """A counter-clockwise (N, 2) outline in x, y pushed up from z = 0 to `height`, minus holes."""
    if height <= 0.0:
        raise GeometryError(f"a prism of height {height} m is empty; height must be positive")
    loops = [np.asarray(outline, float), *(np.asarray(h, float)[::-1] for h in holes)]
    cap = np.asarray(m3.triangulate(loops))
    plane = np.concatenate(loops)
    count = len(plane)
    starts = np.cumsum([0] + [len(loop) for loop in loops])
    here = np.arange(count)
    following = np.concatenate([np.roll(here[a:b], -1) for a, b in pairwise(starts)])
    walls = np.stack([here, following, following + count, here, following + count, here + count])
    faces = np.concatenate([cap[:, ::-1], cap + count, walls.T.reshape(-1, 3)])
    vertices = np.concatenate([np.c_[plane, np.zeros(count)], np.c_[plane, np.full(count, height)]])
    return Solid(m3.Manifold(m3.Mesh64(vertices, faces.astype(np.uint64))))


def upright(solid: Solid, axis: Axis) -> Solid:
    """What was drawn along +z laid along +x or +y; x, y of the drawing become (y, z) or (z, x)."""
    cycle = {"z": np.eye(3), "x": np.eye(3)[[2, 0, 1]], "y": np.eye(3)[[1, 2, 0]]}[axis]
    matrix = np.eye(4)
    matrix[:3, :3] = cycle
    return solid.transformed(matrix)


def cylinder(
    radius: float, height: float, *, axis: Axis = "z", segments: int | None = None
) -> Solid:
    """A round bar from 0 to `height` along +axis."""
    return upright(prism(circle(radius, segments=segments), height), axis)


def cone(
    bottom: float, top: float, height: float, *, axis: Axis = "z", segments: int | None = None
) -> Solid:
    """A truncated cone from radius `bottom` at 0 to `top` at `height` along +axis."""
    count = segments or max(8, arc_segments(max(bottom, top)))
    return upright(Solid(m3.Manifold.cylinder(height, bottom, top, count)), axis)


def tube(
    outer: float, inner: float, height: float, *, axis: Axis = "z", segments: int | None = None
) -> Solid:
    """A round pipe from 0 to `height` along +axis."""
    count = segments or max(8, arc_segments(outer))
    ring = prism(circle(outer, segments=count), height, holes=[circle(inner, segments=count)])
    return upright(ring, axis)


def revolve(outline: ArrayLike, *, axis: Axis = "z", segments: int | None = None) -> Solid:
    """An (N, 2) outline of (radius >= 0, height) points, counter-clockwise, turned about +axis.

    manifold3d rounds the outline to 1e-8 m here.
    """
    points = np.asarray(outline, float)
    count = segments or max(8, arc_segments(float(points[:, 0].max())))
    section = m3.CrossSection([points], m3.FillRule.Positive)
    return upright(Solid(m3.Manifold.revolve(section, count)), axis)


def hull(points: ArrayLike) -> Solid:
    """The convex hull of (N, 3) points."""
    return Solid(m3.Manifold.hull_points(np.asarray(points, float)))


def union(solids: Iterable[Solid]) -> Solid:
    """All of them, joined in one pass."""
    return Solid(m3.Manifold.batch_boolean([s.manifold for s in solids], m3.OpType.Add))


def loft(rings: ArrayLike) -> Solid:
    """A skin through (K, N, 3) rings, counter-clockwise as seen from the last, with flat ends."""
    return Solid(m3.Manifold(_skin(np.asarray(rings, float), closed=False)))


def chamfered_box(
    size: Sequence[float], chamfer: float, *, at: Sequence[float] = (0.0, 0.0, 0.0)
) -> Solid:
    """A cuboid standing on `at` with all twelve edges cut at 45 degrees by `chamfer` m; convex."""
    half = np.asarray(size, float) / 2.0
    if chamfer <= 0.0 or chamfer >= half.min():
        raise GeometryError(f"chamfer {chamfer} m must lie between 0 and half of {list(size)} m")
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    reach = half - chamfer * (1.0 - np.eye(3))  # the corner of each of the three faces there
    points = (signs[:, None, :] * reach[None]).reshape(-1, 3)
    return hull(points + np.asarray(at, float) + (0.0, 0.0, half[2]))


def wire(path: ArrayLike, radius: float, *, sides: int = 6, closed: bool = False) -> Solid:
    """A round wire along an (N, 3) polyline, mitred at the corners; one piece, no self-overlap
    inside.

    The cross-section is a regular polygon whose area equals that of the round wire, so mass is
    right."""
    points = np.asarray(path, float)
    fair = radius * math.sqrt(2.0 * math.pi / (sides * math.sin(2.0 * math.pi / sides)))
    rings = _mitred_rings(points, fair, sides, closed)
    return Solid(m3.Manifold(_skin(rings, closed)))


def _mitred_rings(points: Floats, radius: float, sides: int, closed: bool) -> Floats:
    """(N, sides, 3) rings, each in the plane that bisects its corner, twist carried along."""
    following = np.roll(points, -1, axis=0) - points
    leg = following / np.linalg.norm(following, axis=1, keepdims=True)
    legs_in = np.roll(leg, 1, axis=0)
    if not closed:
        leg[-1], legs_in[0] = leg[-2], leg[0]
    helper = np.eye(3)[int(np.argmin(np.abs(leg[0])))]
    side = np.cross(leg[0], helper)
    side /= np.linalg.norm(side)
    angles = 2.0 * math.pi * (np.arange(sides) + 0.5) / sides
    rings = []
    for point, before, after in zip(points, legs_in, leg, strict=True):
        up = np.cross(before, side)
        up /= np.linalg.norm(up)
        side = np.cross(up, before)
        ring = radius * (np.cos(angles)[:, None] * side + np.sin(angles)[:, None] * up)
        mitre = before + after
        ring -= before * ((ring @ mitre) / (before @ mitre))[:, None]  # slide along the wire
        rings.append(point + ring)
        turn = after - before * (before @ after)
        if np.linalg.norm(turn) > 1e-12:
            side = _carried(side, before, after)
    return np.array(rings)


def _carried(vector: Floats, before: Floats, after: Floats) -> Floats:
    """`vector` turned by the least rotation that takes `before` to `after` (both unit)."""
    cross, cos = np.cross(before, after), float(before @ after)
    return np.asarray(
        vector * cos + np.cross(cross, vector) + cross * (cross @ vector) / (1.0 + cos)
    )


def _skin(rings: Floats, closed: bool) -> m3.Mesh64:
    """Quads between consecutive rings, and caps at open ends."""
    count, sides = rings.shape[:2]
    index = np.arange(count * sides).reshape(count, sides)
    triangles: list[Sequence[int]] = []
    last = count if closed else count - 1
    for k in range(last):
        low, high = index[k], index[(k + 1) % count]
        for i in range(sides):
            j = (i + 1) % sides
            triangles += [(low[i], low[j], high[j]), (low[i], high[j], high[i])]
    if not closed:
        for i in range(1, sides - 1):
            triangles.append((index[0][0], index[0][i + 1], index[0][i]))
            triangles.append((index[-1][0], index[-1][i], index[-1][i + 1]))
    return m3.Mesh64(rings.reshape(-1, 3), np.array(triangles, np.uint64))
