"""Wheeled refuse bins: a tapered body with a collar, two wheels, a lid about a rear axis."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, hull, loft, prism, revolve, slab, union

WALL, COLLAR, LIFT = 0.0045, 0.020, 0.028
"""Wall, how far the collar stands out, how high the body stands over the floor, m."""
BEHIND, ABOVE = 0.042, 0.012
"""The lid's axis: behind the body's rear and over its edge, m."""
CUBOIDS = 3
"""Contact cuboids of a wheel; their corners are those of a polygon of 12 sides."""


@dataclass(frozen=True, kw_only=True)
class WheelieBin:
    """Measures at the mouth, m.

    Attributes:
        narrow: half width at the bottom as a share of that at the mouth.
        slope: how far the front leans in at the bottom.
        corner: radius of the corners.
        wheel: radius.
        tread: width of a wheel.
        opens: rad.
    """

    half: tuple[float, float]
    height: float
    narrow: float
    slope: float
    corner: float
    wheel: float
    tread: float
    opens: float
    friction: float
    ribs: int
    body: Stock
    lid: Stock
    plastic: Stock
    rubber: Stock
    steel: Stock

    @property
    def axis(self) -> tuple[float, float]:
        """(y, z) of the lid's hinge."""
        return self.half[1] + BEHIND, self.height + ABOVE

    @property
    def axle(self) -> tuple[float, float]:
        """(y, z) of the wheels' axle."""
        return self.half[1] - 0.55 * self.wheel, self.wheel

    def level(self, z: float) -> tuple[float, float, float]:
        """Half width, front and rear of the body's outside at a height."""
        share = (z - LIFT) / (self.height - LIFT)
        a = self.half[0] * (self.narrow + (1.0 - self.narrow) * share)
        rear = self.half[1] - 0.012 * (1.0 - share)
        return a, -self.half[1] + self.slope * (1.0 - share), rear


def _ring(b: WheelieBin, z: float, inset: float) -> list[tuple[float, float, float]]:
    a, front, rear = b.level(z)
    flat = rounded_rectangle(
        2.0 * (a - inset), rear - front - 2.0 * inset, max(b.corner - inset, 0.004), segments=4
    )
    return [(float(x), float(y) + (front + rear) / 2.0, z) for x, y in flat]


def wheelie_bin(b: WheelieBin) -> Works:
    """Body with its handle bar, lid, and two wheels that roll on their own."""
    return Works(base=tuple(_body(b))) + _lid(b) + _wheel(b, "left", -1.0) + _wheel(b, "right", 1.0)


def _body(b: WheelieBin) -> list[Body]:
    top = b.height
    outer = loft(np.array([_ring(b, LIFT, 0.0), _ring(b, top, 0.0)]))
    inner = loft(np.array([_ring(b, LIFT + 0.006, WALL), _ring(b, top + 0.01, WALL)]))
    ring = prism(_plane(b, -COLLAR), 0.034, holes=[_plane(b, WALL)]).at(0.0, 0.0, top - 0.034)
    lip = prism(_plane(b, -COLLAR), 0.006, holes=[_plane(b, -COLLAR + 0.004)])
    lip = lip.at(0.0, 0.0, top - 0.040)
    room = _arches(b)
    shell = union([outer - room, ring, lip, *_ribs(b)]) - inner
    end = _wheel_middle(b) - 0.14 * b.tread
    return [
        b.body.piece(shell - room, contact=tuple(_contact(b)), grain="z"),
        b.body.piece(_arch_walls(b, room) & outer, contact=()),
        *_frame(b),
        b.steel.piece(cylinder(0.009, 2.0 * end, axis="x", segments=14).at(-end, *b.axle)),
        *(b.body.piece(foot, contact=(foot,)) for foot in _feet(b)),
    ]


def _plane(b: WheelieBin, inset: float) -> Floats:
    points = np.array(_ring(b, b.height, 0.0))[:, :2]
    middle = points.mean(axis=0)
    a, front, rear = b.level(b.height)
    size = (2.0 * (a - inset), rear - front - 2.0 * inset)
    flat = rounded_rectangle(*size, max(b.corner - inset, 0.004), segments=4)
    return np.asarray(flat + middle)


def _wheel_middle(b: WheelieBin) -> float:
    """x of the right wheel's outer face."""
    return b.half[0] - 0.004


def _arches(b: WheelieBin) -> Solid:
    """The room of the wheels, cut into the body."""
    y, z = b.axle
    inner = _wheel_middle(b) - b.tread - 0.006
    well = cylinder(b.wheel + 0.014, 0.3, axis="x", segments=28)
    below = slab((0.0, -b.wheel - 0.014, -0.5), (0.3, b.wheel + 0.014, 0.0))
    behind = slab((0.0, 0.0, -0.5), (0.3, 0.5, b.wheel + 0.014))
    right = union([well, below, behind]).at(inner, y, z)
    return right | right.mirrored("x")


