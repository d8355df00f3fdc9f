"""Slotted cartons of corrugated board (FEFCO 02xx): walls, closed bottom, and flaps on creases.

A flap turns about the outer edge of its wall, as if hinged by the outer liner alone, so that it may
fold all the way out. Minor flaps lie on the short walls, major flaps above them on the long ones,
which are higher by the board.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from artgen.articulation.types import Body, Decal, DraftPart, Grip, Joint, Limit, Precondition
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright

Vector = tuple[float, float, float]
CREASE, SLOT, OUTSET = 0.0005, 0.0012, 0.0005
"""Air under a closed flap, beside it, and from a wall to the axis before it, m."""
LINER = 0.0004
"""Thickness of the printed sheet, m."""
BEND = 0.001
"""From a wall's outer face to its closed flap, m."""
CORNER = 0.003
"""Radius of folded corners, m."""
HOLE = (0.092, 0.030)
"""Width and height of a hand hole, m."""


@dataclass(frozen=True, kw_only=True)
class Carton:
    """A box by its outer measures, m.

    Attributes:
        length: along x, the longer side.
        height: of the short walls' upper edges.
        board: thickness.
        major: depth of the flaps on the long walls.
        minor: depth of the flaps on the short walls.
        overlapped: whether the rear major flap lies on the front one.
        hand_holes: whether the short walls have one each.
        stocks: `board` (walls and flaps), `edge` (cut edges across flutes), `front`, `side`, `top`
            (printed liners).
        wave: length of the edge image, m.
    """

    length: float
    width: float
    height: float
    board: float
    major: float
    minor: float
    overlapped: bool
    hand_holes: bool
    stocks: Mapping[str, Stock]
    wave: float

    @property
    def long_wall(self) -> float:
        """z of the long walls' upper edges; the rear one is higher by a board if flaps overlap."""
        return self.height + self.board + CREASE


def walls(c: Carton) -> tuple[Body, ...]:
    """Four walls folded from one blank, the glued joint inside, printed liners outside."""
    t, x, y = c.board, c.length / 2.0, c.width / 2.0
    outer = rounded_rectangle(c.length, c.width, CORNER, segments=3)
    inner = rounded_rectangle(c.length - 2.0 * t, c.width - 2.0 * t, 0.0015, segments=2)
    rear = c.long_wall + (t + CREASE if c.overlapped else 0.0)
    ring = prism(outer, rear, holes=[inner])
    if c.overlapped:
        ring -= slab((-1.0, -1.0, c.long_wall), (1.0, y - t, rear + 1.0))
    ring -= slab((-1.0, -y + t, c.height), (1.0, y - t, rear + 1.0))
    contact = [
        slab((-x, -y, 0.0), (x, -y + t, c.long_wall)),
        slab((-x, y - t, 0.0), (x, y, rear)),
    ]
    for sign in (-1.0, 1.0):
        contact += _short_wall(c, sign)
    if c.hand_holes:
        ring -= upright(prism(_hole(), 2.0), "x").at(-1.0, 0.0, hole_height(c))
    seam = slab((x - t - 0.034, y - 2.0 * t, t * 2.0), (x - t, y - t, c.height - 0.004))
    board = c.stocks["board"]
    return (
        board.piece(ring, contact=tuple(contact), grain="z"),
        board.piece(seam, grain="z"),
        *_liners(c),
        *_rim_edges(c, rear),
        *_webs(c, rear),
    )


def _hole() -> Floats:
    return rounded_rectangle(HOLE[0], HOLE[1], 0.0149, segments=6)


def hole_height(c: Carton) -> float:
    """z of the middles of hand holes."""
    return c.height - min(0.07, 0.25 * c.height)


def _short_wall(c: Carton, sign: float) -> list[Solid]:
    """Contact of a short wall: one box, or four around its hand hole."""
    t, y = c.board, c.width / 2.0 - c.board
    x0, x1 = sorted((sign * (c.length / 2.0 - t), sign * c.length / 2.0))
    if not c.hand_holes:
        return [slab((x0, -y, 0.0), (x1, y, c.height))]
    half, z = HOLE[0] / 2.0, hole_height(c)
    low, high = z - HOLE[1] / 2.0, z + HOLE[1] / 2.0
    return [
        slab((x0, -y, 0.0), (x1, y, low)),
        slab((x0, -y, high), (x1, y, c.height)),
        slab((x0, -y, low), (x1, -half, high)),
        slab((x0, half, low), (x1, y, high)),
    ]


