"""Barrels of a clamshell hinge: knuckles of two parts in turn on one axis along x."""

from collections.abc import Iterable
from dataclasses import dataclass

from artgen.geometry.solid import Solid, cylinder, slab, union

Span = tuple[float, float]
"""From x to x, m."""
SEGMENTS = 16
PLAY = 0.0006
"""m; between neighboring knuckles along the axis."""


@dataclass(frozen=True, kw_only=True)
class Barrels:
    """Knuckles along the axis through (y, z); those of the base and the lid take turns.

    Attributes:
        y: of the axis, m.
        z: of the axis, m.
        radius: of every knuckle, m.
        base: spans of the base's knuckles.
        lid: spans of the lid's knuckles.
    """

    y: float
    z: float
    radius: float
    base: tuple[Span, ...]
    lid: tuple[Span, ...]

    def knuckle(self, span: Span) -> Solid:
        """One knuckle, coaxial with the joint."""
        left, right = span
        bar = cylinder(self.radius, right - left, axis="x", segments=SEGMENTS)
        return bar.at(left, self.y, self.z)

    def core(self, span: Span) -> Solid:
        """The box inside a knuckle: it never leaves the knuckle's circle while it turns."""
        half = 0.7 * self.radius
        return slab(
            (span[0], self.y - half, self.z - half), (span[1], self.y + half, self.z + half)
        )


def two_hinges(*, width: float, place: float, length: float, base_length: float) -> tuple[
    tuple[Span, ...], tuple[Span, ...]
]:  # fmt: skip
    """Spans of the base and of the lid: at x = -place and +place a lid knuckle between two of the
    base.

    Args:
        width: of the object; knuckles stay inside it, m.
        place: of the middle of each hinge, m.
        length: of the lid's knuckles, m.
        base_length: of the base's knuckles, m.
    """
    half = length / 2.0
    outer = min(place + half + PLAY + base_length, width / 2.0)
    right_lid: Span = (place - half, place + half)
    right_base: tuple[Span, ...] = (
        (place - half - PLAY - base_length, place - half - PLAY),
        (place + half + PLAY, outer),
    )
    return _both(right_base), _both((right_lid,))


def one_long_hinge(
    *, length: float, base_length: float
) -> tuple[tuple[Span, ...], tuple[Span, ...]]:
    """Spans of the base and of the lid: one barrel of the lid in the middle, the base's at its
    ends."""
    half = length / 2.0
    end: Span = (half + PLAY, half + PLAY + base_length)
    return _both((end,)), ((-half, half),)


def _both(spans: Iterable[Span]) -> tuple[Span, ...]:
    """Spans on the right and their mirror images, from left to right."""
    right = sorted(spans)
    return (*((-b, -a) for a, b in reversed(right)), *right)


def pockets(barrels: Barrels, *, clearance: float, depth: float, rear: float) -> Solid:
    """What the base must leave free for the lid's knuckles and their arms.

    Above and before the axis the arms stay over the base; behind it they come down, so there the
    pocket is open to y = `rear` and reaches `depth` under the axis.
    """
    pieces = []
    for left, right in barrels.lid:
        low, high = left - PLAY, right + PLAY
        groove = cylinder(barrels.radius + clearance, high - low, axis="x", segments=SEGMENTS)
        pieces.append(groove.at(low, barrels.y, barrels.z))
        pieces.append(
            slab((low, barrels.y, barrels.z - depth), (high, rear, barrels.z + 2.0 * depth))
        )
    return union(pieces)


def free_spans(barrels: Barrels, *, width: float) -> tuple[Span, ...]:
    """Where across the width no pocket cuts the base."""
    edges = [-width / 2.0]
    for left, right in sorted(barrels.lid):
        edges += [left - PLAY, right + PLAY]
    edges.append(width / 2.0)
    return tuple((a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 0.002)
