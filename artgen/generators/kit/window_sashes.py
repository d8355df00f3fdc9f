"""Sashes that turn, tilt or slide in a window's frame, with their handles, hinges and locks."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from artgen.articulation.types import (
    Body,
    DraftPart,
    Grip,
    Joint,
    Limit,
    Precondition,
    Spring,
    Vector,
)
from artgen.core.conventions import GRAVITY
from artgen.generators.kit.board import Stock
from artgen.generators.kit.counterbalance import counterbalance, weighed
from artgen.generators.kit.door_leaf import pierced
from artgen.generators.kit.flush_pull import FlushPull
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.glazed_sash import SashMaker
from artgen.generators.kit.mirror_image import mirrored_body, mirrored_joint, mirrored_part
from artgen.generators.kit.window_frame import AIR, OVERLAP
from artgen.generators.kit.window_handle import CamLock, Style, WindowHandle, finger_lift
from artgen.geometry.solid import Solid, cylinder, slab

FREE = 0.9
"""Share of a handle's turn from which its sash is free."""
BEFORE = 0.002
"""m; between the frame's face and a sash's overlap."""
KNUCKLE, OUT = 0.0065, 0.008
"""Radius of a sash's hinge, and from its pin to the sash's edge, m."""
SIDE, BETWEEN = 0.0025, 0.007
"""Around sliding sashes, and between the planes they slide in, m."""
PLANE = 0.0135
"""y of the face of the nearer sliding sash, m."""


@dataclass(frozen=True, kw_only=True)
class Sashes:
    """What moving sashes bring along; `base` goes to the frame."""

    parts: tuple[DraftPart, ...]
    joints: tuple[Joint, ...]
    rules: tuple[Precondition, ...] = ()
    base: tuple[Body, ...] = ()

    def __add__(self, other: "Sashes") -> "Sashes":
        return Sashes(
            parts=self.parts + other.parts,
            joints=self.joints + other.joints,
            rules=self.rules + other.rules,
            base=self.base + other.base,
        )

    def mirrored(self) -> "Sashes":
        """Left and right exchanged."""
        return replace(
            self,
            parts=tuple(mirrored_part(part) for part in self.parts),
            joints=tuple(mirrored_joint(joint) for joint in self.joints),
            base=tuple(mirrored_body(body) for body in self.base),
        )


@dataclass(frozen=True, kw_only=True)
class Fittings:
    """Handles and how hard things move.

    Attributes:
        style: of the handle.
        length: of its grip, m.
        share: height of the handle, of the sash's height.
        metal: what it is made of.
        turning: friction of handles, N m.
        swinging: friction of turning sashes, N m.
        sliding: friction of sliding ones, N.
    """

    style: Style
    length: float
    share: float
    metal: Stock
    turning: float
    swinging: float
    sliding: float


def swinging_sash(
    maker: SashMaker,
    fit: Fittings,
    light: Rect,
    *,
    name: str,
    lip: float,
    depth: float,
    opening: float,
    tilts: bool = False,
    handle: bool = True,
    extras: Sequence[Body] = (),
) -> Sashes:
    """A sash that overlaps the frame around `light`, hung at its left or, if it tilts, below."""
    rect, y0 = light.shrunk(-OVERLAP), -BEFORE - lip
    y = y0 + lip / 2.0
    bodies = maker.rebated(rect, y0, y0 + depth, lip=lip, reach=OVERLAP + AIR)
    along = (rect.x0, rect.x1) if tilts else (rect.z0, rect.z1)
    pins, base = [], []
    for place in (along[0] + 0.09, along[1] - 0.09):
        turning, fixed = _hinge(y)
        where = (place, y, rect.z0 - OUT) if tilts else (rect.x0 - OUT, y, place)
        pins.append(fit.metal.piece(_laid(turning, tilts).at(*where)))
        base.append(fit.metal.piece(_laid(fixed, tilts).at(*where)))
    axis: Vector = (1.0, 0.0, 0.0) if tilts else (0.0, 0.0, -1.0)
    origin = (0.0, y, rect.z0 - OUT) if tilts else (rect.x0 - OUT, y, 0.0)
    parts = (*bodies, *pins, *extras)
    friction, spring = fit.swinging, None
    if tilts:  # Sprung stays hold it at every angle, its handle too.
        spring, left = counterbalance(parts, pivot=origin, upper=opening)
        friction = max(friction, 1.5 * left + 0.9)
    swing = Joint(
        name=f"{name}_tilt" if tilts else f"{name}_swing",
        type="revolute",
        parent="base",
        child=name,
        axis=axis,
        origin=origin,
        limit=Limit(lower=0.0, upper=opening),
        friction=friction,
        damping=0.3,
        effort=60.0,
        spring=spring,
    )
    sash = DraftPart(name=name, label="sash", bodies=parts)
    alone = Sashes(parts=(sash,), joints=(swing,), base=tuple(base))
    if not handle:
        return alone
    at = (rect.x1 - maker.member / 2.0, y0, rect.z0 + fit.share * rect.height)
    return _with_handle(alone, fit, at, turn_deg=180.0 if tilts else 90.0)