def _liners(c: Carton) -> list[Body]:
    """Printed sheets in the outer faces, as large as the flat of the wall."""
    x, y, high = c.length / 2.0, c.width / 2.0, c.long_wall - 0.001
    flat_x, flat_y, low = x - CORNER, y - CORNER, 0.001
    side_high = c.height - 0.001
    sheets: list[tuple[str, Solid, Vector, Vector, tuple[float, float]]] = [
        ("front", slab((-flat_x, -y, low), (flat_x, -y + LINER, high)),
         (-flat_x, -y, low), (1.0, 0.0, 0.0), (2.0 * flat_x, high - low)),
        ("front", slab((-flat_x, y - LINER, low), (flat_x, y, high)),
         (flat_x, y, low), (-1.0, 0.0, 0.0), (2.0 * flat_x, high - low)),
        ("side", slab((x - LINER, -flat_y, low), (x, flat_y, side_high)),
         (x, -flat_y, low), (0.0, 1.0, 0.0), (2.0 * flat_y, side_high - low)),
        ("side", slab((-x, -flat_y, low), (-x + LINER, flat_y, side_high)),
         (-x, flat_y, low), (0.0, -1.0, 0.0), (2.0 * flat_y, side_high - low)),
    ]  # fmt: skip
    cut = upright(prism(_hole(), 2.0), "x").at(-1.0, 0.0, hole_height(c))
    bodies = []
    for name, solid, origin, right, size in sheets:
        if c.hand_holes and name == "side":
            solid = solid - cut
        stock = c.stocks[name]
        decal = Decal(origin=origin, right=right, up=(0.0, 0.0, 1.0), size=size)
        bodies.append(Body(solid=solid, surface=stock.surface, density=stock.density, decal=decal))
    return bodies


def _edge(c: Carton, solid: Solid, origin: Vector, right: Vector, up: Vector) -> Body:
    """A strip at a cut across the flutes, with their waves on it."""
    stock = c.stocks["edge"]
    decal = Decal(origin=origin, right=right, up=up, size=(c.wave, c.board))
    return Body(solid=solid, surface=stock.surface, density=stock.density, decal=decal)


