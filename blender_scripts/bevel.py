"""Rounding: coplanar triangles merged, sharp convex edges bevelled, everything checked in numpy."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bmesh
import numpy as np

from artgen.core.mesh import Floats, Ints
from artgen.finish_jobs import RoundJob, read_bodies, write_bodies
from artgen.geometry.measure import moments, welded

FLAT = math.radians(0.05)
"""Faces that meet at less than this are one plane."""
SHARP = math.radians(40.0)
"""Convex edges that turn by more than this are rounded; arcs are built in finer steps."""
FINE_RADIUS = 0.0008
"""m; below it one segment (a chamfer) is all that a render can show."""
DECIMALS = 7
"""Finished vertices are rounded to 1e-7 m; a body must survive that."""
LEAST_VOLUME_KEPT = 0.6
"""A bevel that clamps itself to the body still keeps more than this: a cube rounded to a ball keeps
pi / 6 = 0.52, which no design asks for."""
LEAST_CUT = 0.06
"""Share of the asked volume that a visible bevel takes: a round of two segments takes about 0.55 of
the chamfer's triangle, a third of the radius a ninth of that."""
FAINT_CUT = 0.004
"""Share that a thin plate keeps, whose whole thickness is a twelfth of the diameter asked for."""
LEAST_HEIGHT = 5e-7
"""m; a triangle flatter than this has no dependable normal once rounded to 1e-7 m."""
SLACK = 2e-6
"""m by which a bevel may leave the old bounds: float32 at 1 m is 6e-8, times a few operations."""

Body = tuple[Floats, Ints]


def run(job: Mapping[str, Any], _threads: int) -> dict[str, Any]:
    """Round every body of the job's input; equal bodies are worked once."""
    task = RoundJob(**job)
    bodies, radii = read_bodies(Path(task.input))
    done: dict[bytes, Body | None] = {}
    rounded, kept_sharp = [], []
    for index, ((vertices, faces), radius) in enumerate(zip(bodies, radii, strict=True)):
        center = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
        local = np.round(vertices - center, 9)
        key = local.tobytes() + faces.tobytes() + float(radius).hex().encode()
        if key not in done:
            done[key] = rounded_body(local, faces, float(radius))
        body = done[key]
        if body is None:
            kept_sharp.append(index)
            rounded.append((vertices, faces))
        else:
            rounded.append((body[0] + center, body[1]))
    write_bodies(Path(task.output), rounded)
    return {"kept_sharp": kept_sharp, "bodies": len(bodies), "distinct": len(done)}


def rounded_body(vertices: Floats, faces: Ints, radius: float) -> Body | None:
    """The body with rounded edges; None when no bevel of it stays sound.

    Blender shrinks one body's radius to what its shortest edge allows. Where that leaves nothing to
    see, the chains of sharp edges that touch short edges stay sharp instead. Vertices lie around
    zero, so that Blender's float32 costs them 3e-8 of the body's own size.
    """
    faint = None
    for shortest in (0.0, radius / 4.0, radius):
        body, asked = _bevelled(vertices, faces, radius, shortest)
        if asked == 0.0:
            break
        if is_sound(body, vertices, faces):
            cut = moments(vertices[faces]).volume - moments(body[0][body[1]]).volume
            if cut >= LEAST_CUT * asked:
                return body
            if cut >= FAINT_CUT * asked and faint is None:
                faint = body
    return faint


def _bevelled(vertices: Floats, faces: Ints, radius: float, shortest: float) -> tuple[Body, float]:
    """The bevelled triangles, and the volume (m3) that the bevel should take off."""
    mesh = bmesh.new()
    try:
        _fill(mesh, vertices.tolist(), faces.tolist())
        bmesh.ops.dissolve_limit(
            mesh, angle_limit=FLAT, verts=list(mesh.verts), edges=list(mesh.edges), delimit=set()
        )
        sharp = [edge for edge in mesh.edges if edge.is_convex and edge.calc_face_angle() > SHARP]
        if shortest > 0.0:
            sharp = _roomy(sharp, shortest)
        asked = sum(e.calc_length() * math.sin(e.calc_face_angle()) for e in sharp)
        bmesh.ops.bevel(
            mesh,
            geom=sharp,
            offset=radius,
            offset_type="OFFSET",
            segments=1 if radius < FINE_RADIUS else 2,
            profile=0.5,
            affect="EDGES",
            clamp_overlap=True,
        )
        return _triangulated(*_sorted_polygons(mesh)), 0.5 * radius * radius * asked
    finally:
        mesh.free()


