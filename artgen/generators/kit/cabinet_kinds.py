"""Kinds of cabinets: usual sizes, what they stand on, and how their faces are divided.

Sizes follow what is sold: kitchen base units are 0.72 m high on a plinth of 0.10 to 0.15 m and
0.56 to 0.60 m deep (EN 1116); chests, sideboards and the rest follow furniture catalogues.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from artgen.generators.kit.front_layout import Leaf, Node, Split

DRAWER, OPEN, PAIR = Leaf(kind="drawer"), Leaf(kind="open"), Leaf(kind="pair")
WIDEST_DOOR = 0.56
"""m; wider openings get a pair."""


@dataclass(frozen=True, kw_only=True)
class Site:
    """What a pattern may look at: the clear room of a column and the draws that concern it.

    Attributes:
        hinge_left: side of a single door.
        rows: how many drawers a stack asks for.
        growth: height of a drawer's front over that of the one above it.
        top_drawer: height of a drawer above a door, m.
        inner: drawers that wait behind a single door.
    """

    width: float
    height: float
    hinge_left: bool
    rows: int
    growth: float
    top_drawer: float
    inner: int


@dataclass(frozen=True, kw_only=True)
class CabinetKind:
    """Middle of the usual sizes (m), columns at least and at most, fewest moving parts, choices."""

    width: float
    depth: float
    height: float
    columns: tuple[int, int]
    fewest: int
    stands: tuple[str, ...]
    patterns: tuple[str, ...]


def stack(site: Site, rows: int, height: float) -> Node:
    """Drawers that grow downwards, about 0.12 m to 0.30 m high."""
    rows = max(1, round(height / 0.30), min(rows, int(height / 0.115)))
    if rows == 1:
        return DRAWER
    weights = tuple(site.growth ** (rows - 1 - k) for k in range(rows))
    return Split(axis="z", weights=weights, nodes=(DRAWER,) * rows)


def door(site: Site) -> Leaf:
    """One door, or a pair where one would be too wide."""
    if site.width > WIDEST_DOOR:
        return PAIR
    return Leaf(kind="door_left" if site.hinge_left else "door_right")


def _over(above: Node, below: Node, share: float) -> Split:
    """One node above another, the upper one taking `share` of the height."""
    return Split(axis="z", weights=(1.0 - share, share), nodes=(below, above))


def _drawer_over_door(site: Site) -> Node:
    return _over(DRAWER, door(site), min(0.4, site.top_drawer / site.height))


def _drawers_over_door(site: Site) -> Node:
    share = min(0.5, 2.0 * site.top_drawer / site.height)
    return _over(stack(site, 2, share * site.height), door(site), share)


def _door_over_drawer(site: Site) -> Node:
    share = min(0.4, 1.25 * site.top_drawer / site.height)
    return _over(door(site), DRAWER, 1.0 - share)


def _door_over_door(site: Site) -> Node:
    return _over(door(site), door(site), 0.42)


def _open_over_drawers(site: Site) -> Node:
    rows = max(1, site.rows - 2)
    low = min(0.62, 0.22 * rows / site.height) if site.height > 0.6 else 0.55
    return _over(OPEN, stack(site, rows, low * site.height), 1.0 - low)


def _open_over_door(site: Site) -> Node:
    return _over(OPEN, door(site), 0.38)


def _drawer_over_open(site: Site) -> Node:
    return _over(DRAWER, OPEN, min(0.5, 1.1 * site.top_drawer / site.height))


def _door_over_drawers(site: Site) -> Node:
    rows = max(2, site.rows - 2)
    low = min(0.5, 0.2 * rows / site.height)
    return _over(door(site), stack(site, rows, low * site.height), 1.0 - low)


def _drawer_between(site: Site) -> Node:
    """A niche, a drawer under it, a door below."""
    share = min(0.3, site.top_drawer / site.height)
    weights = (0.72 - share, share, 0.28)
    return Split(axis="z", weights=weights, nodes=(door(site), DRAWER, OPEN))


def _inner_drawers(site: Site) -> Node:
    """Drawers behind a door: one must be opened before the other."""
    leaf = door(site)
    return leaf if leaf.kind == "pair" else Leaf(kind=leaf.kind, inner=site.inner)


def _split_top(site: Site) -> Node:
    """Two small drawers side by side over a stack of wide ones."""
    rows = max(2, site.rows - 1)
    share = 0.9 / (rows + 1)
    pair = Split(axis="x", weights=(1.0, 1.0), nodes=(DRAWER, DRAWER))
    return _over(pair, stack(site, rows, (1.0 - share) * site.height), share)


PATTERNS: Mapping[str, Callable[[Site], Node]] = {
    "door": door,
    "drawers": lambda site: stack(site, site.rows, site.height),
    "two_drawers": lambda site: stack(site, 2, site.height),
    "one_drawer": lambda site: DRAWER,
    "open": lambda site: OPEN,
    "drawer_over_door": _drawer_over_door,
    "drawers_over_door": _drawers_over_door,
    "door_over_drawer": _door_over_drawer,
    "door_over_drawers": _door_over_drawers,
    "door_over_door": _door_over_door,
    "open_over_drawers": _open_over_drawers,
    "open_over_door": _open_over_door,
    "drawer_over_open": _drawer_over_open,
    "open_drawer_door": _drawer_between,
    "inner_drawers": _inner_drawers,
    "split_top": _split_top,
}
LEGS = ("round_legs", "square_legs", "hairpin", "frame")
KINDS: Mapping[str, CabinetKind] = {
    "sideboard": CabinetKind(
        width=1.45, depth=0.42, height=0.78, columns=(2, 4), fewest=3, stands=("plinth", *LEGS),
        patterns=("door", "drawers", "drawer_over_door", "door_over_drawer", "open_over_drawers",
                  "open_over_door", "inner_drawers"),
    ),
    "chest": CabinetKind(
        width=0.88, depth=0.46, height=0.92, columns=(1, 2), fewest=3,
        stands=("plinth", "round_legs", "square_legs", "panel"),
        patterns=("drawers", "split_top", "drawers"),
    ),
    "base_unit": CabinetKind(
        width=0.66, depth=0.58, height=0.87, columns=(1, 2), fewest=2, stands=("plinth", "panel"),
        patterns=("drawer_over_door", "drawers", "door", "drawers_over_door", "inner_drawers"),
    ),
    "vanity": CabinetKind(
        width=0.85, depth=0.46, height=0.64, columns=(1, 3), fewest=2,
        stands=("wall", "square_legs", "round_legs", "frame", "plinth"),
        patterns=("two_drawers", "door", "drawer_over_door", "drawer_over_open"),
    ),
    "nightstand": CabinetKind(
        width=0.46, depth=0.40, height=0.55, columns=(1, 1), fewest=1,
        stands=("plinth", "panel", "wall", *LEGS),
        patterns=("drawers", "drawer_over_open", "drawer_over_door", "two_drawers"),
    ),
    "tall": CabinetKind(
        width=0.62, depth=0.40, height=1.62, columns=(1, 2), fewest=2,
        stands=("plinth", "panel", "square_legs", "frame"),
        patterns=("door_over_drawers", "door_over_door", "open_over_drawers", "open_drawer_door",
                  "door", "inner_drawers"),
    ),
    "media": CabinetKind(
        width=1.55, depth=0.42, height=0.50, columns=(2, 4), fewest=2,
        stands=("plinth", "wall", *LEGS),
        patterns=("door", "open", "two_drawers", "one_drawer", "drawer_over_open"),
    ),
    "highboard": CabinetKind(
        width=0.96, depth=0.42, height=1.18, columns=(1, 3), fewest=3,
        stands=("plinth", "panel", "round_legs", "square_legs", "frame"),
        patterns=("door", "door_over_drawer", "open_over_drawers", "drawers", "open_over_door",
                  "drawer_over_door"),
    ),
}  # fmt: skip


def columns_of(kind: CabinetKind, wanted: int, width: float) -> int:
    """How many columns: as wanted, within the kind's and 0.27 m to 1.05 m a column."""
    lower = max(kind.columns[0], -int(-width // 1.05))
    upper = max(lower, min(kind.columns[1], int(width / 0.27)))
    return max(lower, min(upper, wanted))


def picked(names: Sequence[str], draw: float) -> str:
    """The name at `draw` in [0, 1) of the list."""
    return names[min(len(names) - 1, int(draw * len(names)))]
