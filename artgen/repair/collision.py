"""Collision: convex pieces by CoACD where there are none, or where one hull fills the part."""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence

import manifold3d as m3
import numpy as np

from artgen.core.errors import ArtgenError, GeometryError
from artgen.core.mesh import TriMesh
from artgen.geometry.convex import convexity_gap
from artgen.geometry.decompose import decomposed
from artgen.geometry.measure import closed
from artgen.geometry.solid import Solid
from artgen.repair.change import Change, Left, Outcome
from artgen.repair.draft import Draft, link_element, link_visual, unsound
from artgen.validate import validate_asset
from artgen.validate.levels import Selection
from artgen.validate.subject import body_volumes
from artgen.validate.urdf_subject import UrdfSubject

PIECES = 32
CONVEX = 0.999
"""Of its hull's volume that a body fills which stands for its own piece."""
STRAY = 0.02
"""Of a part's volume: pieces outside of the mesh by more than this invent what they meet."""


def mended_collision(draft: Draft, pieces: int) -> Iterator[Outcome]:
    """Missing and concave collision first, then pieces that meet where visual meshes do not."""
    subject = draft.subject()
    reasons: dict[str, str] = {}
    touched = {subject.links[shape.link].part for shape in subject.contact_shapes}
    for name, link in subject.links.items():
        own = [shape for shape in subject.contact_shapes if shape.link == name]
        if link.part not in touched:
            reasons[name] = "no collision was stated"
        elif len(own) == 1 and (gap := _gap(own[0].read)) > draft.bounds.hull_gap.value:
            reasons[name] = f"one mesh, concave by {gap:.3g} m, of which simulators take the hull"
    yield from _replaced(draft, subject, reasons, pieces)
    subject = draft.subject()
    yield from _replaced(draft, subject, _sticking_out(draft, subject), pieces)
    subject = draft.subject()
    yield from _replaced(draft, subject, _inventing(draft, subject), pieces)


def _gap(read: Callable[[], TriMesh]) -> float:
    """How concave a shape is, m; 0 for one that cannot be read, which the validator tells."""
    try:
        return convexity_gap(read())
    except (ArtgenError, OSError):
        return 0.0


def _sticking_out(draft: Draft, subject: UrdfSubject) -> dict[str, str]:
    """Links of parts whose pieces lie outside of their mesh, which is what the validator finds."""
    report = validate_asset(draft.source, Selection(names=("mesh.reach",)), draft.bounds)
    parts = {f.part.split(", ")[0] for f in report.findings if f.check == "mesh.reach"}
    why = f"pieces stick out by more than {draft.bounds.collision_reach.value:g} m"
    return {name: why for name, link in subject.links.items() if link.part in parts}


def _inventing(draft: Draft, subject: UrdfSubject) -> dict[str, str]:
    """Links whose pieces meet another part's where no visual meshes do, and stick out of the
    mesh."""
    checks = Selection(names=("motion.collision", "motion.overlap"))
    report = validate_asset(draft.source, checks, draft.bounds)
    real = {f.part for f in report.findings if f.check == "motion.overlap"}
    met = [f for f in report.findings if f.check == "motion.collision" and f.part not in real]
    blamed: dict[str, str] = {}
    for finding in met:
        for name, link in subject.links.items():
            if link.part in finding.part.split(", ") and _strays(subject, name):
                blamed[name] = f"its pieces meet where the meshes of {finding.part} do not"
    return blamed


def _strays(subject: UrdfSubject, link: str) -> bool:
    try:
        mesh = link_visual(subject, link)
        hulls = [_hull(shape.read()) for shape in subject.contact_shapes if shape.link == link]
    except (ArtgenError, OSError):
        return False
    if mesh is None or not hulls or not closed(mesh.faces):
        return False
    solid = _solid(mesh)
    outside = m3.Manifold.batch_boolean(hulls, m3.OpType.Add) - solid
    return bool(outside.volume() > STRAY * solid.volume())


def _replaced(
    draft: Draft, subject: UrdfSubject, reasons: dict[str, str], pieces: int
) -> Sequence[Outcome]:
    robot, outcomes = subject.robot, list[Outcome]()
    for name, why in reasons.items():
        try:
            mesh = link_visual(subject, name)
            if mesh is None:
                continue
            if (doubt := unsound(mesh, draft.bounds)) is not None:
                raise GeometryError(doubt)
            found = convex_pieces(mesh, pieces)
        except (ArtgenError, OSError) as error:
            kept = "its collision is left as it is"
            outcomes.append(Left(subject=name, why=f"{why}; {kept}: {error}"))
            continue
        link = link_element(robot, name)
        before = len(link.findall("collision"))
        _put_pieces(draft, link, found)
        outcomes.append(
            Change(
                subject=name,
                what="collision",
                before=f"{before} shapes" if before else "nothing",
                after=f"{len(found)} convex pieces",
                why=f"{why}; {open_interior(mesh, found)}",
            )
        )
    draft.save_if_changed(robot)
    return outcomes


def _put_pieces(draft: Draft, link: ET.Element, pieces: Sequence[TriMesh]) -> None:
    for old in link.findall("collision"):
        link.remove(old)
    for number, piece in enumerate(pieces):
        path = draft.add_mesh(f"{link.get('name')}_piece_{number}", piece)
        geometry = ET.SubElement(ET.SubElement(link, "collision"), "geometry")
        ET.SubElement(geometry, "mesh", filename=path)


def convex_pieces(mesh: TriMesh, pieces: int) -> tuple[TriMesh, ...]:
    """Bodies that are convex as they stand, and at most `pieces` of each other one by CoACD.

    Raises:
        GeometryError: CoACD is missing or failed.
    """
    found: list[TriMesh] = []
    for body in _bodies(mesh):
        hull = Solid(_hull(body))
        full = float(body_volumes(body).sum()) > CONVEX * hull.volume
        found += [hull.trimesh()] if full else decomposed(body, pieces=pieces)
    return tuple(found)


def _bodies(mesh: TriMesh) -> Iterator[TriMesh]:
    body = np.asarray(mesh.body)
    for number in range(int(body.max()) + 1):
        used, compact = np.unique(mesh.faces[body == number], return_inverse=True)
        yield TriMesh(vertices=mesh.vertices[used], faces=compact.reshape(-1, 3))


def open_interior(mesh: TriMesh, pieces: Sequence[TriMesh]) -> str:
    """How much of its hull a mesh leaves open, and how much of that its pieces leave open."""
    hull, solid = _hull(mesh), _solid(mesh)
    hollow = hull - solid
    share = hollow.volume() / hull.volume()
    if share < 1.0 - CONVEX:
        return "the mesh fills its hull"
    filled = m3.Manifold.batch_boolean([_hull(piece) for piece in pieces], m3.OpType.Add)
    left = (hollow - filled).volume() / hollow.volume()
    return f"the mesh leaves {share:.1%} of its hull open, the pieces {left:.1%} of that"


def _hull(mesh: TriMesh) -> m3.Manifold:
    return m3.Manifold.hull_points(np.array(mesh.vertices))


def _solid(mesh: TriMesh) -> m3.Manifold:
    """The union of a mesh's bodies."""
    bodies = [
        m3.Manifold(m3.Mesh64(np.array(body.vertices), body.faces.astype(np.uint64)))
        for body in _bodies(mesh)
    ]
    return m3.Manifold.batch_boolean(bodies, m3.OpType.Add)
