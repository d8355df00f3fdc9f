"""Half shells of hard suitcases: lofted, ribbed, lined; they meet in an upright plane.

A half is drawn as the front one, opening at y = 0 and growing along -y; the rear one is its mirror
image. Contact is built from boxes: walls, a plate, and one box within each rounded corner.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, hull, loft, prism, slab, union

CORNER_SEGMENTS, ROUND_STEPS = 5, 4
GAP = 0.0006
"""From the plane where the halves meet to each of them, m."""
WALL, LINING = 0.0032, 0.0014
"""m."""
REACH = 0.0034
"""How far contact boxes may stand out of a rounding, m."""


@dataclass(frozen=True, kw_only=True)
class HalfShell:
    """One half, m.

    Attributes:
        low: z of its bottom.
        corner: radius of the corners seen from the front.
        round: radius of the edges around the face.
        pattern: key of RIBS.
        ribs: how many.
        rib: height of ribs.
    """

    width: float
    low: float
    high: float
    depth: float
    corner: float
    round: float
    pattern: str
    ribs: int
    rib: float

    @property
    def height(self) -> float:
        """Along z."""
        return self.high - self.low

    @property
    def flat(self) -> float:
        """How far from the meeting plane the walls are straight."""
        return self.depth - self.round


def outline(h: HalfShell, inset: float) -> Floats:
    """(N, 2) points in x, z, counter-clockwise seen from the front."""
    points = rounded_rectangle(
        h.width - 2.0 * inset,
        h.height - 2.0 * inset,
        max(h.corner - inset, 0.002),
        segments=CORNER_SEGMENTS,
    )
    return np.asarray(points + np.array((0.0, (h.low + h.high) / 2.0)))


def standing(flat: Solid) -> Solid:
    """What was drawn in x, y and pushed along +z, in x, z and along -y."""
    return flat.turned("x", math.pi / 2.0)


def _bowl(h: HalfShell, inset: float, start: float) -> Solid:
    """The half as a solid, `inset` within its outside, from `start` behind the meeting plane."""
    rings = [np.c_[outline(h, inset), np.full(4 * (CORNER_SEGMENTS + 1), start)]]
    bend = max(h.round - inset, 0.002)
    for step in range(ROUND_STEPS + 1):
        angle = 0.5 * math.pi * step / ROUND_STEPS
        pulled = bend * (1.0 - math.cos(angle))
        level = h.depth - inset - bend * (1.0 - math.sin(angle))
        ring = outline(h, inset + pulled)
        rings.append(np.c_[ring, np.full(len(ring), level)])
    return standing(loft(rings))


def outside(h: HalfShell) -> Solid:
    """The half without ribs, solid throughout."""
    return _bowl(h, 0.0, GAP)


def half_shell(h: HalfShell, shell: Stock, cloth: Stock) -> tuple[Body, Body]:
    """The front half: shell with ribs and contact, and its lining."""
    outer = union([_bowl(h, 0.0, GAP), *RIBS[h.pattern](h)])
    hollow = _bowl(h, WALL, 0.0)
    lining = hollow - _bowl(h, WALL + LINING, -0.001) - slab((-1, -GAP, 0), (1, 1, 5))
    return (
        shell.piece(outer - hollow, contact=tuple(contact(h)), grain="z"),
        cloth.piece(lining, grain="z"),
    )


def contact(h: HalfShell) -> list[Solid]:
    """Nine boxes: a plate, four walls, four corners."""
    x, r, t = h.width / 2.0, h.corner, WALL
    near, far = -(h.depth - _clip(h.round)), -GAP
    cut = _clip(r)
    side = r - math.sqrt((r + REACH) ** 2 - r * r)
    low, high = h.low, h.high
    pieces = [
        slab((-x, near, low + side), (-x + t, far, high - side)),
        slab((x - t, near, low + side), (x, far, high - side)),
        slab((-x + side, near, low), (x - side, far, low + t)),
        slab((-x + side, near, high - t), (x - side, far, high)),
    ]
    inner = min(side + t, 2.2 * cut + t)
    for sx in (-1.0, 1.0):
        for z0, z1 in ((low + cut, low + inner), (high - inner, high - cut)):
            x0, x1 = sorted((sx * (x - cut), sx * (x - inner)))
            pieces.append(slab((x0, near, z0), (x1, far, z1)))
    edge = _clip(h.round)
    pieces.append(
        slab((-x + edge, -h.depth - 0.5 * h.rib, low + edge), (x - edge, -h.depth + t, high - edge))
    )
    return pieces


def _clip(radius: float) -> float:
    """How far a square corner is pulled in so that it stands out of an arc by REACH at most."""
    return max(0.0, radius - (radius + REACH) / math.sqrt(2.0))


def rim(h: HalfShell, stock: Stock, *, out: float, deep: float) -> Body:
    """A band around the opening that stands out by `out`: a zip's tape, or an aluminium frame."""
    ring = prism(outline(h, -out), deep, holes=[outline(h, WALL)])
    return stock.piece(standing(ring).at(0.0, -GAP, 0.0), grain="z")


