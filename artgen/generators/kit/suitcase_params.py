"""Params of suitcases, and the halves and casters that follow from them."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.generators.kit.caster import Caster
from artgen.generators.kit.clamshell import HalfShell
from artgen.generators.kit.suitcase_fittings import FROM_FACE, bottom_of

SIZES: Mapping[str, tuple[float, float, float]] = {
    "cabin": (0.37, 0.235, 0.55),
    "medium": (0.45, 0.275, 0.67),
    "large": (0.51, 0.305, 0.77),
}
"""Width, depth and height with wheels, m; a cabin case keeps to 0.55 x 0.40 x 0.23 m and so."""


@dataclass(frozen=True, kw_only=True)
class SuitcaseParams:
    """Factors multiply the sizes of SIZES; lengths in m."""

    size: str
    width_factor: float
    depth_factor: float
    height_factor: float
    lid_share: float
    closure: str
    corner: float
    round: float
    pattern: str
    ribs: int
    rib: float
    inside: str
    caps: bool
    opening_deg: float
    lid_friction: float
    gauge: float
    reach: float
    handle_friction: float
    handle_stop: float
    handle_length: float
    girth: float
    side_handle: bool
    wheel: float
    wheel_width: float
    trail: float
    hood: float
    brand: int

    @property
    def caster(self) -> Caster:
        """One of four."""
        return Caster(
            radius=self.wheel, width=self.wheel_width, trail=self.trail, stem=0.008, hood=self.hood
        )

    @property
    def depth(self) -> float:
        """Over both shells, ribs aside."""
        return SIZES[self.size][1] * self.depth_factor - 2.0 * self.rib

    @property
    def height(self) -> float:
        """Of the shells' top over the floor."""
        return SIZES[self.size][2] * self.height_factor - 0.028

    def half(self, share: float) -> HalfShell:
        """A half that takes `share` of the depth."""
        return HalfShell(
            width=SIZES[self.size][0] * self.width_factor,
            low=bottom_of(self.caster),
            high=self.height,
            depth=share * self.depth,
            corner=self.corner,
            round=self.round,
            pattern=self.pattern,
            ribs=self.ribs,
            rib=self.rib,
        )


def wheels_clear_each_other(p: SuitcaseParams) -> bool:
    """Casters may turn all the way round, front and rear ones side by side."""
    reach = math.hypot(p.trail + p.wheel + 0.006, p.wheel_width / 2.0)
    return p.depth - 2.0 * FROM_FACE > 2.0 * reach + 0.002


def lid_is_deep_enough(p: SuitcaseParams) -> bool:
    """For its wheels to stand under its flat, and for the handle's pocket behind it."""
    return p.lid_share * p.depth > 0.086 and (1.0 - p.lid_share) * p.depth - p.round > 0.072


def ribs_stand_apart(p: SuitcaseParams) -> bool:
    """Slanting ribs come in small numbers, fields without any."""
    return p.pattern in ("vertical", "horizontal") or p.ribs <= 8


INVARIANTS: Mapping[str, Callable[[SuitcaseParams], bool]] = {
    "wheels_clear_each_other": wheels_clear_each_other,
    "lid_is_deep_enough": lid_is_deep_enough,
    "ribs_stand_apart": ribs_stand_apart,
}
