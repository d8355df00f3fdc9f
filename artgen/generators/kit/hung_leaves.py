"""The hung leaves of a house door, with handle, latch and fittings, from the door's numbers."""

import math
from dataclasses import replace

from artgen.articulation.types import Body, Grip
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import GLASS
from artgen.generators.kit.door_fittings import LetterPlate, kick_plate, spy_hole
from artgen.generators.kit.door_frame import REVEAL
from artgen.generators.kit.door_leaf import lock_rail_middle
from artgen.generators.kit.door_params import (
    GAP,
    MEETING,
    METALS,
    DoorParams,
    hinge_of,
    leaf_maker,
    lever_set,
)
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.mortise_latch import MortiseLatch
from artgen.generators.kit.swing_leaf import Hung, SwingLeaf, widest_swing


def active_leaf(p: DoorParams, opening: Rect, *, meeting: bool) -> Hung:
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


def passive_leaf(p: DoorParams, opening: Rect) -> Hung:
    """The leaf that waits for the other; its handles are fixed."""
    leaf = _swing_leaf(p, opening, "passive")
    extras = _kick(p, leaf.rect)
    if p.handle in ("knob", "curved", "return"):
        return leaf.hung(extras=extras, grips=(_edge_grip(p, leaf.rect),))
    return leaf.hung(levers=replace(lever_set(p, leaf.rect.x1), lock="none"), extras=extras)


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
            hinge=hinge, bare=REVEAL, proud=p.casing_proud, wanted=math.radians(p.opening_deg)
        ),
        friction=p.friction,
        metals=METALS,
    )


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