def _arch_walls(b: WheelieBin, room: Solid) -> Solid:
    """Sheet between the wheels' room and the inside."""
    y, z = b.axle
    inner = _wheel_middle(b) - b.tread - 0.006 - WALL
    reach = b.wheel + 0.014 + WALL
    well = cylinder(reach, 0.3, axis="x", segments=28)
    below = slab((0.0, -reach, -0.5), (0.3, reach, 0.0))
    behind = slab((0.0, 0.0, -0.5), (0.3, 0.5, reach))
    right = union([well, below, behind]).at(inner, y, z)
    return (right | right.mirrored("x")) - room


def _ribs(b: WheelieBin) -> list[Solid]:
    """Upright ridges on the front."""
    ribs = []
    for x in np.linspace(-0.55, 0.55, b.ribs) * b.half[0]:
        low, high = LIFT + 0.10, b.height - 0.16
        points = []
        for z in (low, high):
            front = b.level(z)[1]
            points += [(x - 0.012, front + 0.001, z), (x + 0.012, front + 0.001, z)]
            points += [(x - 0.007, front - 0.006, z), (x + 0.007, front - 0.006, z)]
        ribs.append(hull(np.array(points)))
    return ribs


def _contact(b: WheelieBin) -> list[Solid]:
    """Four leaning walls, a floor, and the collar's four sides."""
    low, high = LIFT, b.height - 0.034
    clear = 2.0 * b.axle[1] + 0.03
    (a0, f0, r0), (a1, f1, r1) = b.level(low), b.level(high)
    am, _, rm = b.level(clear)
    t, c = WALL + 0.002, 0.5 * b.corner
    front = [(s * (a - c), f + d, z) for a, f, z in ((a0, f0, low), (a1, f1, high))
             for s in (-1, 1) for d in (0.0, t)]  # fmt: skip
    rear = [(s * (a - c), r - d, z) for a, r, z in ((am, rm, clear), (a1, r1, high))
            for s in (-1, 1) for d in (0.0, t)]  # fmt: skip
    y0 = b.axle[0] - b.wheel - 0.02
    pieces = [hull(np.array(front)), hull(np.array(rear))]
    for s in (-1.0, 1.0):
        side = [
            (s * (a - d), y, z)
            for a, f, r, z in ((am, b.level(clear)[1], rm, clear), (a1, f1, r1, high))
            for y in (f + c, r - c)
            for d in (0.0, t)
        ]
        lower = [
            (s * (a - d), y, z)
            for a, f, z in ((a0, f0, low), (am, b.level(clear)[1], clear))
            for y in (f + c, y0)
            for d in (0.0, t)
        ]
        pieces += [hull(np.array(side)), hull(np.array(lower))]
    inner = _wheel_middle(b) - b.tread - 0.008
    pieces.append(slab((-a0 + c, f0 + c, low), (a0 - c, y0, low + 0.006)))
    pieces.append(slab((-inner, y0, low), (inner, r0 - 0.004, low + 0.006)))
    pieces.append(slab((-inner, r0 - 0.008, low + 0.006), (inner, r0 - 0.002, clear)))
    a, b0, b1, z = a1 + COLLAR, f1 - COLLAR, r1 + COLLAR, b.height
    pieces += [
        slab((-a + 0.03, b0, high), (a - 0.03, f1 + t, z)),
        slab((-a + 0.03, r1 - t, high), (a - 0.03, b1, z)),
        slab((-a, b0 + 0.03, high), (-a1 + t, b1 - 0.03, z)),
        slab((a1 - t, b0 + 0.03, high), (a, b1 - 0.03, z)),
    ]
    return pieces


def _feet(b: WheelieBin) -> list[Solid]:
    """Two blocks in front, as high as the wheels hold the rear."""
    a, front, _ = b.level(LIFT)
    return [
        slab((x - 0.03, front + 0.012, 0.0), (x + 0.03, front + 0.06, LIFT + 0.002))
        for x in (-0.6 * a, 0.6 * a)
    ]


def _frame(b: WheelieBin) -> list[Body]:
    """Two brackets behind the collar, with the bar that is both handle and hinge."""
    (y, z), a = b.axis, 0.80 * b.half[0]
    brackets = []
    for x in (-a, a):
        block = slab((x - 0.012, b.half[1] + 0.004, z - 0.075), (x + 0.012, y + 0.008, z - 0.013))
        brackets.append(b.body.piece(block, contact=(block,)))
    bar = cylinder(0.011, 2.0 * a, axis="x", segments=16).at(-a, y + 0.004, z - 0.036)
    reach = slab((-a, y - 0.004, z - 0.044), (a, y + 0.012, z - 0.028))
    ears = [
        b.body.piece(
            union([
                cylinder(0.009, 0.010, axis="x", segments=14).at(x, y, z),
                slab((x, y - 0.009, z - 0.03), (x + 0.010, y + 0.009, z)),
            ])
        )
        for x in (-a - 0.012, a + 0.002)
    ]  # fmt: skip
    return [*brackets, b.body.piece(bar, contact=(reach,)), *ears]


