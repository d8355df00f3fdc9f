"""Doors: a lining with architraves and one or two hung leaves, or a leaf that slides."""

import math
from collections.abc import Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart, Grip, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import door_params
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ALUMINIUM, GLASS, OAK, RUBBER
from artgen.generators.kit.door_fittings import LetterPlate, kick_plate, spy_hole
from artgen.generators.kit.door_frame import DoorFrame, skirting, threshold, wall
from artgen.generators.kit.door_leaf import lock_rail_middle, pierced
from artgen.generators.kit.door_params import (
    GAP,
    DoorParams,
    frame_free,
    hinge_of,
    leaf_maker,
    lever_set,
    metal,
)
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.mortise_latch import MortiseLatch
from artgen.generators.kit.swing_leaf import Hung, Metals, SwingLeaf, widest_swing

PARAMS = DoorParams
INVARIANTS = door_params.INVARIANTS
MEETING = 0.005
"""m; between the leaves of a double door."""
LOCK = Stock(surface="lock", density=7000.0, edge=0.0)
METALS = Metals(
    handle=metal("metal"),
    hinge=replace(metal("metal"), edge=0.0),
    lock=LOCK,
    dark=Stock(surface="dark", density=1100.0),
)
WALL = Stock(surface="wall", density=260.0, edge=0.002)
"""Plasterboard on studs with mineral wool, effective."""


