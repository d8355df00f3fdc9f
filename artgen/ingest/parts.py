"""Parts: cleaned bodies as finished parts of ours, in canonical order and under names of theirs."""

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np

from artgen.articulation.canonical import canonical_order
from artgen.articulation.types import Mass, Part
from artgen.core.conventions import UV_DECIMALS
from artgen.core.errors import IngestError
from artgen.core.mesh import Floats, TriMesh
from artgen.finish import ATLAS_RESOLUTION
from artgen.geometry.unwrap import atlas_uv, metric_uv
from artgen.ingest.foreign import ForeignObject
from artgen.ingest.meshes.clean import Body, Outside, Washed, bodies_of, welded_soup
from artgen.ingest.meshes.pieces import convex_pieces
from artgen.ingest.meshes.soup import Soup
from artgen.ingest.meshes.weigh import weighed
from artgen.ingest.options import Options
from artgen.ingest.placing import Place
from artgen.ingest.reading import ReadMeshes
from artgen.ingest.surfaces import Surfaces

MOST_BODIES = 30_000
"""Bodies of one part; their numbers have 16 bits."""
LIGHTEST, HEAVIEST = 20.0, 12_000.0
"""kg/m3 between which solids are; a mass that asks for others is not believed."""
Bodies = Mapping[str, Sequence[Body]]
"""Part name of the source to its bodies, in the object frame at rest."""


def cleaned(foreign: ForeignObject, meshes: ReadMeshes, place: Place) -> tuple[Bodies, Washed]:
    """Bodies of all parts, welded, told apart and facing outward, and what that took.

    Raises:
        IngestError: a part has no triangle left, or falls into too many bodies.
    """
    found: dict[str, list[Body]] = {}
    washed = Washed()
    for part in foreign.parts:
        own: list[Body] = []
        for shape in part.shapes:
            if shape not in meshes.soups:
                continue
            soup, first = welded_soup(_moved(meshes.soups[shape], place, part.name))
            bodies, second = bodies_of(soup, shape.leaf)
            own += bodies
            washed = washed + first + second
        if not own:
            raise IngestError(f"{part.name} ({part.word}): no triangle of it has an area")
        if len(own) > MOST_BODIES:
            raise IngestError(f"{part.name} ({part.word}) falls into {len(own)} bodies; weld it")
        found[part.name] = own
    outside = Outside([body for own in found.values() for body in own])
    for name, own in found.items():
        faced = []
        for body in own:
            if not body.closed:
                body, turned = outside.facing_out(body)
                washed = washed + Washed(turned=turned, unsure=int(not body.certain))
            faced.append(body)
        found[name] = faced
    return found, washed


def _moved(soup: Soup, place: Place, part: str) -> Soup:
    return Soup(
        vertices=place.points(part, soup.vertices),
        faces=soup.faces,
        uv=soup.uv,
        look=soup.look,
        looks=soup.looks,
    )


def ordered_names(bodies: Bodies, labels: Mapping[str, str]) -> dict[str, str]:
    """Source's part name to ours, in canonical order: the role, numbered where it repeats."""
    listed = list(bodies)
    boxes = [_box(bodies[name]) for name in listed]
    order = [listed[k] for k in canonical_order(boxes)]
    count = Counter(labels[name] for name in order)
    seen: Counter[str] = Counter()
    names = {}
    for name in order:
        label = labels[name]
        seen[label] += 1
        names[name] = label if count[label] == 1 else f"{label}_{seen[label]}"
    return names


def _box(bodies: Sequence[Body]) -> Floats:
    points = np.concatenate([body.soup.vertices for body in bodies])
    return np.stack([points.min(axis=0), points.max(axis=0)])


def finished_parts(
    bodies: Bodies,
    names: Mapping[str, str],
    labels: Mapping[str, str],
    surfaces: Surfaces,
    options: Options,
    stated: Mapping[str, float],
    poses: Sequence[Mapping[str, Floats]],
) -> tuple[Part, ...]:
    """Meshes with both UV sets, collision pieces and mass, in the order of `names`.

    Args:
        stated: kg of parts that the source weighs; kept where that is a mass of solids.
        poses: part name of the source to (4, 4) motion from rest, at states in which collision
            pieces should not meet.

    Raises:
        GeometryError: the atlas cannot be packed, or a part has no mass.
    """
    meshes = {name: part_mesh(bodies[name], surfaces) for name in names}
    atlas = atlas_uv(
        [(mesh.vertices, mesh.faces) for mesh in meshes.values()], resolution=ATLAS_RESOLUTION
    )
    pieces = convex_pieces({name: bodies[name] for name in names}, most=options.pieces, poses=poses)
    parts = []
    for (name, mesh), uv in zip(meshes.items(), atlas, strict=True):
        own = bodies[name]
        solid = all(body.closed for body in own)
        mass = weighed(own, density=options.density, thickness=options.thickness)
        factor = mass_factor(mass, stated.get(name), options.density)
        parts.append(
            Part(
                name=names[name],
                label=labels[name],
                mesh=TriMesh(
                    vertices=mesh.vertices,
                    faces=mesh.faces,
                    uv=mesh.uv,
                    atlas=uv,
                    slot=mesh.slot,
                    body=mesh.body,
                ),
                collision=pieces[name],
                mass=_scaled(mass, factor),
                densities=(factor * options.density,) * len(own) if solid else None,
            )
        )
    return tuple(parts)


def mass_factor(mass: Mass, stated: float | None, density: float) -> float:
    """By how much heavier a part is than assumed: as stated, if its density is then that of a
    solid; else 1."""
    if stated is None:
        return 1.0
    factor = stated / mass.mass
    return factor if LIGHTEST <= factor * density <= HEAVIEST else 1.0


def _scaled(mass: Mass, factor: float) -> Mass:
    return Mass(mass=factor * mass.mass, center=mass.center, inertia=factor * mass.inertia)


def part_mesh(bodies: Sequence[Body], surfaces: Surfaces) -> TriMesh:
    """All bodies of a part in one mesh; texture coordinates as meters on the tile of each surface,
    by projection where the source has none."""
    starts = np.cumsum([0, *(len(body.soup.vertices) for body in bodies)])
    slots = [
        np.array([surfaces.slots[look.digest] for look in body.soup.looks])[body.soup.look]
        for body in bodies
    ]
    tiles = np.array([spec.tile for spec in surfaces.specs])
    return TriMesh(
        vertices=np.concatenate([body.soup.vertices for body in bodies]),
        faces=np.concatenate(
            [body.soup.faces + start for body, start in zip(bodies, starts, strict=False)]
        ),
        uv=np.concatenate(
            [
                _uv(body.soup, tiles[slot], place)
                for place, (body, slot) in enumerate(zip(bodies, slots, strict=True))
            ]
        ),
        slot=np.concatenate(slots),
        body=np.repeat(np.arange(len(bodies)), [len(body.soup.faces) for body in bodies]),
    )


def _uv(soup: Soup, tile: Floats, place: int) -> Floats:
    """(F, 3, 2) m; `tile` is (F, 2)."""
    stated = np.isfinite(soup.uv).all(axis=(1, 2))
    uv = np.round(soup.uv * tile[:, None, :], UV_DECIMALS)
    if not stated.all():
        faces = np.asarray(soup.faces, np.int32)
        uv[~stated] = metric_uv(soup.vertices, faces, grain=None, place=place)[~stated]
    return np.asarray(uv, np.float64)
