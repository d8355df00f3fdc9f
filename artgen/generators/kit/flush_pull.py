"""A pull let into the face of a sliding leaf: a rimmed cup for the fingers."""

from dataclasses import dataclass

from artgen.articulation.types import Body, Grip
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, upright

DEEP, RIM, PROUD = 0.011, 0.006, 0.0012
"""Depth of the cup, width of its rim and how far the rim stands out, m."""


@dataclass(frozen=True, kw_only=True)
class FlushPull:
    """A cup in a face; `out` is -1 where the face looks to -y, +1 where it looks to +y.

    Attributes:
        at: (x, z) of its middle, m.
        face: y of the face, m.
        size: width and height of the rim, m.
        pull: direction in which the leaf is drawn, along x.
    """

    at: tuple[float, float]
    face: float
    out: float
    size: tuple[float, float]
    pull: float

    def recess(self) -> Solid:
        """What the leaf must leave free."""
        return self._block(0.0006, -0.01, DEEP)

    def body(self, metal: Stock) -> Body:
        """Rim, walls and floor of the cup."""
        rim = self._block(0.0, -PROUD, 0.0) - self._block(RIM, -0.02, 0.0)
        cup = self._block(0.0006, 0.0, DEEP) - self._block(RIM, -0.02, DEEP - 0.0015)
        return metal.piece(rim | cup)

    def grip(self, name: str) -> Grip:
        """Where fingers hook in."""
        return Grip(
            name=name,
            kind="handle",
            position=(self.at[0], self.face, self.at[1]),
            outward=(0.0, self.out, 0.0),
            pull=(self.pull, 0.0, 0.0),
        )

    def _block(self, inset: float, start: float, stop: float) -> Solid:
        """The rim's outline, inset, from `start` to `stop` under the face."""
        w, h = self.size[0] - 2.0 * inset, self.size[1] - 2.0 * inset
        outline = rounded_rectangle(h, w, min(w, h) * 0.35, segments=4)
        solid = upright(prism(outline, stop - start), "y").at(0.0, start, 0.0)
        if self.out > 0.0:
            solid = solid.mirrored("y")
        return solid.at(self.at[0], self.face, self.at[1])
