"""URDF: link frames at the joints, all parallel to the object frame, so every `rpy` is zero but
those of grips, which are links of their own without mass."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from artgen.articulation.grips import grip_frame
from artgen.articulation.types import (
    ArticulatedObject,
    Grip,
    Joint,
    JointType,
    Mimic,
    Part,
    Vector,
)
from artgen.core.errors import ExportError
from artgen.core.mesh import Floats
from artgen.core.transform import rigid
from artgen.export.kinematics import FileGrip, FileJoint, FileKinematics, FileMass, vector
from artgen.export.layout import URDF, BoxPiece, HullPiece, collision_pieces, mesh_path, pivots
from artgen.export.numbers import exact, parsed

NO_ROTATION = "0 0 0"
FRAME = "_frame"
"""What the fixed joint of a grip's link adds to the grip's name."""
TENSOR = (("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2))


def urdf_text(obj: ArticulatedObject) -> str:
    """The whole robot description; meshes are named by paths relative to the file."""
    frames = pivots(obj)
    robot = ET.Element("robot", name=obj.asset_id)
    # MuJoCo reads this element, others skip it: keep the base as a body and the visual meshes.
    hints = ET.SubElement(robot, "mujoco")
    ET.SubElement(hints, "compiler", fusestatic="false", discardvisual="false")
    robot.extend(link_element(obj.asset_id, part, frames[part.name]) for part in obj.parts)
    robot.extend(joint_element(joint, frames[joint.parent]) for joint in obj.joints)
    for part in obj.parts:
        for grip in part.grips:
            robot.extend(grip_elements(grip, part.name, frames[part.name]))
    ET.indent(robot)
    return ET.tostring(robot, encoding="unicode", xml_declaration=True) + "\n"


def link_element(asset_id: str, part: Part, pivot: Floats) -> ET.Element:
    """`<link>` with exact mass properties, the OBJ as visual, and convex collision."""
    link = ET.Element("link", name=part.name)
    inertial = ET.SubElement(link, "inertial")
    _origin(inertial, part.mass.center - pivot)
    ET.SubElement(inertial, "mass", value=exact(part.mass.mass))
    tensor = {name: exact(part.mass.inertia[i, j]) for name, i, j in TENSOR}
    ET.SubElement(inertial, "inertia", tensor)
    visual = ET.SubElement(link, "visual", name=f"{part.name}_visual")
    _origin(visual, -pivot)
    shape = ET.SubElement(visual, "geometry")
    ET.SubElement(shape, "mesh", filename=mesh_path(asset_id, part.name))
    for piece in collision_pieces(asset_id, part):
        link.append(_collision_element(part.name, piece, pivot))
    return link


def _collision_element(part: str, piece: BoxPiece | HullPiece, pivot: Floats) -> ET.Element:
    element = ET.Element("collision", name=f"{part}_collision_{piece.index}")
    if isinstance(piece, BoxPiece):
        _origin(element, piece.center - pivot)
        shape = ET.SubElement(element, "geometry")
        ET.SubElement(shape, "box", size=exact(piece.size))
    else:
        _origin(element, -pivot)
        shape = ET.SubElement(element, "geometry")
        ET.SubElement(shape, "mesh", filename=piece.file)
    return element


def joint_element(joint: Joint, parent_pivot: Floats) -> ET.Element:
    """`<joint>`; effort and velocity are mandatory, springs and latches have no place in URDF."""
    element = ET.Element("joint", name=joint.name, type=joint.type)
    _origin(element, np.subtract(joint.origin, parent_pivot))
    ET.SubElement(element, "parent", link=joint.parent)
    ET.SubElement(element, "child", link=joint.child)
    ET.SubElement(element, "axis", xyz=exact(joint.axis))
    limit = {"effort": exact(joint.effort), "velocity": exact(joint.velocity)}
    if joint.limit is not None:
        limit = {"lower": exact(joint.limit.lower), "upper": exact(joint.limit.upper)} | limit
    ET.SubElement(element, "limit", limit)
    ET.SubElement(element, "dynamics", damping=exact(joint.damping), friction=exact(joint.friction))
    if joint.mimic is not None:
        multiplier, offset = exact(joint.mimic.multiplier), exact(joint.mimic.offset)
        ET.SubElement(
            element, "mimic", joint=joint.mimic.joint, multiplier=multiplier, offset=offset
        )
    return element


def grip_elements(grip: Grip, part: str, pivot: Floats) -> tuple[ET.Element, ET.Element]:
    """A link without mass or shape at the grip's frame, and the fixed joint that holds it."""
    frame = grip_frame(grip)
    joint = ET.Element("joint", name=f"{grip.name}{FRAME}", type="fixed")
    angles = exact(rpy_from_matrix(frame[:3, :3]))
    ET.SubElement(joint, "origin", xyz=exact(frame[:3, 3] - pivot), rpy=angles)
    ET.SubElement(joint, "parent", link=part)
    ET.SubElement(joint, "child", link=grip.name)
    return ET.Element("link", name=grip.name), joint


