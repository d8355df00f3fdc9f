"""What is screwed to the shells of a suitcase: hinge, zip lock, latches, wheel wells."""

import math

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit, Precondition
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.caster import STEM, Caster, CasterLook, quarter_placed
from artgen.generators.kit.clamshell import HalfShell, outside
from artgen.geometry.solid import Solid, chamfered_box, cylinder, slab, union

AXIS = 0.008
"""How far the hinge's axis lies outside the left side, m."""
BARREL = 0.0035
"""Radius of the hinge, m."""
WELL, SEAT = 0.013, 0.0012
"""Height of the blocks that carry the casters; air over a caster's shoulder, m."""
FROM_SIDE, FROM_FACE = 0.055, 0.045
"""Where casters stand: from the sides and from the faces, m."""
LEVER = 0.005
"""Thickness of a latch's lever, m."""


def hinge(h: HalfShell, stock: Stock) -> Body:
    """A long barrel with a fin to the rear half; what the front half turns about."""
    x, z0, z1 = -h.width / 2.0, h.low + h.corner + 0.01, h.high - h.corner - 0.01
    barrel = cylinder(BARREL, z1 - z0, segments=12).at(x - AXIS, 0.0, z0)
    fin = slab((x - AXIS - 0.0015, 0.0, z0), (x - AXIS + 0.0015, 0.018, z1))
    pad = slab((x - AXIS - 0.0015, 0.014, z0), (x + 0.001, 0.018, z1))
    return stock.piece(union([barrel, fin, pad]), contact=(pad,), grain="z")


def lid_joint(h: HalfShell, *, angle: float, friction: float) -> Joint:
    """The front half turns about the left side and its free side comes to the front."""
    return Joint(
        name="lid_hinge",
        type="revolute",
        parent="base",
        child="lid",
        axis=(0.0, 0.0, -1.0),
        origin=(-h.width / 2.0 - AXIS, 0.0, 0.0),
        limit=Limit(lower=0.0, upper=angle),
        friction=friction,
        damping=0.15,
        effort=15.0,
    )


def zip_lock(h: HalfShell, plastic: Stock, metal: Stock) -> Works:
    """A lock on the rear half, and a slider that must run down the zip before the lid opens."""
    x, z = h.width / 2.0, h.low + 0.66 * h.height
    case = chamfered_box((0.012, 0.020, 0.062), 0.0016, at=(x + 0.006, 0.0155, z - 0.031))
    dials = [
        cylinder(0.0065, 0.0035, segments=14).at(x + 0.0072, 0.0155, z - 0.002 - 0.0065 * k)
        for k in range(3)
    ]
    keyhole = cylinder(0.0042, 0.0006, axis="x", segments=16).at(x + 0.012, 0.0155, z + 0.017)
    low, high = h.low + h.corner + 0.020, z - 0.062
    slider = chamfered_box((0.0062, 0.013, 0.022), 0.0016, at=(x + 0.0056, 0.0, high))
    neck = slab((x + 0.0085, -0.0014, high + 0.001), (x + 0.0108, 0.0014, high + 0.017))
    tab = slab((x + 0.0092, -0.0045, high - 0.026), (x + 0.0112, 0.0045, high + 0.006))
    part = DraftPart(
        name="zip_slider",
        label="latch",
        bodies=(
            metal.piece(union([slider, neck]), contact=(slab(*slider.bounds.tolist()),)),
            metal.piece(tab, contact=(tab,)),
        ),
        grips=(
            Grip(
                name="zip_pull",
                kind="handle",
                position=(x + 0.0102, 0.0, high - 0.016),
                outward=(1.0, 0.0, 0.0),
                pull=(0.0, 0.0, -1.0),
            ),
        ),
    )
    travel = round(high - 0.026 - low, 3)
    joint = Joint(
        name="zip_slide",
        type="prismatic",
        parent="base",
        child="zip_slider",
        axis=(0.0, 0.0, -1.0),
        limit=Limit(lower=0.0, upper=travel),
        friction=6.0,
        damping=4.0,
        effort=60.0,
    )
    contact = slab(*case.bounds.tolist())
    return Works(
        parts=(part,),
        joints=(joint,),
        base=(
            plastic.piece(case, contact=(contact,)),
            *(metal.piece(dial) for dial in dials),
            metal.piece(keyhole),
        ),
        preconditions=(
            Precondition(joint="lid_hinge", requires="zip_slide", at_least=0.95 * travel),
        ),
    )


