"""What a refrigerator's leaf is pulled by: handles on posts, edge profiles, finger grooves."""

from dataclasses import dataclass
from typing import Literal

from artgen.articulation.types import Body, Grip
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cold_leaf import ColdLeaf
from artgen.generators.kit.density import ALUMINIUM
from artgen.generators.kit.handle import Handle
from artgen.geometry.solid import Solid, slab, union

PullStyle = Literal["bar", "square", "bow", "profile", "groove"]
GROOVE = (0.016, 0.008, 0.022)
"""m; how far a groove reaches in from the edge, and where it begins and ends behind the face."""


@dataclass(frozen=True, kw_only=True)
class DoorPull:
    """On a leaf's free edge (a door) or on its upper edge (a drawer's front).

    Attributes:
        handle: measures of a handle on posts.
        inset: from the edge to the handle's axis, m.
        level: z of the middle of a door's handle, in the leaf's drawing.
    """

    leaf: ColdLeaf
    style: PullStyle
    handle: Handle
    inset: float
    level: float
    drawer: bool = False

    def room(self) -> tuple[Solid, ...]:
        """What the leaf must leave free for fingers."""
        if self.style != "groove":
            return ()
        d, (deep, start, end) = self.leaf, GROOVE
        low, high = d.front + start, d.front + end
        if self.drawer:
            return (slab((0.05, low, d.length - deep), (d.width - 0.05, high, d.length + 0.01)),)
        return (slab((d.width - deep, low, 0.05), (d.width + 0.01, high, d.length - 0.05)),)

    def bodies(self) -> tuple[Body, ...]:
        """In the leaf's drawing; they wear `handle`."""
        d = self.leaf
        edge = 0.0 if self.style in ("bar", "bow") else 0.0008  # Round ones have no edges to ease.
        stock = Stock(surface="handle", density=0.5 * ALUMINIUM, edge=edge)
        if self.style == "groove":
            return ()
        if self.style == "profile":
            legs = self._profile()
            return (stock.piece(union(legs), contact=legs),)
        if self.drawer:
            return (self.handle.at(d.width / 2.0, d.front, d.length - self.inset, "x", stock),)
        return (self.handle.at(d.width - self.inset, d.front, self.level, "z", stock),)

    def grip(self) -> Grip:
        """Where the hand closes."""
        d = self.leaf
        away = {"profile": 0.006, "groove": 0.004}.get(self.style, self.inset)
        y = d.front + {"profile": -0.012, "groove": 0.006}.get(self.style, -self.handle.standoff)
        middle = self.style in ("profile", "groove")
        kind: Literal["handle", "edge"] = "edge" if self.style == "groove" else "handle"
        if self.drawer:
            return d.grip(d.width / 2.0, y, d.length - away, kind)
        return d.grip(d.width - away, y, 0.5 * d.length if middle else self.level, kind)

    def _profile(self) -> tuple[Solid, Solid]:
        """A leg that stands out from the edge, and its lip."""
        d, e = self.leaf, 0.0015
        y0, y1, y2 = d.front - 0.026, d.front - 0.0215, d.front + 0.001
        if self.drawer:
            z = d.length
            return (slab((e, y0, z - 0.0045), (d.width - e, y2, z)),
                    slab((e, y0, z - 0.018), (d.width - e, y1, z)))  # fmt: skip
        x = d.width
        return (slab((x - 0.0045, y0, e), (x, y2, d.length - e)),
                slab((x - 0.018, y0, e), (x, y1, d.length - e)))  # fmt: skip
