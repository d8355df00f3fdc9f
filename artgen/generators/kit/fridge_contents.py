"""What is in the rooms of a refrigerator: shelves, crispers, freezer drawers, groceries, light."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from artgen.articulation.types import Body, DraftPart, Joint, Latch, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import cold_fittings as fittings
from artgen.generators.kit.bottles import CONTAINERS, ranks, stand
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.generators.kit.flat_shelf import FlatShelf
from artgen.generators.kit.fridge_design import RUNNER, FridgeParams, Zone
from artgen.generators.kit.insulated_door import InsulatedDoor, basket
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.printed import icon, plate, printed, words
from artgen.generators.kit.pull_out_bin import PullOutBin
from artgen.geometry.solid import slab

CRISPER_LABEL = (0.060, 0.016)
TALLEST = 0.26
"""m; height of a freezer's drawer at most."""
LIGHT = (0.050, 0.005)
"""m; depth and thickness of the lamp under the ceiling."""


@dataclass(frozen=True, kw_only=True)
class Inside:
    """Bodies of the base, parts that slide, and when they may."""

    base: tuple[Body, ...] = ()
    parts: tuple[DraftPart, ...] = ()
    joints: tuple[Joint, ...] = ()
    rules: tuple[Precondition, ...] = ()

    def __add__(self, other: "Inside") -> "Inside":
        return Inside(
            base=self.base + other.base,
            parts=self.parts + other.parts,
            joints=self.joints + other.joints,
            rules=self.rules + other.rules,
        )


def inside(p: FridgeParams, zone: Zone) -> Inside:
    """Everything behind the doors of a zone."""
    room = p.room(zone)
    if zone.closing == "drawer":
        return Inside()
    if p.has_drawers(zone):
        return _freezer_drawers(p, zone, room)
    if zone.cold == "freezer":
        return _shelves(p, zone, room, room.low[2] + 0.02)
    crispers, top = _crispers(p, zone, room)
    control = _control(p, zone, room)
    return crispers + _shelves(p, zone, room, top) + _light(p, zone, room) + control


def _crispers(p: FridgeParams, zone: Zone, room: LinedCavity) -> tuple[Inside, float]:
    """Bins on the floor before the step, a pane over them; also the z above that pane."""
    (x0, _, z0), (x1, y1, _) = room.low, room.high
    y0, back = p.inside_front(zone), p.back_at(room, z0)
    top = z0 + 0.004 + p.crisper_height
    edges = np.linspace(x0 + RUNNER, x1 - RUNNER, p.crispers + 1)
    made = Inside()
    for k, (left, right) in enumerate(pairwise(edges)):
        name = f"{zone.name}_crisper_{k + 1}"
        low = (float(left) + (0.0015 if k else 0.0), y0, z0 + 0.0035)
        high = (float(right) - (0.0015 if k < p.crispers - 1 else 0.0), back, top)
        bin_ = PullOutBin(name=name, low=low, high=high, front=0.012, style=p.bin_style)
        part = bin_.part("bin", "bin_front")
        label = plate(bin_.face(CRISPER_LABEL), "crisper_label", density=ABS, thickness=0.0010,
                      sunk=0.0005)  # fmt: skip
        joint = bin_.joint(travel=p.travel * bin_.depth, friction=0.45 * p.slide_friction)
        made += Inside(
            parts=(replace(part, bodies=(*part.bodies, label)),),
            joints=(joint,),
            rules=_rules(p, zone, joint, low[0], high[0], alone=p.crispers == 2),
        )
    shelf = FlatShelf(left=x0 + 0.0015, right=x1 - 0.0015, front=y0, back=y1 - 0.002,
                      top=top + 0.004 + 0.018, style="glass")  # fmt: skip
    runners = _runners(room, y0 + 0.02, back, top - 0.014, p)
    cover = (*shelf.bodies("glass", "shelf_trim"), *shelf.ledges((x0, x1), "liner"))
    return made + Inside(base=(*runners, *cover)), shelf.top


def _rules(
    p: FridgeParams, zone: Zone, joint: Joint, low: float, high: float, *, alone: bool
) -> tuple[Precondition, ...]:
    """The doors that have to be out of a bin's way, and how far."""
    rules = []
    for leaf in p.leaves(zone):
        middle = (zone.cell[0][0] + zone.cell[1][0]) / 2.0
        same_side = ((low + high) / 2.0 < middle) == (leaf.hinge == "left")
        if zone.closing == "pair" and alone and not same_side:
            continue
        rules.append(Precondition(joint=joint.name, requires=f"{leaf.name}_hinge",
                                  at_least=p.needed(zone, leaf)))  # fmt: skip
    return tuple(rules)


