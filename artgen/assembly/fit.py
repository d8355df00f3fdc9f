"""Donors fitted to slots: a scale for each axis, mirrored, frames kept at their width."""

import dataclasses
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Grip, Vector
from artgen.assembly.piece import Piece, body_boxes
from artgen.assembly.uv_fix import fixed_uv
from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.mesh import Floats, Ints, TriMesh
from artgen.export.kinematics import vector
from artgen.geometry.convex import as_box
from artgen.geometry.measure import welded
from artgen.geometry.solid import hull

EDGE = 0.001
"""m; a body that comes this near to a side of the front's box lies along it."""
SPAN = 0.5
"""Least share of a side that a stile or rail covers."""
DEEPEST = 0.35
"""Greatest share of the box that one border may take."""
MIDDLE = 0.2
"""Share of the slot that has to be left between two borders."""
UNEVEN = 1.5
"""Unequal scales beyond this keep borders even where no frame is found."""
BORDER = 0.15
"""Border of a front without a frame, as a share of its shorter side."""
Across = Literal[0, 2]


@dataclass(frozen=True, kw_only=True, eq=False)
class BoxMap:
    """A separable map of a box onto another: piecewise linear along each axis, then mirrored.

    Attributes:
        source: (2, 3) box that is mapped, m.
        target: (2, 3) box that it is mapped onto, m.
        borders: (2, 3) widths along the lower and upper sides of the source that keep their size;
            0 where there is none.
        mirrored: left and right change places.
    """

    source: Floats
    target: Floats
    borders: Floats
    mirrored: bool

    @property
    def scale(self) -> Floats:
        """(3,) extent of the target over that of the source."""
        return np.asarray(np.diff(self.target, axis=0)[0] / np.diff(self.source, axis=0)[0])

    def points(self, points: Floats) -> Floats:
        """(N, 3) points mapped; those outside of the box go on as its outermost span does."""
        mapped = np.stack([self._along(axis, points[:, axis]) for axis in range(3)], axis=1)
        if self.mirrored:
            mapped[:, 0] = self.target[:, 0].sum() - mapped[:, 0]
        return mapped

    def _along(self, axis: int, values: Floats) -> Floats:
        here = self._knots(self.source[:, axis], axis)
        there = self._knots(self.target[:, axis], axis)
        inner = np.interp(values, here, there)
        first = (there[1] - there[0]) / (here[1] - here[0])
        last = (there[-1] - there[-2]) / (here[-1] - here[-2])
        below = there[0] + (values - here[0]) * first
        above = there[-1] + (values - here[-1]) * last
        upward = np.where(values > here[-1], above, inner)
        return np.asarray(np.where(values < here[0], below, upward))

    def _knots(self, ends: Floats, axis: int) -> Floats:
        low, high = self.borders[:, axis]
        inside = [ends[0] + low] * bool(low > 0.0) + [ends[1] - high] * bool(high > 0.0)
        return np.array([ends[0], *inside, ends[1]])


def box_map(front: Piece, slot: Floats, *, mirrored: bool) -> BoxMap:
    """The map of a donor's body onto the box of a slot: borders of a frame keep their width where
    they fit; a plain front that would be stretched unevenly keeps its own border as well."""
    source = front.bounds
    borders = frame_borders(front)
    scale = np.diff(slot, axis=0)[0] / np.diff(source, axis=0)[0]
    uneven = max(scale[0], scale[2]) / min(scale[0], scale[2])
    if not borders.any() and uneven > UNEVEN:
        size = np.diff(source, axis=0)[0]
        borders[:, [0, 2]] = BORDER * min(size[0], size[2])
    room = (1.0 - MIDDLE) * np.diff(slot, axis=0)[0]
    borders[:, borders.sum(axis=0) > room] = 0.0
    return BoxMap(source=source, target=slot, borders=borders, mirrored=mirrored)


