"""Ways to edit a URDF so that it goes wrong."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import numpy as np

from artgen.core.mesh import Floats
from artgen.defect_study.defect import Plant
from artgen.export.layout import URDF

Change = Callable[[ET.Element], None]
LIMITED = ("revolute", "prismatic")
MOVING = ("revolute", "prismatic", "continuous")


def in_tree(change: Change) -> Plant:
    """A plant that edits the URDF's elements."""

    def plant(folder: Path) -> None:
        tree = ET.parse(folder / URDF)
        change(tree.getroot())
        tree.write(folder / URDF)

    return plant


def in_text(change: Callable[[str], str]) -> Plant:
    """A plant that edits the URDF as text."""

    def plant(folder: Path) -> None:
        path = folder / URDF
        path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")

    return plant


def joint(root: ET.Element, *kinds: str) -> ET.Element:
    """The first joint of one of the kinds; of any kind, one that has limits comes first, as what
    only spins, like a spray arm, has no rest and no way to be wrong about it."""
    for wanted in (kinds,) if kinds else (LIMITED, MOVING):
        for element in root.iter("joint"):
            if element.get("type") in wanted:
                return element
    raise LookupError(f"no joint of type {' or '.join(kinds or MOVING)}")


def child_link(root: ET.Element, moved: ET.Element) -> ET.Element:
    """The link that a joint moves."""
    name = below(moved, "child").get("link")
    return next(link for link in root.iter("link") if link.get("name") == name)


def below(element: ET.Element, path: str) -> ET.Element:
    """The element at a path."""
    found = element.find(path)
    if found is None:
        raise LookupError(f"no {path} in {element.get('name')}")
    return found


def on_joint(path: str, key: str, value: str, *kinds: str) -> Plant:
    """Set an attribute below the first joint of a kind; a path of "." is the joint itself."""

    def change(root: ET.Element) -> None:
        target = joint(root, *kinds)
        (target if path == "." else below(target, path)).set(key, value)

    return in_tree(change)


def on_link(path: str, key: str, value: str) -> Plant:
    """Set an attribute below the first moving link."""

    def change(root: ET.Element) -> None:
        below(child_link(root, joint(root)), path).set(key, value)

    return in_tree(change)


def without(path: str, *, of_joint: bool) -> Plant:
    """Take every element at a path out of the first joint or moving link."""

    def change(root: ET.Element) -> None:
        owner = joint(root) if of_joint else child_link(root, joint(root))
        found = owner.findall(path)
        if not found:
            raise LookupError(f"no {path} in {owner.get('name')}")
        for element in found:
            owner.remove(element)

    return in_tree(change)


def numbers(element: ET.Element, key: str) -> Floats:
    """The numbers of an attribute."""
    return np.array([float(word) for word in element.get(key, "0 0 0").split()])


def put(element: ET.Element, key: str, values: Floats) -> None:
    """Write numbers to an attribute."""
    element.set(key, " ".join(repr(float(value)) for value in values))


def scaled(path: str, key: str, factor: float) -> Plant:
    """Multiply the numbers of an attribute below the first moving link."""

    def change(root: ET.Element) -> None:
        element = below(child_link(root, joint(root)), path)
        put(element, key, factor * numbers(element, key))

    return in_tree(change)


def shifted(path: str, key: str, by: tuple[float, float, float], *kinds: str) -> Plant:
    """Add to the numbers of an attribute below the first joint of a kind."""

    def change(root: ET.Element) -> None:
        element = below(joint(root, *kinds), path)
        put(element, key, numbers(element, key) + by)

    return in_tree(change)


def tilted(degrees: float) -> Plant:
    """Turn the first hinge's axis about a perpendicular."""

    def change(root: ET.Element) -> None:
        element = below(joint(root, "revolute", "continuous"), "axis")
        axis = numbers(element, "xyz")
        aside = np.cross(axis, (0.36, 0.48, 0.8))
        angle = math.radians(degrees)
        turned = math.cos(angle) * axis + math.sin(angle) * aside / np.linalg.norm(aside)
        put(element, "xyz", turned)

    return in_tree(change)


def reversed_axis(*kinds: str) -> Plant:
    """Turn the first axis of a kind around."""

    def change(root: ET.Element) -> None:
        element = below(joint(root, *kinds), "axis")
        put(element, "xyz", -numbers(element, "xyz"))

    return in_tree(change)


def limits_times(factor: float, *kinds: str) -> Plant:
    """Multiply both limits of the first joint of a kind."""

    def change(root: ET.Element) -> None:
        element = below(joint(root, *kinds), "limit")
        for key in ("lower", "upper"):
            element.set(key, repr(factor * float(element.get(key, "0"))))

    return in_tree(change)


def without_limits(root: ET.Element) -> None:
    """A hinge or slide that ends nowhere."""
    moved = joint(root, "revolute", "prismatic")
    moved.remove(below(moved, "limit"))


def rest_shifted(share: float) -> Plant:
    """Move the zero of the first joint by a share of its range, limits with it: rest is ajar."""

    def change(root: ET.Element) -> None:
        moved = joint(root, "revolute", "prismatic")
        limit, origin = below(moved, "limit"), below(moved, "origin")
        lower, upper = (float(limit.get(key, "0")) for key in ("lower", "upper"))
        shift = share * (upper - lower)
        axis = numbers(below(moved, "axis"), "xyz")
        limit.set("lower", repr(lower - shift))
        limit.set("upper", repr(upper - shift))
        if moved.get("type") == "prismatic":
            put(origin, "xyz", numbers(origin, "xyz") + shift * axis)
        else:
            put(origin, "rpy", shift * axis)  # right where the axis is a coordinate axis

    return in_tree(change)


