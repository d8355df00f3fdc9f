"""Parts and joints as the URDF and the manifest state them, before any type has refused a value."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from artgen.core.mesh import Floats

UNMOVED = ("fixed", "floating", "planar")
"""URDF types without one axis of motion."""


@dataclass(frozen=True, kw_only=True)
class StatedJoint:
    """One joint in one file; numbers that are missing or unreadable are nan.

    Effort, velocity, friction and damping are None where the format may leave them out and does.
    """

    file: str
    name: str
    type: str
    parent: str
    child: str
    axis: tuple[float, ...]
    origin: tuple[float, ...]
    lower: float
    upper: float
    friction: float | None
    damping: float | None
    effort: float | None
    velocity: float | None

    @property
    def label(self) -> str:
        """Joint and file, for findings."""
        return f"{self.name} ({self.file})"

    @property
    def limited(self) -> bool:
        """Whether its type has limits."""
        return self.type not in ("continuous", *UNMOVED)

    @property
    def moves(self) -> bool:
        """Whether it has an axis that parts move along or about."""
        return self.type not in UNMOVED


@dataclass(frozen=True, kw_only=True, eq=False)
class StatedBody:
    """Mass properties of one part in one file; nan where missing or unreadable.

    `center` is (3,) m in the frame of the file, `inertia` (3, 3) kg m2 about it.
    """

    file: str
    name: str
    mass: float
    center: Floats
    inertia: Floats

    @property
    def label(self) -> str:
        """Part and file, for findings."""
        return f"{self.name} ({self.file})"


def without_frames(robot: ET.Element, names: Collection[str]) -> ET.Element:
    """A URDF less the links of some names that hold nothing, and the fixed joints to them."""
    empty = {e.get("name") for e in robot.iterfind("link") if e.get("name") in names and not len(e)}
    joints = robot.iterfind("joint[@type='fixed']")
    ends = {
        joint: child.get("link") for joint in joints if (child := joint.find("child")) is not None
    }
    dropped = {joint for joint, link in ends.items() if link in empty}
    held = {ends[joint] for joint in dropped}
    dropped |= {link for link in robot.iterfind("link") if link.get("name") in held}
    left = ET.Element(robot.tag, robot.attrib)
    left.extend(element for element in robot if element not in dropped)
    return left


def urdf_bodies(file: str, robot: ET.Element) -> list[StatedBody]:
    """The `<inertial>` of every `<link>`."""
    return [_urdf_body(file, link) for link in robot.iterfind("link")]


def _urdf_body(file: str, link: ET.Element) -> StatedBody:
    def value(path: str, key: str) -> str:
        found = link.find(f"inertial/{path}")
        return "" if found is None else found.get(key, "")

    keys = (("ixx", "ixy", "ixz"), ("ixy", "iyy", "iyz"), ("ixz", "iyz", "izz"))
    return StatedBody(
        file=file,
        name=link.get("name", ""),
        mass=number(value("mass", "value")),
        center=filled(numbers(value("origin", "xyz")), (3,)),
        inertia=np.array([[number(value("inertia", key)) for key in row] for row in keys]),
    )


def manifest_bodies(file: str, manifest: Mapping[str, Any]) -> list[StatedBody]:
    """Mass properties of every entry of `parts`."""
    return [
        StatedBody(
            file=file,
            name=str(part.get("name")),
            mass=number(part.get("mass")),
            center=filled(part.get("com"), (3,)),
            inertia=filled(part.get("inertia"), (3, 3)),
        )
        for part in manifest["parts"]
    ]


def filled(values: object, shape: tuple[int, ...]) -> Floats:
    """Numbers of that shape, or nan all over where they are not."""
    try:
        array = np.array(values, np.float64)
    except (TypeError, ValueError):
        array = np.zeros(0)
    return array if array.shape == shape else np.full(shape, math.nan)


def urdf_joints(file: str, robot: ET.Element) -> list[StatedJoint]:
    """Every `<joint>`."""
    return [_urdf_joint(file, element) for element in robot.iterfind("joint")]


def _urdf_joint(file: str, element: ET.Element) -> StatedJoint:
    def words(path: str, key: str) -> str:
        found = element.find(path)
        return "" if found is None else found.get(key, "")

    return StatedJoint(
        file=file,
        name=element.get("name", ""),
        type=element.get("type", ""),
        parent=words("parent", "link"),
        child=words("child", "link"),
        axis=numbers(words("axis", "xyz")),
        origin=numbers(words("origin", "xyz")),
        lower=number(words("limit", "lower")),
        upper=number(words("limit", "upper")),
        friction=number(words("dynamics", "friction")),
        damping=number(words("dynamics", "damping")),
        effort=number(words("limit", "effort")),
        velocity=number(words("limit", "velocity")),
    )


def foreign_urdf_joints(file: str, robot: ET.Element) -> list[StatedJoint]:
    """Every `<joint>`, with the defaults of the URDF specification for what a joint leaves out."""
    return [
        _with_defaults(_urdf_joint(file, element), element) for element in robot.iterfind("joint")
    ]


def _with_defaults(joint: StatedJoint, element: ET.Element) -> StatedJoint:
    left_out = {
        key: value
        for path, word, key, value in URDF_DEFAULTS
        if (found := element.find(path)) is None or word not in found.attrib
        if key not in ("effort", "velocity") or joint.type == "continuous" or not joint.moves
    }
    return replace(joint, **left_out)  # type: ignore[arg-type]


URDF_DEFAULTS = (
    ("axis", "xyz", "axis", (1.0, 0.0, 0.0)),
    ("origin", "xyz", "origin", (0.0, 0.0, 0.0)),
    ("dynamics", "friction", "friction", None),
    ("dynamics", "damping", "damping", None),
    ("limit", "effort", "effort", None),
    ("limit", "velocity", "velocity", None),
)
"""Element, attribute, field and what the specification puts there; limits are asked of joints that
have a stop."""


def manifest_joints(file: str, manifest: Mapping[str, Any]) -> list[StatedJoint]:
    """Every entry of `joints`."""
    return [_manifest_joint(file, entry) for entry in manifest["joints"]]


def _manifest_joint(file: str, entry: Mapping[str, Any]) -> StatedJoint:
    def value(key: str) -> float:
        return number(entry.get(key))

    return StatedJoint(
        file=file,
        name=str(entry.get("name")),
        type=str(entry.get("type")),
        parent=str(entry.get("parent")),
        child=str(entry.get("child")),
        axis=tuple(number(v) for v in entry.get("axis") or ()),
        origin=tuple(number(v) for v in entry.get("origin") or ()),
        lower=value("lower"),
        upper=value("upper"),
        friction=value("friction"),
        damping=value("damping"),
        effort=value("effort"),
        velocity=value("velocity"),
    )


def number(value: object) -> float:
    """The number, or nan where there is none."""
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return math.nan


def numbers(text: str) -> tuple[float, ...]:
    """Blank-separated numbers; nan for words that are none."""
    return tuple(number(word) for word in text.split())


def file_references(root: ET.Element) -> Iterator[str]:
    """Every file that a URDF or MJCF names."""
    for element in root.iter():
        for key in ("filename", "file"):
            if key in element.attrib:
                yield element.attrib[key]