def _with_handle(alone: Sashes, fit: Fittings, at: Vector, *, turn_deg: float) -> Sashes:
    """The first sash gets a handle that must be turned before it moves."""
    sash, move = alone.parts[0], alone.joints[0]
    handle = WindowHandle(
        style=fit.style, at=at, length=fit.length, towards=-1.0, turn_deg=turn_deg
    )
    name = f"{sash.name}_handle"
    turn = handle.joint(f"{name}_turn", parent=sash.name, child=name, friction=fit.turning)
    sash = replace(sash, bodies=(*sash.bodies, handle.plate(fit.metal)))
    rule = Precondition(joint=move.name, requires=turn.name, at_least=FREE * math.radians(turn_deg))
    return replace(
        alone,
        parts=(sash, *alone.parts[1:], handle.part(name, fit.metal)),
        joints=(move, *alone.joints[1:], turn),
        rules=(*alone.rules, rule),
    )


def _hinge(y: float) -> tuple[Solid, Solid]:
    """Halves of a hinge with its pin at zero along z: the sash's, to +x; the frame's, to y = 0."""
    half, play = 0.030, 0.0008
    upper = cylinder(KNUCKLE, half - play, segments=14).at(0.0, 0.0, play)
    lower = cylinder(KNUCKLE, half, segments=14).at(0.0, 0.0, -half)
    arm = slab((0.0, -0.004, play), (OUT + 0.003, 0.004, half - 0.002))
    foot = slab((-0.005, 0.0, -half + 0.002), (0.005, -y, -0.001))
    return upper | arm, lower | foot


def _laid(solid: Solid, tilts: bool) -> Solid:
    """The pin along z laid along x; what lay to +x then stands up."""
    return solid.turned("y", -math.pi / 2.0) if tilts else solid


