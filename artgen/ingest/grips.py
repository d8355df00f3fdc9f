"""Grips of foreign parts: where a hand takes hold, told by the source's words or by the shape."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.roles import ROLES
from artgen.articulation.states import required_state
from artgen.articulation.types import ArticulatedObject, Grip, GripKind, Joint, Part
from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted
from artgen.export.kinematics import vector
from artgen.geometry.distance import inside_bodies, nearest_distance
from artgen.validate.grips import FINGER, NO_ARM, way_of

WORDS: Mapping[str, GripKind] = {
    "handle": "handle", "pull": "handle", "grip": "handle", "knob": "knob", "lever": "lever",
}  # fmt: skip
"""Words in a source's names of fragments, and what is gripped there."""
ITSELF: Mapping[str, GripKind] = {
    "handle": "handle", "lever": "lever", "knob": "knob", "dial": "knob", "button": "button",
}  # fmt: skip
"""Roles of parts that are gripped whole."""
FRONTED = ("door", "drawer", "lid", "flap", "cover", "sash")
"""Roles of parts before whose front a handle stands; of a rack, wires stand out everywhere."""
TOUCHING = 0.005
"""m; bodies of one handle are no farther apart than this."""
STANDS_OUT = 0.008
"""m by which a body stands out before its front to be a handle."""
SMALL = 0.35
"""Of a front's area that a handle covers at most."""
NEAR = 0.012
"""m; a grip's middle is no farther from the surface; validators allow 0.02 m."""
OUTER = 0.35
"""Of a handle's depth: the outer part, around which fingers close."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Found:
    """Bodies of a part by which it is gripped, and how that is known."""

    bodies: NDArray[np.int64]
    kind: GripKind
    why: str


def with_grips(obj: ArticulatedObject) -> ArticulatedObject:
    """The object with grips on its moving parts; `grips_read` of its provenance says for each why
    it is thought to be one, and which parts that close have none."""
    parts, said = [], dict[str, Any]()
    joints = {joint.child: joint for joint in obj.joints}
    fragments: Any = obj.provenance.get("fragments", {})
    for part in obj.parts:
        joint = joints.get(part.name)
        grips: list[Grip] = []
        if joint is not None:
            for found in found_grips(part, joint, fragments.get(part.name, ())):
                name = _name(obj, part, found.kind, len(grips))
                grip = _grip(name, part, joint, found)
                if _reachable(obj, part, joint, grip):
                    grips.append(grip)
                    said[name] = found.why
            if not grips and ROLES[part.label].closes:
                said[part.name] = "nothing by which to take hold of it was found"
        parts.append(dataclasses.replace(part, grips=tuple(grips)))
    provenance = {**obj.provenance, "grips_read": said}
    return dataclasses.replace(obj, parts=tuple(parts), provenance=provenance)


def found_grips(
    part: Part, joint: Joint, fragments: Sequence[Mapping[str, Any]]
) -> Iterator[Found]:
    """What is gripped of a part: all of it if it is a knob or the like; else bodies that the source
    names so; else what stands out before its front.

    Args:
        fragments: runs of bodies with the source's name of each, as manifests state them.
    """
    numbers = np.unique(np.asarray(part.mesh.body))
    if part.label in ITSELF:
        yield Found(bodies=numbers, kind=ITSELF[part.label], why=f"the part is a {part.label}")
        return
    named = False
    for word, kind in WORDS.items():
        runs = [entry["bodies"] for entry in fragments if word in str(entry["leaf"]).lower()]
        own = [k for first, count in runs for k in range(first, first + count)]
        for cluster in _clusters(part, np.array(own, np.int64)):
            named = True
            yield Found(bodies=cluster, kind=kind, why=f"the source calls it a {word}")
    if not named and part.label in FRONTED:
        yield from _standing_out(part, joint)


def _standing_out(part: Part, joint: Joint) -> Iterator[Found]:
    """The bodies that stand out the farthest before the front of a part that opens."""
    boxes = _boxes(part)
    numbers = np.array(sorted(boxes))
    corners = np.array([boxes[k] for k in numbers.tolist()])
    farthest = _farthest(part, joint)
    axis, sign = _outward(way_of(joint, _at(farthest)))
    spans = np.delete(corners[:, 1] - corners[:, 0], axis, axis=1).prod(axis=1)
    tops = corners[:, 1 if sign > 0.0 else 0, axis] * sign
    front = int(np.argmax(spans))
    chosen = (tops > tops[front] + STANDS_OUT) & (spans < SMALL * spans[front])
    clusters = _clusters(part, numbers[chosen])
    if clusters:
        highest = [max(tops[np.isin(numbers, own)]) for own in clusters]
        why = "it stands out before the front"
        yield Found(bodies=clusters[int(np.argmax(highest))], kind="handle", why=why)


def _grip(name: str, part: Part, joint: Joint, found: Found) -> Grip:
    """Position in the outer part of the bodies; outward where they stand out from the rest."""
    body = np.asarray(part.mesh.body)
    own = part.mesh.triangles[np.isin(body, found.bodies)]
    rest = part.mesh.triangles[~np.isin(body, found.bodies)]
    middle = (own.min(axis=(0, 1)) + own.max(axis=(0, 1))) / 2.0
    way = way_of(joint, _at(middle))
    axis, sign = _face(own, rest, joint, part, way)
    outward = sign * np.eye(3)[axis]
    position = _held(own, outward)
    way = way_of(joint, _at(position))
    arm = float(np.linalg.norm(way))
    pull = way / arm if arm >= NO_ARM else outward
    return Grip(
        name=name,
        kind=found.kind,
        position=vector(np.round(position, 7)),
        outward=vector(outward),
        pull=vector(pull),
    )


def _face(own: Floats, rest: Floats, joint: Joint, part: Part, way: Floats) -> tuple[int, float]:
    """Axis and sign along which bodies stand out farthest from the rest of their part; of a part
    that is gripped whole, away from what carries it; else the way it moves."""
    if len(rest):
        low, high = rest.min(axis=(0, 1)), rest.max(axis=(0, 1))
        out = np.stack([own.max(axis=(0, 1)) - high, low - own.min(axis=(0, 1))])
        if out.max() > STANDS_OUT:
            side, axis = np.unravel_index(int(np.argmax(out)), out.shape)
            return int(axis), 1.0 if side == 0 else -1.0
        return _outward(way)
    along = np.array(joint.axis)
    if part.label in ("knob", "dial", "button"):
        middle = (own.min(axis=(0, 1)) + own.max(axis=(0, 1))) / 2.0
        return _outward(along if along @ (middle * (1.0, 1.0, 0.0)) >= 0.0 else -along)
    return _outward(way)


def _held(own: Floats, outward: Floats) -> Floats:
    """The middle of the outer part of a surface, or the place on it that is nearest to that."""
    points = np.concatenate([own.mean(axis=1), *own.transpose(1, 0, 2)])
    area = np.linalg.norm(np.cross(own[:, 1] - own[:, 0], own[:, 2] - own[:, 0]), axis=1)
    weight = np.tile(area, 4)
    height = points @ outward
    outer = height >= height.max() - OUTER * np.ptp(height)
    middle = np.average(points[outer], axis=0, weights=weight[outer] + 1e-300)
    if nearest_distance(own, middle) <= NEAR:
        return np.asarray(middle)
    return np.asarray(points[outer][np.argmin(np.linalg.norm(points[outer] - middle, axis=1))])


def _outward(way: Floats) -> tuple[int, float]:
    """The coordinate axis nearest to a direction, and its sign."""
    axis = int(np.argmax(np.abs(np.round(way, 9))))
    return axis, 1.0 if way[axis] >= 0.0 else -1.0


def _farthest(part: Part, joint: Joint) -> Floats:
    """The vertex that moves most."""
    points = part.mesh.vertices
    if joint.type == "prismatic":
        return np.asarray(points[0])
    arms = np.cross(np.array(joint.axis), points - np.array(joint.origin))
    return np.asarray(points[np.argmax(np.linalg.norm(arms, axis=1))])


def _at(position: Floats) -> Grip:
    """A grip at a place, to ask how the place moves."""
    up = (0.0, 0.0, 1.0)
    return Grip(name="", kind="handle", position=vector(position), outward=up, pull=up)


def _boxes(part: Part) -> dict[int, Floats]:
    """Number of a body to its (2, 3) bounds."""
    body, corners = np.asarray(part.mesh.body), part.mesh.triangles
    return {
        int(k): np.stack([corners[body == k].min(axis=(0, 1)), corners[body == k].max(axis=(0, 1))])
        for k in np.unique(body)
    }


def _clusters(part: Part, numbers: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Bodies whose boxes touch, together; in the order of the first of each."""
    boxes = _boxes(part) if len(numbers) else {}
    found: list[list[int]] = []
    for number in sorted(set(numbers.tolist()) & set(boxes)):
        touched = [own for own in found if any(_touch(boxes[number], boxes[k]) for k in own)]
        found = [own for own in found if own not in touched]
        found.append([number, *(k for own in touched for k in own)])
    return [np.array(sorted(own), np.int64) for own in sorted(found, key=min)]


def _touch(one: Floats, other: Floats) -> bool:
    return bool((np.maximum(one[0], other[0]) <= np.minimum(one[1], other[1]) + TOUCHING).all())


def _name(obj: ArticulatedObject, part: Part, kind: GripKind, number: int) -> str:
    """Unlike any part and joint."""
    taken = {p.name for p in obj.parts} | {j.name for j in obj.joints}
    name = f"{part.name}_{kind}" + (f"_{number + 1}" if number else "")
    return f"{name}_grip" if name in taken else name


def _reachable(obj: ArticulatedObject, part: Part, joint: Joint, grip: Grip) -> bool:
    """Whether a finger gets there when what bars the joint is open."""
    state = required_state(joint.name, obj.preconditions)
    poses = forward_kinematics(obj.parts[0].name, obj.joints, state)
    reach = np.array([grip.position, np.add(grip.position, np.multiply(FINGER, grip.outward))])
    placed = apply(poses[part.name], reach)
    return not any(
        inside_bodies(other.mesh, apply(inverted(poses[other.name]), placed)).any()
        for other in obj.parts
        if other.name != part.name
    )
