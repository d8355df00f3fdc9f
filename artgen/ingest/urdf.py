"""A URDF as a ForeignObject: links that fixed joints connect are one part."""

import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from artgen.articulation.types import JointType
from artgen.core.errors import IngestError
from artgen.core.jsonio import file_hash
from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import apply
from artgen.export.kinematics import vector
from artgen.ingest.foreign import ForeignJoint, ForeignObject, ForeignPart, ForeignShape
from artgen.ingest.meshes.scenes import read_soup
from artgen.ingest.meshes.soup import Look, Soup
from artgen.validate.places import inside
from artgen.validate.stated import StatedJoint, foreign_urdf_joints, number, numbers
from artgen.validate.urdf_subject import pose_of, solid_mesh
from artgen.validate.xmlfile import read_xml

MOVING: Mapping[str, JointType] = {
    "revolute": "revolute",
    "continuous": "continuous",
    "prismatic": "prismatic",
}
TURN_DECIMALS = 15
"""So that a right angle, whose cosine is 2e-16 in float64, keeps axes on axes."""
LISTS = ("xyz", "rpy", "scale", "size", "rgba")
"""Attributes whose numbers some files separate by commas."""


def read_urdf(path: Path, *, turn_deg: float, root: Path | None = None) -> ForeignObject:
    """The object that a URDF file describes; meshes are named from its folder.

    Args:
        turn_deg: about z, brings the object's front to -y.
        root: folder that no mesh or image may lie outside of; the file's own where it is None.

    Raises:
        IngestError: it is no robot description, or its joints make no tree.
    """
    try:
        robot = read_xml(path)
    except ET.ParseError as error:
        raise IngestError(f"{path.name} is no XML: {error}") from error
    if robot.tag != "robot":
        raise IngestError(f"{path.name}: root element <{robot.tag}> instead of <robot>")
    commas = _without_commas(robot)
    tree = _Tree(robot, path)
    place = _Place(file=path, root=path.parent if root is None else root)
    turn = np.round(axis_angle_matrix((0.0, 0.0, 1.0), np.radians(turn_deg)), TURN_DECIMALS)
    return ForeignObject(
        dataset="urdf",
        id=robot.get("name") or path.stem,
        category=robot.get("name") or path.stem,
        digest=file_hash(path),
        parts=tuple(_part(robot, place, tree, name, links) for name, links in tree.groups.items()),
        joints=tuple(_joint(stated, tree) for stated in tree.movers),
        object_from_source=turn,
        doubts=(*([f"{commas} lists of numbers had commas"] * bool(commas)), *tree.doubts),
        meters_per_unit=1.0,
    )


@dataclass(frozen=True, kw_only=True)
class _Place:
    """A URDF file, and the folder inside which it may name others."""

    file: Path
    root: Path


def _without_commas(robot: ET.Element) -> int:
    """Blanks for commas between numbers; how many attributes had any."""
    count = 0
    for element in robot.iter():
        for key in LISTS:
            if "," in (text := element.get(key, "")):
                element.set(key, text.replace(",", " "))
                count += 1
    return count


@dataclass(init=False)
class _Tree:
    """Links in groups that move as one, the base's first.

    Attributes:
        groups: the link that a moving joint moves to all links fixed to it.
        movers: joints that move, parents before children.
        owner: link to its group. pose: link to `object_from_link` (4, 4) at q = 0.
        poses: joint to `object_from_joint`.
    """

    groups: dict[str, list[str]]
    movers: list[StatedJoint]
    owner: dict[str, str]
    pose: dict[str, Floats]
    doubts: list[str]

    def __init__(self, robot: ET.Element, path: Path) -> None:
        links = [link.get("name", "") for link in robot.iterfind("link")]
        if not links or len(set(links)) != len(links):
            raise IngestError(f"{path.name}: it has no links, or names of links repeat")
        frames = [pose_of(element) for element in robot.iterfind("joint")]
        below: dict[str, list[tuple[StatedJoint, Floats]]] = defaultdict(list)
        stated = foreign_urdf_joints(path.name, robot)
        for joint, frame in zip(stated, frames, strict=True):
            if joint.parent not in links or joint.child not in links:
                raise IngestError(f"joint {joint.name} names a link that is not there")
            below[joint.parent].append((joint, frame))
        children = [joint.child for joint in stated]
        if len(set(children)) != len(children):
            raise IngestError(f"{path.name}: a link is moved by several joints")
        roots = [name for name in links if name not in set(children)]
        if not roots:
            raise IngestError(f"{path.name}: its joints make a circle")
        base = max(roots, key=lambda name: (len(_below(name, below)), -links.index(name)))
        self.doubts = [f"{len(roots)} roots; all are fixed to {base}"] * (len(roots) > 1)
        self.doubts += _unheld(robot)
        self.groups, self.movers = {base: []}, []
        self.owner, self.pose = {}, {}
        waiting = [(name, base, np.eye(4)) for name in (base, *(r for r in roots if r != base))]
        while waiting:
            link, group, pose = waiting.pop(0)
            self.groups.setdefault(group, []).append(link)
            self.owner[link], self.pose[link] = group, pose
            for joint, frame in below[link]:
                moves = joint.type in MOVING
                self.movers += [joint] if moves else []
                waiting.append((joint.child, joint.child if moves else group, pose @ frame))
        if len(self.owner) != len(links):
            raise IngestError(f"{path.name}: its joints make a circle")


