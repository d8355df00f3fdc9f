"""Backs of office chairs: stretched nets, padded shells, high backs of stacked cushions."""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cushion import pad, piping, plan, upholstered
from artgen.geometry.solid import Solid, loft, slab, union, wire

Style = Literal["net", "shell", "panels"]
SHELL = 0.010
"""m; thickness of a padded back's shell."""
AIR = 0.0018
"""m; between the shell and its cushions, so that chords of one do not cut the other."""
FRAME = 0.0095
"""m; radius of a net's frame."""


@dataclass(frozen=True, kw_only=True)
class ChairBack:
    """A back that faces -y, bent around the sitter and over the lumbar spine.

    Attributes:
        style: net in a frame, padded shell, or a shell with cushions one above the other.
        width: m.
        height: m.
        low: z of the lower edge, m.
        front: y of the middle of the lower edge, m.
        lean: how far it leans back a meter of height.
        bow: how far its sides come forward, m.
        lumbar: how far it swells forward at the small of the back, m.
        corner: radius of the corners, m.
        taper: how much narrower it is at the top, as a share.
        padding: thickness of the cushions, m.
        cushions: how many, one above the other.
    """

    style: Style
    width: float
    height: float
    low: float
    front: float
    lean: float
    bow: float
    lumbar: float
    corner: float
    taper: float
    padding: float
    cushions: int

    def place(self, flat: Floats) -> Floats:
        """(N, 3) of (across, height from the middle, out of the back) to the object's frame."""
        rise = flat[:, 1] + self.height / 2.0
        x = flat[:, 0] * (1.0 - self.taper * np.clip(rise / self.height, 0.0, 1.0) ** 2)
        return np.c_[x, self._depth(x, rise) - flat[:, 2], self.low + rise]

    def _depth(self, x: Floats, rise: Floats) -> Floats:
        small = (rise - 0.30 * self.height) / (0.34 * self.height)
        swell = self.lumbar * np.clip(1.0 - small * small, 0.0, 1.0) ** 2
        return np.asarray(
            self.front + self.lean * rise - swell - self.bow * (2.0 * x / self.width) ** 2
        )

    def behind(self, rise: float) -> float:
        """y of the shell's or net's rear face in the middle at a height above the lower edge, m."""
        middle = float(self._depth(np.zeros(1), np.full(1, rise))[0])
        return middle + (0.002 if self.style == "net" else SHELL)

    def bodies(self, cover: Stock, shell: Stock, cord: Stock) -> list[Body]:
        """The back without what carries it; contact pieces lie along its bend."""
        if self.style == "net":
            return self._net(cover, shell)
        outline = plan(self.width, self.height, self.corner)
        inner = [0.5 * share * self.width for share in (0.3, 0.6, 0.92)]
        rear_face = [(inset, -SHELL) for inset in reversed(inner)]
        front_face = [(inset, -0.0010) for inset in inner]
        edge = [(0.003, -SHELL), (0.0, -0.6 * SHELL), (0.0, -0.002), (0.002, -0.0010)]
        steps = [*rear_face, *edge, *front_face]
        rear = replace(shell, edge=0.0).piece(pad(outline, steps, self.place))
        bodies = [rear]
        for low, high in self._shares():
            bodies += self._cushion(low, high, cover, cord)
        return bodies

    def _shares(self) -> list[tuple[float, float]]:
        """Lower and upper edge of each cushion, from the middle, m."""
        count = self.cushions if self.style == "panels" else 1
        edge, gap = 0.010, 0.003
        clear = self.height - 2.0 * edge + gap
        cuts = [edge + clear * k / count - self.height / 2.0 for k in range(count + 1)]
        return [(a, b - gap) for a, b in pairwise(cuts)]

    def _cushion(self, low: float, high: float, cover: Stock, cord: Stock) -> list[Body]:
        width = self.width - 0.020
        radius = min(0.8 * self.corner, 0.45 * (high - low))
        outline = plan(width, high - low, radius, segments=3)
        roll = min(0.6 * self.padding, 0.025)
        steps = upholstered(
            0.75 * self.padding,
            roll=roll,
            crown=0.25 * self.padding,
            reach=min(width, high - low) / 2,
            rings=(2, 4, 3) if self.style == "shell" else (2, 3, 2),
            under=(0.9, 0.45) if self.style == "shell" else (0.6,),
        )

        def bend(flat: Floats) -> Floats:
            return self.place(flat + np.array((0.0, (low + high) / 2.0, AIR)))

        contact = self._contact(SHELL, 0.8 * self.padding, low, high)
        soft = cover.piece(pad(outline, steps, bend), contact=contact)
        if self.style == "panels":
            return [soft]
        seam = piping(outline, (0.0005, 0.45 * self.padding), bend, 0.0022)
        return [soft, cord.piece(seam)]

    def _net(self, cover: Stock, frame: Stock) -> list[Body]:
        """A bent tube, and bands across it with gaps one sees through."""
        outline = plan(self.width - 2 * FRAME, self.height - 2 * FRAME, self.corner)
        rim = wire(self.place(np.c_[outline, np.zeros(len(outline))]), FRAME, sides=6, closed=True)
        bands = [self._band(outline, h) for h in self._band_heights()]
        frame_body = replace(frame, edge=0.0).piece(rim, contact=self._contact(0.004, 0.004))
        return [cover.piece(union(bands)), frame_body]

    def _band_heights(self) -> list[float]:
        half = self.height / 2.0 - FRAME - 0.006
        count = round(2.0 * half / 0.0132)
        return [-half + 2.0 * half * (k + 0.5) / count for k in range(count)]

    def _band(self, outline: Floats, h: float) -> Solid:
        """One band from rim to rim."""
        reach = _half_width(outline, h)
        rings = []
        for x in np.linspace(-reach, reach, 5):
            section = [(x, h + a, b) for a, b in ((-0.0046, -0.0006), (0.0046, -0.0006),
                                                  (0.0046, 0.0006), (-0.0046, 0.0006))]  # fmt: skip
            rings.append(self.place(np.array(section)))
        return loft(rings)

    def _contact(
        self, behind: float, before: float, low: float | None = None, high: float | None = None
    ) -> tuple[Solid, ...]:
        """Cuboids along the bend, three across and as many up as keep within it."""
        low = -self.height / 2.0 if low is None else low
        high = self.height / 2.0 if high is None else high
        rows = max(1, round((high - low) / 0.17))
        edges = [low + (high - low) * k / rows for k in range(rows + 1)]
        pieces = []
        for a, b in pairwise(edges):
            for left, right in ((-0.47, -0.2), (-0.2, 0.2), (0.2, 0.47)):
                flat = np.array([(left * self.width, (a + b) / 2, 0), (right * self.width, a, 0)])
                middle = np.array([((left + right) / 2 * self.width, (a + b) / 2.0, 0.0)])
                (x0, _, _), (x1, _, _) = self.place(flat)
                _, y, _ = self.place(middle)[0]
                pieces.append(
                    slab((x0, y - before - 0.001, self.low + self.height / 2 + a),
                         (x1, y + behind + 0.001, self.low + self.height / 2 + b))
                )  # fmt: skip
        return tuple(pieces)


def _half_width(outline: Floats, h: float) -> float:
    """How far the outline reaches at a height, m."""
    following = np.roll(outline, -1, axis=0)
    low, high = outline[:, 1], following[:, 1]
    hit = (np.minimum(low, high) <= h) & (np.maximum(low, high) > h)
    share = (h - low[hit]) / (high - low)[hit]
    return float(np.abs(outline[hit, 0] + share * (following - outline)[hit, 0]).max())
