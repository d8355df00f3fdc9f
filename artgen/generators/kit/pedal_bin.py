"""Bins with a lid over an inner bucket: opened by a pedal that lifts the lid, or by hand."""

from dataclasses import dataclass

from artgen.articulation.types import (
    Body,
    DraftPart,
    Grip,
    Joint,
    Limit,
    Mimic,
    Precondition,
)
from artgen.generators.kit.bin_plan import Plan
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.geometry.solid import Solid, chamfered_box, cylinder, slab, union

FOOT, SHEET, SEAM = 0.046, 0.0016, 0.0015
"""Height of the foot, thickness of the drawn shell, air under the lid, m."""
BEHIND, ABOVE = 0.016, 0.008
"""Where the lid's axis lies: behind the shell and over its edge, m."""
BUCKET = 0.015
"""From the shell's outside to the bucket's, m."""
PEDAL = (0.030, 0.036)
"""Lower and upper z of the pedal at rest, m."""
INSIDE = 0.045
"""How far behind the shell's front the pedal turns, m."""


@dataclass(frozen=True, kw_only=True)
class PedalBin:
    """One bin standing at x = `at`.

    Attributes:
        name: prefix of its parts' names.
        height: z of the shell's upper edge.
        dome: height of the lid.
        step: width of the pedal; None where the lid is opened by hand.
        press: angle of the pedal, rad.
        opens: angle of the lid, rad.
        bag: whether a liner hangs over the bucket's rim.
    """

    name: str
    at: float
    plan: Plan
    height: float
    dome: float
    step: float | None
    press: float
    opens: float
    friction: float
    bag: bool
    shell: Stock
    lid: Stock
    plastic: Stock
    bucket: Stock
    liner: Stock

    @property
    def depth(self) -> float:
        """Half of it."""
        return self.plan.half[1]

    @property
    def axis(self) -> tuple[float, float]:
        """(y, z) of the lid's hinge."""
        return self.depth + BEHIND, self.height + ABOVE


def pedal_bin(b: PedalBin) -> Works:
    """Shell, lid, bucket and, where there is one, the pedal."""
    works = Works(base=tuple(_moved(b, body) for body in _shell(b))) + _lid(b)
    if b.step is not None:
        works += _pedal(b, b.step)
    return works + _bucket(b)


def _moved(b: PedalBin, body: Body) -> Body:
    return Body(
        solid=body.solid.at(b.at),
        surface=body.surface,
        density=body.density,
        edge=body.edge,
        collision=tuple(piece.at(b.at) for piece in body.collision),
        grain=body.grain,
    )


def _part(b: PedalBin, word: str, label: str, bodies: list[Body], grips: list[Grip]) -> DraftPart:
    return DraftPart(
        name=f"{b.name}{word}",
        label=label,
        bodies=tuple(_moved(b, body) for body in bodies),
        grips=tuple(grips),
    )


def _shell(b: PedalBin) -> list[Body]:
    """Foot with the pedal's slot, sheet, rim, and the housing of the hinge behind."""
    plan, (y, z) = b.plan, b.axis
    front = -b.depth
    foot = plan.stack([(0.0, 0.0), (-0.003, 0.004), (-0.003, FOOT - 0.004), (-0.0005, FOOT)])
    touch = [plan.inner_box(0.0, 0.0, FOOT)]
    if b.step is not None:
        half = b.step / 2.0 + 0.004
        slot = slab((-half, front - 0.01, 0.006), (half, front + INSIDE + 0.014, FOOT - 0.003))
        foot -= slot
        touch = _beside_slot(touch[0], half, front + INSIDE + 0.014)
    ring = plan.ring(0.0, SHEET, FOOT - 0.004, b.height)
    walls = plan.wall_contact(0.0, SHEET + 0.001, FOOT, b.height, pieces=12)
    rim = plan.ring(SHEET, SHEET + 0.004, b.height - 0.016, b.height)
    housing = chamfered_box(
        (0.060, 0.027, 0.078), 0.003, at=(0.0, b.depth + 0.0125, b.height - 0.079)
    )
    box = slab((-0.03, b.depth, b.height - 0.079), (0.03, b.depth + 0.026, b.height - 0.001))
    ears = [
        slab((x, b.depth + 0.003, b.height - 0.02), (x + 0.008, b.depth + 0.026, z + 0.006))
        for x in (-0.026, 0.018)
    ]
    return [
        b.plastic.piece(foot, contact=tuple(touch)),
        b.shell.piece(ring, contact=walls, grain="z"),
        b.plastic.piece(rim),
        b.plastic.piece(union([housing, *ears]) - plan.plate(0.0, 0.0, b.height), contact=(box,)),
        *(b.plastic.piece(_pin(x, y, z)) for x in (-0.027, 0.026)),
    ]


