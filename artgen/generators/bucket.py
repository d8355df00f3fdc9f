"""Buckets: a tapered vessel with ears; its bail rests on the rim and swings over its mouth."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.articulation.types import Body, Draft, DraftPart, Grip, Joint, Limit
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.bail import Bail, lying
from artgen.generators.kit.bucket_ears import PLAY, bored_ear, low_grip, tipping_strap
from artgen.generators.kit.bucket_marks import scale_mark, sticker
from artgen.generators.kit.density import POLYPROPYLENE, STEEL
from artgen.generators.kit.vessel import Ring, Vessel, spread
from artgen.geometry.solid import slab, union, wire

SHEET = 0.0007
"""m; steel sheet of a bucket, which is drawn at the thickness of a molded wall."""
POWER = {"round": 2.0, "oval": 2.2, "square": 4.5}
SEGMENTS = 44


@dataclass(frozen=True, kw_only=True)
class BucketParams:
    """What the rule draws."""

    material: str
    plan: str
    mouth: float
    aspect: float
    slenderness: float
    taper: float
    bow: float
    wall: float
    bead: float
    beads: int
    bead_low: float
    foot: float
    lip: float
    ear_drop: float
    wire: float
    slack: float
    grip: str
    grip_radius: float
    grip_length: float
    hold: str
    scale: bool
    sticker: bool
    brand: int
    drag: float


PARAMS = BucketParams


def vessel_of(p: BucketParams) -> Vessel:
    """The wall, from the foot ring to the rim."""
    deep = 1.0 if p.plan == "round" else p.aspect
    height = 2.0 * p.mouth * p.slenderness
    rings = []
    for share in (0.0, 0.25, 0.5, 0.75, 0.88, 1.0):
        width = p.mouth * (p.taper + (1.0 - p.taper) * share + p.bow * math.sin(math.pi * share))
        lip = p.lip * max(0.0, (share - 0.75) / 0.25) ** 2
        rings.append(
            Ring(
                z=p.foot + share * height, half=(width, deep * width), power=POWER[p.plan], lip=lip
            )
        )
    return Vessel(rings=tuple(rings), wall=p.wall, floor=1.3 * p.wall, segments=SEGMENTS)


def bail_of(p: BucketParams) -> Bail:
    """The hoop, so wide that it passes the rim, so long that it lies on it."""
    vessel = vessel_of(p)
    a, b = vessel.mouth.half
    sleeve = None if p.grip == "none" else p.grip_radius
    return Bail(
        span=a + 1.5 * p.bead + 2.0 * p.wire + 0.004, reach=b + 0.5 * p.bead + p.lip + p.slack,
        height=vessel.mouth.z - p.ear_drop, wire=p.wire, grip=sleeve, grip_length=p.grip_length,
    )  # fmt: skip


def rim_line(p: BucketParams) -> Floats:
    """(SEGMENTS, 3) middle of the rolled rim."""
    mouth = vessel_of(p).mouth
    return mouth.points(SEGMENTS, inset=-0.4 * p.bead)


def build(p: BucketParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the bail lies on the rim towards the front; +q lifts it up and over to the back."""
    vessel, bail = vessel_of(p), bail_of(p)
    rest, over = (bail.rest(rim_line(p), p.bead, side=side) for side in (-1.0, 1.0))
    marks = [scale_mark(vessel)] if p.scale else []
    marks += [sticker(vessel, p.brand)] if p.sticker else []
    base = DraftPart(
        name="base", label="base",
        bodies=(*body_pieces(p, vessel, bail), *(body for body, _ in marks)),
        grips=(low_grip(vessel),) if p.hold == "pull" else (),
    )  # fmt: skip
    hoop = Body(
        solid=lying(bail.hoop(hook=2.0 * p.wire + 0.003), bail, rest), surface="wire",
        density=STEEL, collision=bail.collision(rest, middle=p.grip != "roller"),
    )  # fmt: skip
    away = (0.0, -math.cos(rest), math.sin(rest))
    middle = (0.0, away[1] * bail.reach, bail.height + away[2] * bail.reach)
    reach = bail.reach + (bail.grip or bail.wire)
    outside = (0.0, away[1] * reach, bail.height + away[2] * reach)
    grip = Grip(
        name="bail_grip", kind="handle", position=outside, outward=away,
        pull=(0.0, away[2], -away[1]),
    )  # fmt: skip
    sleeve = Body(
        solid=lying(bail.sleeve(play=0.0005 if p.grip == "roller" else -0.0002), bail, rest),
        surface="sleeve", density=950.0, collision=(bail.sleeve_collision(rest),),
    )  # fmt: skip
    joints = [
        Joint(
            name="bail_hinge", type="revolute", parent="base", child="bail",
            axis=(-1.0, 0.0, 0.0),  # +q lifts the hoop from -y over the mouth to +y
            origin=(0.0, 0.0, bail.height), limit=Limit(lower=0.0, upper=math.pi - rest - over),
            friction=p.drag, damping=0.004, effort=4.0, velocity=6.0,
        )
    ]  # fmt: skip
    parts = [base]
    if p.grip == "roller":
        parts += [
            DraftPart(name="bail", label="handle", bodies=(hoop,), grips=(grip,)),
            DraftPart(name="grip", label="handle", bodies=(sleeve,)),
        ]
        joints.append(
            Joint(
                name="grip_roll", type="continuous", parent="bail", child="grip",
                axis=(1.0, 0.0, 0.0), origin=middle, limit=None, friction=0.006, damping=0.001,
                effort=0.5, velocity=8.0,
            )
        )  # fmt: skip
    else:
        worn = (hoop,) if p.grip == "none" else (hoop, sleeve)
        parts.append(DraftPart(name="bail", label="handle", bodies=worn, grips=(grip,)))
    used = {body.surface for part in parts for body in part.bodies}
    known = (*surfaces.values(), *(surface for _, surface in marks))
    return Draft(
        category="bucket", parts=tuple(parts), joints=tuple(joints),
        surfaces=tuple(surface for surface in known if surface.name in used),
    )  # fmt: skip


