"""Placing: parts at rest, in meters, in our frame; joints about axes there, positive opening."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Limit
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.export.kinematics import vector
from artgen.ingest.foreign import ForeignJoint, ForeignObject
from artgen.ingest.rest import Rest, drawn_joint
from artgen.ingest.sizes import Scale, chosen_scale
from artgen.validate.sweep import POSES


@dataclass(frozen=True, kw_only=True, eq=False)
class Place:
    """Where everything goes.

    Attributes:
        rest_from_drawn: part name to the (4, 4) motion from its pose as drawn to rest, source
            frame and units.
        object_from_source: (3, 4) turn, scale and shift from the source's frame at rest to the
            object frame: standing on z = 0, centered in x and y.
    """

    scale: Scale
    rest_from_drawn: Mapping[str, Floats]
    object_from_source: Floats

    def points(self, part: str, points: Floats) -> Floats:
        """(N, 3) points of a part as drawn, in the object frame at rest, m."""
        at_rest = apply(self.rest_from_drawn[part], points)
        return self._moved(at_rest)

    def _moved(self, points: Floats) -> Floats:
        turn = self.object_from_source[:, :3]
        return np.asarray(points @ turn.T + self.object_from_source[:, 3])


def placed(
    obj: ForeignObject,
    rests: Mapping[str, Rest],
    points: Mapping[str, Floats],
    *,
    meters_per_unit: float | None,
) -> Place:
    """Rest poses, scale and ground for an object whose parts have these (N, 3) points as drawn.

    Raises:
        IngestError: a scale is not positive, or the object is flat.
    """
    joints = [drawn_joint(joint) for joint in obj.joints]
    state = {name: rest.q for name, rest in rests.items()}
    poses = forward_kinematics(obj.parts[0].name, joints, state)
    turned = np.concatenate(
        [apply(poses[name], own) @ obj.object_from_source.T for name, own in points.items()]
    )
    lower, upper = turned.min(axis=0), turned.max(axis=0)
    scale = chosen_scale(
        obj.category, upper - lower, given=meters_per_unit, stated=obj.meters_per_unit
    )
    size = scale.meters_per_unit
    middle = (lower + upper) / 2.0
    shift = -size * np.array([middle[0], middle[1], lower[2]])
    turn = size * obj.object_from_source
    return Place(
        scale=scale,
        rest_from_drawn=poses,
        object_from_source=np.concatenate([turn, shift[:, None]], axis=1),
    )


@dataclass(frozen=True, kw_only=True)
class PlacedJoint:
    """A joint's motion in the object frame at rest; without names and forces.

    Attributes:
        sign: +1 where it opens along the source's axis, -1 where along the other way.
        limit: None where it turns without end.
    """

    axis: tuple[float, float, float]
    origin: tuple[float, float, float]
    sign: float
    limit: Limit | None


def placed_joint(joint: ForeignJoint, rest: Rest, place: Place) -> PlacedJoint:
    """Axis and origin moved with the parent; limits about rest, the longer way being positive.

    With q the source's value, the new one is sign * (q - rest), times the scale where it slides.
    """
    parent = place.rest_from_drawn[joint.parent]
    size = place.scale.meters_per_unit
    turn = place.object_from_source[:, :3] / size
    axis = turn @ parent[:3, :3] @ np.array(joint.axis)
    origin = place.points(joint.parent, np.array([joint.origin]))[0]
    sign, limit = 1.0, None
    if joint.lower is not None and joint.upper is not None:
        unit = size if joint.type == "prismatic" else 1.0
        below, above = unit * (joint.lower - rest.q), unit * (joint.upper - rest.q)
        sign = -1.0 if -below > above else 1.0
        lower, upper = (below, above) if sign > 0.0 else (-above, -below)
        limit = Limit(lower=min(lower + 0.0, 0.0), upper=upper)
    direction = sign * axis / np.linalg.norm(axis)
    return PlacedJoint(axis=vector(direction), origin=vector(origin), sign=sign, limit=limit)


def swept_poses(
    parts: Sequence[str], joints: Sequence[ForeignJoint], rests: Mapping[str, Rest], place: Place
) -> list[dict[str, Floats]]:
    """Part name to its (4, 4) motion from rest, in the object frame: each joint through its range
    with the others at rest, and with the others open, as the validator moves them."""
    moved = {joint.name: placed_joint(joint, rests[joint.name], place) for joint in joints}
    chain = [
        dataclasses.replace(
            drawn_joint(joint), axis=moved[joint.name].axis, origin=moved[joint.name].origin
        )
        for joint in joints
    ]
    full = Limit(lower=-math.pi, upper=math.pi)
    ranges = {name: at.limit or full for name, at in moved.items()}
    open_ = {name: limit.upper for name, limit in ranges.items()}
    others = [dict.fromkeys(open_, 0.0), open_] if len(joints) > 1 else [{}]
    states = [
        {**held, name: q}
        for name, limit in ranges.items()
        for held in others
        for q in np.linspace(limit.lower, limit.upper, POSES).tolist()
    ]
    return [forward_kinematics(parts[0], chain, state) for state in states]


def carried(parts: Sequence[str], joints: Sequence[ForeignJoint]) -> dict[str, list[str]]:
    """Part name to the parts that move with it, itself first; joints are parents first."""
    found: dict[str, list[str]] = {name: [name] for name in parts}
    for joint in reversed(joints):
        found[joint.parent] += found[joint.child]
    return found