def inertia_set(change: Callable[[Floats, float], Floats]) -> Plant:
    """Replace the tensor of the first moving link by a function of it and of the mass."""

    def edit(root: ET.Element) -> None:
        inertial = below(child_link(root, joint(root)), "inertial")
        element = below(inertial, "inertia")
        keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        xx, xy, xz, yy, yz, zz = (float(element.get(key, "0")) for key in keys)
        mass = float(below(inertial, "mass").get("value", "0"))
        tensor = change(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), mass)
        for key, value in zip(keys, tensor[np.triu_indices(3)].tolist(), strict=True):
            element.set(key, repr(value))

    return in_tree(edit)


def about_link_origin(root: ET.Element) -> None:
    """The tensor about the link's origin, where the format wants it about the center of mass."""
    inertial = below(child_link(root, joint(root)), "inertial")
    x = numbers(below(inertial, "origin"), "xyz")
    shift = float(x @ x) * np.eye(3) - np.outer(x, x)
    element = below(inertial, "inertia")
    mass = float(below(inertial, "mass").get("value", "0"))
    for key, (i, j) in {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1)}.items():
        element.set(key, repr(float(element.get(key, "0")) + mass * float(shift[i, j])))


def second_root(root: ET.Element) -> None:
    """A joint is forgotten, so its child hangs in the air."""
    root.remove(joint(root))


def twin(tag: str) -> Plant:
    """A second element with the name of the first moving one."""

    def change(root: ET.Element) -> None:
        moved = joint(root)
        element = moved if tag == "joint" else child_link(root, moved)
        root.append(ET.fromstring(ET.tostring(element)))

    return in_tree(change)


def extra_joint(parent: str, child: str) -> Plant:
    """Another joint between links: `base`, `first` (the first moving link) or a name."""

    def change(root: ET.Element) -> None:
        moved = joint(root)
        names = {
            "base": below(moved, "parent").get("link", ""),
            "first": below(moved, "child").get("link", ""),
        }
        added = ET.SubElement(root, "joint", name="added", type="fixed")
        ET.SubElement(added, "parent", link=names.get(parent, parent))
        ET.SubElement(added, "child", link=names.get(child, child))

    return in_tree(change)


def loose_frame(root: ET.Element) -> None:
    """Where to take hold, on a joint that should have been fixed."""
    held = below(joint(root), "child").get("link", "")
    added = ET.SubElement(root, "joint", name="grip_frame", type="revolute")
    ET.SubElement(added, "parent", link=held)
    ET.SubElement(added, "child", link="grip")
    ET.SubElement(added, "limit", lower="0", upper="1", effort="1", velocity="1")
    ET.SubElement(root, "link", name="grip")


def mimic(other: str) -> Plant:
    """The first joint follows another; `self` is itself."""

    def change(root: ET.Element) -> None:
        moved = joint(root)
        followed = moved.get("name", "") if other == "self" else other
        ET.SubElement(moved, "mimic", joint=followed, multiplier="1", offset="0")

    return in_tree(change)


def friction_above_effort(root: ET.Element) -> None:
    """Nothing the joint may exert moves it."""
    moved = joint(root)
    effort = float(below(moved, "limit").get("effort", "1"))
    dynamics = moved.find("dynamics")
    if dynamics is None:
        dynamics = ET.SubElement(moved, "dynamics")
    dynamics.set("friction", repr(3.0 * effort))


def collision_boxes(
    change: Callable[[Floats, Floats], tuple[Floats, Floats]],
) -> Plant:
    """Change center and size of every box of the moving link with the largest one."""

    def edit(root: ET.Element) -> None:
        links = [child_link(root, moved) for moved in root.iter("joint") if len(moved)]
        for piece in max((_boxes(link) for link in links), key=_largest):
            box, origin = below(piece, "geometry/box"), below(piece, "origin")
            center, size = change(numbers(origin, "xyz"), numbers(box, "size"))
            put(origin, "xyz", center)
            put(box, "size", size)

    return in_tree(edit)


def _boxes(link: ET.Element) -> list[ET.Element]:
    return [c for c in link.findall("collision") if c.find("geometry/box") is not None]


def _largest(boxes: list[ET.Element]) -> float:
    """m3 of the largest box; 0 for none."""
    sizes = [numbers(below(piece, "geometry/box"), "size") for piece in boxes]
    return max((float(size.prod()) for size in sizes), default=0.0)


def visual_as_collision(root: ET.Element) -> None:
    """The whole visible mesh stands for the base in contact; simulators take its hull."""
    base = root.find("link")
    if base is None:
        raise LookupError("no link")
    mesh = below(base, "visual/geometry/mesh").get("filename", "")
    for piece in base.findall("collision"):
        base.remove(piece)
    added = ET.SubElement(base, "collision")
    ET.SubElement(added, "origin", xyz="0 0 0", rpy="0 0 0")
    ET.SubElement(ET.SubElement(added, "geometry"), "mesh", filename=mesh)