def _runners(room: LinedCavity, front: float, back: float, z: float, p: FridgeParams) -> list[Body]:
    """Ribs on both walls under the rims of bins."""
    (x0, _, _), (x1, _, _) = room.low, room.high
    pieces = [slab((x0 - 0.001, front, z - 0.006), (x0 + RUNNER - 0.002, back, z)),
              slab((x1 - RUNNER + 0.002, front, z - 0.006), (x1 + 0.001, back, z))]  # fmt: skip
    return [Body(solid=s, surface="liner", density=ABS) for s in pieces]


def _shelves(p: FridgeParams, zone: Zone, room: LinedCavity, bottom: float) -> Inside:
    """Panes on ledges with groceries; the lowest level is what `bottom` closes."""
    (x0, _, z0), (x1, y1, z1) = room.low, room.high
    fridge = zone.cold == "fridge"
    start = max(bottom, p.case.step[1] if z0 < p.case.step[1] else bottom)
    tall = z1 - start - (fittings.BAR if fridge else 0.0)
    most = 1 if p.layout == "four_door" else 2
    count = max(1, min(4 if fridge else most, round(tall / p.shelf_pitch) - (1 if fridge else 0)))
    if tall < 0.30 and fridge:
        count = 0
    made: list[Body] = []
    levels = [bottom] if fridge else []
    for k in range(count):
        share = p.shelf_shares[k % len(p.shelf_shares)]
        z = start + tall * (k + (1.0 if fridge else 0.6)) / (count + (1.0 if fridge else 0.6))
        shelf = FlatShelf(
            left=x0 + 0.0015, right=x1 - 0.0015, front=p.inside_front(zone), back=y1 - 0.002,
            top=z + 0.02 * (share - 0.5), style="glass" if fridge else "wire", wires=10,
        )  # fmt: skip
        made += [*shelf.bodies("glass" if fridge else "wire", "shelf_trim"),
                 *shelf.ledges((x0, x1), "liner")]  # fmt: skip
        levels.append(shelf.top)
    if fridge:
        made += _groceries(p, zone, room, levels)
    return Inside(base=tuple(made))


def _groceries(p: FridgeParams, zone: Zone, room: LinedCavity, levels: list[float]) -> list[Body]:
    """A rank of one kind on each level, left or right, if it fits."""
    made: list[Body] = []
    (x0, _, _), (x1, y1, z1) = room.low, room.high
    stocked = 1 if p.layout == "four_door" else 3  # Bundles of many doors stay below 3 MB.
    for k, z in enumerate(levels):
        kind = p.groceries[k % len(p.groceries)] if k < stocked else "none"
        above = levels[k + 1] - 0.026 if k + 1 < len(levels) else z1 - fittings.BAR - 0.01
        if kind == "none" or above - z < CONTAINERS[kind].height + 0.012:
            continue
        half = 0.5 * (x1 - x0)
        left, right = (x0 + 0.02, x0 + half) if k % 2 else (x0 + half, x1 - 0.02)
        front = p.inside_front(zone) + 0.05
        places = ranks(kind, (left, front), (right, y1 - 0.02), most=(3, 1))
        made += stand(kind, places, z + 0.0013, glass=GLASS_OF.get(kind, "bottle"),
                      label=f"label_{kind}", cap="crown")  # fmt: skip
    return made


GLASS_OF = {"can": "can", "slim_can": "can", "jar": "jar", "pet": "pet"}
"""Surfaces of containers that are no glass bottles."""


def bottles_in(p: FridgeParams, zone: Zone, door: InsulatedDoor) -> list[Body]:
    """Bottles in the lowest bin of a chilled room's door, others in the next; of two doors the
    right one."""
    made: list[Body] = []
    (x0, x1), leaf = door.sides, door.leaf
    if zone.cold == "freezer" or (zone.closing == "pair" and leaf.hinge == "left"):
        return made
    for k, ((z, _), kind) in enumerate(zip(door.bins, reversed(p.groceries), strict=False)):
        above = door.bins[k + 1][0] if k + 1 < len(door.bins) else door.high - 0.05
        if kind == "none" or above - z < CONTAINERS[kind].height + 0.01:
            continue
        pitch = 2.0 * CONTAINERS[kind].radius + 0.012
        places = [leaf.point(x0 + 0.08 + pitch * i, 0.5 * (p.bin_depth + leaf.back), 0.0)[:2]
                  for i in range(2 + k % 2) if x0 + 0.08 + pitch * (i + 1) < x1]  # fmt: skip
        floor, glass = leaf.corner[2] + z + 0.0033, GLASS_OF.get(kind, "bottle")
        made += stand(
            kind, places, floor, glass=glass, label=f"label_{kind}", cap="crown", way=-1.0
        )
    return made


