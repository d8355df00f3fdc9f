"""Draft to ArticulatedObject: overlaps settled, edges rounded, unwrapped twice, weighed."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.canonical import canonicalize
from artgen.articulation.types import ArticulatedObject, Body, Draft, DraftPart, Mass, Part
from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, Ints, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.geometry.measure import combined, moments, open_edges, welded
from artgen.geometry.mend import without_crumbs, without_flat_triangles
from artgen.geometry.solid import AXES, Solid, union
from artgen.geometry.unwrap import atlas_uv, flat_uv, metric_uv

ATLAS_RESOLUTION = 1024
"""Texels along the atlas's side; charts keep two texels apart at this size."""
OVERLAP = 1e-9
"""m; boxes that share less than this in depth are taken as touching."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RawBody:
    """A closed body as arrays: vertices (V, 3) m, faces (F, 3), and the radius of its edges, m."""

    vertices: Floats
    faces: Ints
    radius: float


Rounder = Callable[[Sequence[RawBody]], Sequence[tuple[Floats, Ints]]]
"""Rounds the sharp convex edges of each body by its radius; Blender's worker is one."""


def finish(
    draft: Draft,
    *,
    asset_id: str,
    rounder: Rounder,
    provenance: Mapping[str, object] | None = None,
) -> ArticulatedObject:
    """The finished object in canonical form; meshes rounded to 1e-7 m, bodies closed and disjoint.

    Raises:
        GeometryError: a body vanishes under a later one, is open, or has no volume.
    """
    draft = canonicalize(draft)
    settled = [settle_overlaps(part) for part in draft.parts]
    meshes = meshed(settled, rounder)
    slots = {surface.name: k for k, surface in enumerate(draft.surfaces)}
    joined = [
        joined_mesh(part, bodies, slots, draft.surfaces)
        for part, bodies in zip(settled, meshes, strict=True)
    ]
    atlas = atlas_uv([(mesh.vertices, mesh.faces) for mesh in joined], resolution=ATLAS_RESOLUTION)
    parts = tuple(
        Part(
            name=part.name,
            label=part.label,
            mesh=_with_atlas(mesh, uv),
            collision=_collision(part),
            mass=_weighed(part, bodies),
            densities=tuple(body.density for body in part.bodies),
            grips=part.grips,
        )
        for part, bodies, mesh, uv in zip(settled, meshes, joined, atlas, strict=True)
    )
    return ArticulatedObject(
        category=draft.category,
        asset_id=asset_id,
        parts=parts,
        joints=draft.joints,
        surfaces=draft.surfaces,
        preconditions=draft.preconditions,
        provenance=dict(provenance or {}),
    )


def settle_overlaps(part: DraftPart) -> DraftPart:
    """Bodies made disjoint: where two overlap, the later one displaces the earlier."""
    boxes = np.array([body.solid.bounds for body in part.bodies])
    bodies = []
    for k, body in enumerate(part.bodies):
        depth = np.minimum(boxes[k, 1], boxes[k + 1 :, 1]) - np.maximum(
            boxes[k, 0], boxes[k + 1 :, 0]
        )
        later = [part.bodies[k + 1 + j] for j in np.flatnonzero((depth > OVERLAP).all(axis=1))]
        bodies.append(_displaced(part, body, later))
    return dataclasses.replace(part, bodies=tuple(bodies))


def _displaced(part: DraftPart, body: Body, later: Sequence[Body]) -> Body:
    crossing = [other.solid for other in later if not (body.solid & other.solid).is_empty]
    if not crossing:
        return body
    left = body.solid - union(crossing)
    if left.is_empty:
        raise GeometryError(
            f"part {part.name}: a body of {body.surface} vanishes inside later bodies; "
            "drop it or list it after them"
        )
    return dataclasses.replace(body, solid=left)


