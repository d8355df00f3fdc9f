"""Telescopic handles: a grip on two bars that slide in two tubes, which slide in the case."""

from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.geometry.solid import Solid, chamfered_box, slab, union

BAR, TUBE, GUIDE = (0.0080, 0.0060), (0.0124, 0.0104), (0.0146, 0.0126)
"""Outside of the bars, outside of the tubes, inside of the guides: along x and y, m."""
SHEET, SHEATH = 0.0011, 0.0050
"""Wall of the tubes, and of the cloth-covered guides, m."""
GRIP = (0.021, 0.019)
"""Depth and height of the grip, m."""
SINK = 0.030
"""How deep the grip's pocket is, m."""
PLAY = 0.0016
"""Around the grip in its pocket, m."""
FLOOR = 0.003
"""Of the pocket, m."""


@dataclass(frozen=True, kw_only=True)
class Telescope:
    """Where a handle stands in its case.

    Attributes:
        top: z of the case's top around the pocket.
        foot: z of the lower ends of the tubes.
        y: of the bars' middle.
        gauge: from one bar to the other.
        travel: of each stage.
        friction: N.
        stop: force of the catches that hold a stage in, N.
    """

    top: float
    foot: float
    y: float
    gauge: float
    travel: float
    friction: float
    stop: float
    metal: Stock
    plastic: Stock
    cloth: Stock

    @property
    def floor(self) -> float:
        """z of the pocket's floor."""
        return self.top - SINK + FLOOR

    @property
    def middles(self) -> tuple[float, float]:
        """x of the bars."""
        return -self.gauge / 2.0, self.gauge / 2.0

    @property
    def half(self) -> tuple[float, float]:
        """Half width and half depth of the pocket."""
        return self.gauge / 2.0 + 0.018 + PLAY, GRIP[0] / 2.0 + PLAY


def pocket_room(t: Telescope) -> Solid:
    """What the pocket and its tray take from the case."""
    (x, y), edge = t.half, 0.002
    return slab((-x - edge, t.y - y - edge, t.top - SINK), (x + edge, t.y + y + edge, t.top + 0.01))


def pocket(t: Telescope) -> tuple[Body, ...]:
    """The tray around the stowed grip, and the guides below it."""
    (x, y), edge = t.half, 0.002
    tray = slab((-x - edge, t.y - y - edge, t.top - SINK), (x + edge, t.y + y + edge, t.top))
    tray -= slab((-x, t.y - y, t.floor), (x, t.y + y, t.top + 0.1))
    lip = slab((-x - 0.006, t.y - y - 0.005, t.top), (x + 0.006, t.y + y + 0.005, t.top + 0.0016))
    lip -= slab((-x, t.y - y, t.top - 0.01), (x, t.y + y, t.top + 0.1))
    tray = tray | lip
    for u in t.middles:
        tray -= _bore(u, t.y, GUIDE, t.top - 1.0, t.top)
    sides = (
        slab((-x - edge, t.y - y - edge, t.top - SINK), (x + edge, t.y - y, t.top)),
        slab((-x - edge, t.y + y, t.top - SINK), (x + edge, t.y + y + edge, t.top)),
        slab((-x - edge, t.y - y, t.top - SINK), (-x, t.y + y, t.top)),
        slab((x, t.y - y, t.top - SINK), (x + edge, t.y + y, t.top)),
    )
    guides = []
    for u in t.middles:
        outer = _bore(u, t.y, (GUIDE[0] + 2 * SHEATH, GUIDE[1] + 2 * SHEATH), t.foot - 0.004,
                      t.top - SINK)  # fmt: skip
        guides.append(outer - _bore(u, t.y, GUIDE, t.foot, t.top))
    return (
        t.plastic.piece(tray, contact=sides, grain="x"),
        *(t.cloth.piece(guide, contact=_front_wall(t, u), grain="z")
          for guide, u in zip(guides, t.middles, strict=True)),
    )  # fmt: skip