def frame_borders(front: Piece) -> Floats:
    """(2, 3) widths of the stiles and rails along the sides of a front in x and z, m; 0 where the
    front is not framed there."""
    boxes, whole = body_boxes(front.mesh), front.bounds
    borders = np.zeros((2, 3))
    if len(boxes) < 3:
        return borders
    for across, along in ((0, 2), (2, 0)):
        size, length = whole[1] - whole[0], boxes[:, 1, along] - boxes[:, 0, along]
        depth = boxes[:, 1, across] - boxes[:, 0, across]
        member = (length >= SPAN * size[along]) & (depth <= DEEPEST * size[across])
        for end in (0, 1):
            at_edge = member & (np.abs(boxes[:, end, across] - whole[end, across]) < EDGE)
            borders[end, across] = depth[at_edge].max(initial=0.0)
        if borders[:, across].min() == 0.0:
            borders[:, across] = 0.0
    return borders


def fitted(piece: Piece, how: BoxMap) -> Piece:
    """A piece under a map: meshes, collision and grips; UV as dense as they were, grain turned
    back, outward winding kept."""
    vertices = np.round(how.points(piece.mesh.vertices), VERTEX_DECIMALS) + 0.0
    faces, uv = piece.mesh.faces, np.asarray(piece.mesh.uv)
    if how.mirrored:
        faces, uv = faces[:, [0, 2, 1]], uv[:, [0, 2, 1]]
    mesh = dataclasses.replace(piece.mesh, vertices=vertices, faces=faces, uv=uv)
    before = dataclasses.replace(piece.mesh, faces=faces, uv=uv)
    return dataclasses.replace(
        piece,
        mesh=dataclasses.replace(mesh, uv=fixed_uv(before, vertices, mirrored=how.mirrored)),
        collision=tuple(mapped_convex(c, how) for c in piece.collision),
        grips=tuple(_mapped_grip(grip, how) for grip in piece.grips),
    )


def mapped_convex(piece: TriMesh, how: BoxMap) -> TriMesh:
    """A collision piece under a map: boxes stay boxes, other pieces become the hull of what their
    corners map to."""
    points = np.round(how.points(piece.vertices), VERTEX_DECIMALS) + 0.0
    if as_box(piece) is not None:
        faces = piece.faces[:, [0, 2, 1]] if how.mirrored else piece.faces
        return TriMesh(vertices=points, faces=faces)
    return convex_mesh(points)


def convex_mesh(points: Floats) -> TriMesh:
    """The hull of (N, 3) points on the grid of finished vertices."""
    mesh = hull(points).trimesh()
    vertices, faces = welded(np.round(mesh.vertices, VERTEX_DECIMALS) + 0.0, mesh.faces)
    return TriMesh(vertices=vertices, faces=faces)


def _mapped_grip(grip: Grip, how: BoxMap) -> Grip:
    flip = np.array([-1.0, 1.0, 1.0]) if how.mirrored else np.ones(3)
    return dataclasses.replace(
        grip,
        position=vector(how.points(np.array([grip.position]))[0]),
        outward=vector(flip * grip.outward + 0.0),
        pull=vector(flip * grip.pull + 0.0),
    )


def moved_piece(piece: Piece, matrix: Floats) -> Piece:
    """A piece under a rigid motion and one scale (4, 4); UV grow with it, so that they stay meters
    on the surface."""
    turn = matrix[:3, :3]
    scale = float(np.cbrt(np.linalg.det(turn)))

    def placed(points: Floats) -> Floats:
        return np.asarray(np.round(points @ turn.T + matrix[:3, 3], VERTEX_DECIMALS) + 0.0)

    def direction(values: Vector) -> Vector:
        return vector(np.round(turn @ np.array(values) / scale, 12) + 0.0)

    def convex(mesh: TriMesh) -> TriMesh:
        return TriMesh(vertices=placed(mesh.vertices), faces=mesh.faces)

    mesh = dataclasses.replace(
        piece.mesh, vertices=placed(piece.mesh.vertices), uv=np.asarray(piece.mesh.uv) * scale
    )
    return dataclasses.replace(
        piece,
        mesh=mesh,
        collision=tuple(convex(c) for c in piece.collision),
        grips=tuple(
            dataclasses.replace(
                g,
                position=vector(placed(np.array([g.position]))[0]),
                outward=direction(g.outward),
                pull=direction(g.pull),
            )
            for g in piece.grips
        ),
    )


def flat_triangles(vertices: Floats, faces: Ints) -> int:
    """How many triangles have next to no area."""
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return int((np.linalg.norm(np.cross(b - a, c - a), axis=1) < 4e-14).sum())