def _lid(b: WheelieBin) -> Works:
    """A lid with a rim that overhangs the collar in front, on two arms to the bar behind."""
    low, (y, z) = b.height + 0.002, b.axis
    a, front, rear = b.half[0] + COLLAR - 0.002, -b.half[1] - COLLAR - 0.012, b.half[1] + 0.012

    def plane(inset: float, level: float) -> list[tuple[float, float, float]]:
        flat = rounded_rectangle(
            2.0 * (a - inset), rear - front - 2.0 * inset, max(0.05 - inset, 0.006), segments=4
        )
        return [(float(u), float(v) + (front + rear) / 2.0, level) for u, v in flat]

    crown = 0.055
    levels = ((0.0, low), (0.0, low + 0.014), (0.03, low + 0.036), (0.09, low + crown))
    outer = loft(np.array([plane(i, v) for i, v in levels]))
    room = loft(
        np.array([plane(i + 0.005, v - 0.005) for i, v in ((0.0, low - 0.01), *levels[1:])])
    )
    flaps = []
    for sign in (-1.0, 1.0):
        x0, x1 = sorted((sign * 0.62 * b.half[0], sign * (0.80 * b.half[0] - 0.016)))
        arm = slab((x0, rear - 0.03, low + 0.003), (x1, y, low + 0.016))
        knuckle = cylinder(0.010, x1 - x0, axis="x", segments=16).at(x0, y, z)
        flaps.append(arm | knuckle)
    plate = slab((-a + 0.03, front + 0.02, low + 0.002), (a - 0.03, rear - 0.01, low + 0.016))
    handles = [
        slab((s * 0.5 * a - 0.045, front - 0.014, low + 0.002),
             (s * 0.5 * a + 0.045, front + 0.004, low + 0.008))
        for s in (-1.0, 1.0)
    ]  # fmt: skip
    shell = union([outer - room, *(flap - room for flap in flaps), *handles])
    joint = Joint(
        name="lid_hinge",
        type="revolute",
        parent="base",
        child="lid",
        axis=(-1.0, 0.0, 0.0),
        origin=(0.0, y, z),
        limit=Limit(lower=0.0, upper=b.opens),
        friction=b.friction,
        damping=0.1,
        effort=40.0,
    )
    grips = tuple(
        Grip(
            name=f"lid_grip_{side}",
            kind="edge",
            position=(sign * 0.5 * a, front - 0.012, low + 0.005),
            outward=(0.0, -1.0, 0.0),
            pull=(0.0, 0.0, 1.0),
        )
        for side, sign in (("left", -1.0), ("right", 1.0))
    )
    part = DraftPart(
        name="lid",
        label="lid",
        bodies=(b.lid.piece(shell, contact=(plate,), grain="x"),),
        grips=grips,
    )
    return Works(parts=(part,), joints=(joint,))


def _wheel(b: WheelieBin, side: str, sign: float) -> Works:
    """A solid rubber tire on a plastic disc with spokes."""
    y, z = b.axle
    r, w = b.wheel, b.tread
    tire = revolve(
        [(0.80 * r, 0.0), (0.96 * r, 0.0), (r, 0.12 * w), (r, 0.88 * w), (0.96 * r, w),
         (0.80 * r, w)],
        axis="x", segments=36,
    )  # fmt: skip
    hub, rim, bed = 0.24 * r, 0.72 * r, 0.803 * r
    disc = revolve(
        [(0.010, 0.1 * w), (hub, 0.1 * w), (hub, 0.42 * w), (rim, 0.42 * w), (rim, 0.08 * w),
         (bed, 0.08 * w), (bed, 0.92 * w), (rim, 0.92 * w), (rim, 0.58 * w), (hub, 0.58 * w),
         (hub, 0.9 * w), (0.010, 0.9 * w)],
        axis="x", segments=28,
    )  # fmt: skip
    cap = cylinder(0.11 * r, 0.006, axis="x", segments=14)
    x = _wheel_middle(b) - w
    step = math.pi / (4 * CUBOIDS)
    reach = r / math.cos(step)
    turns = [step * (2 * k + 1) for k in range(CUBOIDS)]
    contact = [
        slab((0.0, -reach * math.cos(t), -reach * math.sin(t)),
             (w, reach * math.cos(t), reach * math.sin(t)))
        for t in turns
    ]  # fmt: skip
    whole = disc | cap.at(w * 0.92)

    def placed(solid: Solid) -> Solid:
        moved = solid.at(x)
        return (moved if sign > 0.0 else moved.mirrored("x")).at(0.0, y, z)

    name = f"wheel_{side}"
    part = DraftPart(
        name=name,
        label="wheel",
        bodies=(
            b.plastic.piece(placed(whole), contact=tuple(placed(c) for c in contact)),
            b.rubber.piece(placed(tire)),
        ),
    )
    joint = Joint(
        name=f"{name}_roll",
        type="continuous",
        parent="base",
        child=name,
        axis=(1.0, 0.0, 0.0),
        origin=(0.0, y, z),
        limit=None,
        friction=0.03,
        damping=0.004,
        effort=5.0,
        velocity=10.0,
    )
    return Works(parts=(part,), joints=(joint,))
