"""Fall flaps: a front that drops to a writing surface on slide stays, hinged at its lower edge."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit, Mimic
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.handle import Handle
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, cylinder, prism, slab, union

KNUCKLE, PLAY, BUTT = 0.0035, 0.001, 0.066
"""Radius of hinge knuckles, clearance around them, length of a hinge along x, m."""
BAR, STUD = 0.006, 0.0025
"""Half height of a stay's bar, radius of its studs, m."""
STEP = 0.008
"""How far a stay's stud on the flap stands behind the flap, m."""
ROOM = 0.014
"""What stays take at each side of the opening, m."""
LEAN = math.radians(25.0)
"""Angle between the two studs of a stay as seen from the hinge, flap closed."""


@dataclass(frozen=True, kw_only=True)
class FallFlap:
    """A flap set into an opening whose floor is the surface that it continues when open.

    Attributes:
        front: y of the flap's face.
        arm: from the hinge to the studs of the stays, m.
        friction: N m.
        grip: knob or handle on the flap.
    """

    opening: Rect
    front: float
    thickness: float
    gap: float
    arm: float
    friction: float
    grip: Handle
    wood: Stock
    leather: Stock | None
    metal: Stock

    @property
    def hinge(self) -> tuple[float, float]:
        """(y, z) of the axis: where the flap's rear meets the floor of the opening."""
        return self.front + self.thickness, self.opening.z0

    @property
    def reach(self) -> float:
        """How far a stay reaches into the case behind the flap, m."""
        return STEP + _chord(self.arm, math.pi / 2.0) + 0.022


def flap_floor(flap: FallFlap, place: Rect, rear: float, stock: Stock) -> Body:
    """The board whose upper side the flap continues, notched for the hinges' knuckles."""
    y = flap.hinge[0]
    plain = slab((place.x0, y + PLAY, place.z0), (place.x1, rear, place.z1))
    return stock.piece(plain - _knuckle_rooms(flap), contact=(plain,), grain="x")


def fall_flap(flap: FallFlap, name: str) -> Works:
    """The flap with its joint, and both stays, which follow it at half its angle."""
    o, (y, z) = flap.opening, flap.hinge
    place = Rect(x0=o.x0 + flap.gap, x1=o.x1 - flap.gap, z0=z + PLAY, z1=o.z1 - flap.gap)
    whole = slab((place.x0, flap.front, place.z0), (place.x1, y, place.z1))
    middle, high = place.middle[0], place.z1 - 0.05
    plate = cylinder(0.011, 0.0016, axis="y", segments=20).at(middle, flap.front - 0.0016, high)
    key = slab((middle - 0.0016, -5.0, high - 0.006), (middle + 0.0016, 5.0, high + 0.004))
    hold = (middle, flap.front - flap.grip.standoff, place.z1 - 0.11)
    bodies = [
        flap.wood.piece(whole - _knuckle_rooms(flap), contact=(whole,), grain="x"),
        *_inlay(flap, place),
        flap.metal.piece(plate - key),
        flap.grip.at(middle, flap.front, hold[2], "x", flap.metal),
        *(flap.metal.piece(solid) for solid in _hinge_leaves(flap, moving=True)),
        *(flap.metal.piece(_bracket(flap, sign)) for sign in (1.0, -1.0)),
    ]
    hinge = f"{name}_hinge"
    grip = Grip(
        name=f"{name}_handle",
        kind="handle",
        position=hold,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )
    joint = Joint(
        name=hinge,
        type="revolute",
        parent="base",
        child=name,
        axis=(1.0, 0.0, 0.0),  # +q brings the upper edge to the front, which is -y.
        origin=(0.0, y, z),
        limit=Limit(lower=0.0, upper=math.pi / 2.0),
        friction=flap.friction,
        damping=0.8 * flap.friction,
        effort=40.0,
        latch=Latch(force=1.5, reach=0.06),
    )
    works = Works(
        parts=(DraftPart(name=name, label="door", bodies=tuple(bodies), grips=(grip,)),),
        joints=(joint,),
        base=(
            *(flap.metal.piece(solid) for solid in _hinge_leaves(flap, moving=False)),
            *(flap.metal.piece(_case_stud(flap, sign)) for sign in (1.0, -1.0)),
            *_stops(flap, place),
        ),
    )
    for side, sign in (("left", 1.0), ("right", -1.0)):
        works += _stay(flap, name, hinge, side=side, sign=sign)
    return works


def _inlay(flap: FallFlap, place: Rect) -> list[Body]:
    """Leather let into the writing side."""
    if flap.leather is None:
        return []
    y = flap.hinge[0]
    low, high = place.z0 + 0.05, place.z1 - 0.05
    field = slab((place.x0 + 0.06, y - 0.0012, low), (place.x1 - 0.06, y, high))
    return [flap.leather.piece(field)]


def _stops(flap: FallFlap, place: Rect) -> list[Body]:
    """Two ball catches under the board above; the flap closes against them."""
    o, y = flap.opening, flap.hinge[0] + 0.0012
    middle = place.middle[0]
    return [
        flap.metal.board((x - 0.02, y, o.z1 - 0.012), (x + 0.02, y + 0.014, o.z1))
        for x in (middle - 0.2 * o.width, middle + 0.2 * o.width)
    ]


def _hinge_middles(flap: FallFlap) -> tuple[float, ...]:
    o = flap.opening
    return (o.x0 + 0.11, o.middle[0], o.x1 - 0.11) if o.width > 0.7 else (o.x0 + 0.1, o.x1 - 0.1)