def _light(p: FridgeParams, zone: Zone, room: LinedCavity) -> Inside:
    """A flat lamp under the ceiling."""
    (x0, _, _), (x1, _, z1) = room.low, room.high
    y, middle, half = p.inside_front(zone) + 0.06, (x0 + x1) / 2.0, 0.22 * (x1 - x0)
    lamp = slab((middle - half, y, z1 - LIGHT[1]), (middle + half, y + LIGHT[0], z1 + 0.001))
    return Inside(base=(Body(solid=lamp, surface="led", density=ABS, edge=0.001),))


def _control(p: FridgeParams, zone: Zone, room: LinedCavity) -> Inside:
    """A knob or a display on a bar under the ceiling, behind the bins of the door."""
    if not p.has_control:
        return Inside()
    front = p.inside_front(zone) + 0.012
    bar = fittings.control_bar(room, "trim", front=front)
    lit = fittings.light(room, "top", front=front)
    if p.control == "digital":
        return Inside(base=(bar, *lit, fittings.screen(room, front=front)))
    dial = fittings.thermostat()
    plane: PanelPlane = fittings.bar_plane(room, fittings.DIAL_FACE, front=front)
    drilled = replace(bar, solid=bar.solid - plane.placed(dial.hole()))
    return Inside(
        base=(drilled, *lit, fittings.thermostat_face(room, dial, front=front)),
        parts=(dial.part(plane, "knob", "mark", density=900.0),),
        joints=(dial.joint(plane, parent="base"),),
    )


def _freezer_drawers(p: FridgeParams, zone: Zone, room: LinedCavity) -> Inside:
    """Drawers above each other, shelves over them; the lowest ends before the step."""
    (x0, _, z0), (x1, _, z1) = room.low, room.high
    count = max(2, min(p.freezer_drawers, int((z1 - z0) / 0.19)))
    end = min(z1 - 0.006, z0 + 0.004 + count * TALLEST)
    levels = np.linspace(z0 + 0.004, end, count + 1)
    made = _shelves(p, zone, room, end + 0.01) if z1 - end > 0.30 else Inside()
    for k, (low, high) in enumerate(pairwise(levels)):
        name = f"{zone.name}_bin_{k + 1}"
        y0, back = p.inside_front(zone), p.back_at(room, float(low))
        corner = (x0 + RUNNER, y0, float(low))
        drawer = PullOutBin(
            name=name, low=corner, high=(x1 - RUNNER, back, float(high) - 0.010), front=0.014,
            style=p.bin_style, label="drawer",
        )  # fmt: skip
        joint = drawer.joint(travel=p.travel * drawer.depth, friction=p.slide_friction)
        made += Inside(
            base=tuple(_runners(room, y0 + 0.02, back, float(high) - 0.024, p)),
            parts=(drawer.part("bin", "bin_front"),),
            joints=(joint,),
            rules=_rules(p, zone, joint, corner[0], x1 - RUNNER, alone=False),
        )
    return made


def drawer_front(p: FridgeParams, zone: Zone) -> tuple[DraftPart, Joint, list[Body]]:
    """A freezer's pull-out drawer with its basket, and the runners on the walls."""
    leaf, room = p.leaves(zone)[0], p.room(zone)
    door = p.door_of(leaf, zone)
    front = replace(door, bins=(), rim=0.010, far=door.far + 0.0)
    (x0, _, z0), (x1, _, z1) = room.low, room.high
    low = (x0 + RUNNER + 0.002, leaf.back - 0.001, z0 + 0.020)
    back = p.back_at(room, low[2])
    high = (x1 - RUNNER - 0.002, back, z0 + 0.020 + p.drawer_fill * (z1 - z0 - 0.04))
    tub = basket(low, high, wall=0.0035, surface="bin")
    part = DraftPart(name=leaf.name, label="drawer",
                     bodies=(*(leaf.carried(body) for body in front.bodies()), tub),
                     grips=(front.pull.grip(),))  # fmt: skip
    joint = leaf.slide(travel=p.travel * (back - low[1]), friction=p.slide_friction + 6.0,
                       latch=Latch(force=12.0 + p.latch, reach=0.012))  # fmt: skip
    return part, joint, _runners(room, 0.02, back, high[2] - 0.03, p)


def crisper_print() -> SurfaceSpec:
    """A leaf and a word."""
    w, h = CRISPER_LABEL
    marks = [icon((0.14 * w, 0.5 * h), "leaf", size=0.62 * h, ink="#3f6b47"),
             words((0.58 * w, 0.34 * h), "FRESH ZONE", cap=0.34 * h, ink="#4a5258")]  # fmt: skip
    return printed("crisper_label", CRISPER_LABEL, background="#eef1f0", marks=marks)