def build(p: DoorParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """Leaves close the opening with their faces in y = 0 and swing towards -y."""
    double = p.kind == "double"
    width = p.leaf_width * (2 if double else 1) + 2.0 * GAP + (MEETING if double else 0.0)
    opening = Rect(x0=-width / 2.0, x1=width / 2.0, z0=0.0, z1=p.floor + p.leaf_height + GAP)
    hung = [_active(p, opening, meeting=double)]
    if double:
        hung.append(_passive(p, opening).mirrored())
    if not p.hinge_left:
        hung = [leaf.mirrored() for leaf in hung]
    base = _frame(p, opening)
    for leaf in hung:
        base += leaf.frame
    parts = [part for leaf in hung for part in leaf.parts]
    struck = hung[0].strike_hole
    if struck is not None:
        cut = pierced(base if not double else parts[-1].bodies, struck, clear=struck)
        cut += hung[0].strike
        if double:
            parts[-1] = replace(parts[-1], bodies=cut)
        else:
            base = cut
    rules = [rule for leaf in hung for rule in leaf.preconditions]
    if double:
        rules.append(Precondition(joint="passive_swing", requires="leaf_swing", at_least=0.5))
    return Draft(
        category="door",
        parts=(DraftPart(name="base", label="base", bodies=base), *parts),
        joints=tuple(joint for leaf in hung for joint in leaf.joints),
        surfaces=_used((*base, *(body for part in parts for body in part.bodies)), surfaces),
        preconditions=tuple(rules),
    )


def _used(bodies: tuple[Body, ...], surfaces: Mapping[str, SurfaceSpec]) -> tuple[SurfaceSpec, ...]:
    names = {body.surface for body in bodies}
    return tuple(spec for role, spec in surfaces.items() if role in names)


def _swing_leaf(p: DoorParams, opening: Rect, name: str) -> SwingLeaf:
    """Hung at the left of the opening."""
    x0 = opening.x0 + GAP
    rect = Rect(x0=x0, x1=x0 + p.leaf_width, z0=p.floor, z1=p.floor + p.leaf_height)
    hinge = hinge_of(p, opening.x0)
    step = (p.leaf_height - 0.40) / (p.hinges - 1)
    return SwingLeaf(
        name=name,
        rect=rect,
        faces=(0.0, p.leaf_thickness),
        bodies=leaf_maker(p).leaf(p.layout, rect, 0.0),
        hinge=hinge,
        heights=tuple(p.floor + 0.22 + k * step for k in range(p.hinges)),
        opening=widest_swing(
            hinge=hinge, bare=0.008, proud=p.casing_proud, wanted=math.radians(p.opening_deg)
        ),
        friction=p.friction,
        metals=METALS,
    )


def _active(p: DoorParams, opening: Rect, *, meeting: bool) -> Hung:
    """The leaf that is opened first, with its handle, its latch and what else it wears."""
    leaf = _swing_leaf(p, opening, "leaf")
    levers = lever_set(p, leaf.rect.x1)
    latch = MortiseLatch(
        edge=leaf.rect.x1,
        gap=MEETING if meeting else GAP,
        middle=p.leaf_thickness / 2.0,
        z=p.handle_height,
        throw=p.throw,
        height=0.018,
        deadbolt=p.lock in ("keyhole", "cylinder"),
    )
    extras = _worn(p, leaf.rect)
    if meeting:
        x, cover = leaf.rect.x1, leaf_maker(p).stock
        low, high = leaf.rect.z0, leaf.rect.z1
        extras += (
            cover.board((x - 0.016, -0.011, low), (x, 0.0, high)),
            cover.board((x, -0.011, low), (x + 0.020, -0.0015, high)),
        )
    return leaf.hung(levers=levers, latch=latch, letters=_letters(p, leaf.rect), extras=extras)


def _passive(p: DoorParams, opening: Rect) -> Hung:
    """The leaf that waits for the other; its handles are fixed."""
    leaf = _swing_leaf(p, opening, "passive")
    extras = _kick(p, leaf.rect)
    if p.handle == "knob":
        return leaf.hung(extras=extras, grips=(_edge_grip(p, leaf.rect),))
    return leaf.hung(levers=replace(lever_set(p, leaf.rect.x1), lock="none"), extras=extras)


def _edge_grip(p: DoorParams, rect: Rect) -> Grip:
    return Grip(
        name="passive_edge",
        kind="edge",
        position=(rect.x1, p.leaf_thickness / 2.0, p.handle_height),
        outward=(1.0, 0.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )


def _worn(p: DoorParams, rect: Rect) -> tuple[Body, ...]:
    extras = _kick(p, rect)
    if p.spy and p.layout in ("flush", "grooved", "six_panel", "four_panel"):
        glass = Stock(surface="glass", density=GLASS, edge=0.0)
        faces = (0.0, p.leaf_thickness)
        extras += tuple(
            spy_hole(rect.middle[0], 1.52, faces=faces, metal=METALS.hinge, glass=glass)
        )
    return extras


def _kick(p: DoorParams, rect: Rect) -> tuple[Body, ...]:
    if not p.kick:
        return ()
    return (kick_plate(rect, face=0.0, height=p.bottom_rail - 0.03, metal=METALS.hinge),)


def _letters(p: DoorParams, rect: Rect) -> LetterPlate | None:
    """In the lock rail, or at its height in a flush leaf."""
    z = lock_rail_middle(leaf_maker(p), p.layout, rect)
    if z is None or not p.letter_plate or p.lock_rail < 0.15:
        return None
    width = min(0.25, p.leaf_width - 2.0 * p.stile - 0.16)
    faces = (0.0, p.leaf_thickness)
    return LetterPlate(middle=(rect.middle[0], z), faces=faces, width=width, height=0.032)


def _frame(p: DoorParams, opening: Rect) -> tuple[Body, ...]:
    wood = Stock(surface="frame", density=OAK if p.sill == "wood" else 560.0, edge=0.001)
    frame = DoorFrame(
        opening=opening,
        depth=p.depth,
        lining=p.lining,
        stop=p.leaf_thickness + 0.0025,
        casing=p.casing,
        casing_size=(p.casing_width, p.casing_proud),
    )
    bodies = frame.bodies(wood, Stock(surface="seal", density=RUBBER))
    if p.sill != "none":
        stock = wood if p.sill == "wood" else Stock(surface="lock", density=ALUMINIUM, edge=0.0008)
        bodies += (threshold(opening, depth=p.depth, height=0.016, stock=stock),)
    if p.in_wall:
        bodies += _wall(p, opening)
    return bodies


def _wall(p: DoorParams, opening: Rect) -> tuple[Body, ...]:
    t = p.lining
    hole = replace(opening, x0=opening.x0 - t, x1=opening.x1 + t, z1=opening.z1 + t)
    side = frame_free(p) - t + p.wall_side
    above = frame_free(p) - t + 0.06 + p.wall_above
    wood = Stock(surface="frame", density=560.0, edge=0.002)
    both = (side, side)
    skirts = skirting(hole, side=both, inset=frame_free(p) - t, height=0.08, front=0.0, stock=wood)
    body = wall(hole, side=both, above=above, front=0.0, back=p.depth, stock=WALL)
    return (body, *skirts)
