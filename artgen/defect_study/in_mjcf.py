"""Defects of a MJCF file."""

import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

from artgen.defect_study.defect import Defect, Plant
from artgen.export.layout import MJCF


def in_tree(change: Callable[[ET.Element], None]) -> Plant:
    """A plant that edits the MJCF's elements."""

    def plant(folder: Path) -> None:
        tree = ET.parse(folder / MJCF)
        change(tree.getroot())
        tree.write(folder / MJCF)

    return plant


def first(root: ET.Element, path: str) -> ET.Element:
    """The first element at a path."""
    found = root.find(path)
    if found is None:
        raise LookupError(f"no {path}")
    return found


def put(path: str, key: str, value: str) -> Plant:
    """Set an attribute of the first element at a path."""
    return in_tree(lambda root: first(root, path).set(key, value))


def everywhere(path: str, key: str, value: str) -> Plant:
    """Set an attribute of all elements at a path."""

    def change(root: ET.Element) -> None:
        for element in root.findall(path):
            element.set(key, value)

    return in_tree(change)


def removed(path: str) -> Plant:
    """Take the first element at a path out."""

    def change(root: ET.Element) -> None:
        target = first(root, path)
        parents = {child: parent for parent in root.iter() for child in parent}
        parents[target].remove(target)

    return in_tree(change)


MOVING = "worldbody/body/body"
JOINT = f"{MOVING}/joint[@limited='true']"
HINGE = f"{JOINT}[@type='hinge']"


def range_swapped(root: ET.Element) -> None:
    """Upper before lower."""
    element = first(root, JOINT)
    element.set("range", " ".join(reversed(element.get("range", "0 1").split())))


def reversed_axis(root: ET.Element) -> None:
    """The part opens inwards."""
    element = first(root, JOINT)
    element.set("axis", " ".join(repr(-float(word)) for word in element.get("axis", "").split()))


def pivot_moved(root: ET.Element) -> None:
    """The pivot lies 80 mm beside the edge."""
    element = first(root, HINGE)
    x, y, z = (float(word) for word in element.get("pos", "0 0 0").split())
    element.set("pos", f"{x + 0.08!r} {y + 0.08!r} {z!r}")


def degrees(root: ET.Element) -> None:
    """Radians read as degrees."""
    first(root, HINGE)
    first(root, "compiler").set("angle", "degree")


def mass_grams(root: ET.Element) -> None:
    """Mass in grams."""
    element = first(root, f"{MOVING}/inertial")
    element.set("mass", repr(1000.0 * float(element.get("mass", "1"))))


def base_hull(root: ET.Element) -> None:
    """One hull stands for the carcass in contact."""
    base = first(root, "worldbody/body")
    mesh = first(base, "geom[@class='visual']").get("mesh", "")
    for geom in base.findall("geom[@class='collision']"):
        base.remove(geom)
    ET.SubElement(base, "geom", {"class": "collision", "type": "mesh", "mesh": mesh, "mass": "0"})


def latch_pushes(root: ET.Element) -> None:
    """A catch with the sign of a spring: it throws the part open."""
    tendons = ET.SubElement(root, "tendon")
    catch = {"name": "catch", "stiffness": "400", "springlength": "0.05 1e10"}
    fixed = ET.SubElement(tendons, "fixed", catch)
    ET.SubElement(fixed, "joint", joint=first(root, JOINT).get("name", ""), coef="1")


MJCF_DEFECTS = tuple(
    Defect(name=f"mjcf_{name}", format="mjcf", what=what, plant=plant)
    for name, what, plant in (
        ("range_swapped", "upper before lower", in_tree(range_swapped)),
        ("unlimited", "limits not switched on", put(JOINT, "limited", "false")),
        ("degrees", "radians read as degrees", in_tree(degrees)),
        ("axis_zero", "an axis of no length", put(JOINT, "axis", "0 0 0")),
        ("axis_nan", "an axis that is not a number", put(JOINT, "axis", "nan 0 1")),
        ("axis_reversed", "the part opens inwards", in_tree(reversed_axis)),
        ("pivot_moved", "the pivot lies beside the edge", in_tree(pivot_moved)),
        ("damping_negative", "damping that drives", put(JOINT, "damping", "-2")),
        ("friction_negative", "friction that drives", put(JOINT, "frictionloss", "-1")),
        ("mass_zero", "no mass", put(f"{MOVING}/inertial", "mass", "0")),
        ("mass_grams", "mass in grams", in_tree(mass_grams)),
        (
            "triangle",
            "no body has this inertia",
            put(f"{MOVING}/inertial", "fullinertia", "1 1 3 0 0 0"),
        ),
        ("inertial_missing", "inertia left to the simulator", removed(f"{MOVING}/inertial")),
        ("mesh_missing", "a mesh that is not there", put("asset/mesh", "file", "meshes/nix.obj")),
        (
            "mesh_outside",
            "a path out of the folder",
            put("asset/mesh", "file", "../../../../etc/passwd"),
        ),
        (
            "no_contact",
            "contact switched off everywhere",
            everywhere(".//geom[@class='collision']", "contype", "0"),
        ),
        ("base_hull", "one hull stands for a carcass", in_tree(base_hull)),
        ("latch_pushes", "a catch that pushes", in_tree(latch_pushes)),
        ("body_nan", "a part nowhere", put(MOVING, "pos", "nan 0 0")),
        ("unknown_element", "a word that MuJoCo does not know", put(JOINT, "colour", "red")),
    )
)
