"""Boards and the stock they are cut from."""

from collections.abc import Sequence
from dataclasses import dataclass

from artgen.articulation.types import Axis, Body
from artgen.geometry.solid import Solid, slab


@dataclass(frozen=True, kw_only=True)
class Stock:
    """What pieces are cut from: a surface, its density (kg/m3) and how far edges are eased (m)."""

    surface: str
    density: float
    edge: float = 0.001

    def board(
        self, lower: Sequence[float], upper: Sequence[float], *, grain: Axis | None = None
    ) -> Body:
        """The cuboid between two corners, solid to the touch; grain along its longest side."""
        solid = slab(lower, upper)
        return self.piece(solid, contact=(solid,), grain=grain)

    def piece(
        self, solid: Solid, *, contact: tuple[Solid, ...] = (), grain: Axis | None = None
    ) -> Body:
        """Any shape; `contact` are the convex solids that stand for it."""
        return Body(
            solid=solid,
            surface=self.surface,
            density=self.density,
            edge=self.edge,
            collision=contact,
            grain=grain,
        )
