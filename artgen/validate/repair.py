"""A mended copy of a stranger's URDF, and a list of every change made to it."""

import copy
import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import manifold3d as m3
import numpy as np

from artgen.core.jsonio import write_bytes
from artgen.core.mesh import Floats, TriMesh
from artgen.export.numbers import exact
from artgen.export.obj import hull_text
from artgen.geometry.convex import convexity_gap
from artgen.geometry.decompose import decomposed
from artgen.geometry.measure import closed, moments, welded
from artgen.geometry.measure import inertia as tensor_of
from artgen.geometry.solid import Solid
from artgen.validate.assembly import merged
from artgen.validate.bounds import Bounds
from artgen.validate.inertia import rigid
from artgen.validate.interior import hollow_points, inside_any
from artgen.validate.meshfile import as_bodies
from artgen.validate.stated import StatedJoint
from artgen.validate.structure import tree
from artgen.validate.urdf_subject import UrdfSubject

DENSITY = 700.0
"""kg/m3 where a link states no mass: wood, and plastic or sheet metal with air inside."""
QUARTER = math.pi / 2.0
SLIDE_SHARE = 0.8
"""Of its part's length along the axis, where a slide states no limit."""
EFFORT, VELOCITY = 50.0, 1.0
PIECES = 32
TENSOR = (("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2))


@dataclass(frozen=True, kw_only=True)
class Change:
    """One thing that was mended: what it was, what it is, and why."""

    part: str
    what: str
    before: str
    after: str
    reason: str

    def __str__(self) -> str:
        return f"{self.part}: {self.what}: {self.before} -> {self.after} ({self.reason})"


@dataclass(frozen=True, kw_only=True, eq=False)
class Repair:
    """A copy in the making: the document that is changed, and where its meshes go."""

    subject: UrdfSubject
    robot: ET.Element
    folder: Path
    pieces: int

    @property
    def bounds(self) -> Bounds:
        """Bounds that tell what needs mending."""
        return self.subject.bounds

    def link(self, name: str) -> ET.Element:
        """The link's element."""
        return next(e for e in self.robot.iterfind("link") if e.get("name") == name)

    def write_mesh(self, stem: str, mesh: TriMesh) -> str:
        """Write a mesh; its path relative to the URDF."""
        path = f"meshes/{self.subject.name}_{stem}.obj"
        write_bytes(self.folder / path, hull_text(mesh).encode())
        return path


def repaired(subject: UrdfSubject, folder: Path, *, pieces: int = PIECES) -> list[Change]:
    """Write `folder`/NAME.urdf with its meshes beside it; what was changed, in order.

    Raises:
        ArtgenError: a mesh cannot be read, or the joints make no tree: that is beyond mending.
    """
    work = Repair(subject=subject, robot=copy.deepcopy(subject.robot), folder=folder, pieces=pieces)
    changes = list(mended_joints(work))
    for link in subject.robot.iterfind("link"):
        name = link.get("name", "")
        visual, dropped = mended_visuals(work, name)
        changes += dropped
        if visual is not None:
            changes += mended_collision(work, name, visual)
            changes += mended_inertia(work, name, visual)
    ET.indent(work.robot)
    text = ET.tostring(work.robot, encoding="utf-8", xml_declaration=True)
    write_bytes(folder / f"{subject.name}.urdf", text + b"\n")
    return changes


def mended_joints(work: Repair) -> Iterator[Change]:
    """Axes of length 1, limits in order, efforts and speeds above 0, dampers that damp."""
    for joint, element in zip(
        work.subject.stated_joints, work.robot.iterfind("joint"), strict=True
    ):
        if joint.moves:
            yield from _mended_axis(joint, element)
            yield from _mended_limits(work, joint, element)
            yield from _mended_dynamics(joint, element)


def _set(
    element: ET.Element, tag: str, values: dict[str, str], part: str, reason: str
) -> Iterator[Change]:
    """Set attributes of a child, which is made if missing; a change for each that differs."""
    child = element.find(tag)
    if child is None:
        child = ET.SubElement(element, tag)
    for key, after in values.items():
        before = child.get(key, "nothing")
        if before != after:
            child.set(key, after)
            yield Change(part=part, what=f"{tag} {key}", before=before, after=after, reason=reason)


def _mended_axis(joint: StatedJoint, element: ET.Element) -> Iterator[Change]:
    norm = math.hypot(*joint.axis)
    if len(joint.axis) == 3 and norm > 0.0 and math.isfinite(norm) and abs(norm - 1.0) > 1e-12:
        unit = exact(np.array(joint.axis) / norm)
        yield from _set(element, "axis", {"xyz": unit}, joint.name, "axes have length 1")


def _mended_limits(work: Repair, joint: StatedJoint, element: ET.Element) -> Iterator[Change]:
    if joint.limited and not joint.lower < joint.upper:
        lower, upper, reason = 0.0, QUARTER, "no limit was stated: a quarter turn is assumed"
        if joint.lower > joint.upper:
            lower, upper, reason = joint.upper, joint.lower, "the bounds were exchanged"
        elif joint.type == "prismatic":
            upper = SLIDE_SHARE * _length(work, joint)
            reason = f"no limit was stated: {SLIDE_SHARE:g} of the part's length is assumed"
        values = {"lower": exact(lower), "upper": exact(upper)}
        yield from _set(element, "limit", values, joint.name, reason)
    for key, value, usual in (
        ("effort", joint.effort, EFFORT),
        ("velocity", joint.velocity, VELOCITY),
    ):
        if value is not None and not (math.isfinite(value) and value > 0.0):
            reason = "a joint of none cannot move"
            yield from _set(element, "limit", {key: exact(usual)}, joint.name, reason)


def _length(work: Repair, joint: StatedJoint) -> float:
    """How long a joint's child is along its axis, m."""
    shapes = [s for s in work.subject.visuals if s.link == joint.child]
    points = np.concatenate([shape.read().vertices for shape in shapes]) if shapes else np.eye(3)
    return float(np.ptp(points @ np.array(joint.axis)))


def _mended_dynamics(joint: StatedJoint, element: ET.Element) -> Iterator[Change]:
    for key, value in (("friction", joint.friction), ("damping", joint.damping)):
        if value is not None and not (math.isfinite(value) and value >= 0.0):
            reason = "a negative one drives the joint"
            yield from _set(element, "dynamics", {key: "0.0"}, joint.name, reason)


def mended_visuals(work: Repair, name: str) -> tuple[TriMesh | None, list[Change]]:
    """All visual shapes of a link in its frame, written as OBJ without scale or turned origin;
    triangles that stand there twice, or have no extent, are left out."""
    meshes, changes = [], []
    link = work.link(name)
    shapes = [shape for shape in work.subject.visuals if shape.link == name]
    for number, (shape, element) in enumerate(zip(shapes, link.findall("visual"), strict=True)):
        mesh = shape.read()
        clean = _deduplicated(mesh)
        meshes.append(clean)
        _point_to(element, work.write_mesh(f"{name}_{number}", clean))
        if (count := len(mesh.faces) - len(clean.faces)) > 0:
            before, after = f"{len(mesh.faces)} triangles", f"{len(clean.faces)}"
            reason = f"{count} stood there twice or had no extent"
            changes.append(
                Change(part=shape.label, what="mesh", before=before, after=after, reason=reason)
            )
    return (merged(meshes) if meshes else None), changes


def _deduplicated(mesh: TriMesh) -> TriMesh:
    """A mesh with each triangle once; unchanged where it is closed."""
    if closed(mesh.faces):
        return mesh
    vertices, faces = welded(mesh.vertices, mesh.faces)
    turned = np.argmin(faces, axis=1)[:, None]
    rolled = np.take_along_axis(faces, (turned + np.arange(3)) % 3, axis=1)
    kept = np.sort(np.unique(rolled, axis=0, return_index=True)[1])
    return as_bodies(vertices, faces[kept])


def _point_to(element: ET.Element, path: str) -> None:
    """Let a visual or collision be a mesh file in the link's frame."""
    for child in [*element.findall("origin"), *element.findall("geometry")]:
        element.remove(child)
    ET.SubElement(ET.SubElement(element, "geometry"), "mesh", filename=path)


def mended_collision(work: Repair, name: str, visual: TriMesh) -> Iterator[Change]:
    """Convex pieces: those stated if they are convex, else what CoACD makes of the visual mesh."""
    shapes = [shape for shape in work.subject.contact_shapes if shape.link == name]
    stated = [shape.read() for shape in shapes]
    gap = max((convexity_gap(mesh) for mesh in stated), default=math.inf)
    if gap <= work.bounds.hull_gap.value:
        _keep(work, name, stated)
        return
    before = f"{len(stated)} pieces" + (f", concave by {gap:.3g} m" if stated else "")
    pieces = convex_pieces(visual, work.pieces)
    link = work.link(name)
    for element in link.findall("collision"):
        link.remove(element)
    for number, piece in enumerate(pieces):
        path = work.write_mesh(f"{name}_piece_{number}", piece)
        _point_to(ET.SubElement(link, "collision"), path)
    hollow = hollow_points(visual)
    said = "it encloses no hollow"
    if len(hollow):
        left = 1.0 - float(inside_any(hollow, pieces, work.bounds.gap_slack.value).mean())
        said = f"{left:.0%} of its interior stays open"
    yield Change(
        part=name,
        what="collision",
        before=before,
        after=f"{len(pieces)} convex pieces",
        reason=f"simulators fill what is not convex; {said}",
    )


def _keep(work: Repair, name: str, stated: Sequence[TriMesh]) -> None:
    """Write meshes that collision names beside the copy; solids stay as they are."""
    link = work.link(name)
    for number, (element, mesh) in enumerate(zip(link.findall("collision"), stated, strict=True)):
        if element.find("geometry/mesh") is not None:
            _point_to(element, work.write_mesh(f"{name}_piece_{number}", mesh))


def convex_pieces(mesh: TriMesh, pieces: int) -> tuple[TriMesh, ...]:
    """Each body that is convex as it stands, and CoACD's pieces of the others; GeometryError where
    CoACD fails."""
    found: list[TriMesh] = []
    bodies = np.asarray(mesh.body)
    for body in range(int(bodies.max()) + 1):
        faces = mesh.faces[bodies == body]
        used, compact = np.unique(faces, return_inverse=True)
        own = TriMesh(vertices=mesh.vertices[used], faces=compact.reshape(faces.shape))
        solid = Solid(m3.Manifold.hull_points(own.vertices))
        filled = closed(own.faces) and moments(own.triangles).volume > 0.999 * solid.volume
        found += [solid.trimesh()] if filled else decomposed(own, pieces=pieces)
    return tuple(found)


def mended_inertia(work: Repair, name: str, visual: TriMesh) -> Iterator[Change]:
    """Mass properties of a uniform solid where those stated are missing or impossible."""
    reason = _inertia_problem(work, name, visual)
    if reason is None:
        return
    solid, doubt = visual, ""
    if not closed(visual.faces) or moments(visual.triangles).volume <= 0.0:
        hull = Solid(m3.Manifold.hull_points(visual.vertices.copy()))
        solid, doubt = hull.trimesh(), "; its mesh is not closed, so its hull stands for it"
    measured = moments(solid.triangles)
    stated = next((b.mass for b in work.subject.stated_bodies if b.name == name), math.nan)
    known = math.isfinite(stated) and stated > 0.0
    density = stated / measured.volume if known else DENSITY
    if not known:
        doubt += f"; no mass was stated, {DENSITY:g} kg/m3 is assumed"
    tensor = tensor_of(density * measured.second)
    _write_inertial(work.link(name), density * measured.volume, measured.center, tensor)
    yield Change(
        part=name,
        what="inertial",
        before=f"mass {stated:g} kg",
        after=f"mass {density * measured.volume:.6g} kg, integrated over the mesh",
        reason=reason + doubt,
    )


def _inertia_problem(work: Repair, name: str, visual: TriMesh) -> str | None:
    """What is wrong with a link's stated mass properties, or None."""
    body = next((b for b in work.subject.stated_bodies if b.name == name), None)
    if body is None:
        return "none were stated"
    for finding in rigid(work.subject):
        if finding.part == body.label:
            return finding.cause
    lower, upper = visual.bounds
    if not ((body.center > lower) & (body.center < upper)).all():
        return "its center lay outside of it"
    if not closed(visual.faces):
        return None
    measured = moments(visual.triangles)
    uniform = np.linalg.eigvalsh(tensor_of(body.mass / measured.volume * measured.second))
    ratio = np.linalg.eigvalsh(body.inertia) / uniform
    off = max(float(ratio.max()), 1.0 / float(ratio.min()))
    return None if off <= work.bounds.uniform_ratio.value else f"moments were off {off:.3g} times"


def _write_inertial(link: ET.Element, mass: float, center: Floats, tensor: Floats) -> None:
    for old in link.findall("inertial"):
        link.remove(old)
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=exact(center), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=exact(mass))
    ET.SubElement(inertial, "inertia", {key: exact(tensor[i, j]) for key, i, j in TENSOR})


def beyond_mending(subject: UrdfSubject) -> str | None:
    """Why an asset cannot be mended, or None: its files or its tree are broken."""
    for file, problem in subject.problems():
        return f"{file}: {problem}"
    for finding in tree(subject):
        return str(finding)
    return None
