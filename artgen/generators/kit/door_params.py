"""The numbers of a door, what they must obey, and the makers that follow from them."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import GLASS, STEEL
from artgen.generators.kit.door_frame import REVEAL, Casing
from artgen.generators.kit.door_hinge import DoorHinge, HingeKind
from artgen.generators.kit.door_leaf import LAYOUTS, LeafMaker
from artgen.generators.kit.lever_handle import LeverSet, LeverStyle, Lock, Plate
from artgen.generators.kit.swing_leaf import Metals

GAP = 0.0036
"""m; between a leaf and its lining."""
MEETING = 0.005
"""m; between the leaves of a double door."""
UNDER = 0.008
"""m; below a leaf, to the floor or the sill."""

HARDWARE = Stock(surface="metal", density=STEEL, edge=0.0006)
METALS = Metals(
    handle=HARDWARE,
    hinge=replace(HARDWARE, edge=0.0),
    lock=Stock(surface="lock", density=7000.0, edge=0.0),
    dark=Stock(surface="dark", density=1100.0),
)


@dataclass(frozen=True, kw_only=True)
class DoorParams:
    """See category_rules/door.toml."""

    kind: str
    layout: str
    leaf_width: float
    leaf_height: float
    leaf_thickness: float
    stile: float
    bottom_rail: float
    lock_rail: float
    bead: float
    fielded: bool
    standing_bars: int
    lying_bars: int
    grooves: int
    core: float
    hinge_left: bool
    hinge: HingeKind
    hinges: int
    hinge_height: float
    pin_radius: float
    finials: bool
    handle: LeverStyle
    plate: Plate
    lock: Lock
    lever_length: float
    lever_radius: float
    standoff: float
    turn_deg: float
    handle_height: float
    backset: float
    throw: float
    lining: float
    depth: float
    casing: Casing
    casing_width: float
    casing_proud: float
    sill: str
    frame_matches: bool
    in_wall: bool
    wall_side: float
    wall_above: float
    letter_plate: bool
    spy: bool
    kick: bool
    pull_length: float
    opening_deg: float
    friction: float
    slide_friction: float

    @property
    def floor(self) -> float:
        """z of the leaf's lower edge."""
        return UNDER + (0.0 if self.sill == "none" else 0.016)


def _clears_lining(p: DoorParams) -> bool:
    """The rear corner of the free edge swings further out than its front."""
    back = p.pin_radius + 0.0012 + p.leaf_thickness
    return math.hypot(p.leaf_width, back) - p.leaf_width < GAP - 0.001


def _wide_enough(p: DoorParams) -> bool:
    columns = max((row[1] for row in LAYOUTS[p.layout]), default=1)
    free = p.leaf_width - 2.0 * p.stile - (columns - 1) * 0.9 * p.stile
    return free / columns > 0.15


INVARIANTS: Mapping[str, Callable[[DoorParams], bool]] = {
    "leaf_clears_lining": _clears_lining,
    "panels_are_wide_enough": _wide_enough,
}


def leaf_maker(p: DoorParams) -> LeafMaker:
    """Stiles, rails and fillings as the params say."""
    return LeafMaker(
        stock=Stock(surface="leaf", density=p.core, edge=0.0015),
        pane=Stock(surface="glass", density=GLASS, edge=0.0),
        thickness=p.leaf_thickness,
        stile=p.stile,
        bottom_rail=p.bottom_rail,
        lock_rail=p.lock_rail,
        bead=p.bead,
        fielded=p.fielded,
        bars=(p.standing_bars, p.lying_bars),
        grooves=p.grooves,
    )


def hinge_of(p: DoorParams, jamb: float) -> DoorHinge:
    """At the jamb whose face is x = `jamb`."""
    height = p.hinge_height if p.hinge != "drill_in" else 0.75 * p.hinge_height
    return DoorHinge(
        kind=p.hinge, jamb=jamb, gap=GAP, face=0.0, height=height, radius=p.pin_radius,
        finials=p.finials,
    )  # fmt: skip


def lever_set(p: DoorParams, edge: float) -> LeverSet:
    """On a leaf whose right edge is x = `edge`."""
    return LeverSet(
        style=p.handle,
        plate=p.plate,
        lock=p.lock,
        length=p.lever_length,
        radius=p.lever_radius,
        standoff=p.standoff,
        turn_deg=p.turn_deg,
        at=(edge - p.backset, p.handle_height),
        faces=(0.0, p.leaf_thickness),
    )


def frame_free(p: DoorParams) -> float:
    """From the opening to the outer edge of an architrave, m."""
    return REVEAL + p.casing_width
