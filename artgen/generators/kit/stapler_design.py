"""What a stapler's numbers mean. Places count from the hinge: y = 0 there, the mouth at -y."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.profile import arc

CHANNEL = 0.0074
"""m; half of the magazine's width: staples 26/6 are 12.8 mm wide."""
SHEET = 0.0011
PLAY = 0.0012
"""m; between neighbors on the hinge pin."""
PIN = 0.0024
"""m; radius of the hinge pin."""
ANVIL = 0.0016
"""m; by which the anvil stands out of the base."""
SIZES = {"full": 1.0, "half": 0.72, "mini": 0.42, "long_reach": 1.85, "heavy": 1.4}
"""Length of the magazine by kind, in that of a full strip."""


@dataclass(frozen=True, kw_only=True)
class StaplerParams:
    """Sampled by category_rules/stapler.toml; lengths in m, angles in degrees."""

    kind: str
    length: float
    action: str
    shape: str
    arm_width: float
    arm_wall: float
    arm_height: float
    nose_height: float
    base_width: float
    base_height: float
    base_round: float
    overhang: float
    tail: float
    gap: float
    opening: float
    anvil_turns: bool
    anvil: float
    staples: float
    follower: float
    pad: bool
    inlay: bool
    lift: float
    hinge_friction: float
    stop_place: float
    brand: int
    one_color: bool

    @property
    def bulk(self) -> float:
        """Breadth and height relative to a full strip's."""
        return {"mini": 0.86, "heavy": 1.35}.get(self.kind, 1.0)

    @cached_property
    def mouth(self) -> float:
        """y of the magazine's front."""
        return -self.length * SIZES[self.kind]

    @property
    def pivot(self) -> float:
        """z of the hinge."""
        return self.base_top + self.clear + 0.0080

    @property
    def tacks(self) -> bool:
        """Whether the magazine opens up; else it is pressed down."""
        return self.action == "tack" or self.kind == "long_reach"

    @property
    def clear(self) -> float:
        """Between base and magazine; what is pressed turns by 3 degrees at least."""
        return self.gap if self.tacks else max(self.gap, 0.0525 * -self.mouth + ANVIL + 0.0014)

    @property
    def base_top(self) -> float:
        """z of the base's upper face."""
        return 0.002 + self.base_height * self.bulk

    @property
    def press(self) -> float:
        """rad by which the magazine turns until it meets the anvil, less a millimeter."""
        return math.asin((self.clear - ANVIL - 0.0012) / -self.mouth)

    @property
    def arm_half(self) -> tuple[float, float]:
        """Inner and outer half width of the arm."""
        inner = CHANNEL + PLAY
        outer = max(inner + self.arm_wall, 0.5 * self.arm_width * self.bulk)
        return inner, outer

    @property
    def ear(self) -> tuple[float, float]:
        """Half widths of the base's hinge ears."""
        low = self.arm_half[1] + PLAY
        return low, low + 0.0026

    @property
    def base_half(self) -> float:
        """Half width of the base."""
        wide = 1.6 if self.kind == "long_reach" else 1.0
        return max(0.5 * self.base_width * wide * self.bulk, self.ear[1] + 0.002)

    @property
    def arm_front(self) -> float:
        """y of the arm's front face."""
        return self.mouth - 0.0016 - self.arm_wall

    @property
    def arm_round(self) -> float:
        """Radius of the arm's end around the pin."""
        return 0.0124

    @property
    def opened(self) -> float:
        """rad by which the arm opens for loading."""
        return math.radians(self.opening)

    @cached_property
    def profile(self) -> Floats:
        """(N, 2) convex outline of the arm in (y, z) about the pin, counter-clockwise."""
        front, low, r = self.arm_front, -0.0052, self.arm_round
        top = max(self.arm_height * self.bulk, r + 0.001)
        nose = max(self.nose_height * self.bulk, 0.0105)
        bow = 0.006 if self.kind != "mini" else 0.004
        back = arc((0.0, 0.0), r, -0.5 * math.pi, 0.62 * math.pi, 9)
        corner = arc((front + bow, nose - bow), bow, 0.55 * math.pi, math.pi, 5)
        share = {"classic": (0.25, 0.70), "humped": (0.42, 0.55), "wedge": (0.16, 0.28)}[self.shape]
        ridge = [(front * s, top) for s in share]
        if self.shape == "humped":
            ridge = [
                (front * s, top * k)
                for s, k in ((0.30, 0.93), *((s, 1.0) for s in share), (0.70, 0.93))
            ]
        outline = np.concatenate([back, ridge, corner, [(front, low), (-0.02, -r)]])
        return convex_outline(outline)


def convex_outline(points: Floats) -> Floats:
    """(N, 2) corners of the convex hull of points, counter-clockwise (monotone chain)."""
    ordered = sorted({(float(x), float(y)) for x, y in points})
    chains = []
    for run in (ordered, ordered[::-1]):
        chain: list[tuple[float, float]] = []
        for p in run:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 1e-9:
                chain.pop()
            chain.append(p)
        chains.append(chain[:-1])
    return np.array(chains[0] + chains[1])


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def inset_convex(outline: Floats, by: float) -> Floats:
    """(N, 2) a convex counter-clockwise outline with every side moved inwards by `by` m."""
    following = np.roll(outline, -1, axis=0)
    way = following - outline
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    normal = np.stack([-way[:, 1], way[:, 0]], axis=1)
    reach = (normal * outline).sum(axis=1) + by
    before = np.roll(normal, 1, axis=0)
    both = np.stack([before, normal], axis=1)
    sides = np.stack([np.roll(reach, 1), reach], axis=1)
    return np.asarray(np.linalg.solve(both, sides[..., None])[..., 0])