def pair_of_sashes(
    maker: SashMaker,
    fit: Fittings,
    light: Rect,
    *,
    lip: float,
    depth: float,
    opening: float,
    mullion: float | None,
) -> Sashes:
    """Two sashes side by side: each with a handle beside a mullion, or one that waits."""
    if mullion is not None:
        left = replace(light, x1=-mullion / 2.0)
        first = swinging_sash(
            maker, fit, left, name="sash_left", lip=lip, depth=depth, opening=opening
        )
        other = swinging_sash(
            maker, fit, left, name="sash_right", lip=lip, depth=depth, opening=opening
        )
        return first + other.mirrored()
    left = replace(light, x1=-OVERLAP - 0.0025)
    rect, y0 = left.shrunk(-OVERLAP), -BEFORE - lip
    stock = maker.stock
    cover = (
        stock.board((rect.x1 - 0.014, y0 - 0.008, rect.z0), (rect.x1, y0, rect.z1)),
        stock.board((rect.x1, y0 - 0.008, rect.z0), (rect.x1 + 0.018, y0 - 0.0015, rect.z1)),
    )
    inner = rect.shrunk(OVERLAP + AIR)
    post = stock.board(  # Drawn at the left sash's edge; the waiting one is mirrored.
        (inner.x1, 0.0, inner.z0), (-inner.x1 - 0.012, y0 + depth, inner.z1)
    )
    first = swinging_sash(
        maker, fit, left, name="sash_left", lip=lip, depth=depth, opening=opening, extras=cover
    )
    other = swinging_sash(
        maker, fit, left, name="sash_right", lip=lip, depth=depth, opening=opening,
        handle=False, extras=(post,),
    )  # fmt: skip
    edge = Grip(
        name="sash_right_edge",
        kind="edge",
        position=(rect.x1, y0 + lip / 2.0, rect.middle[1]),
        outward=(1.0, 0.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )
    other = replace(other, parts=(replace(other.parts[0], grips=(edge,)), *other.parts[1:]))
    wait = Precondition(joint="sash_right_swing", requires="sash_left_swing", at_least=0.5)
    both = first + other.mirrored()
    return replace(both, rules=(*both.rules, wait))


def planes(depth: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """y of front and rear of the nearer and of the farther sliding sash."""
    far = PLANE + depth + BETWEEN
    return (PLANE, PLANE + depth), (far, far + depth)


def hung_sashes(
    maker: SashMaker, fit: Fittings, opening: Rect, *, depth: float, travel: float
) -> Sashes:
    """A lower sash that is pushed up and an upper one that comes down, locked to each other."""
    (near, inner), (outer, far) = planes(depth)
    o, half = opening.shrunk(SIDE), maker.member / 2.0
    middle = opening.middle[1]
    low, high = replace(o, z1=middle + half), replace(o, z0=middle - half)
    way = travel * (opening.z1 - low.z1 - 0.040)
    lock = CamLock(
        at=(0.0, (near + inner) / 2.0, low.z1), reach=outer + 0.0025 - (near + inner) / 2.0
    )
    lifts, grips = _lifts(o, near, o.z0 + half, fit.metal)
    lower = DraftPart(
        name="sash_lower",
        label="sash",
        bodies=(*maker.sash(low, near, inner), lock.base(fit.metal), *lifts),
        grips=grips,
    )
    keeper = lock.keeper(fit.metal, front=outer, rear=outer + 0.008)
    rail = Grip(
        name="sash_upper_rail",
        kind="edge",
        position=(0.3 * o.width, outer, high.z1 - half),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, -1.0),
    )
    upper = DraftPart(
        name="sash_upper",
        label="sash",
        bodies=(*maker.sash(high, outer, far), keeper),
        grips=(rail,),
    )
    joints = (
        _slide(lower, (0.0, 0.0, 1.0), way, fit.sliding),
        _slide(upper, (0.0, 0.0, -1.0), way, fit.sliding),
        lock.joint("sash_lock_turn", parent="sash_lower", child="sash_lock"),
    )
    need = FREE * math.radians(135.0)
    rules = tuple(
        Precondition(joint=joint.name, requires="sash_lock_turn", at_least=need)
        for joint in joints[:2]
    )
    return Sashes(
        parts=(lower, upper, lock.part("sash_lock", fit.metal)), joints=joints, rules=rules
    )


def _lifts(
    opening: Rect, face: float, z: float, metal: Stock
) -> tuple[list[Body], tuple[Grip, ...]]:
    """Two finger lifts on the lower rail, and where hands take them."""
    places = ((-0.28 * opening.width, "left"), (0.28 * opening.width, "right"))
    grips = tuple(
        Grip(
            name=f"lift_{side}",
            kind="handle",
            position=(x, face - 0.012, z),
            outward=(0.0, -1.0, 0.0),
            pull=(0.0, 0.0, 1.0),
        )
        for x, side in places
    )
    return [finger_lift(x, face, z, metal=metal) for x, _ in places], grips


def sliding_sashes(
    maker: SashMaker,
    fit: Fittings,
    opening: Rect,
    *,
    depth: float,
    travel: float,
    rear_slides: bool,
) -> Sashes:
    """The nearer sash at the right slides to the left; the other to the right, or is fixed."""
    (near, inner), (outer, far) = planes(depth)
    o, half = opening.shrunk(SIDE), maker.member / 2.0
    right, left = replace(o, x0=-half), replace(o, x1=half)
    way = travel * (right.x0 - o.x0)
    sash = DraftPart(name="sash_right", label="sash", bodies=maker.sash(right, near, inner))
    alone = Sashes(parts=(sash,), joints=(_slide(sash, (-1.0, 0.0, 0.0), way, fit.sliding),))
    at = (right.x1 - half, near, right.z0 + fit.share * right.height)
    made = _with_handle(alone, fit, at, turn_deg=90.0)
    panes = maker.sash(left, outer, far)
    if not rear_slides:
        return replace(made, base=panes)
    z = left.z0 + fit.share * left.height
    size = (min(0.032, 0.6 * maker.member), 0.12)
    pull = FlushPull(at=(left.x0 + half, z), face=outer, out=-1.0, size=size, pull=1.0)
    other = DraftPart(
        name="sash_left",
        label="sash",
        bodies=(*pierced(panes, pull.recess()), pull.body(fit.metal)),
        grips=(pull.grip("sash_left_pull"),),
    )
    return made + Sashes(parts=(other,), joints=(_slide(other, (1.0, 0.0, 0.0), way, fit.sliding),))


BALANCE = 4.0
"""N/m; stiffness of a sash balance, so soft that it carries about the weight all the way."""


def _slide(sash: DraftPart, axis: Vector, travel: float, friction: float) -> Joint:
    """Along the face; one that rises or falls is carried by balances."""
    weight = GRAVITY * weighed(sash.bodies)[0]
    spring = Spring(stiffness=BALANCE, reference=axis[2] * weight / BALANCE) if axis[2] else None
    return Joint(
        name=f"{sash.name}_slide",
        type="prismatic",
        parent="base",
        child=sash.name,
        axis=axis,
        limit=Limit(lower=0.0, upper=travel),
        friction=friction,
        damping=8.0,
        effort=150.0,
        velocity=1.0,
        spring=spring,
    )
