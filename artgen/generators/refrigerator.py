"""Refrigerators: foamed cases with one to four doors, freezer drawers, crispers, dispensers."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Latch
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import cold_fittings as fittings
from artgen.generators.kit import ice_dispenser as dispensers
from artgen.generators.kit.bottles import label_print
from artgen.generators.kit.cold_leaf import ColdLeaf
from artgen.generators.kit.fridge_contents import (
    Inside,
    bottles_in,
    crisper_print,
    drawer_front,
    inside,
)
from artgen.generators.kit.fridge_design import (
    STOP,
    FridgeParams,
    Zone,
    doors_hold_bins,
    doors_open_far_enough,
    freezer_holds_something,
)
from artgen.generators.kit.ice_dispenser import IceDispenser

PARAMS = FridgeParams
INKS = (("#0e4c92", "#f2f4f6"), ("#f1e6c8", "#7a1f1a"), ("#0f6b3c", "#f6f1dc"),
        ("#e58a13", "#fff8ea"), ("#f5f5f2", "#b3161c"))  # fmt: skip
"""Ground and ink of labels."""


def build(p: FridgeParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest all is shut; bins slide out once their door is out of the way."""
    everything = Inside(base=tuple(_base_bodies(p)))
    for zone in p.zones:
        if zone.closing == "drawer":
            part, joint, runners = drawer_front(p, zone)
            everything += Inside(base=tuple(runners), parts=(part,), joints=(joint,))
            continue
        content = inside(p, zone)
        doors = [_door(p, zone, leaf, content) for leaf in p.leaves(zone)]
        for made in doors:
            everything += made
        everything += content
    parts = (DraftPart(name="base", label="base", bodies=everything.base), *everything.parts)
    worn = {body.surface for part in parts for body in part.bodies}
    specs = (*surfaces.values(), *_prints(p))
    return Draft(
        category="refrigerator",
        parts=parts,
        joints=everything.joints,
        surfaces=tuple(spec for spec in specs if spec.name in worn),
        preconditions=everything.rules,
    )


def _base_bodies(p: FridgeParams) -> list[Body]:
    """Case, compressor, feet, grille, coil."""
    c = p.case
    bodies = [
        *c.bodies([(z.cell, p.room(z)) for z in p.zones], shell="side", liner="liner"),
        *c.compressor(metal="works", mass=p.compressor),
        *c.feet("rubber", radius=0.020),
        *c.grille("grille", bars=p.bars, upright_bars=p.upright_bars),
    ]
    if p.coil and p.layout in ("mini", "larder", "top_freezer"):
        bodies += c.coil("works", legs=10)
    return bodies


def _door(p: FridgeParams, zone: Zone, leaf: ColdLeaf, content: Inside) -> Inside:
    """A door, its joint, its hinges on the case, and what is set into its skin."""
    door = p.door_of(leaf, zone)
    slides = any(rule.requires == f"{leaf.name}_hinge" for rule in content.rules)
    least = p.needed(zone, leaf) + STOP if slides else 0.0
    joint = leaf.swing(upper=min(max(p.opening, least), leaf.widest()),
                       friction=p.friction, latch=Latch(force=p.latch, reach=0.05))  # fmt: skip
    extra: list[Body] = []
    parts: list[DraftPart] = []
    joints: list[Joint] = [joint]
    if _carries_dispenser(p, zone, leaf):
        dispenser = _dispenser(leaf)
        door = replace(door, holes=(dispenser.hole(),))
        extra += [*(leaf.carried(body) for body in dispenser.bodies()), dispenser.face()]
        parts.append(dispenser.paddle())
        joints.append(dispenser.joint())
    elif p.panel and leaf is p.leaves(zone)[0] and zone is p.zones[-1] and leaf.length > 0.9:
        extra.append(dispensers.touch_panel(leaf, (0.5 * leaf.width, 0.62 * leaf.length)))
    if _carries_badge(p, zone, leaf):
        low = (0.5 * (leaf.width - dispensers.BADGE[0]), leaf.length - 0.075)
        extra.append(dispensers.badge(leaf, low))
    bodies = (*(leaf.carried(body) for body in door.bodies()), *extra, *bottles_in(p, zone, door))
    part = DraftPart(name=leaf.name, label="door", bodies=bodies, grips=(door.pull.grip(),))
    return Inside(base=(*leaf.hinge_plates("metal"), *leaf.hinge_cap('cap', top=p.case.top)),
                  parts=(part, *parts), joints=tuple(joints))  # fmt: skip


def _carries_badge(p: FridgeParams, zone: Zone, leaf: ColdLeaf) -> bool:
    return zone is p.zones[-1] and leaf.name == p.leaves(zone)[-1].name


def _carries_dispenser(p: FridgeParams, zone: Zone, leaf: ColdLeaf) -> bool:
    """The left door of the tall ones."""
    tall = leaf.length > 0.9
    return p.has_dispenser and tall and leaf.hinge == "left"


def _dispenser(leaf: ColdLeaf) -> IceDispenser:
    wide = min(0.22, 0.56 * leaf.width)
    z = min(0.98 - leaf.corner[2], leaf.length - 0.55)
    return IceDispenser(leaf=leaf, low=(0.47 * leaf.width - wide / 2.0, max(z, 0.16)),
                        size=(wide, 0.36), panel=0.12)  # fmt: skip


def _prints(p: FridgeParams) -> list[SurfaceSpec]:
    """Labels, displays, badge."""
    kinds = sorted({kind for kind in p.groceries if kind != "none"})
    made = [label_print(f"label_{kind}", kind, number=p.label + k, ground=INKS[k % 5][0],
                        ink=INKS[k % 5][1]) for k, kind in enumerate(kinds)]  # fmt: skip
    leaf = p.leaves(p.zones[-1])[0]
    return [
        *made,
        crisper_print(),
        dispensers.badge_print(p.brand),
        dispensers.touch_print(p.temperature, p.led),
        dispensers.dispenser_print(_dispenser(leaf).face_size, p.led),
        fittings.screen_print(p.temperature, p.led),
        fittings.thermostat_print(fittings.thermostat()),
    ]


INVARIANTS: Mapping[str, Callable[[FridgeParams], bool]] = {
    check.__name__: check
    for check in (doors_hold_bins, doors_open_far_enough, freezer_holds_something)
}