def rpy_from_matrix(turn: Floats) -> Vector:
    """Angles about fixed x, then y, then z; the last is 0 where y is a quarter turn."""
    level = math.hypot(turn[0, 0], turn[1, 0])
    pitch = math.atan2(-turn[2, 0], level)
    if level < 1e-9:
        return math.atan2(-turn[1, 2], turn[1, 1]), pitch, 0.0
    return math.atan2(turn[2, 1], turn[2, 2]), pitch, math.atan2(turn[1, 0], turn[0, 0])


def matrix_from_rpy(rpy: Sequence[float]) -> Floats:
    """(3, 3) of angles about fixed x, then y, then z."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def _origin(parent: ET.Element, xyz: Floats) -> None:
    ET.SubElement(parent, "origin", xyz=exact(xyz), rpy=NO_ROTATION)


def load_kinematics(folder: Path) -> FileKinematics:
    """Parts and joints of `folder`/asset.urdf in the object frame.

    Raises:
        ExportError: the file is not one that `urdf_text` wrote.
    """
    robot = ET.parse(folder / URDF).getroot()
    frames: dict[str, Floats] = {}
    joints = []
    children = {_need(element, "child").get("link") for element in robot.iter("joint")}
    base = next(name for name in _names(robot) if name not in children)
    frames[base] = np.zeros(3)
    grips = []
    for element in robot.iter("joint"):
        if element.get("type") == "fixed":
            grips.append(_file_grip(element, frames))
            continue
        joint = _file_joint(element, frames)
        frames[joint.child] = np.array(joint.origin)
        joints.append(joint)
    masses = {
        str(link.get("name")): _file_mass(link, frames[str(link.get("name"))])
        for link in robot.iter("link")
        if link.get("name") in frames
    }
    return FileKinematics(base=base, masses=masses, joints=tuple(joints), grips=tuple(grips))


def _file_grip(element: ET.Element, frames: Mapping[str, Floats]) -> FileGrip:
    """A fixed joint holds nothing but a grip's frame."""
    part, origin = _need(element, "parent").attrib["link"], _need(element, "origin").attrib
    turn = matrix_from_rpy(parsed(origin["rpy"]))
    frame = rigid(turn, frames[part] + parsed(origin["xyz"]))
    return FileGrip(name=_need(element, "child").attrib["link"], part=part, frame=frame)


def _names(robot: ET.Element) -> list[str]:
    return [str(link.get("name")) for link in robot.iter("link")]


def _need(element: ET.Element, tag: str) -> ET.Element:
    found = element.find(tag)
    if found is None:
        raise ExportError(
            f"{URDF}: <{element.tag} name={element.get('name')!r}> has no <{tag}>; export anew"
        )
    return found


def _file_mass(link: ET.Element, pivot: Floats) -> FileMass:
    inertial = _need(link, "inertial")
    tensor = np.zeros((3, 3))
    numbers = _need(inertial, "inertia").attrib
    for name, i, j in TENSOR:
        tensor[i, j] = tensor[j, i] = float(numbers[name])
    center = pivot + parsed(_need(inertial, "origin").attrib["xyz"])
    mass = float(_need(inertial, "mass").attrib["value"])
    return FileMass(mass=mass, center=center, inertia=tensor)


KINDS: dict[str, JointType] = {
    "revolute": "revolute",
    "continuous": "continuous",
    "prismatic": "prismatic",
}


def _file_joint(element: ET.Element, frames: dict[str, Floats]) -> FileJoint:
    parent = _need(element, "parent").attrib["link"]
    limit = _need(element, "limit").attrib
    dynamics = _need(element, "dynamics").attrib
    mimic = element.find("mimic")
    return FileJoint(
        name=element.attrib["name"],
        type=KINDS[element.attrib["type"]],
        parent=parent,
        child=_need(element, "child").attrib["link"],
        axis=vector(np.array(parsed(_need(element, "axis").attrib["xyz"]))),
        origin=vector(frames[parent] + parsed(_need(element, "origin").attrib["xyz"])),
        lower=float(limit["lower"]) if "lower" in limit else None,
        upper=float(limit["upper"]) if "upper" in limit else None,
        friction=float(dynamics["friction"]),
        damping=float(dynamics["damping"]),
        effort=float(limit["effort"]),
        velocity=float(limit["velocity"]),
        spring=None,
        latch=None,
        mimic=None if mimic is None else _file_mimic(mimic),
    )


def _file_mimic(element: ET.Element) -> Mimic:
    numbers = element.attrib
    return Mimic(
        joint=numbers["joint"],
        multiplier=float(numbers["multiplier"]),
        offset=float(numbers["offset"]),
    )
