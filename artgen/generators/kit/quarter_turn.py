"""Parts and joints turned exactly by a quarter about z, so that what faced +x faces the user."""

import dataclasses

import numpy as np

from artgen.articulation.types import Axis, Body, Decal, DraftPart, Grip, Joint, Vector
from artgen.core.mesh import Floats

CLOCKWISE: Floats = np.array(
    [[0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""+x goes to -y: what faced right faces the user."""


def clockwise(v: Vector) -> Vector:
    """A point or direction, turned as seen from above."""
    return v[1] + 0.0, -v[0] + 0.0, v[2]


def turned_part(part: DraftPart) -> DraftPart:
    """A part with its bodies and grips, turned clockwise as seen from above."""
    return dataclasses.replace(
        part,
        bodies=tuple(_turned_body(body) for body in part.bodies),
        grips=tuple(_turned_grip(grip) for grip in part.grips),
    )


def turned_joint(joint: Joint) -> Joint:
    """A joint, turned clockwise as seen from above."""
    return dataclasses.replace(joint, axis=clockwise(joint.axis), origin=clockwise(joint.origin))


def _turned_body(body: Body) -> Body:
    swapped: dict[Axis, Axis] = {"x": "y", "y": "x", "z": "z"}
    return dataclasses.replace(
        body,
        solid=body.solid.transformed(CLOCKWISE),
        collision=tuple(piece.transformed(CLOCKWISE) for piece in body.collision),
        grain=None if body.grain is None else swapped[body.grain],
        decal=None if body.decal is None else _turned_decal(body.decal),
    )


def _turned_decal(decal: Decal) -> Decal:
    return dataclasses.replace(
        decal,
        origin=clockwise(decal.origin),
        right=clockwise(decal.right),
        up=clockwise(decal.up),
    )


def _turned_grip(grip: Grip) -> Grip:
    return dataclasses.replace(
        grip,
        position=clockwise(grip.position),
        outward=clockwise(grip.outward),
        pull=clockwise(grip.pull),
    )
