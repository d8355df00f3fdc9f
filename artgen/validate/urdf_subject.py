"""A URDF under test: read by us, and handed to MuJoCo with every mesh as bytes we have read."""

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import manifold3d as m3
import mujoco
import numpy as np

from artgen.articulation.types import Mimic
from artgen.core.errors import ArtgenError, GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import rigid
from artgen.export.urdf import matrix_from_rpy
from artgen.geometry.solid import Solid, box, cylinder
from artgen.validate.assembly import Assembly, FileJoint, Geometry, LinkMass, assembled, moved
from artgen.validate.foreign_subject import ForeignSubject
from artgen.validate.meshfile import read_mesh
from artgen.validate.physics import quiet
from artgen.validate.places import inside, read_capped
from artgen.validate.stated import (
    StatedBody,
    StatedJoint,
    foreign_urdf_joints,
    number,
    numbers,
    urdf_bodies,
)
from artgen.validate.xmlfile import read_xml

ROUND = 32
"""Sides of a cylinder or meridians of a sphere; their volume is 0.6 % small."""


@dataclass(frozen=True, kw_only=True, eq=False)
class UrdfSubject(ForeignSubject):
    """A robot description of anyone's."""

    @cached_property
    def robot(self) -> ET.Element:
        """The root element."""
        return read_xml(self.source.file)

    def files(self) -> Iterable[Path]:
        """The file and the meshes that it names."""
        yield self.source.file
        with suppress(ArtgenError, OSError, ET.ParseError, ValueError):
            for name in sorted({mesh.get("filename", "") for mesh in self.robot.iter("mesh")}):
                yield inside(self.source.root, self.source.file.parent, name)

    def problems(self) -> Iterator[tuple[str, str]]:
        """The file itself, and the files that it names."""
        file = self.source.file.name
        try:
            if self.robot.tag != "robot":
                yield file, f"root element <{self.robot.tag}> instead of <robot>"
                return
        except OSError as error:
            yield file, f"cannot be opened: {error.strerror}"
            return
        except (ET.ParseError, ValueError, ArtgenError) as error:
            yield file, f"cannot be parsed: {error}"
            return
        if self.robot.find("link") is None:
            yield file, "no <link>"
        for name in sorted({mesh.get("filename", "") for mesh in self.robot.iter("mesh")}):
            try:
                inside(self.source.root, self.source.file.parent, name)
            except ArtgenError as error:
                yield file, str(error)

    @cached_property
    def stated_links(self) -> Mapping[str, list[str]]:
        """Names of the links."""
        names = [link.get("name", "") for link in self.robot.iterfind("link")]
        return {self.source.file.name: names}

    @cached_property
    def stated_joints(self) -> list[StatedJoint]:
        """Joints with the defaults of the specification."""
        return foreign_urdf_joints(self.source.file.name, self.robot)

    @cached_property
    def stated_bodies(self) -> list[StatedBody]:
        """The `<inertial>` of each link that has one."""
        stated = [link for link in self.robot.iterfind("link") if link.find("inertial") is not None]
        holder = ET.Element("robot")
        holder.extend(stated)
        return [_with_default_center(b) for b in urdf_bodies(self.source.file.name, holder)]

    @cached_property
    def assembly(self) -> Assembly:
        """Parts and joints in the object frame at rest."""
        frames = [pose_of(element) for element in self.robot.iterfind("joint")]
        mimics = [_mimic(element) for element in self.robot.iterfind("joint")]
        joints = [
            FileJoint(stated=stated, parent_from_joint=frame, mimic=mimic)
            for stated, frame, mimic in zip(self.stated_joints, frames, mimics, strict=True)
        ]
        elements = {link.get("name", ""): link for link in self.robot.iterfind("link")}
        masses = {body.name: _link_mass(body, elements[body.name]) for body in self.stated_bodies}
        return assembled(list(elements), masses, joints)

    @cached_property
    def visuals(self) -> Sequence[Geometry]:
        """Every `<visual>`."""
        return list(self._shapes("visual"))

    @cached_property
    def contact_shapes(self) -> Sequence[Geometry]:
        """Every `<collision>`."""
        return list(self._shapes("collision"))

    def _shapes(self, kind: str) -> Iterator[Geometry]:
        for link in self.robot.iterfind("link"):
            for index, element in enumerate(link.iterfind(kind)):
                name = link.get("name", "")
                yield Geometry(
                    link=name,
                    label=f"{name}, {kind} {index}",
                    link_from_shape=np.eye(4),
                    read=partial(self._mesh, element),
                )

    def _mesh(self, element: ET.Element) -> TriMesh:
        """Triangles of a `<visual>` or `<collision>` in the link's frame; GeometryError where its
        kind or numbers are unknown."""
        return moved(self._shape(element), pose_of(element))

    def _shape(self, element: ET.Element) -> TriMesh:
        """Triangles of a `<geometry>` in its own frame."""
        mesh = element.find("geometry/mesh")
        if mesh is None:
            return solid_mesh(element.find("geometry/*"))
        scale = np.array(numbers(mesh.get("scale", "1 1 1")))
        if scale.shape != (3,) or not np.isfinite(scale).all() or not scale.all():
            raise GeometryError(f"scale {mesh.get('scale')!r} is not three numbers other than 0")
        name = mesh.get("filename", "")
        return read_mesh(inside(self.source.root, self.source.file.parent, name), scale)

    @property
    def urdf_text(self) -> str:
        """The document without shapes, which pinocchio would look for."""
        robot = copy.deepcopy(self.robot)
        for link in robot.iterfind("link"):
            for shape in (*link.findall("visual"), *link.findall("collision")):
                link.remove(shape)
        return ET.tostring(robot, encoding="unicode")

    def spec(self, file: str) -> mujoco.MjSpec:
        """What MuJoCo reads; it gets meshes as bytes under names of ours, and opens no file."""
        quiet()
        robot = copy.deepcopy(self.robot)
        assets: dict[str, bytes] = {}
        for link in robot.iterfind("link"):
            for visual in link.findall("visual"):
                link.remove(visual)
        for extension in robot.findall("mujoco"):
            robot.remove(extension)
        for mesh in robot.iter("mesh"):
            name = mesh.get("filename", "")
            try:
                path = inside(self.source.root, self.source.file.parent, name)
                key = f"mesh{len(assets)}{path.suffix.lower()}"
                assets[key] = read_capped(path)
            except (ArtgenError, OSError) as error:
                raise ValueError(str(error)) from error
            mesh.set("filename", key)
        text = ET.tostring(robot, encoding="unicode")
        return mujoco.MjSpec.from_string(text, assets=assets)


