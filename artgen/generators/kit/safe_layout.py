"""The numbers of one safe: what the rule draws, where everything sits for it, what must fit."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.generators.kit.boltwork import CARRIER, REACH, Boltwork
from artgen.generators.kit.density import STEEL
from artgen.generators.kit.safe_case import AIR, Case
from artgen.generators.kit.safe_door import DoorFittings
from artgen.generators.kit.safe_lock import room

FORMS: Mapping[str, tuple[tuple[float, float], ...]] = {
    "home": ((0.25, 0.36), (0.20, 0.30), (0.20, 0.28), (0.003, 0.003)),
    "hotel": ((0.40, 0.46), (0.20, 0.25), (0.34, 0.40), (0.003, 0.003)),
    "office": ((0.34, 0.46), (0.40, 0.62), (0.32, 0.42), (0.005, 0.005)),
    "fire": ((0.38, 0.62), (0.40, 0.92), (0.42, 0.60), (0.045, 0.028)),
}
"""Range of width, height and depth, m; wall and plate of the door, m."""
FILLED = 1500.0
"""Two sheets with a fill of gypsum between them, kg/m3."""
COVER = 0.032
INSET = 0.013
"""m; depth of the boltwork's cover, and how far it stays inside the plate's edge."""


@dataclass(frozen=True, kw_only=True)
class SafeParams:
    """What the rule draws; shares are of the form's ranges."""

    form: str
    breadth: float
    tallness: float
    deepness: float
    wall: float
    frame: float
    gap: float
    corner: float
    hinge: str
    hinges: str
    barrel: float
    opening_deg: float
    lock: str
    handle: str
    stacked: bool
    handle_size: float
    turn_deg: float
    bolts: int
    bolt: float
    shelves: int
    foot: float
    carpet: bool
    brand: int
    dial_size: float
    door_drag: float


def case_of(p: SafeParams) -> Case:
    """Outer walls and opening."""
    form = FORMS[p.form]
    width, height, depth = (
        low + share * (high - low)
        for (low, high), share in zip(form, (p.breadth, p.tallness, p.deepness), strict=False)
    )
    wall, plate = form[3][0] * p.wall, form[3][1] * p.wall
    margin = wall + p.frame
    return Case(
        half_width=width / 2.0, depth=depth, foot=p.foot, top=p.foot + height, wall=wall,
        lip=plate, opening_x=width / 2.0 - margin, low=p.foot + margin,
        high=p.foot + height - margin, density=FILLED if p.form == "fire" else STEEL,
        corner=min(p.corner, 0.4 * wall),
    )  # fmt: skip


def works_of(p: SafeParams, case: Case) -> Boltwork:
    """Bolts that leave towards +x from a door whose hinge is at -x."""
    reach = case.opening_x - p.gap
    low, high = case.low + p.gap + INSET, case.high - p.gap - INSET
    span = high - low - 6.0 * p.bolt
    heights = tuple(low + 3.0 * p.bolt + span * k / (p.bolts - 1) for k in range(p.bolts))
    return Boltwork(
        near=-reach + INSET, far=reach - INSET, low=low, high=high, front=case.lip,
        back=case.lip + COVER, radius=p.bolt, heights=heights,
        thrown=case.opening_x + 0.7 * p.frame,
    )  # fmt: skip


def fittings_of(p: SafeParams, case: Case, side: float) -> DoorFittings:
    """Where handle and lock sit on the door, `side` towards the hinge."""
    reach, middle = case.opening_x - p.gap, (case.low + case.high) / 2.0
    size = room(p.lock, p.dial_size)
    if p.stacked:
        free = (case.high - case.low - size[1] - 2.0 * p.handle_size) / 3.0
        return DoorFittings(
            handle=(0.0, case.low + free + p.handle_size),
            lock=(0.0, case.high - free - size[1] / 2.0), size=size,
        )  # fmt: skip
    free = (2.0 * reach - size[0] - 2.0 * p.handle_size) / 3.0
    return DoorFittings(
        handle=(-side * (reach - free - p.handle_size), middle),
        lock=(side * (reach - free - size[0] / 2.0), middle), size=size,
    )  # fmt: skip


def door_swings_clear(p: SafeParams) -> bool:
    """The free edge, and the cover behind it, turn past the frame with 0.8 mm to spare."""
    case, works = case_of(p), works_of(p, case_of(p))
    y = 0.0 if p.hinges == "hidden" else p.barrel + AIR
    pivot = -case.opening_x - p.gap / 2.0
    corners = ((case.opening_x - p.gap, case.lip), (works.far, works.back))
    return all(
        math.hypot(x - pivot, depth + y) < case.opening_x - pivot - 0.0008 for x, depth in corners
    )


def bolts_fit(p: SafeParams) -> bool:
    """Bolts stand apart, end before the wall, and their carrier stays inside the cover."""
    case, works = case_of(p), works_of(p, case_of(p))
    apart = works.heights[1] - works.heights[0] > 3.0 * p.bolt
    root = works.thrown - REACH - CARRIER - works.travel
    return apart and works.thrown < case.inner_x - 0.002 and root > works.near + 0.004


def fittings_fit(p: SafeParams) -> bool:
    """Handle and lock have their room on the door and beside each other."""
    case = case_of(p)
    width, height = 2.0 * (case.opening_x - p.gap) - 0.012, case.high - case.low - 0.012
    size, handle = room(p.lock, p.dial_size), 2.0 * p.handle_size + 0.012
    if p.stacked:
        return size[1] + handle < height and max(size[0], handle) < width
    return size[0] + handle < width and max(size[1], handle) < height


INVARIANTS: Mapping[str, Callable[[SafeParams], bool]] = {
    check.__name__: check for check in (door_swings_clear, bolts_fit, fittings_fit)
}
