"""Fronts of drawers and doors: slab, shaker, grooved, fluted, glazed, louvred."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Axis, Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.profile import arc, rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright

Style = Literal["slab", "shaker", "grooved", "fluted", "glass", "louvred"]
Edge = Literal["left", "right", "top"]
LIP, POCKET, REAR = 0.0055, 0.017, 0.026
"""Milled grip: thickness of its lip, depth of the pocket below the lip's end, height of the bare
rear wall above it, m."""


@dataclass(frozen=True, kw_only=True)
class FrontMaker:
    """How the fronts of one piece of furniture are made.

    Attributes:
        thickness: of slabs and frames, m.
        frame: width of stiles and rails, m.
        pitch: distance of grooves, flutes or louvres, m.
        bars: glazing bars across a pane.
        grain: axis along which the grain of whole boards runs.
        pane: what panes are cut from.
    """

    stock: Stock
    pane: Stock
    thickness: float
    frame: float
    pitch: float
    bars: int
    grain: Axis

    def front(self, style: Style, rect: Rect, back: float) -> tuple[Body, ...]:
        """A front over `rect` whose rear lies in the plane y = `back`."""
        contact = (self._slab(rect, back),)
        framed = style in ("shaker", "glass", "louvred")
        if framed and min(rect.width, rect.height) < 2.0 * self.frame + 0.05:
            style = "slab"
        if style == "slab":
            return (self.stock.piece(contact[0], contact=contact, grain=self.grain),)
        if style in ("grooved", "fluted"):
            outline = (_grooved if style == "grooved" else _fluted)(
                rect, back, self.thickness, self.pitch
            )
            solid = prism(outline, rect.height).at(0.0, 0.0, rect.z0)
            rounded = Stock(
                surface=self.stock.surface,
                density=self.stock.density,
                edge=0.0007 if style == "grooved" else 0.0,
            )
            return (rounded.piece(solid, contact=contact, grain="z"),)
        hole = rect.shrunk(self.frame)
        fill = {"shaker": self._panel, "glass": self._glazing, "louvred": self._louvres}[style]
        return (*self._frame(rect, back, contact), *fill(hole, back))

    def milled(self, rect: Rect, back: float, edge: Edge) -> tuple[Body, ...]:
        """A slab whose `edge` is milled to a grip: fingers reach behind a lip."""
        t = self.thickness
        length = rect.height if edge == "top" else rect.width
        lip, floor = length - REAR, length - REAR - POCKET
        wall = max(LIP + 0.008, t - 0.0055)
        profile = np.array(
            [(0, 0), (t, 0), (t, length), (wall, length), (wall, floor + 0.003),
             (wall - 0.003, floor), (LIP, floor), (LIP, lip), (0, lip)]
        )  # fmt: skip
        if edge == "top":
            solid = upright(prism(profile, rect.width), "x").at(rect.x0, back - t, rect.z0)
        else:
            turned = profile[::-1, ::-1]  # (along x, depth), counter-clockwise again.
            solid = prism(turned, rect.height).at(0.0, back - t, rect.z0)
            solid = solid.at(rect.x0) if edge == "right" else solid.mirrored("x").at(rect.x1)
        contact = (self._slab(rect, back),)
        return (self.stock.piece(solid, contact=contact, grain=self.grain),)

    def cut_out(self, rect: Rect, back: float, edge: Edge, at: float) -> tuple[Body, ...]:
        """A slab with a rounded notch in its `edge`, around x or z = `at`."""
        width, depth, t = 0.11, 0.030, self.thickness
        notch = rounded_rectangle(width, 2.0 * depth, 0.024, segments=5)
        hole = upright(prism(notch, t + 0.01), "y").at(0.0, back - t - 0.005, 0.0)
        if edge == "top":  # Drawn x, y became z, x: a notch that is long along z.
            hole = hole.turned("y", math.pi / 2.0).at(at, 0.0, rect.z1)
        else:
            hole = hole.at(rect.x1 if edge == "right" else rect.x0, 0.0, at)
        solid, contact = self._slab(rect, back) - hole, (self._slab(rect, back),)
        return (self.stock.piece(solid, contact=contact, grain=self.grain),)

    def _slab(self, rect: Rect, back: float) -> Solid:
        return slab((rect.x0, back - self.thickness, rect.z0), (rect.x1, back, rect.z1))

    def _frame(self, rect: Rect, back: float, contact: tuple[Solid, ...]) -> list[Body]:
        """Stiles over the full height, rails between them; one contact box for the whole front."""
        front, f = back - self.thickness, self.frame
        stiles = [slab((x, front, rect.z0), (x + f, back, rect.z1)) for x in (rect.x0, rect.x1 - f)]
        rails = [
            slab((rect.x0 + f, front, z), (rect.x1 - f, back, z + f))
            for z in (rect.z0, rect.z1 - f)
        ]
        return [
            self.stock.piece(stiles[0], contact=contact, grain="z"),
            self.stock.piece(stiles[1], grain="z"),
            *(self.stock.piece(rail, grain="x") for rail in rails),
        ]

    def _panel(self, hole: Rect, back: float) -> list[Body]:
        depth = 0.45 * self.thickness
        rear = back - 0.15 * self.thickness
        solid = slab((hole.x0, rear - depth, hole.z0), (hole.x1, rear, hole.z1))
        return [
            Stock(surface=self.stock.surface, density=self.stock.density, edge=0.0).piece(
                solid, grain=self.grain
            )
        ]

    def _glazing(self, hole: Rect, back: float) -> list[Body]:
        middle, bars = back - 0.5 * self.thickness, self.bars
        pane = slab((hole.x0, middle, hole.z0), (hole.x1, middle + 0.004, hole.z1))
        width = 0.018
        across = [
            slab(
                (hole.x0, back - self.thickness, z - width / 2.0),
                (hole.x1, middle, z + width / 2.0),
            )
            for z in np.linspace(hole.z0, hole.z1, bars + 2)[1:-1].tolist()
        ]
        return [self.pane.piece(pane), *(self.stock.piece(bar, grain="x") for bar in across)]

    def _louvres(self, hole: Rect, back: float) -> list[Body]:
        """Slats that lean forwards at their lower edge and overlap as roof tiles do."""
        tilt = math.radians(17.0)
        width = (self.thickness - 0.003 - 0.006 * math.cos(tilt)) / math.sin(tilt)
        rise = width * math.cos(tilt) + 0.006 * math.sin(tilt)
        count = max(2, math.floor((hole.height - rise) / (0.86 * rise)) + 1)
        slat = slab((hole.x0, -0.003, -width / 2.0), (hole.x1, 0.003, width / 2.0))
        slat = slat.turned("x", -tilt)
        middle = back - self.thickness / 2.0
        half = float(slat.extent[2]) / 2.0
        heights = np.linspace(hole.z0 + half, hole.z1 - half, count).tolist()
        plain = Stock(surface=self.stock.surface, density=self.stock.density, edge=0.0)
        return [plain.piece(slat.at(0.0, middle, z), grain="x") for z in heights]


def _grooved(rect: Rect, back: float, thickness: float, pitch: float) -> Floats:
    """Plan of a board with V grooves 5 mm wide and 3 mm deep, evenly spread."""
    front, count = back - thickness, max(2, round(rect.width / max(pitch, 0.04)))
    xs = np.linspace(rect.x0, rect.x1, count + 1)[1:-1]
    cuts = [[(x - 0.0025, front), (x, front + 0.003), (x + 0.0025, front)] for x in xs]
    ends = [[(rect.x0, front)], *cuts, [(rect.x1, front), (rect.x1, back), (rect.x0, back)]]
    return np.concatenate([np.asarray(points) for points in ends])


def _fluted(rect: Rect, back: float, thickness: float, pitch: float) -> Floats:
    """Plan of a board whose face is a row of convex reeds."""
    count = max(3, round(rect.width / min(pitch, 0.03)))
    step = rect.width / count
    half = math.radians(50.0)
    radius = step / 2.0 / math.sin(half)
    reed = arc((0.0, 0.0), radius, -math.pi / 2.0 - half, -math.pi / 2.0 + half, 4)
    front = back - thickness + radius
    middles = [np.array([rect.x0 + (k + 0.5) * step, front]) for k in range(count)]
    rows = [reed[:1] + middles[0], *(reed[1:] + middle for middle in middles)]
    return np.concatenate([*rows, [(rect.x1, back), (rect.x0, back)]])