def corner_caps(h: HalfShell, metal: Stock) -> list[Body]:
    """Sheet caps over the four corners of the face, a rivet on each of their three sides."""
    size, out = h.corner + 0.006, 0.0012
    skin = _bowl(h, -out, 0.016) - _bowl(h, 0.0, 0.010)
    bodies = []
    for sx in (-1.0, 1.0):
        for z0, z1 in ((h.low - 0.01, h.low + size), (h.high - size, h.high + 0.01)):
            x0, x1 = sorted((sx * (h.width / 2.0 - size), sx * (h.width / 2.0 + 0.01)))
            bodies.append(metal.piece(skin & slab((x0, -1.0, z0), (x1, 0.0, z1)), grain="z"))
            bodies += [metal.piece(rivet) for rivet in _rivets(h, sx, z0 < h.low, size)]
    return bodies


def _rivets(h: HalfShell, sx: float, lower: bool, size: float) -> list[Solid]:
    """Domed heads on the flat parts of a cap: at the side and at the end."""
    x, end = sx * h.width / 2.0, h.low if lower else h.high
    inwards = 1.0 if lower else -1.0
    dome, y = 0.0022, -0.6 * (h.flat + 0.016)
    side = cylinder(dome, 0.0032, axis="x", segments=10)
    top = cylinder(dome, 0.0032, segments=10)
    return [
        side.at(x - (0.001 if sx > 0.0 else 0.0022), y, end + inwards * (size - 0.004)),
        top.at(x - sx * (size - 0.004), y, end - (0.0022 if lower else 0.001)),
    ]


def _vertical(h: HalfShell) -> list[Solid]:
    """Ridges from top to bottom, evenly spread over the face."""
    half = h.width / 2.0 - h.round - 0.012
    end = (h.low + h.round + 0.004, h.high - h.round - 0.004)
    return [
        _ridge((x, end[0]), (x, end[1]), 0.52 * half / h.ribs, h)
        for x in np.linspace(-half, half, h.ribs)
    ]


def _horizontal(h: HalfShell) -> list[Solid]:
    """Ridges from side to side."""
    half = h.width / 2.0 - h.round - 0.006
    low, high = h.low + h.round + 0.02, h.high - h.round - 0.02
    wide = 0.20 * (high - low) / h.ribs
    return [_ridge((-half, z), (half, z), wide, h) for z in np.linspace(low, high, h.ribs)]


def _chevron(h: HalfShell) -> list[Solid]:
    """Pairs of slanting ridges that meet in the middle."""
    half = h.width / 2.0 - h.round - 0.008
    low, high = h.low + h.round + 0.02, h.high - h.round - 0.02
    drop = min(0.30 * h.width, 0.3 * (high - low))
    wide = 0.25 * (high - low - drop) / h.ribs
    tops = np.linspace(low + drop, high, h.ribs)
    return [_ridge((sx * 0.006, z), (sx * half, z - drop), wide, h) for z in tops for sx in (-1, 1)]


