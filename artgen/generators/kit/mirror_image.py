"""Parts and joints mirrored left to right, so that one hand of an object gives the other."""

import dataclasses

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Vector


def mirrored_body(body: Body) -> Body:
    """A body without decal, left and right exchanged."""
    return dataclasses.replace(
        body,
        solid=body.solid.mirrored("x"),
        collision=tuple(piece.mirrored("x") for piece in body.collision),
    )


def mirrored_part(part: DraftPart) -> DraftPart:
    """A part with its bodies and grips, left and right exchanged."""
    return dataclasses.replace(
        part,
        bodies=tuple(mirrored_body(body) for body in part.bodies),
        grips=tuple(_mirrored_grip(grip) for grip in part.grips),
    )


def mirrored_joint(joint: Joint) -> Joint:
    """A joint that moves the mirrored part as the mirror shows: a turn's axis is no arrow, its
    other two components change sign."""
    x, y, z = joint.axis
    axis = _across(joint.axis) if joint.type == "prismatic" else (x, 0.0 - y, 0.0 - z)
    return dataclasses.replace(joint, axis=axis, origin=_across(joint.origin))


def _mirrored_grip(grip: Grip) -> Grip:
    return dataclasses.replace(
        grip,
        position=_across(grip.position),
        outward=_across(grip.outward),
        pull=_across(grip.pull),
    )


def _across(v: Vector) -> Vector:
    return 0.0 - v[0], v[1], v[2]
