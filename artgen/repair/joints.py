"""Joints: axes, limits, efforts, speeds, damping."""

import copy
import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator

import numpy as np

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Joint
from artgen.core.errors import ArtgenError
from artgen.geometry.clearance import Mover, overlaps
from artgen.repair.change import Left, Outcome
from artgen.repair.draft import Draft, put, vector_text
from artgen.validate.stated import StatedJoint
from artgen.validate.urdf_subject import UrdfSubject

QUARTER = math.pi / 2.0
"""rad that a hinge without limits is swept at most."""
SLIDE_SHARE = 0.8
"""Of its part's length that a slide without limits is swept; rails keep the rest."""
STEPS = 45
"""Poses each way: 2 degrees, or 9 mm of half a meter."""
EFFORT = {"prismatic": 100.0}
"""N of an arm's pull; others take `TORQUE`."""
TORQUE = 50.0
"""N m: that pull at half a meter from a hinge."""
VELOCITY = 1.0
"""rad/s or m/s: a door or drawer moved by hand."""


def mended_joints(draft: Draft) -> Iterator[Outcome]:
    """All joints of the copy; what is missing is assumed and said so, what is nan is left."""
    subject = draft.subject()
    robot = subject.robot
    outcomes: list[Outcome] = []
    for joint, element in zip(subject.stated_joints, robot.iterfind("joint"), strict=True):
        if joint.moves:
            outcomes += _axis(joint, element, draft.bounds.axis_norm_foreign.value)
            outcomes += _limits(joint, element)
            outcomes += _strength(joint, element)
            outcomes += _losses(joint, element)
    draft.save_if_changed(robot)
    yield from outcomes


def _axis(joint: StatedJoint, element: ET.Element, allowed: float) -> Iterator[Outcome]:
    norm = math.hypot(*joint.axis)
    if len(joint.axis) == 3 and 0.0 < norm < math.inf and not abs(norm - 1.0) <= allowed:
        unit = {"xyz": vector_text(np.array(joint.axis) / norm)}
        yield from put(element, "axis", unit, subject=joint.name, why="an axis has length 1")
    elif len(joint.axis) != 3 or not 0.0 < norm < math.inf:
        yield Left(subject=joint.name, why=f"its axis {joint.axis} is no direction")


def _limits(joint: StatedJoint, element: ET.Element) -> Iterator[Outcome]:
    """Exchanged bounds put right; what is equal, infinite or nan is left."""
    if not joint.limited or unlimited(element):
        return
    if joint.lower > joint.upper and math.isfinite(joint.lower - joint.upper):
        values = {"lower": vector_text([joint.upper]), "upper": vector_text([joint.lower])}
        why = "lower and upper were exchanged"
        yield from put(element, "limit", values, subject=joint.name, why=why)
    elif not joint.lower < joint.upper:
        yield Left(subject=joint.name, why="its limits leave no way, or are no numbers")
    elif not math.isfinite(joint.upper - joint.lower):
        yield Left(subject=joint.name, why="a limit is infinite; where it ends is not known")


def unlimited(element: ET.Element) -> bool:
    """Whether a joint that needs limits states neither of them."""
    stated = element.find("limit")
    needs = element.get("type") in ("revolute", "prismatic")
    return needs and (stated is None or not {"lower", "upper"} & set(stated.attrib))


def limited_joints(draft: Draft) -> Iterator[Outcome]:
    """Limits for hinges and slides without any, from sweeping the visual meshes."""
    robot = draft.subject().robot
    missing = [element for element in robot.iterfind("joint") if unlimited(element)]
    if not missing:
        return
    wide = copy.deepcopy(robot)
    for element in wide.iterfind("joint"):
        if unlimited(element):
            list(put(element, "limit", {"lower": "-10", "upper": "10"}, subject="", why=""))
    draft.save(wide)  # A joint without limits is no joint to the reader.
    subject, outcomes = draft.subject(), list[Outcome]()
    for element in missing:
        name = element.get("name", "")
        try:
            lower, upper, why = free_travel(subject, name)
        except (ArtgenError, ValueError) as error:
            outcomes.append(Left(subject=name, why=f"no limits, and none to be found: {error}"))
            continue
        values = {"lower": vector_text([lower]), "upper": vector_text([upper])}
        outcomes += put(element, "limit", values, subject=name, why=why)
    draft.save(robot)
    yield from outcomes


def free_travel(subject: UrdfSubject, name: str) -> tuple[float, float, str]:
    """Lower and upper limit of the longer way from rest on which nothing is met, and how that was
    found; the positive way where both are as long.

    Raises:
        ArtgenError: a mesh is missing or the joints make no tree.
    """
    joint = next(joint for joint in subject.joints if joint.name == name)
    reach, said = QUARTER, "a quarter turn"
    if joint.type == "prismatic":
        points = subject.meshes[joint.child].vertices if joint.child in subject.meshes else None
        reach = SLIDE_SHARE * (1.0 if points is None else float(np.ptp(points @ joint.axis)))
        said = f"{SLIDE_SHARE:g} of the part's length"
    ways = {sign: _free(subject, joint, sign * reach) for sign in (1.0, -1.0)}
    sign = max(ways, key=ways.__getitem__)
    travel = ways[sign] * reach
    if travel == 0.0:
        sign, travel = 1.0, reach
        why = f"no limits were stated; it is barred at rest, so {said} is assumed"
    elif ways[sign] < 1.0:
        why = f"no limits were stated; assumed as far as visual meshes do not meet, at most {said}"
    else:
        why = f"no limits were stated; nothing is met within {said}, which is assumed"
    return min(0.0, sign * travel), max(0.0, sign * travel), why


def _free(subject: UrdfSubject, joint: Joint, reach: float) -> float:
    """Share of a way from rest before visual meshes of different parts first meet."""
    base, joints = subject.parts[0].name, subject.joints
    states = [{joint.name: reach * step / STEPS} for step in range(1, STEPS + 1)]
    placed = [forward_kinematics(base, joints, state) for state in states]
    movers = [
        Mover(name=part, shape=shape, poses=np.stack([poses[part] for poses in placed]))
        for part, shape in subject.shapes.items()
    ]
    bound = subject.bounds.overlap.value
    hits = [hit.pose for hit in overlaps(movers) if hit.volume > bound]
    return min(hits, default=STEPS) / STEPS


def _strength(joint: StatedJoint, element: ET.Element) -> Iterator[Outcome]:
    usual = {"effort": EFFORT.get(joint.type, TORQUE), "velocity": VELOCITY}
    for key, value in (("effort", joint.effort), ("velocity", joint.velocity)):
        if value is not None and not 0.0 < value < math.inf:
            given = {key: vector_text([usual[key]])}
            why = f"no positive {key} was stated; {usual[key]:g} is assumed"
            yield from put(element, "limit", given, subject=joint.name, why=why)


def _losses(joint: StatedJoint, element: ET.Element) -> Iterator[Outcome]:
    for key, value in (("friction", joint.friction), ("damping", joint.damping)):
        if value is None or 0.0 <= value < math.inf:
            continue
        if value < 0.0:
            why = f"negative {key} drives the joint"
            yield from put(element, "dynamics", {key: "0.0"}, subject=joint.name, why=why)
        else:
            yield Left(subject=joint.name, why=f"its {key} is no finite number")