def latches(h: HalfShell, metal: Stock) -> tuple[Works, tuple[Body, ...]]:
    """Two lever latches on the right; the keepers that they hold belong to the front half."""
    works, keepers = Works(), []
    for name, share in (("lower", 0.24), ("upper", 0.76)):
        z = h.low + share * h.height
        works += _latch(h, f"latch_{name}", z, metal)
        x = h.width / 2.0
        keeper = slab((x - 0.001, -0.018, z - 0.012), (x + 0.0034, -0.003, z + 0.012))
        keepers.append(metal.piece(keeper, contact=(keeper,)))
    return works, tuple(keepers)


def _latch(h: HalfShell, name: str, z: float, metal: Stock) -> Works:
    x, y, half = h.width / 2.0 + 0.007, 0.026, 0.016
    lever = chamfered_box(
        (LEVER, 0.046, 2.0 * half), 0.0012, at=(x, y - 0.025, z - half)
    ) | cylinder(0.0034, 2.0 * half - 0.002, segments=12).at(x, y, z - half + 0.001)
    reach = slab((x - LEVER / 2, y - 0.048, z - half), (x + LEVER / 2, y - 0.002, z + half))
    plate = slab(
        (h.width / 2.0 - 0.001, 0.004, z - 0.026), (h.width / 2.0 + 0.0030, 0.040, z + 0.026)
    )
    ears = [_ear(h, y, z0) for z0 in (z - half - 0.0055, z + half + 0.0015)]
    joint = Joint(
        name=f"{name}_turn",
        type="revolute",
        parent="base",
        child=name,
        axis=(0.0, 0.0, 1.0),  # +q swings the lever's end, which points to -y, out to +x.
        origin=(x, y, 0.0),
        limit=Limit(lower=0.0, upper=math.radians(115.0)),
        friction=0.08,
        damping=0.02,
        effort=3.0,
        latch=Latch(force=0.12, reach=0.3),
    )
    grip = Grip(
        name=f"{name}_lever",
        kind="lever",
        position=(x + LEVER / 2, y - 0.040, z),
        outward=(1.0, 0.0, 0.0),
        pull=(1.0, 0.0, 0.0),
    )
    return Works(
        parts=(
            DraftPart(
                name=name,
                label="latch",
                bodies=(metal.piece(lever, contact=(reach,), grain="y"),),
                grips=(grip,),
            ),
        ),
        joints=(joint,),
        base=(
            metal.piece(plate, contact=(plate,), grain="z"),
            *(metal.piece(ear) for ear in ears),
        ),
        preconditions=(
            Precondition(joint="lid_hinge", requires=joint.name, at_least=math.radians(75.0)),
        ),
    )


def _ear(h: HalfShell, y: float, z: float) -> Solid:
    """Beside a lever's barrel, on the plate."""
    x = h.width / 2.0
    disc = cylinder(0.0042, 0.004, segments=14).at(x + 0.007, y, z)
    return disc | slab((x, y - 0.0042, z), (x + 0.007, y + 0.0042, z + 0.004))


def bottom_of(caster: Caster) -> float:
    """z of the bottom of a case that rolls on such casters."""
    return caster.shoulder + SEAT + WELL


def rolling(h: HalfShell, caster: Caster, look: CasterLook, *, parent: str, rear: bool) -> Works:
    """Two casters under one half, and the wells that carry them, which belong to that half."""
    y = (h.depth - FROM_FACE) * (1.0 if rear else -1.0)
    works = Works()
    for side, sign in (("left", -1.0), ("right", 1.0)):
        name = f"{'rear' if rear else 'front'}_{side}"
        x = sign * (h.width / 2.0 - FROM_SIDE)
        place = quarter_placed((x, y, 0.0), 0 if rear else 2)
        fork, wheel = f"caster_{name}", f"wheel_{name}"
        works += Works(
            parts=(caster.swivel_part(fork, place, look), caster.wheel_part(wheel, place, look)),
            joints=caster.joints(fork, wheel, place, parent=parent),
            base=(_well(h, caster, x, y, look.hood, rear=rear),),
        )
    return works


def _well(h: HalfShell, caster: Caster, x: float, y: float, stock: Stock, *, rear: bool) -> Body:
    """A block under a corner of the shell, bored for the stem."""
    low = caster.shoulder + SEAT
    block = chamfered_box((0.076, 0.060, WELL + 0.03), 0.004, at=(x, y, low))
    shell = outside(h).mirrored("y") if rear else outside(h)
    bore = cylinder(STEM + 0.0011, caster.stem - SEAT + 0.0011, segments=14).at(x, y, low)
    touch = slab((x - 0.034, y - 0.026, low), (x + 0.034, y + 0.026, low + WELL))
    return stock.piece(block - shell - bore, contact=(touch,))
