"""Leaves of house doors: flush, grooved, panelled, glazed, louvred; stiles, rails, beads, panes."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.solid import Solid, hull, prism, slab, union, upright

Fill = Literal["panel", "glass", "louvre"]
Row = tuple[float, int, Fill]
"""Share of the free height, columns, what fills them."""

LAYOUTS: Mapping[str, tuple[Row, ...]] = {
    "flush": (),
    "grooved": (),
    "one_panel": ((1.0, 1, "panel"),),
    "two_panel": ((0.40, 1, "panel"), (0.60, 1, "panel")),
    "four_panel": ((0.40, 2, "panel"), (0.60, 2, "panel")),
    "five_panel": tuple((0.2, 1, "panel") for _ in range(5)),
    "six_panel": ((0.38, 2, "panel"), (0.45, 2, "panel"), (0.17, 2, "panel")),
    "glazed": ((1.0, 1, "glass"),),
    "half_glazed": ((0.38, 2, "panel"), (0.62, 1, "glass")),
    "three_quarter_glazed": ((0.22, 1, "panel"), (0.78, 1, "glass")),
    "louvred": ((0.47, 1, "louvre"), (0.53, 1, "louvre")),
    "half_louvred": ((0.40, 1, "louvre"), (0.60, 1, "panel")),
}
"""Rows from the bottom; the rail above the first one is the wide lock rail."""


@dataclass(frozen=True, kw_only=True)
class LeafMaker:
    """How leaves are made; lengths in m.

    Attributes:
        stock: of stiles, rails and slabs.
        pane: what panes are cut from.
        thickness: of stiles and rails.
        stile: width of stiles and of the top rail.
        bottom_rail: height of the lowest rail.
        lock_rail: height of the rail above the first row.
        bead: width of the beads that hold panels and panes.
        fielded: panels have a raised field.
        bars: glazing bars that stand and that lie across a pane.
        grooves: that run across a grooved leaf.
    """

    stock: Stock
    pane: Stock
    thickness: float
    stile: float
    bottom_rail: float
    lock_rail: float
    bead: float
    fielded: bool
    bars: tuple[int, int]
    grooves: int

    def leaf(self, layout: str, rect: Rect, front: float) -> tuple[Body, ...]:
        """A leaf over `rect` whose face lies in the plane y = `front`, towards -y."""
        rows = LAYOUTS[layout]
        if not rows:
            return (self._flush(rect, front, self.grooves if layout == "grooved" else 0),)
        inner = replace(
            rect.shrunk(self.stile), z0=rect.z0 + self.bottom_rail, z1=rect.z1 - self.stile
        )
        bodies = [self._bar(rect, front, x0=x, x1=x + self.stile) for x in (rect.x0, inner.x1)]
        bodies.append(self._bar(replace(rect, x0=inner.x0, x1=inner.x1), front, z1=inner.z0))
        bodies.append(self._bar(replace(rect, x0=inner.x0, x1=inner.x1), front, z0=inner.z1))
        for number, (cell, columns, fill) in enumerate(self._cells(inner, rows)):
            if number < len(rows) - 1:
                above = Rect(
                    x0=cell.x0, x1=cell.x1, z0=cell.z1, z1=cell.z1 + self._rail(number, rows)
                )
                bodies.append(self._bar(above, front))
            bodies += self._row(cell, columns, fill, front)
        return tuple(bodies)

    def _rail(self, number: int, rows: tuple[Row, ...]) -> float:
        return self.lock_rail if number == 0 and len(rows) < 5 else 0.8 * self.stile

    def _cells(self, inner: Rect, rows: tuple[Row, ...]) -> list[tuple[Rect, int, Fill]]:
        rails = [self._rail(number, rows) for number in range(len(rows) - 1)]
        free, z, cells = inner.height - sum(rails), inner.z0, []
        for (share, columns, fill), rail in zip(rows, [*rails, 0.0], strict=True):
            cells.append((replace(inner, z0=z, z1=z + share * free), columns, fill))
            z += share * free + rail
        return cells

    def _row(self, cell: Rect, columns: int, fill: Fill, front: float) -> list[Body]:
        if columns == 2:
            x, half = cell.middle[0], 0.45 * self.stile
            left, right = replace(cell, x1=x - half), replace(cell, x0=x + half)
            middle = self._bar(replace(cell, x0=x - half, x1=x + half), front)
            return [middle, *self._row(left, 1, fill, front), *self._row(right, 1, fill, front)]
        return {"panel": self._panel, "glass": self._glazing, "louvre": self._louvres}[fill](
            cell, front
        )

    def _bar(
        self,
        rect: Rect,
        front: float,
        *,
        x0: float | None = None,
        x1: float | None = None,
        z0: float | None = None,
        z1: float | None = None,
    ) -> Body:
        """A stile or rail over `rect` or a side of it, its grain along it."""
        low = (x0 or rect.x0, front, rect.z0 if z0 is None else z0)
        high = (x1 or rect.x1, front + self.thickness, rect.z1 if z1 is None else z1)
        return self.stock.board(low, high)

    def _flush(self, rect: Rect, front: float, grooves: int) -> Body:
        whole = slab((rect.x0, front, rect.z0), (rect.x1, front + self.thickness, rect.z1))
        step, cut = rect.height / (grooves + 1), whole
        for k in range(grooves):
            z = rect.z0 + (k + 1) * step
            for y in (front, front + self.thickness):
                vee = prism([(0.004, 0.0), (0.0, 0.004), (-0.004, 0.0), (0.0, -0.004)], rect.width)
                cut = cut - upright(vee, "x").at(rect.x0, y, z)
        stock = replace(self.stock, edge=0.0) if grooves else self.stock
        return stock.piece(cut, contact=(whole,), grain="z")

    def _beads(self, hole: Rect, front: float, inset: float) -> list[Body]:
        """A frame of sloped beads on each face, `inset` below it, around what fills the hole."""
        core = 0.5 * self.thickness - inset - 0.0065
        ring = slab((hole.x0, 0.0, hole.z0), (hole.x1, core, hole.z1))
        ring = ring - _funnel(hole.shrunk(0.003), hole.shrunk(self.bead), 1.02 * core)
        rear, plain = self.thickness - inset, replace(self.stock, edge=0.0)
        return [
            plain.piece(ring.at(0.0, front + inset, 0.0), grain="z"),
            plain.piece(ring.mirrored("y").at(0.0, front + rear, 0.0), grain="z"),
        ]

    def _panel(self, hole: Rect, front: float) -> list[Body]:
        """A panel 13 mm thick in beads; a fielded one rises towards both faces."""
        middle = front + 0.5 * self.thickness
        core = _plate(hole, middle, 0.0065)
        solid, contact = core, [core]
        rise = 0.5 * self.thickness - 0.005
        if self.fielded and min(hole.width, hole.height) > 0.14:
            low, high = hole.shrunk(self.bead + 0.006), hole.shrunk(self.bead + 0.034)
            field = hull(
                [
                    (x, middle + s * y, z)
                    for r, y in ((low, 0.0066), (high, rise))
                    for s in (-1.0, 1.0)
                    for x in (r.x0, r.x1)
                    for z in (r.z0, r.z1)
                ]
            )
            solid, contact = core | field, [core, _plate(high, middle, rise)]
        bodies = [replace(self.stock, edge=0.0).piece(solid, contact=tuple(contact), grain="z")]
        return bodies + self._beads(hole, front, 0.003)

    def _glazing(self, hole: Rect, front: float) -> list[Body]:
        """A pane of 6 mm in beads, bars across it on both faces."""
        middle, (standing, lying) = front + 0.5 * self.thickness, self.bars
        pane = _plate(hole, middle, 0.003)
        half, depth = 0.011, 0.5 * self.thickness - 0.004
        inner = hole.shrunk(self.bead)
        bars = [
            slab((x - half, middle - depth, inner.z0), (x + half, middle + depth, inner.z1))
            for x in np.linspace(inner.x0, inner.x1, standing + 2)[1:-1].tolist()
        ] + [
            slab((inner.x0, middle - depth, z - half), (inner.x1, middle + depth, z + half))
            for z in np.linspace(inner.z0, inner.z1, lying + 2)[1:-1].tolist()
        ]
        beads = self._beads(hole, front, 0.003)
        if not bars:
            return [*beads, self.pane.piece(pane, contact=(pane,))]
        grid = replace(self.stock, edge=0.003).piece(union(bars), contact=tuple(bars), grain="z")
        return [*beads, self.pane.piece(pane, contact=(pane,)), grid]

    def _louvres(self, hole: Rect, front: float) -> list[Body]:
        """Slats that lean forwards at their lower edge and overlap."""
        tilt, thick = math.radians(27.0), 0.007
        width = (self.thickness - 0.004 - thick * math.cos(tilt)) / math.sin(tilt)
        slat = slab((hole.x0, -thick / 2.0, -width / 2.0), (hole.x1, thick / 2.0, width / 2.0))
        slat = slat.turned("x", -tilt)
        half, middle = float(slat.extent[2]) / 2.0, front + 0.5 * self.thickness
        count = max(3, math.ceil((hole.height - 2.0 * half) / 0.034) + 1)
        heights = np.linspace(hole.z0 + half, hole.z1 - half, count).tolist()
        plain = replace(self.stock, edge=0.0)
        contact = _plate(hole, middle, 0.007)
        slats = union([slat.at(0.0, middle, z) for z in heights])
        return [plain.piece(slats, contact=(contact,), grain="x")]


def _funnel(wide: Rect, narrow: Rect, depth: float) -> Solid:
    """From `wide` at y = 0 (and before it) to `narrow` at y = `depth`."""
    ends = ((wide, -0.01), (wide, 0.0), (narrow, 0.75 * depth), (narrow, depth))
    return hull([(x, y, z) for r, y in ends for x in (r.x0, r.x1) for z in (r.z0, r.z1)]) | slab(
        (narrow.x0, 0.0, narrow.z0), (narrow.x1, depth + 0.01, narrow.z1)
    )


def _plate(rect: Rect, middle: float, half: float) -> Solid:
    return slab((rect.x0, middle - half, rect.z0), (rect.x1, middle + half, rect.z1))


def pierced(
    bodies: tuple[Body, ...], hole: Solid, *, clear: Solid | None = None
) -> tuple[Body, ...]:
    """The bodies without `hole`; contact boxes are cut back around `clear`, a box, if it is given.

    What remains of a contact box beside `clear` are up to six boxes.
    """
    low, high = hole.bounds
    cut = []
    for body in bodies:
        (a, b), contact = body.solid.bounds, body.collision
        if clear is not None:
            contact = tuple(piece for box in contact for piece in _boxes_beside(box, clear))
        touched = bool((a < high).all() and (b > low).all())
        solid = body.solid - hole if touched else body.solid
        cut.append(replace(body, solid=solid, collision=contact))
    return tuple(cut)


def _boxes_beside(box: Solid, clear: Solid) -> tuple[Solid, ...]:
    """A cuboid minus a cuboid as cuboids."""
    (low, high), (c0, c1) = box.bounds.copy(), clear.bounds
    if not ((low < c1).all() and (high > c0).all()):
        return (box,)
    pieces = []
    for axis in (2, 0, 1):
        if c0[axis] > low[axis]:
            top = high.copy()
            top[axis] = c0[axis]
            pieces.append(slab(low, top))
            low[axis] = c0[axis]
        if c1[axis] < high[axis]:
            bottom = low.copy()
            bottom[axis] = c1[axis]
            pieces.append(slab(bottom, high))
            high[axis] = c1[axis]
    return tuple(pieces)


def lock_rail_middle(maker: LeafMaker, layout: str, rect: Rect) -> float | None:
    """z of the lock rail's middle; 0.95 m up in a slab; None where a leaf has no such rail."""
    rows = LAYOUTS[layout]
    if not rows:
        return rect.z0 + 0.95 if layout == "flush" else None
    if not 2 <= len(rows) < 5:
        return None
    rails = maker.lock_rail + (len(rows) - 2) * 0.8 * maker.stile
    free = rect.height - maker.bottom_rail - maker.stile - rails
    return rect.z0 + maker.bottom_rail + rows[0][0] * free + maker.lock_rail / 2.0