def _knuckle_rooms(flap: FallFlap) -> Solid:
    """What knuckles and their play take from the wood."""
    y, z = flap.hinge
    length = BUTT + 2.0 * PLAY
    room = cylinder(KNUCKLE + PLAY, length, axis="x", segments=12)
    return union(room.at(x - length / 2.0, y, z) for x in _hinge_middles(flap))


def _hinge_leaves(flap: FallFlap, *, moving: bool) -> list[Solid]:
    """Leaves with their knuckles: the flap has the middle knuckle of each hinge."""
    y, z = flap.hinge
    third, sheet, long = BUTT / 3.0, 0.0016, 0.026
    solids = []
    for middle in _hinge_middles(flap):
        for k in (1,) if moving else (0, 2):
            x0 = middle - BUTT / 2.0 + k * third + PLAY / 2.0
            x1 = x0 + third - PLAY
            knuckle = cylinder(KNUCKLE, x1 - x0, axis="x", segments=12).at(x0, y, z)
            leaf = (
                slab((x0, y - sheet, z), (x1, y, z + long))
                if moving
                else slab((x0, y, z - sheet), (x1, y + long, z))
            )
            solids.append(knuckle | leaf)
    return solids


def _chord(arm: float, angle: float) -> float:
    """Distance of a stay's studs, m, with the flap open by `angle`."""
    return 2.0 * arm * math.sin((LEAN + angle) / 2.0)


def _studs(flap: FallFlap) -> tuple[tuple[float, float], tuple[float, float]]:
    """(y, z) of the studs on flap and case, flap closed; both lie `arm` from the hinge."""
    y, z = flap.hinge
    rise = math.asin(STEP / flap.arm)
    return (
        (y + STEP, z + flap.arm * math.cos(rise)),
        (y + flap.arm * math.sin(rise + LEAN), z + flap.arm * math.cos(rise + LEAN)),
    )


def _across(flap: FallFlap, sign: float, low: float, high: float) -> tuple[float, float]:
    """x from an offset from the left side (sign +1), or from the right one."""
    o = flap.opening
    return (o.x0 + low, o.x0 + high) if sign > 0.0 else (o.x1 - high, o.x1 - low)


def _stud(flap: FallFlap, sign: float, span: tuple[float, float], at: tuple[float, float]) -> Solid:
    x0, x1 = _across(flap, sign, *span)
    return cylinder(STUD, x1 - x0, axis="x", segments=12).at(x0, *at)


def _bracket(flap: FallFlap, sign: float) -> Solid:
    """On the flap's rear, with the stud that carries the stay."""
    (qy, qz), y = _studs(flap)[0], flap.hinge[0]
    x0, x1 = _across(flap, sign, 0.0085, 0.0115)
    plate = slab((x0, y - 0.001, qz - 0.007), (x1, qy + 0.005, qz + 0.007))
    return plate | _stud(flap, sign, (0.0025, 0.0085), (qy, qz))


def _case_stud(flap: FallFlap, sign: float) -> Solid:
    """On the side of the case, with a head before the bar."""
    at = _studs(flap)[1]
    x0, x1 = _across(flap, sign, 0.0085, 0.0105)
    head = cylinder(0.006, x1 - x0, axis="x", segments=14).at(x0, *at)
    return head | _stud(flap, sign, (0.0, 0.0086), at)


def _stay(flap: FallFlap, name: str, hinge: str, *, side: str, sign: float) -> Works:
    """A slotted bar that turns on the flap's stud while the case's stud runs in its slot.

    Both studs lie equally far from the hinge, so the bar turns by half of the flap's angle.
    """
    (qy, qz), (py, pz) = _studs(flap)
    x0, x1 = _across(flap, sign, 0.004, 0.007)
    bar = _bar(_chord(flap.arm, 0.0), _chord(flap.arm, math.pi / 2.0), x1 - x0)
    down = math.atan2(qz - pz, py - qy)
    placed = [piece.turned("x", -down).at(x0, qy, qz) for piece in bar]
    stay = f"{name}_stay_{side}"
    joint = Joint(
        name=f"{stay}_pivot",
        type="revolute",
        parent=name,
        child=stay,
        axis=(-1.0, 0.0, 0.0),
        origin=(0.0, qy, qz),
        limit=Limit(lower=0.0, upper=math.pi / 4.0),
        friction=0.02,
        damping=0.01,
        effort=5.0,
        mimic=Mimic(joint=hinge, multiplier=0.5),
    )
    body = flap.metal.piece(placed[0], contact=tuple(placed[1:]), grain="y")
    return Works(parts=(DraftPart(name=stay, label="arm", bodies=(body,)),), joints=(joint,))


def _bar(near: float, far: float, thick: float) -> tuple[Solid, ...]:
    """The bar along +y from its stud at zero, then its contact boxes: an eye and two flanks."""
    end = far + 0.012
    outline = np.concatenate(
        [
            arc((0.0, 0.0), BAR, math.pi / 2.0, 1.5 * math.pi, 6),
            arc((end, 0.0), BAR, -math.pi / 2.0, math.pi / 2.0, 6),
        ]
    )
    half = STUD + PLAY
    slot = np.concatenate(
        [
            arc((near - 0.002, 0.0), half, math.pi / 2.0, 1.5 * math.pi, 6),
            arc((far + 0.002, 0.0), half, -math.pi / 2.0, math.pi / 2.0, 6),
        ]
    )
    eye = arc((0.0, 0.0), half, 0.0, 2.0 * math.pi, 12)[:-1]
    plan = prism(outline, thick, holes=[slot, eye]).transformed(_UPRIGHT)
    flanks = [slab((0.0, near, z), (thick, far, z + BAR - half)) for z in (half, -BAR)]
    return (plan, *flanks)


_UPRIGHT = np.array(
    [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""x, y of a drawing become y, z; its height x."""
