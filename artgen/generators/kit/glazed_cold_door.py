"""Glass doors of refrigerators: a frame, an insulating pair of panes, handles, a barrel lock."""

from dataclasses import dataclass
from typing import Literal

from artgen.articulation.types import Body
from artgen.generators.kit.cold_leaf import ColdLeaf
from artgen.generators.kit.density import ABS, ALUMINIUM, GLASS, STEEL
from artgen.generators.kit.door_pull import DoorPull, PullStyle
from artgen.generators.kit.handle import Handle
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, upright

FrameStyle = Literal["metal", "black_glass"]
PANE = 0.004
EASE = 0.0003
"""m; between a pane and its frame."""


@dataclass(frozen=True, kw_only=True)
class GlazedDoor:
    """What is built on a leaf.

    Attributes:
        frame: metal all around, or a printed border under a pane over the whole front.
        rail: width of the frame's sides and top, m.
        low_rail: of its lower side.
        pull: what a hand takes hold of.
        handle: measures of a handle on posts.
        lock: whether there is a barrel lock.
    """

    leaf: ColdLeaf
    frame: FrameStyle
    rail: float
    low_rail: float
    pull: PullStyle
    handle: Handle
    lock: bool

    @property
    def window(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """(x, z) of the lower and the upper corner of the opening, in the leaf's drawing."""
        d = self.leaf
        return (self.rail, self.low_rail), (d.width - self.rail, d.length - self.rail)

    @property
    def works(self) -> DoorPull:
        """What the door is pulled by."""
        d = self.leaf
        level = min(0.5 * d.length, 0.95) if d.length > 1.2 else 0.56 * d.length
        return DoorPull(leaf=d, style=self.pull, handle=self.handle, inset=0.5 * self.rail,
                        level=level)  # fmt: skip

    def bodies(self) -> tuple[Body, ...]:
        """In the object frame; surfaces `frame`, `trim`, `glass`, `seal`, `handle`, `metal`."""
        d = self.leaf
        drawn = [*self._frame(), *self._panes(), d.gasket("seal"), *self.works.bodies()]
        if self.lock:
            drawn.append(self._lock())
        return tuple(d.carried(body) for body in drawn)

    def _contact(self) -> tuple[Solid, ...]:
        d, ((x0, z0), (x1, z1)) = self.leaf, self.window
        f, b = d.front, d.back
        return (
            slab((0.0, f, 0.0), (x0, b, d.length)),
            slab((x1, f, 0.0), (d.width, b, d.length)),
            slab((x0, f, 0.0), (x1, b, z0)),
            slab((x0, f, z1), (x1, b, d.length)),
            slab((x0, f + 0.002, z0), (x1, b - 0.002, z1)),
        )

    def _frame(self) -> list[Body]:
        """Outer frame and, behind it, the plastic one that the gasket sits in."""
        d = self.leaf
        split = d.front + 0.62 * d.thickness
        face = d.front + (PANE if self.frame == "black_glass" else 0.0)
        opening = self._plate(face - 0.01, d.back + 0.01, grown=0.0)
        outer = d.slab(front=face, back=split) - opening - d.bores()
        for room in self.works.room():
            outer = outer - room
        inner = d.slab(front=split, back=d.back, inset=0.0015) - opening - d.bores()
        return [
            Body(solid=outer, surface="frame", density=0.34 * ALUMINIUM, edge=0.0022,
                 collision=self._contact()),
            Body(solid=inner, surface="trim", density=0.6 * ABS, edge=0.001),
        ]  # fmt: skip

    def _panes(self) -> list[Body]:
        """Two panes; the outer one covers the whole front over a printed border."""
        d = self.leaf
        if self.frame == "black_glass":
            outer = d.slab(front=d.front, back=d.front + PANE - EASE, inset=0.0008)
            for room in self.works.room():
                outer = outer - room
        else:
            outer = self._plate(d.front + 0.004, d.front + 0.004 + PANE, grown=-EASE)
        low = d.back - 0.004 - PANE
        inner = self._plate(low, low + PANE, grown=-EASE)
        spacer = self._plate(d.front + 0.010, low - EASE, grown=-EASE) - self._plate(
            d.front, d.back, grown=-0.009
        )
        return [
            Body(solid=outer, surface="glass", density=GLASS),
            Body(solid=inner, surface="glass", density=GLASS),
            Body(solid=spacer, surface="spacer", density=0.3 * ALUMINIUM),
        ]

    def _plate(self, front: float, back: float, *, grown: float) -> Solid:
        (x0, z0), (x1, z1) = self.window
        outline = rounded_rectangle(
            z1 - z0 + 2.0 * grown, x1 - x0 + 2.0 * grown, 0.006 + grown, segments=2
        )
        solid = upright(prism(outline, back - front), "y")
        return solid.at(x=(x0 + x1) / 2.0, y=front, z=(z0 + z1) / 2.0)

    def _lock(self) -> Body:
        """A barrel with its slit in the lower rail."""
        d = self.leaf
        x, z = d.width - 0.5 * self.rail, 0.5 * self.low_rail
        barrel = cylinder(0.009, 0.006, axis="y", segments=18).at(x, d.front - 0.0035, z)
        slit = slab(
            (x - 0.0009, d.front - 0.01, z - 0.005), (x + 0.0009, d.front - 0.0015, z + 0.005)
        )
        return Body(solid=barrel - slit, surface="metal", density=STEEL)
