"""Armrests of office chairs: pads on posts that rise from sleeves, or on fixed loops."""

from dataclasses import dataclass, replace

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.bent_strip import bent_strip
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cushion import COARSE, pad, plan, upholstered
from artgen.geometry.solid import slab

POST = (0.016, 0.046)
"""m; section of the post that slides, along x and y."""
PLAY = 0.0012
WALL = 0.0045
PAD = 0.026


@dataclass(frozen=True, kw_only=True)
class Armrest:
    """One armrest, drawn on the side of +x.

    Attributes:
        x: of its middle, m.
        y: of its post, m.
        mount: z of the pan's lower face, to which the bracket is screwed, m.
        top: z of the pad's surface at rest, m.
        length: of the pad, m.
        width: of the pad, m.
        travel: how far it rises, m.
    """

    x: float
    y: float
    mount: float
    top: float
    length: float
    width: float
    travel: float

    @property
    def sleeve_ends(self) -> tuple[float, float]:
        """Lower and upper end of the sleeve, m."""
        return self.mount + 0.030, self.top - PAD - 0.024

    def sleeve(self, stock: Stock) -> list[Body]:
        """The bracket under the pan and the sleeve for the post."""
        low, high = self.sleeve_ends
        arm = bent_strip(
            [(self.mount - 0.005, 0.10), (self.mount - 0.005, self.x), (low + 0.01, self.x)],
            bend=0.022, thickness=0.009, width=0.055, across="y",
        ).at(y=self.y)  # fmt: skip
        hx, hy = POST[0] / 2.0 + PLAY, POST[1] / 2.0 + PLAY
        bore = slab((self.x - hx, self.y - hy, low + 0.004), (self.x + hx, self.y + hy, high + 0.1))
        outer = slab((self.x - hx - WALL, self.y - hy - WALL, low),
                     (self.x + hx + WALL, self.y + hy + WALL, high))  # fmt: skip
        level = slab((0.10, self.y - 0.0275, self.mount - 0.0095),
                     (self.x, self.y + 0.0275, self.mount - 0.0005))  # fmt: skip
        wall = slab((self.x + hx, self.y - hy, low), (self.x + hx + WALL, self.y + hy, high))
        other = slab((self.x - hx - WALL, self.y - hy, low), (self.x - hx, self.y + hy, high))
        return [
            stock.piece(arm - bore, contact=(level,)),
            stock.piece(outer - bore, contact=(wall, other)),
        ]

    def part(self, name: str, post: Stock, soft: Stock) -> DraftPart:
        """Post and pad of one that rises."""
        low, high = self.sleeve_ends
        foot = max(low + 0.006, high - self.travel - 0.045)
        bar = slab((self.x - POST[0] / 2.0, self.y - POST[1] / 2.0, foot),
                   (self.x + POST[0] / 2.0, self.y + POST[1] / 2.0, self.top - PAD))  # fmt: skip
        plate = slab((self.x - 0.024, self.y - 0.06, self.top - PAD - 0.006),
                     (self.x + 0.024, self.y + 0.06, self.top - PAD + 0.002))  # fmt: skip
        hold = Grip(
            name=f"{name}_pad",
            kind="handle",
            position=(self.x, self.y, self.top - PAD / 2.0),
            outward=(1.0, 0.0, 0.0),
            pull=(0.0, 0.0, 1.0),
        )
        bodies = (post.piece(bar, contact=(bar,)), post.piece(plate), self._pad(soft))
        return DraftPart(name=name, label="armrest", bodies=bodies, grips=(hold,))

    def joint(self, name: str) -> Joint:
        """Up by +q; the catch in the sleeve acts as friction."""
        return Joint(
            name=f"{name}_lift",
            type="prismatic",
            parent="seat",
            child=name,
            axis=(0.0, 0.0, 1.0),
            limit=Limit(lower=0.0, upper=self.travel),
            friction=22.0,
            damping=15.0,
            effort=90.0,
        )

    def loop(self, stock: Stock, soft: Stock) -> list[Body]:
        """A closed loop with its pad, fixed to the pan."""
        y0, y1 = self.y - 0.40 * self.length, self.y + 0.42 * self.length
        z0, z1 = self.mount - 0.006, self.top - PAD - 0.004
        corners = [(y0 + 0.10, z0), (y0, z1), (y1, z1), (y1 - 0.02, z0)]
        loop = bent_strip(corners, bend=0.035, thickness=0.022, width=0.042, across="x").at(self.x)
        foot = slab((0.12, y0 + 0.085, z0 - 0.006), (self.x + 0.021, y1 - 0.005, z0 + 0.006))
        rail = slab(
            (self.x - 0.020, y0 + 0.02, z1 - 0.010), (self.x + 0.020, y1 - 0.01, z1 + 0.010)
        )
        post = slab((self.x - 0.020, y1 - 0.026, z0), (self.x + 0.020, y1 - 0.004, z1 - 0.01))
        return [
            stock.piece(loop, contact=(rail, post)),
            replace(stock, edge=0.0).piece(foot, contact=(foot,)),
            self._pad(soft),
        ]

    def _pad(self, soft: Stock) -> Body:
        outline = plan(self.width, self.length, 0.42 * self.width, segments=3)
        steps = upholstered(
            PAD - 0.004, roll=0.010, crown=0.004, reach=self.width / 2.0, rings=COARSE
        )

        def lie(flat: Floats) -> Floats:
            bend = flat.copy()
            bend[:, 2] += self.top - PAD - 0.006 * (2.0 * flat[:, 1] / self.length) ** 2
            return np.asarray(bend + np.array((self.x, self.y - 0.02, 0.0)))

        half, long = 0.42 * self.width, 0.45 * self.length
        touch = slab((self.x - half, self.y - 0.02 - long, self.top - PAD),
                     (self.x + half, self.y - 0.02 + long, self.top - 0.005))  # fmt: skip
        return soft.piece(pad(outline, steps, lie), contact=(touch,))