def _sorted_polygons(mesh: bmesh.types.BMesh) -> tuple[list[list[float]], list[list[int]]]:
    """Points and polygons in an order that follows from the shape alone: the bevel makes its faces
    in the order of memory addresses."""
    mesh.verts.index_update()
    points = np.array([vertex.co for vertex in mesh.verts], np.float64).reshape(-1, 3)
    order = np.lexsort(points.T[::-1])
    place = np.argsort(order)
    polygons = []
    for face in mesh.faces:
        loop = [int(place[vertex.index]) for vertex in face.verts]
        first = loop.index(min(loop))
        polygons.append(loop[first:] + loop[:first])
    return points[order].tolist(), sorted(polygons)


def _triangulated(points: list[list[float]], polygons: list[list[int]]) -> Body:
    """Triangles of the polygons, collapsed ones dissolved."""
    mesh = bmesh.new()
    try:
        _fill(mesh, points, polygons)
        bmesh.ops.dissolve_degenerate(mesh, dist=1e-7, edges=list(mesh.edges))
        bmesh.ops.triangulate(mesh, faces=list(mesh.faces))
        return _arrays(mesh)
    finally:
        mesh.free()


def _fill(mesh: bmesh.types.BMesh, points: list[list[float]], polygons: list[list[int]]) -> None:
    placed = [mesh.verts.new(point) for point in points]
    for polygon in polygons:
        mesh.faces.new([placed[k] for k in polygon])
    mesh.normal_update()


def _roomy(sharp: list[bmesh.types.BMEdge], shortest: float) -> list[bmesh.types.BMEdge]:
    """Those connected chains of sharp edges where no edge at any vertex is below `shortest` m."""
    chain = {vertex: vertex for edge in sharp for vertex in edge.verts}

    def root(vertex: bmesh.types.BMVert) -> bmesh.types.BMVert:
        while chain[vertex] != vertex:
            chain[vertex] = chain[chain[vertex]]
            vertex = chain[vertex]
        return vertex

    for edge in sharp:
        chain[root(edge.verts[0])] = root(edge.verts[1])
    cramped = {
        root(vertex)
        for vertex in chain
        if any(edge.calc_length() < shortest for edge in vertex.link_edges)
    }
    return [edge for edge in sharp if root(edge.verts[0]) not in cramped]


def _arrays(mesh: bmesh.types.BMesh) -> Body:
    mesh.verts.index_update()
    points = np.array([vertex.co for vertex in mesh.verts], np.float64).reshape(-1, 3)
    corners = [[vertex.index for vertex in face.verts] for face in mesh.faces]
    return points, np.array(corners, np.int32).reshape(-1, 3)


def is_sound(body: Body, vertices: Floats, faces: Ints) -> bool:
    """True when `body` is a closed, outward 2-manifold of proper triangles that still fills the
    sharp body it came from, and stays one after rounding to 1e-7 m."""
    if len(body[1]) < 4 or not np.isfinite(body[0]).all():
        return False
    points, triangles = welded(np.round(body[0], DECIMALS), body[1])
    if not (is_manifold(body[1]) and is_manifold(triangles)):
        return False
    outside = np.maximum(points.max(axis=0) - vertices.max(axis=0), 0.0)
    outside = np.maximum(outside, vertices.min(axis=0) - points.min(axis=0))
    if least_height(points[triangles]) < LEAST_HEIGHT:
        return False
    old, new = moments(vertices[faces]).volume, moments(points[triangles]).volume
    return bool(outside.max() <= SLACK and LEAST_VOLUME_KEPT * old < new <= old * (1.0 + 1e-5))


def least_height(corners: Floats) -> float:
    """The smallest height over the longest side among (F, 3, 3) triangles, m."""
    a, b, c = corners.transpose(1, 0, 2)
    doubled = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    longest = np.linalg.norm(np.stack([b - a, c - b, a - c]), axis=2).max(axis=0)
    return float((doubled / longest).min())


def is_manifold(faces: Ints) -> bool:
    """True when every edge is used once in each direction."""
    if len(faces) == 0:
        return False
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    size = int(edges.max()) + 1
    forth, back = np.sort(edges @ (size, 1)), np.sort(edges @ (1, size))
    return bool((np.diff(forth) > 0).all() and np.array_equal(forth, back))
