"""The copy that is mended: a URDF and the files it names, in a folder of its own."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.core.errors import ArtgenError
from artgen.core.jsonio import write_bytes
from artgen.core.mesh import TriMesh
from artgen.export.numbers import exact
from artgen.export.obj import hull_text
from artgen.geometry.measure import closed
from artgen.repair.change import Change, Outcome
from artgen.validate.assembly import merged
from artgen.validate.bounds import Bounds
from artgen.validate.places import inside, read_capped
from artgen.validate.subject import Source, body_volumes
from artgen.validate.urdf_subject import UrdfSubject
from artgen.validate.xmlfile import read_xml


@dataclass(frozen=True, kw_only=True)
class Draft:
    """A copy on disk; each mending reads it anew, so it sees what those before it have mended."""

    source: Source
    bounds: Bounds

    def subject(self) -> UrdfSubject:
        """The copy as the validator reads it now."""
        return UrdfSubject(source=self.source, bounds=self.bounds)

    def save(self, robot: ET.Element) -> None:
        """Write the document."""
        text = ET.tostring(robot, encoding="utf-8", xml_declaration=True)
        write_bytes(self.source.file, text + b"\n")

    def save_if_changed(self, robot: ET.Element) -> None:
        """Write the document if it says something else than the file: a sound one keeps its
        bytes."""
        if ET.tostring(robot) != ET.tostring(read_xml(self.source.file)):
            self.save(robot)

    def add_mesh(self, stem: str, mesh: TriMesh) -> str:
        """Write a mesh under a name that is free; its path as the URDF states it."""
        folder = self.source.file.parent / "meshes"
        names = (f"{stem}{'_' * number}.obj" for number in range(100))
        name = next(name for name in names if not (folder / name).exists())
        write_bytes(folder / name, hull_text(mesh).encode())
        return f"meshes/{name}"


def copied(original: UrdfSubject, out: Path) -> tuple[Draft, list[Outcome]]:
    """The files of an asset at the same places below `out`; names that only the original's folder
    could resolve (`package://`) become relative.

    Raises:
        ArtgenError: a file does not exist, is too large, or lies outside the asset's folder.
    """
    source = original.source
    root = source.root.resolve()
    target = out / source.file.resolve().relative_to(root)
    write_bytes(target, read_capped(source.file))
    draft = Draft(source=Source(format="urdf", file=target, root=out), bounds=original.bounds)
    for path in original.files():
        for named in (path, *_companions(root, path)):
            write_bytes(out / named.resolve().relative_to(root), read_capped(named))
    return draft, list(_relative_names(original, draft))


def _companions(root: Path, mesh: Path) -> Iterator[Path]:
    """Material libraries of an OBJ and the images that they name, where they are there."""
    if mesh.suffix.lower() != ".obj":
        return
    for library in _named(root, mesh, r"mtllib\s+(.+)"):
        yield library
        yield from _named(root, library, r"\s*(?:map_|bump|disp|norm)\S*\s+(?:.*\s)?(\S+)")


def _named(root: Path, file: Path, pattern: str) -> Iterator[Path]:
    text = read_capped(file).decode("utf-8", "replace")
    for name in sorted({name.strip() for name in re.findall(rf"(?m)^{pattern}$", text)}):
        try:
            yield inside(root, file.parent, name)
        except ArtgenError:
            continue  # Nothing that is judged depends on it.


def _relative_names(original: UrdfSubject, draft: Draft) -> Iterator[Outcome]:
    source, place = original.source, draft.source
    robot = read_xml(place.file)
    for mesh in robot.iter("mesh"):
        name = mesh.get("filename", "")
        try:
            inside(place.root, place.file.parent, name)
        except ArtgenError:
            path = inside(source.root, source.file.parent, name)
            up = len(place.file.parent.relative_to(place.root).parts)
            after = "../" * up + path.relative_to(source.root.resolve()).as_posix()
            mesh.set("filename", after)
            why = "the copy is no package of that name"
            yield Change(subject=place.file.name, what="mesh", before=name, after=after, why=why)
    draft.save_if_changed(robot)


def put(
    element: ET.Element, path: str, values: dict[str, str], *, subject: str, why: str
) -> Iterator[Change]:
    """Set attributes of a child, made if missing; a change for each that differs."""
    child = element.find(path)
    if child is None:
        child = ET.SubElement(element, path)
    for key, after in values.items():
        before = child.get(key, "nothing")
        if before != after:
            child.set(key, after)
            what = f"{path} {key}"
            yield Change(subject=subject, what=what, before=before, after=after, why=why)


def link_element(robot: ET.Element, name: str) -> ET.Element:
    """The link of that name."""
    return next(link for link in robot.iterfind("link") if link.get("name") == name)


def unsound(mesh: TriMesh | None, bounds: Bounds) -> str | None:
    """Why a visual mesh cannot stand for its part's matter, or None."""
    if mesh is None:
        return "it has no visual mesh"
    if not closed(mesh.faces) or not (body_volumes(mesh) > 0.0).all():
        return "its visual mesh is not closed and outward"
    longest = float(np.ptp(mesh.vertices, axis=0).max())
    if not bounds.smallest.value <= longest <= bounds.largest.value:
        return f"its visual mesh is {longest:.3g} m long, which is likely a mistake of units"
    return None


def link_visual(subject: UrdfSubject, link: str) -> TriMesh | None:
    """All visual shapes of a link in its frame, None where it has none.

    Raises:
        ArtgenError: one cannot be read.
    """
    meshes = [shape.read() for shape in subject.visuals if shape.link == link]
    return merged(meshes) if meshes else None


def vector_text(values: object) -> str:
    """Numbers as URDF text that reads back to the same values."""
    return exact(np.asarray(values, np.float64))