def body_pieces(p: BucketParams, vessel: Vessel, bail: Bail) -> tuple[Body, ...]:
    """Wall with foot ring, ribs and rim; two ears; a second grip where there is one."""
    density = POLYPROPYLENE if p.material == "plastic" else STEEL * SHEET / p.wall
    low, high = vessel.rings[0].z, vessel.mouth.z
    ring = vessel.foot_ring(p.foot, thickness=2.5 * p.wall)
    ribs = [
        vessel.band(z, 0.6 * p.bead)
        for z in spread(low + p.bead_low * (high - low), high - 0.045, p.beads)
    ]
    bead = wire(rim_line(p), p.bead, sides=10, closed=True)
    walls = union([vessel.outside(), *ribs]) - vessel.inside()
    touch = (*vessel.wall_collision(), *vessel.floor_collision())
    pieces = [Body(solid=walls | ring, surface=p.material, density=density, collision=touch)]
    rolled = "rim" if p.material == "enamel" else p.material
    hollow = density if p.material == "plastic" else 2.0 * STEEL * SHEET / p.bead
    pieces.append(Body(solid=bead - vessel.inside(), surface=rolled, density=hollow))
    ear = bored_ear(vessel, bail)
    contact = slab(
        (vessel.mouth.half[0], -0.009, bail.height - 0.009),
        (bail.span - p.wire - PLAY, 0.009, bail.height + 0.009),
    )
    fitted = p.material if p.material != "enamel" else "wire"
    for solid, box in ((ear, contact), (ear.mirrored("x"), contact.mirrored("x"))):
        pieces.append(Body(solid=solid, surface=fitted, density=900.0, collision=(box,)))
    if p.hold == "pull":
        pieces.append(Body(solid=tipping_strap(vessel), surface=p.material, density=density))
    return tuple(pieces)


def hoop_clears(p: BucketParams) -> bool:
    """The hoop comes to rest on the rim, less than 35 degrees above level, on both sides."""
    bail = bail_of(p)
    rests = [bail.rest(rim_line(p), p.bead, side=side) for side in (-1.0, 1.0)]
    return all(math.radians(-8.0) < rest < math.radians(35.0) for rest in rests)


def square_buckets_are_molded(p: BucketParams) -> bool:
    """Sheet is rolled to rounds and ovals."""
    return p.plan != "square" or p.material == "plastic"


INVARIANTS: Mapping[str, Callable[[BucketParams], bool]] = {
    check.__name__: check for check in (hoop_clears, square_buckets_are_molded)
}
