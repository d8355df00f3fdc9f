"""Doors: a lining with architraves and one or two hung leaves, or a leaf that slides."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import door_params
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ALUMINIUM, RUBBER
from artgen.generators.kit.door_frame import DoorFrame, skirting, threshold, wall
from artgen.generators.kit.door_params import GAP, MEETING, DoorParams, frame_free
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.hung_leaves import active_leaf, passive_leaf
from artgen.generators.kit.mirror_image import mirrored_joint, mirrored_part
from artgen.generators.kit.sliding_leaf import barn_door, pocket_door

PARAMS = DoorParams
INVARIANTS = door_params.INVARIANTS
METAL_SILL = Stock(surface="lock", density=ALUMINIUM, edge=0.0008)
WALL = Stock(surface="wall", density=260.0, edge=0.002)
"""Plasterboard on studs with mineral wool, effective."""
Made = tuple[tuple[DraftPart, ...], tuple[Joint, ...], tuple[Precondition, ...]]
"""Parts, base first; joints; preconditions; of a door that is hung or slides at the left."""


def build(p: DoorParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Leaves close the opening and swing towards -y or slide along it."""
    parts, joints, rules = KINDS[p.kind](p)
    if not p.hinge_left:
        parts = tuple(mirrored_part(part) for part in parts)
        joints = tuple(mirrored_joint(joint) for joint in joints)
    names = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="door",
        parts=parts,
        joints=joints,
        surfaces=tuple(spec for role, spec in surfaces.items() if role in names),
        preconditions=rules,
    )


def _hung(p: DoorParams) -> Made:
    """One leaf, or two of which the first must be open before the other."""
    double = p.kind == "double"
    width = p.leaf_width * (2 if double else 1) + 2.0 * GAP + (MEETING if double else 0.0)
    opening = Rect(x0=-width / 2.0, x1=width / 2.0, z0=0.0, z1=p.floor + p.leaf_height + GAP)
    leaf = active_leaf(p, opening, meeting=double)
    base, parts, joints, rules = _frame(p, opening), leaf.parts, leaf.joints, leaf.preconditions
    if double:
        other = passive_leaf(p, opening).mirrored()
        struck = replace(other.parts[0], bodies=leaf.struck(other.parts[0].bodies))
        parts, joints, base = (*parts, struck), (*joints, *other.joints), base + other.frame
        rules += (Precondition(joint="passive_swing", requires="leaf_swing", at_least=0.5),)
    else:
        base = leaf.struck(base)
    return (DraftPart(name="base", label="base", bodies=base + leaf.frame), *parts), joints, rules


def _barn(p: DoorParams) -> Made:
    """A leaf before a wall, on a rail over its opening."""
    return barn_door(p, _wood(p), WALL)


def _pocket(p: DoorParams) -> Made:
    """A leaf that slides into the wall."""
    return pocket_door(p, _wood(p), WALL)


KINDS: Mapping[str, Callable[[DoorParams], Made]] = {
    "single": _hung,
    "double": _hung,
    "barn": _barn,
    "pocket": _pocket,
}


def _wood(p: DoorParams) -> Stock:
    """Of lining and architraves: as the leaf, or painted on its own."""
    return Stock(surface="leaf" if p.frame_matches else "frame", density=560.0, edge=0.001)


def _frame(p: DoorParams, opening: Rect) -> tuple[Body, ...]:
    frame = DoorFrame(
        opening=opening,
        depth=p.depth,
        lining=p.lining,
        stop=p.leaf_thickness + 0.0025,
        casing=p.casing,
        casing_size=(p.casing_width, p.casing_proud),
    )
    bodies = frame.bodies(_wood(p), Stock(surface="seal", density=RUBBER))
    if p.sill != "none":
        stock = (
            _wood(p) if p.sill == "wood" else Stock(surface="lock", density=ALUMINIUM, edge=0.0008)
        )
        bodies += (threshold(opening, depth=p.depth, height=0.016, stock=stock),)
    if p.in_wall:
        bodies += _wall(p, opening)
    return bodies


def _wall(p: DoorParams, opening: Rect) -> tuple[Body, ...]:
    t = p.lining
    hole = replace(opening, x0=opening.x0 - t, x1=opening.x1 + t, z1=opening.z1 + t)
    side = frame_free(p) - t + p.wall_side
    above = frame_free(p) - t + 0.06 + p.wall_above
    both = (side, side)
    skirts = skirting(
        hole, side=both, inset=frame_free(p) - t, height=0.08, front=0.0, stock=_wood(p)
    )
    body = wall(hole, side=both, above=above, front=0.0, back=p.depth, stock=WALL)
    return (body, *skirts)
