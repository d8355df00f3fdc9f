"""A glazed frame: stiles and rails around an insulating pane with beads, seals and glazing bars."""

from dataclasses import dataclass, replace

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.solid import Solid, slab, union

BEAD, SEAL = 0.013, 0.0025
"""Width of a glazing bead, and of the seal that shows beside it, m."""


@dataclass(frozen=True, kw_only=True)
class SashMaker:
    """How sashes of one window are made.

    Attributes:
        stock: of the frame members.
        pane: of the glass.
        seal: of the seals on the glass.
        spacer: of the bar between two panes.
        member: width of stiles and rails, m.
        bars: glazing bars that stand and that lie.
        unit: thickness of the pane: over 10 mm it is an insulating one, m.
    """

    stock: Stock
    pane: Stock
    seal: Stock
    spacer: Stock
    member: float
    bars: tuple[int, int]
    unit: float

    def sash(self, rect: Rect, y0: float, y1: float) -> tuple[Body, ...]:
        """A plain sash over `rect` between the planes y0 and y1."""
        return (*self.members(rect, y0, y1), *self.glazing(rect.shrunk(self.member), y0, y1))

    def rebated(
        self, rect: Rect, y0: float, y1: float, *, lip: float, reach: float
    ) -> tuple[Body, ...]:
        """A sash whose front overlaps its frame: over `rect` only to the depth `lip`, then smaller
        by `reach` on each side."""
        inner = rect.shrunk(reach)
        slim = replace(self, member=self.member - reach)
        fronts = [body.solid for body in self.members(rect, y0, y0 + lip)]
        rears = [body.solid for body in slim.members(inner, y0 + lip, y1)]
        bodies = [
            self.stock.piece(front | rear, contact=(front, rear))
            for front, rear in zip(fronts, rears, strict=True)
        ]
        return (*bodies, *self.glazing(rect.shrunk(self.member), y0, y1))

    def members(self, rect: Rect, y0: float, y1: float) -> tuple[Body, ...]:
        """Two stiles over the full height and two rails between them."""
        inner = rect.shrunk(self.member)
        return (
            self.stock.board((rect.x0, y0, rect.z0), (inner.x0, y1, rect.z1), grain="z"),
            self.stock.board((inner.x1, y0, rect.z0), (rect.x1, y1, rect.z1), grain="z"),
            self.stock.board((inner.x0, y0, rect.z0), (inner.x1, y1, inner.z0), grain="x"),
            self.stock.board((inner.x0, y0, inner.z1), (inner.x1, y1, rect.z1), grain="x"),
        )

    def glazing(self, light: Rect, y0: float, y1: float) -> list[Body]:
        """What fills a light: panes, spacer, seals, beads on both faces, bars."""
        middle, half = (y0 + y1) / 2.0, self.unit / 2.0
        beads = [
            replace(self.stock, edge=0.003).piece(_ring(light, BEAD, low, high), grain="x")
            for low, high in ((y0 + 0.004, middle - half), (middle + half, y1 - 0.004))
        ]
        seals = [
            self.seal.piece(_ring(light, BEAD + SEAL, low, high))
            for low, high in (
                (middle - half - 0.0015, middle - half),
                (middle + half, middle + half + 0.0015),
            )
        ]
        return [*self._panes(light, middle), *seals, *beads, *self._bars(light, y0, y1)]

    def _panes(self, light: Rect, middle: float) -> list[Body]:
        """One pane; an insulating unit is a block of its thickness with the spacer let in, so that
        light crosses two faces, and weighs as its two sheets of 4 mm."""
        half = self.unit / 2.0
        whole = _plate(light, middle - half, middle + half)
        if self.unit < 0.010:
            return [self.pane.piece(whole, contact=(whole,))]
        unit = replace(self.pane, density=self.pane.density * 0.008 / self.unit)
        spacer = _ring(light, BEAD + 0.006, middle - half + 0.004, middle + half - 0.004)
        return [unit.piece(whole, contact=(whole,)), self.spacer.piece(spacer)]

    def _bars(self, light: Rect, y0: float, y1: float) -> list[Body]:
        """On both faces of the glass, as they are glued on."""
        (standing, lying), middle, half = self.bars, (y0 + y1) / 2.0, self.unit / 2.0
        inner, w = light.shrunk(BEAD), 0.011
        bodies = []
        for low, high in ((y0 + 0.006, middle - half), (middle + half, y1 - 0.006)):
            bars = [
                slab((x - w, low, inner.z0), (x + w, high, inner.z1))
                for x in np.linspace(inner.x0, inner.x1, standing + 2)[1:-1].tolist()
            ] + [
                slab((inner.x0, low, z - w), (inner.x1, high, z + w))
                for z in np.linspace(inner.z0, inner.z1, lying + 2)[1:-1].tolist()
            ]
            if bars:
                stock = replace(self.stock, edge=0.002)
                bodies.append(stock.piece(union(bars), contact=tuple(bars), grain="z"))
        return bodies


def _plate(rect: Rect, y0: float, y1: float) -> Solid:
    return slab((rect.x0, y0, rect.z0), (rect.x1, y1, rect.z1))


def _ring(rect: Rect, width: float, y0: float, y1: float) -> Solid:
    return _plate(rect, y0, y1) - _plate(rect.shrunk(width), y0 - 1.0, y1 + 1.0)