def pose_of(element: ET.Element) -> Floats:
    """(4, 4) of the `<origin>` below an element; rpy turns about fixed x, then y, then z."""
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    stated = {key: origin.get(key, "0 0 0") for key in ("xyz", "rpy")}
    xyz, rpy = numbers(stated["xyz"]), numbers(stated["rpy"])
    if len(xyz) != 3 or len(rpy) != 3 or not np.isfinite([*xyz, *rpy]).all():
        whose = " ".join([element.tag, *filter(None, [element.get("name")])])
        said = " ".join(f"{key}={text[:60]!r}" for key, text in stated.items())
        raise GeometryError(f"the <origin {said}> of <{whose}> is not six finite numbers")
    return rigid(matrix_from_rpy(rpy), xyz)


def _with_default_center(body: StatedBody) -> StatedBody:
    """A body whose `<origin>` is left out has its center at the link's frame."""
    if np.isnan(body.center).all():
        return StatedBody(
            file=body.file, name=body.name, mass=body.mass, center=np.zeros(3), inertia=body.inertia
        )
    return body


def _link_mass(body: StatedBody, link: ET.Element) -> LinkMass:
    """Mass properties along the link's axes; the `<origin>` of `<inertial>` may be turned."""
    inertial = link.find("inertial")
    pose = np.eye(4) if inertial is None else pose_of(inertial)
    turn = pose[:3, :3]
    return LinkMass(mass=body.mass, center=pose[:3, 3], tensor=turn @ body.inertia @ turn.T)


def _mimic(joint: ET.Element) -> Mimic | None:
    element = joint.find("mimic")
    if element is None:
        return None
    return Mimic(
        joint=element.get("joint", ""),
        multiplier=number(element.get("multiplier", "1")),
        offset=number(element.get("offset", "0")),
    )


def solid_mesh(shape: ET.Element | None) -> TriMesh:
    """Triangles of a `<box>`, `<cylinder>` or `<sphere>` about its own middle.

    Raises:
        GeometryError: it is another element, or a size is not positive.
    """
    tag = "nothing" if shape is None else shape.tag
    sizes = {} if shape is None else {key: numbers(text) for key, text in shape.attrib.items()}
    wanted = {"box": ("size",), "cylinder": ("radius", "length"), "sphere": ("radius",)}
    if tag not in wanted:
        raise GeometryError(f"<geometry> holds {tag}; known: {', '.join(wanted)}, mesh")
    given = [value for key in wanted[tag] for value in sizes.get(key, ())]
    if len(given) != (3 if tag == "box" else len(wanted[tag])) or not min(given) > 0.0:
        raise GeometryError(f"<{tag}> needs {' and '.join(wanted[tag])}, each > 0")
    return _solid(tag, given)


def _solid(tag: str, given: Sequence[float]) -> TriMesh:
    if tag == "box":
        return box(given, at=(0.0, 0.0, -given[2] / 2.0)).trimesh()
    if tag == "cylinder":
        return cylinder(given[0], given[1], segments=ROUND).at(z=-given[1] / 2.0).trimesh()
    return Solid(m3.Manifold.sphere(given[0], ROUND)).trimesh()
