"""Rounding: coplanar triangles merged, sharp convex edges bevelled, everything checked in numpy."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bmesh
import numpy as np

from artgen.core.mesh import Floats, Ints
from artgen.finish_jobs import RoundJob, read_bodies, write_bodies
from artgen.geometry.measure import moments
from blender_scripts.soundness import LEAST_HEIGHT, Body, is_sound, without_caps

FLAT = math.radians(0.05)
"""Faces that meet at less than this are one plane."""
SHARP = math.radians(40.0)
"""Convex edges that turn by more than this are rounded; arcs are built in finer steps."""
FINE_RADIUS = 0.0008
"""m; below it one segment (a chamfer) is all that a render can show."""
LEAST_CUT = 0.06
"""Share of the asked volume that a visible bevel takes: a round of two segments takes about 0.55 of
the chamfer's triangle, a third of the radius a ninth of that."""
FAINT_CUT = 0.004
"""Share that a thin plate keeps, whose whole thickness is a twelfth of the diameter asked for."""


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
        if is_sound(body, vertices, faces, radius):
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
        bmesh.ops.dissolve_degenerate(mesh, dist=2.0 * LEAST_HEIGHT, edges=list(mesh.edges))
        bmesh.ops.triangulate(mesh, faces=list(mesh.faces))
        points, faces = _arrays(mesh)
        return points, without_caps(points, faces)
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