def _pin(x: float, y: float, z: float) -> Solid:
    return cylinder(0.0035, 0.001, axis="x", segments=12).at(x, y, z)


def _beside_slot(box: Solid, half: float, rear: float) -> list[Solid]:
    low, high = box.bounds
    return [
        slab((low[0], low[1], low[2]), (-half, rear, high[2])),
        slab((half, low[1], low[2]), (high[0], rear, high[2])),
        slab((low[0], rear, low[2]), high),
    ]


def _lid(b: PedalBin) -> Works:
    """A shallow dome, hollow below, with an arm to the hinge behind."""
    low, (y, z) = b.height + SEAM, b.axis
    near = min(b.plan.half)
    rise = b.dome - 0.009
    levels = [(0.0006, low), (0.0, low + 0.003), (0.0, low + 0.009)]
    levels += [
        (share * 0.42 * near + 0.002, low + 0.009 + rise * (1.0 - (1.0 - share) ** 2))
        for share in (0.08, 0.25, 0.5, 0.8)
    ]
    outer = b.plan.stack(levels)
    room = b.plan.stack(
        [(0.005, low - 0.01), (0.005, low + 0.004), (0.20 * near, low + 0.005 + 0.5 * rise)]
    )
    liner = b.plan.stack(
        [(0.0051, low + 0.0022), (0.0051, low + 0.004),
         (0.1999 * near, low + 0.005 + 0.5 * rise)]
    ) & b.plan.plate(0.0051, low + 0.0022, low + 0.0052)  # fmt: skip
    seal = b.plan.ring(0.006, 0.011, low + 0.0003, low + 0.0024)
    arm = slab((-0.0165, b.depth - 0.010, low + 0.0012), (0.0165, y, low + 0.0085))
    knuckle = cylinder(0.0055, 0.033, axis="x", segments=16).at(-0.0165, y, z)
    plate = b.plan.inner_box(0.0, low, low + 0.009)
    joint = Joint(
        name=f"{b.name}lid_hinge",
        type="revolute",
        parent="base",
        child=f"{b.name}lid",
        axis=(-1.0, 0.0, 0.0),  # +q lifts the front edge.
        origin=(b.at, y, z),
        limit=Limit(lower=0.0, upper=b.opens),
        friction=b.friction,
        damping=0.08,
        effort=15.0,
        mimic=None
        if b.step is None
        else Mimic(joint=f"{b.name}pedal_press", multiplier=b.opens / b.press),
    )
    grip = Grip(
        name=f"{b.name}lid_edge",
        kind="edge",
        position=(b.at, -b.depth, low + 0.005),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
    bodies = [
        b.lid.piece(outer - room, contact=(plate,), grain="x"),
        b.plastic.piece(liner),
        b.plastic.piece(seal),
        b.plastic.piece(arm | knuckle),
    ]
    return Works(parts=(_part(b, "lid", "lid", bodies, [grip]),), joints=(joint,))


def _pedal(b: PedalBin, wide: float) -> Works:
    """A plate before the foot on an arm that turns inside it; pressed, it lifts the lid."""
    front, (low, high) = -b.depth, PEDAL
    middle = (low + high) / 2.0
    tread = chamfered_box((wide, 0.046, high - low), 0.002, at=(0.0, front - 0.029, low))
    arm = slab(
        (-0.4 * wide, front - 0.010, low + 0.0005), (0.4 * wide, front + INSIDE, high - 0.0005)
    )
    pivot = cylinder(0.0045, 0.9 * wide, axis="x", segments=12).at(
        -0.45 * wide, front + INSIDE, middle
    )
    ridges = [
        slab(
            (-0.42 * wide, front - y, high - 0.0002), (0.42 * wide, front - y + 0.003, high + 0.001)
        )
        for y in (0.046, 0.038, 0.030, 0.022)
    ]
    reach = slab((-wide / 2, front - 0.052, low), (wide / 2, front - 0.006, high))
    joint = Joint(
        name=f"{b.name}pedal_press",
        type="revolute",
        parent="base",
        child=f"{b.name}pedal",
        axis=(1.0, 0.0, 0.0),  # +q presses the tread, which lies at -y, down.
        origin=(b.at, front + INSIDE, middle),
        limit=Limit(lower=0.0, upper=b.press),
        friction=1.2 * b.friction,
        damping=1.6,
        effort=60.0,
        velocity=0.25,
    )
    grip = Grip(
        name=f"{b.name}pedal_tread",
        kind="button",
        position=(b.at, front - 0.032, high),
        outward=(0.0, 0.0, 1.0),
        pull=(0.0, 0.0, -1.0),
    )
    bodies = [
        b.plastic.piece(arm | pivot, contact=(arm,)),
        b.lid.piece(tread, contact=(reach,), grain="x"),
        *(b.plastic.piece(ridge) for ridge in ridges),
    ]
    return Works(parts=(_part(b, "pedal", "pedal", bodies, [grip]),), joints=(joint,))


def _bucket(b: PedalBin) -> Works:
    """A bucket that is lifted out once the lid stands open; a bag over its rim by choice."""
    low, high, wall = FOOT + 0.0012, b.height - 0.009, 0.0022
    plan = b.plan
    taper = 0.0045
    outside = plan.stack([(BUCKET + taper, low), (BUCKET, high - 0.02), (BUCKET, high - 0.004)])
    room = plan.stack(
        [(BUCKET + taper + wall, low + 0.003), (BUCKET + wall, high - 0.02),
         (BUCKET + wall, high + 0.01)]
    )  # fmt: skip
    flange = plan.ring(BUCKET - 0.003, BUCKET + wall, high - 0.005, high)
    floor = plan.inner_box(BUCKET + taper, low, low + 0.003)
    walls = plan.wall_contact(BUCKET + 0.0008, wall + 0.0006, low, high, pieces=8)
    ledge = plan.ring(BUCKET - 0.001, BUCKET + wall + 0.011, high - 0.004, high - 0.001)
    ledge &= slab((0.3 * plan.half[0], 0.0, 0.0), (0.3 * plan.half[0] + 0.03, b.depth, 2.0))
    tub = union([outside - room, flange, ledge])  # Bags are tucked in behind the ledge.
    bodies = [b.bucket.piece(tub, contact=(floor, *walls), grain="z")]
    if b.bag:
        drop = min(0.07, 0.25 * (high - low))
        skirt = plan.ring(BUCKET - 0.0042, BUCKET - 0.0032, high - drop, high + 0.0012)
        top = plan.ring(BUCKET - 0.0042, BUCKET + wall + 0.001, high, high + 0.0012)
        inner = plan.ring(BUCKET + wall, BUCKET + wall + 0.001, high - 2.0 * drop, high + 0.0012)
        bodies.append(b.liner.piece(union([skirt, top, inner])))
    trigger = f"{b.name}lid_hinge" if b.step is None else f"{b.name}pedal_press"
    needed = 0.99 * (b.opens if b.step is None else b.press)
    grips = [
        Grip(
            name=f"{b.name}bucket_rim_{side}",
            kind="rim",
            position=(b.at + sign * (plan.half[0] - BUCKET), 0.0, high),
            outward=(0.0, 0.0, 1.0),
            pull=(0.0, 0.0, 1.0),
        )
        for side, sign in (("left", -1.0), ("right", 1.0))
    ]
    joint = Joint(
        name=f"{b.name}bucket_lift",
        type="prismatic",
        parent="base",
        child=f"{b.name}bucket",
        axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=round(min(0.20, 0.7 * (high - low)), 3)),
        friction=2.0,
        damping=6.0,
        effort=120.0,
        velocity=1.0,
    )
    return Works(
        parts=(_part(b, "bucket", "bin", bodies, grips),),
        joints=(joint,),
        preconditions=(Precondition(joint=joint.name, requires=trigger, at_least=needed),),
    )