def _front_wall(t: Telescope, u: float) -> tuple[Solid, ...]:
    """Of a guide: what hands and clothes meet."""
    wide = GUIDE[0] / 2.0 + SHEATH
    y = t.y - GUIDE[1] / 2.0
    return (slab((u - wide, y - SHEATH, t.foot - 0.004), (u + wide, y, t.top - SINK)),)


def _bore(x: float, y: float, size: tuple[float, float], low: float, high: float) -> Solid:
    a, b = size[0] / 2.0, size[1] / 2.0
    return slab((x - a, y - b, low), (x + a, y + b, high))


def telescope(t: Telescope, parent: str = "base") -> Works:
    """Tubes, then bars with the grip: two slides, one upon the other."""
    inner = (TUBE[0] - 2 * SHEET, TUBE[1] - 2 * SHEET)
    tubes, walls, bars = [], [], []
    for u in t.middles:
        outside = _bore(u, t.y, TUBE, t.foot + 0.001, t.floor + 0.0035)
        collar = _bore(u, t.y, (GUIDE[0] + 0.003, GUIDE[1] + 0.003), t.floor + 0.001,
                       t.floor + 0.0045)  # fmt: skip
        tubes.append((outside | collar) - _bore(u, t.y, inner, t.foot, t.top + 1.0))
        walls += _walls(u, t.y, inner, t.foot + 0.001, t.floor + 0.0035)
        bars.append(_bore(u, t.y, BAR, t.foot + 0.002, t.top - GRIP[1] + 0.001))
    grip = _grip(t)
    reach = slab(
        (-t.gauge / 2 - 0.018, t.y - GRIP[0] / 2, t.top - GRIP[1]),
        (t.gauge / 2 + 0.018, t.y + GRIP[0] / 2, t.top),
    )
    tube_part = DraftPart(
        name="handle_tubes",
        label="handle",
        bodies=(t.metal.piece(union(tubes), contact=tuple(walls), grain="z"),),
    )
    hold = Grip(
        name="pull_handle",
        kind="handle",
        position=(0.0, t.y, t.top - GRIP[1] / 2.0),
        outward=(0.0, 0.0, 1.0),
        pull=(0.0, 0.0, 1.0),
    )
    button = chamfered_box((0.030, 0.011, 0.003), 0.001, at=(0.0, t.y, t.top - 0.0012))
    grip_part = DraftPart(
        name="handle_grip",
        label="handle",
        bodies=(
            t.metal.piece(union(bars), contact=tuple(bars), grain="z"),
            t.plastic.piece(grip, contact=(reach,), grain="x"),
            t.metal.piece(button),
        ),
        grips=(hold,),
    )
    return Works(
        parts=(tube_part, grip_part),
        joints=(
            _slide(t, "handle_tubes", parent),
            _slide(t, "handle_grip", "handle_tubes"),
        ),
    )


def _grip(t: Telescope) -> Solid:
    """A rounded bar; its underside is hollowed for the fingers."""
    size = (t.gauge + 0.036, GRIP[0], GRIP[1])
    bar = chamfered_box(size, 0.003, at=(0.0, t.y, t.top - GRIP[1]))
    return bar - slab(
        (-t.gauge / 2 + 0.014, -1.0, t.top - GRIP[1] - 0.01),
        (t.gauge / 2 - 0.014, 1.0, t.top - GRIP[1] + 0.005),
    )


def _walls(x: float, y: float, inner: tuple[float, float], low: float, high: float) -> list[Solid]:
    """Front and rear wall of a tube."""
    a, b = TUBE[0] / 2.0, TUBE[1] / 2.0
    gap = inner[1] / 2.0
    return [
        slab((x - a, y - b, low), (x + a, y - gap, high)),
        slab((x - a, y + gap, low), (x + a, y + b, high)),
    ]


def _slide(t: Telescope, name: str, parent: str) -> Joint:
    return Joint(
        name=f"{name}_slide",
        type="prismatic",
        parent=parent,
        child=name,
        axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=t.travel),
        friction=t.friction,
        damping=8.0,
        effort=t.friction + t.stop + 60.0,
        velocity=1.5,
        latch=Latch(force=t.stop, reach=0.006),
    )