def _rim_edges(c: Carton, rear: float) -> list[Body]:
    """Upper ends of the walls, where flaps were slotted free."""
    t, deep = c.board, 0.003
    x, y = c.length / 2.0 - CORNER, c.width / 2.0 - t - CORNER
    bodies = []
    for y0, top in ((-c.width / 2.0, c.long_wall), (c.width / 2.0 - t, rear)):
        solid = slab((-x, y0, top - deep), (x, y0 + t, top))
        bodies.append(_edge(c, solid, (-x, y0, top), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    for x0 in (-c.length / 2.0, c.length / 2.0 - t):
        solid = slab((x0, -y, c.height - deep), (x0 + t, y, c.height))
        bodies.append(_edge(c, solid, (x0, y, c.height), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0)))
    return bodies


def _webs(c: Carton, rear: float) -> list[Body]:
    """The outer liner runs on over the creases, up to the axes of the flaps."""
    up, x, y = CREASE + c.board, c.length / 2.0, c.width / 2.0
    half_x, half_y = x - SLOT, y - c.board - SLOT
    places = [
        ((-half_x, -y, c.long_wall), (half_x, -y + LINER, c.long_wall + up)),
        ((-half_x, y - LINER, rear), (half_x, y, rear + up)),
        ((-x, -half_y, c.height), (-x + LINER, half_y, c.height + up)),
        ((x - LINER, -half_y, c.height), (x, half_y, c.height + up)),
    ]
    board = Stock(surface="board", density=c.stocks["board"].density, edge=0.0)
    return [board.piece(slab(low, high), grain="z") for low, high in places]


def bottom(c: Carton) -> tuple[Body, ...]:
    """Major flaps outside, minor ones on them, as glued or taped in the factory."""
    t, x, y, seam = c.board, c.length / 2.0 - c.board, c.width / 2.0 - c.board, 0.0008
    board = c.stocks["board"]
    minor = min(c.width / 2.0, x - 0.001)
    pieces = [
        slab((-x, -y, 0.0), (x, -seam, t)),
        slab((-x, seam, 0.0), (x, y, t)),
        slab((-x, -y + 0.001, t), (-x + minor, y - 0.001, 2.0 * t)),
        slab((x - minor, -y + 0.001, t), (x, y - 0.001, 2.0 * t)),
    ]
    edges = [
        _edge(c, slab((u, -y + 0.001, t), (u + 0.003, y - 0.001, 2.0 * t)),
              (u, -y, t), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        for u in (-x + minor - 0.003, x - minor)
    ]  # fmt: skip
    return (*(board.piece(piece, contact=(piece,)) for piece in pieces), *edges)


def partition(c: Carton, cells: tuple[int, int], height: float) -> tuple[Body, ...]:
    """Slotted dividers that stand on the bottom: `cells` along x and y."""
    t, floor = 0.003, 2.0 * c.board
    x, y = c.length / 2.0 - c.board - 0.0005, c.width / 2.0 - c.board - 0.0005
    board, bodies = c.stocks["board"], []
    for k in range(1, cells[0]):
        u = -x + 2.0 * x * k / cells[0]
        solid = slab((u - t / 2.0, -y, floor), (u + t / 2.0, y, floor + height))
        bodies.append(board.piece(solid, contact=(solid,), grain="z"))
    for k in range(1, cells[1]):
        v = -y + 2.0 * y * k / cells[1]
        solid = slab((-x, v - t / 2.0, floor), (x, v + t / 2.0, floor + height))
        bodies.append(board.piece(solid, contact=(solid,), grain="z"))
    return tuple(bodies)


@dataclass(frozen=True, kw_only=True)
class Flaps:
    """How flaps move: the angle of a full fold, friction of the creases, N m a meter."""

    reach: float
    friction: float


def flaps(
    c: Carton, move: Flaps
) -> tuple[tuple[DraftPart, ...], tuple[Joint, ...], tuple[Precondition, ...]]:
    """Front and rear major flaps, left and right minor ones, and the order they open in."""
    rear = c.long_wall + (c.board + CREASE if c.overlapped else 0.0)
    made = [
        _flap(c, move, "flap_front", wall=c.long_wall, turn=0),
        _flap(c, move, "flap_back", wall=rear, turn=2),
        _flap(c, move, "flap_right", wall=c.height, turn=1),
        _flap(c, move, "flap_left", wall=c.height, turn=3),
    ]
    upright_ = math.pi / 2.0
    order = [
        Precondition(joint=f"flap_{minor}_fold", requires=f"flap_{major}_fold", at_least=upright_)
        for minor in ("right", "left")
        for major in ("front", "back")
    ]
    if c.overlapped:
        order.append(
            Precondition(joint="flap_front_fold", requires="flap_back_fold", at_least=upright_)
        )
    return tuple(part for part, _ in made), tuple(joint for _, joint in made), tuple(order)


def _flap(c: Carton, move: Flaps, name: str, *, wall: float, turn: int) -> tuple[DraftPart, Joint]:
    """A flap drawn on the front wall, then brought round by `turn` quarters about z."""
    major = turn % 2 == 0
    depth, t = (c.major if major else c.minor), c.board
    across = c.length if major else c.width - 2.0 * t
    half = across / 2.0 - SLOT
    y0 = -(c.width if major else c.length) / 2.0
    low = wall + CREASE
    angle = turn * math.pi / 2.0

    def spun(v: Vector) -> Vector:
        cos, sin = (1, 0, -1, 0)[turn], (0, 1, 0, -1)[turn]
        return cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]

    def brought(solid: Solid) -> Solid:
        return solid.turned("z", angle)

    plate = slab((-half, y0 + BEND, low), (half, y0 + depth, low + t))
    board = c.stocks["board"]
    end = slab((-half, y0 + depth - 0.003, low), (half, y0 + depth, low + t))
    bodies = [
        board.piece(brought(plate), contact=(brought(plate),), grain="y" if major else "x"),
        _edge(c, brought(end), spun((half, y0 + depth, low)), spun((-1.0, 0.0, 0.0)),
              (0.0, 0.0, 1.0)),
    ]  # fmt: skip
    if major:
        inner = slab(
            (-half + 0.001, y0 + BEND + 0.001, low + t - LINER), (half - 0.001, y0 + depth, low + t)
        )
        stock = c.stocks["top"]
        decal = Decal(
            origin=spun((-half + 0.001, y0 + 0.001, low + t)),
            right=spun((1.0, 0.0, 0.0)),
            up=spun((0.0, 1.0, 0.0)),
            size=(2.0 * half - 0.002, depth - 0.001),
        )
        bodies.append(
            Body(solid=brought(inner), surface=stock.surface, density=stock.density, decal=decal)
        )
    hold = spun((0.0, y0 + depth, low + t / 2.0))
    grip = Grip(
        name=f"{name}_edge", kind="edge", position=hold, outward=(0.0, 0.0, 1.0),
        pull=(0.0, 0.0, 1.0),
    )  # fmt: skip
    joint = Joint(
        name=f"{name}_fold",
        type="revolute",
        parent="base",
        child=name,
        axis=spun((1.0, 0.0, 0.0)),  # +q lifts the free edge: y goes to z.
        origin=spun((0.0, y0 - OUTSET, low + t)),
        limit=Limit(lower=0.0, upper=_fold(c, move, depth, wall)),
        friction=max(0.006, move.friction * across),
        damping=0.003,
        effort=2.0,
        velocity=6.0,
    )
    return DraftPart(name=name, label="flap", bodies=tuple(bodies), grips=(grip,)), joint


def _fold(c: Carton, move: Flaps, depth: float, wall: float) -> float:
    """As far as asked for, but not into the floor."""
    if depth < wall - 0.01:
        return move.reach
    return min(move.reach, math.pi + math.asin((wall - 0.01) / depth) - 0.05)
