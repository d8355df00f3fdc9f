"""Frames of windows: members, stops or tracks, transom, window board, drip sill, trim."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.solid import loft, slab

OVERLAP, AIR = 0.009, 0.012
"""How far a rebated sash overlaps its frame, and the air between frame and sash behind, m."""


@dataclass(frozen=True, kw_only=True)
class WindowFrame:
    """A frame whose face lies in y = 0 and looks to -y; the room is there.

    Attributes:
        outer: over the frame, m.
        member: width of its members.
        depth: along y.
        stock: what it is made of.
        seal: of the seals that sashes close against.
    """

    outer: Rect
    member: float
    depth: float
    stock: Stock
    seal: Stock

    @property
    def opening(self) -> Rect:
        """Between the members."""
        return self.outer.shrunk(self.member)

    def members(self) -> list[Body]:
        """Jambs over the full height, head and foot between them."""
        o, i, d = self.outer, self.opening, self.depth
        spans = (
            (o.x0, i.x0, o.z0, o.z1), (i.x1, o.x1, o.z0, o.z1),
            (i.x0, i.x1, o.z0, i.z0), (i.x0, i.x1, i.z1, o.z1),
        )  # fmt: skip
        return [
            self.stock.board((x0, 0.0, z0), (x1, d, z1), grain="z" if k < 2 else "x")
            for k, (x0, x1, z0, z1) in enumerate(spans)
        ]

    def divider(self, lower: tuple[float, float], upper: tuple[float, float]) -> Body:
        """A mullion or transom between two (x, z) corners, over the whole depth."""
        return self.stock.board((lower[0], 0.0, lower[1]), (upper[0], self.depth, upper[1]))

    def ledges(self, light: Rect, y0: float, y1: float, width: float) -> list[Body]:
        """Strips around a light that stand into it by `width` between two depths."""
        inner = light.shrunk(width)
        spans = (
            (light.x0, inner.x0, light.z0, light.z1), (inner.x1, light.x1, light.z0, light.z1),
            (inner.x0, inner.x1, light.z0, inner.z0), (inner.x0, inner.x1, inner.z1, light.z1),
        )  # fmt: skip
        return [self.stock.board((x0, y0, z0), (x1, y1, z1)) for x0, x1, z0, z1 in spans]

    def gasket(self, light: Rect, *, y: float, width: float, thick: float) -> Body:
        """A seal around a light, before the plane `y`, `width` inside the light's edge or, when
        negative, outside it."""
        edge = light.shrunk(width)
        wide, narrow = (edge.shrunk(-0.004), edge) if width < 0.0 else (edge, edge.shrunk(0.004))
        ring = slab((wide.x0, y - thick, wide.z0), (wide.x1, y, wide.z1)) - slab(
            (narrow.x0, y - 1.0, narrow.z0), (narrow.x1, y + 1.0, narrow.z1)
        )
        return self.seal.piece(ring)

    def board(self, stock: Stock, *, reach: float, ears: float) -> Body:
        """The window board below the frame, towards the room."""
        o, thick = self.outer, 0.022
        low = (o.x0 - ears, -reach, o.z0 - thick)
        return stock.board(low, (o.x1 + ears, self.depth * 0.4, o.z0), grain="x")

    def drip(self, stock: Stock) -> Body:
        """A sloped sheet outside that sheds the rain."""
        o, d = self.outer, self.depth
        low = o.z0 + 0.010
        section = np.array(
            [(d, low - 0.022), (d + 0.075, low - 0.040), (d + 0.075, low - 0.012), (d, low + 0.006)]
        )
        rings = [np.c_[np.full(4, x), section] for x in (o.x0 - 0.02, o.x1 + 0.02)]
        solid = loft(rings)
        return stock.piece(solid, contact=(solid,), grain="x")

    def trim(self, stock: Stock, *, width: float, proud: float) -> list[Body]:
        """Casing around head and jambs on the room's side, with a head that stands out."""
        o = replace(self.outer.shrunk(0.012), z0=self.outer.z0)
        sides: Sequence[tuple[float, float]] = ((o.x0 - width, o.x0), (o.x1, o.x1 + width))
        bodies = [stock.board((a, -proud, o.z0), (b, 0.0, o.z1), grain="z") for a, b in sides]
        low, over = (o.x0 - width - 0.008, -proud - 0.005, o.z1), 0.008
        head = stock.board(low, (o.x1 + width + over, 0.0, o.z1 + width), grain="x")
        return [*bodies, head]