def _below(name: str, below: Mapping[str, Sequence[tuple[StatedJoint, Floats]]]) -> list[str]:
    """Links that hang on one, itself included; each joint's child is moved by it alone."""
    found = [name]
    for link in found:
        found += [joint.child for joint, _ in below.get(link, ())]
    return found


def _unheld(robot: ET.Element) -> Iterator[str]:
    """What the file says and a bundle of ours does not keep."""
    for joint in robot.iterfind("joint"):
        name, kind = joint.get("name", ""), joint.get("type", "")
        if kind not in (*MOVING, "fixed"):
            yield f"{name}: a {kind or 'nameless'} joint has not one axis; fixed"
        if joint.find("mimic") is not None:
            yield f"{name} follows another joint; taken as free"


def _joint(stated: StatedJoint, tree: _Tree) -> ForeignJoint:
    pose = tree.pose[stated.child]
    axis = pose[:3, :3] @ np.array(stated.axis)
    length = float(np.linalg.norm(axis))
    if not (np.isfinite(axis).all() and length > 0.0):
        raise IngestError(f"joint {stated.name}: its axis is {stated.axis}")
    stops = stated.type != "continuous" and np.isfinite([stated.lower, stated.upper]).all()
    if stops and stated.lower > stated.upper:
        raise IngestError(
            f"joint {stated.name}: lower limit {stated.lower} above upper {stated.upper}"
        )
    kind = MOVING[stated.type]
    return ForeignJoint(
        name=stated.name,
        type="continuous" if kind == "revolute" and not stops else kind,
        parent=tree.owner[stated.parent],
        child=stated.child,
        axis=vector(axis / length),
        origin=vector(pose[:3, 3]),
        lower=stated.lower if stops else None,
        upper=stated.upper if stops else None,
        start=min(max(0.0, stated.lower), stated.upper) if stops else None,
        number=stated.name,
    )


def _part(
    robot: ET.Element, place: _Place, tree: _Tree, name: str, links: Sequence[str]
) -> ForeignPart:
    """Visual shapes of all links of a part; collision shapes where it has none."""
    elements = {link.get("name", ""): link for link in robot.iterfind("link")}
    colors = {m.get("name", ""): m for m in robot.iterfind("material")}
    for kind in ("visual", "collision"):
        shapes = [
            ForeignShape(
                leaf=shape.get("name") or link,
                label=f"{link}, {kind} {index}",
                read=partial(_soup, shape, place, tree.pose[link], colors),
            )
            for link in links
            for index, shape in enumerate(elements[link].iterfind(kind))
        ]
        if shapes:
            break
    masses = [mass for link in links if (mass := stated_mass(elements[link])) is not None]
    return ForeignPart(
        name=name, word=name, shapes=tuple(shapes), mass=sum(masses) if masses else None
    )


def _soup(shape: ET.Element, place: _Place, pose: Floats, colors: Mapping[str, ET.Element]) -> Soup:
    """Triangles of a `<visual>` in the object frame at q = 0."""
    mesh, object_from_shape = shape.find("geometry/mesh"), pose @ pose_of(shape)
    if mesh is None:
        solid = solid_mesh(shape.find("geometry/*"))
        faces = solid.faces.astype(np.int64)
        none = np.full((len(faces), 3, 2), np.nan)
        look = np.zeros(len(faces), np.int64)
        soup = Soup(vertices=solid.vertices, faces=faces, uv=none, look=look, looks=(Look(),))
        scale = np.ones(3)
    else:
        scale = np.array(numbers(mesh.get("scale", "1 1 1")))
        if scale.shape != (3,) or not np.isfinite(scale).all() or not scale.all():
            raise IngestError(f"scale {mesh.get('scale')!r} is not three numbers other than 0")
        file = inside(place.root, place.file.parent, mesh.get("filename", ""))
        soup = read_soup(file, place.root)
    mirrored = float(np.prod(scale)) < 0.0
    stated = _color(shape, colors)
    return Soup(
        vertices=apply(object_from_shape, soup.vertices * scale),
        faces=soup.faces[:, ::-1] if mirrored else soup.faces,
        uv=soup.uv[:, ::-1] if mirrored else soup.uv,
        look=soup.look,
        looks=soup.looks if stated is None else (stated,) * len(soup.looks),
    )


def _color(shape: ET.Element, colors: Mapping[str, ET.Element]) -> Look | None:
    """The color that the URDF states for a shape; None leaves the mesh its own."""
    material = shape.find("material")
    if material is None:
        return None
    if material.find("color") is None:
        material = colors.get(material.get("name", ""), material)
    color = material.find("color")
    if color is None or material.find("texture") is not None:
        return None
    values = numbers(color.get("rgba", ""))
    if len(values) != 4 or not np.isfinite(values).all():
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in values)
    return Look(color=(red, green, blue), opacity=opacity)


def stated_mass(link: ET.Element) -> float | None:
    """kg of a link's `<inertial>`; None where it states no positive number."""
    mass = link.find("inertial/mass")
    value = float("nan") if mass is None else number(mass.get("value", ""))
    return value if np.isfinite(value) and value > 0.0 else None