def meshed(parts: Sequence[DraftPart], rounder: Rounder) -> list[list[tuple[Floats, Ints]]]:
    """Vertices and faces a body of each part, rounded to the grid, in one call of the rounder."""
    raw = []
    for part in parts:
        for body in part.bodies:
            mesh = body.solid.trimesh()
            raw.append(RawBody(vertices=mesh.vertices, faces=mesh.faces, radius=body.edge))
    sharp = iter(rounder([body for body in raw if body.radius > 0.0]))
    rounded = [next(sharp) if body.radius > 0.0 else (body.vertices, body.faces) for body in raw]
    clean = iter([welded(np.round(v, VERTEX_DECIMALS) + 0.0, f) for v, f in rounded])
    return [[_closed(part, body, next(clean)) for body in part.bodies] for part in parts]


def _closed(part: DraftPart, body: Body, mesh: tuple[Floats, Ints]) -> tuple[Floats, Ints]:
    if (count := open_edges(mesh[1])) > 0:
        raise GeometryError(
            f"part {part.name}: a body of {body.surface} has {count} open edges after finishing; "
            "its solid has features thinner than 1e-7 m"
        )
    return without_flat_triangles(*without_crumbs(*mesh))


def joined_mesh(
    part: DraftPart,
    bodies: Sequence[tuple[Floats, Ints]],
    slots: Mapping[str, int],
    surfaces: Sequence[SurfaceSpec],
) -> TriMesh:
    """All bodies of a part in one mesh, each with its own vertices, slot and metric UV."""
    starts = np.cumsum([0] + [len(v) for v, _ in bodies])
    counts = [len(f) for _, f in bodies]
    for body in part.bodies:
        if body.surface not in slots:
            raise GeometryError(
                f"part {part.name}: surface {body.surface!r} is not among the object's "
                f"{sorted(slots)}; list it in Draft.surfaces"
            )
    return TriMesh(
        vertices=np.concatenate([v for v, _ in bodies]),
        faces=np.concatenate([f + start for (_, f), start in zip(bodies, starts, strict=False)]),
        uv=np.concatenate(
            [
                _uv(body, v, f, k)
                for k, (body, (v, f)) in enumerate(zip(part.bodies, bodies, strict=True))
            ]
        ),
        slot=np.repeat([slots[body.surface] for body in part.bodies], counts),
        body=np.repeat(np.arange(len(bodies)), counts),
    )


def _uv(body: Body, vertices: Floats, faces: Ints, place: int) -> Floats:
    if body.decal is not None:
        decal = body.decal
        return flat_uv(vertices, faces, origin=decal.origin, right=decal.right, up=decal.up)
    grain = None if body.grain is None else AXES[body.grain]
    return metric_uv(vertices, faces, grain=grain, place=place)


def _with_atlas(mesh: TriMesh, atlas: Floats) -> TriMesh:
    return dataclasses.replace(mesh, atlas=atlas)


def _collision(part: DraftPart) -> tuple[TriMesh, ...]:
    pieces = [piece for body in part.bodies for piece in body.collision]
    if not pieces:
        raise GeometryError(f"part {part.name} has no collision piece; author at least one")
    return tuple(collision_mesh(piece) for piece in pieces)


def collision_mesh(piece: Solid) -> TriMesh:
    """A convex piece on the grid of finished vertices."""
    mesh = piece.trimesh()
    vertices, faces = welded(np.round(mesh.vertices, VERTEX_DECIMALS) + 0.0, mesh.faces)
    return TriMesh(vertices=vertices, faces=faces)


def _weighed(part: DraftPart, bodies: Sequence[tuple[Floats, Ints]]) -> Mass:
    """Exact mass properties of the finished bodies at their densities."""
    pieces = []
    for body, (vertices, faces) in zip(part.bodies, bodies, strict=True):
        integral = moments(vertices[faces])
        if integral.volume <= 0.0:
            raise GeometryError(
                f"part {part.name}: a body of {body.surface} has volume {integral.volume} m3"
            )
        pieces.append((body.density, integral))
    mass, center, tensor = combined(pieces)
    return Mass(mass=mass, center=center, inertia=tensor)