def _framed(h: HalfShell) -> list[Solid]:
    """A raised field with a second one upon it."""
    x, low, high = h.width / 2.0 - h.round, h.low + h.round, h.high - h.round
    middle = (low + high) / 2.0
    return [
        _field(x - inset, (high - low) / 2.0 - inset, middle, out, h)
        for inset, out in ((0.016, h.rib), (0.045, 1.7 * h.rib))
    ]


def _field(x: float, half: float, middle: float, out: float, h: HalfShell) -> Solid:
    """A raised rectangle with slanting sides."""
    rings = [
        [(sx * (x - pull), -h.depth + y, middle + sz * (half - pull))
         for sx in (-1, 1) for sz in (-1, 1)]
        for pull, y in ((0.0, 0.001), (0.0, 0.0), (1.2 * out, -out))
    ]  # fmt: skip
    return hull(np.concatenate(rings))


def _ridge(
    start: tuple[float, float], stop: tuple[float, float], half: float, h: HalfShell
) -> Solid:
    """A ridge of trapezoid section between two points of the face, its ends slanting."""
    a, b = np.asarray(start, float), np.asarray(stop, float)
    along = (b - a) / np.linalg.norm(b - a)
    across = np.array([-along[1], along[0]])
    points = []
    for wide, pull, out in (
        (half, 0.0, -0.001),
        (half, 0.0, 0.0),
        (0.70 * half, 2.2 * h.rib, h.rib),
    ):
        for end, sign in ((a, 1.0), (b, -1.0)):
            for side in (-1.0, 1.0):
                x, z = end + sign * pull * along + side * wide * across
                points.append((x, -h.depth - out, z))
    return hull(np.asarray(points))


RIBS: Mapping[str, Callable[[HalfShell], list[Solid]]] = {
    "vertical": _vertical,
    "horizontal": _horizontal,
    "chevron": _chevron,
    "framed": _framed,
}


def crossed_straps(h: HalfShell, y: float, cloth: Stock, clip: Stock) -> tuple[Body, ...]:
    """Two elastic straps across a half at depth `y`, with a buckle where they meet."""
    x, low, high = h.width / 2.0 - WALL - LINING, h.low + WALL + LINING, h.high - WALL - LINING
    middle = (low + high) / 2.0
    rise = 0.26 * h.height
    straps = []
    for sign, offset in ((1.0, 0.0), (-1.0, 0.0021)):
        points = [
            (sx * x, y + offset + dy, middle + sign * sx * rise + dz)
            for sx in (-1.0, 1.0)
            for dy in (0.0, 0.0014)
            for dz in (-0.0125, 0.0125)
        ]
        straps.append(cloth.piece(hull(np.asarray(points)), grain="x"))
    buckle = box((0.052, 0.010, 0.040), at=(0.0, y + 0.0015, middle - 0.02))
    tongue = box((0.020, 0.013, 0.030), at=(0.0, y + 0.0015, middle - 0.015))
    return (*straps, clip.piece(buckle, contact=(buckle,)), clip.piece(tongue))


def zipped_divider(h: HalfShell, y: float, cloth: Stock, coil: Stock) -> tuple[Body, ...]:
    """A cloth panel that closes a half at depth `y`, with a zip around three sides of it."""
    inset = WALL + LINING + 0.0005
    panel = standing(prism(outline(h, inset), 0.0022)).at(0.0, y, 0.0)
    lower, upper = panel.bounds
    track = standing(
        prism(outline(h, inset + 0.028), 0.0014, holes=[outline(h, inset + 0.0325)])
    ).at(0.0, y + 0.0012, 0.0)
    track &= slab((-1.0, -1.0, lower[2] + 0.06), (1.0, 1.0, upper[2]))
    plate = slab(
        (lower[0] + 0.02, lower[1], lower[2] + 0.02), (upper[0] - 0.02, upper[1], upper[2] - 0.02)
    )
    return cloth.piece(panel, contact=(plate,), grain="z"), coil.piece(track, grain="z")


def mirrored_body(body: Body) -> Body:
    """The same in the other half: mirrored in the meeting plane."""
    return Body(
        solid=body.solid.mirrored("y"),
        surface=body.surface,
        density=body.density,
        edge=body.edge,
        collision=tuple(piece.mirrored("y") for piece in body.collision),
        grain=body.grain,
    )
