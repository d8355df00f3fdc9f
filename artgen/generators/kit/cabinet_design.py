"""What all cells of one cabinet share, and the rules by which fronts, grips and openings follow."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from artgen.articulation.types import Body, Grip, Vector
from artgen.generators.kit.board import Stock
from artgen.generators.kit.carcass import Case
from artgen.generators.kit.front_layout import Cell, Rect
from artgen.generators.kit.front_panel import REAR, FrontMaker, Style
from artgen.generators.kit.handle import Handle

BUMPER = 0.002
"""m; between a covering front and the case."""
SCREWS = (0.032, 0.064, 0.096, 0.128, 0.160, 0.192, 0.256, 0.320)
"""Distances of handle screws that are sold, m."""
HIGH = 1.0
"""m; doors that begin above have their handle at their lower end, lower ones at their upper."""
OUTWARD = (0.0, -1.0, 0.0)
Side = Literal["left", "right"]


@dataclass(frozen=True, kw_only=True)
class Design:
    """One cabinet's decisions.

    Attributes:
        inset: fronts between the boards; otherwise they cover the case's edges.
        gap: between neighbouring fronts, or between a front and the boards around it, m.
        style: of doors; drawers follow where it suits them.
        grip: a handle style, or `milled`, or `cut_out`.
        handle: measures of handles.
        grip_edge: of long handles from a door's free edge, m.
        stocks: by role.
        runner: of drawers.
        travel: share of its length that a drawer comes out.
        opening: how far doors open that nothing hinders, rad.
        drawer_friction: N.
        door_friction: N m.
    """

    case: Case
    maker: FrontMaker
    inset: bool
    gap: float
    style: Style
    grip: str
    handle: Handle
    grip_edge: float
    stocks: Mapping[str, Stock]
    runner: Literal["metal", "wood"]
    wall: float
    travel: float
    opening: float
    drawer_friction: float
    door_friction: float
    shelf_pitch: float

    @property
    def face(self) -> float:
        """y of the fronts' faces."""
        return self.back - self.maker.thickness

    @property
    def back(self) -> float:
        """y of the fronts' rears."""
        t = self.maker.thickness
        return self.case.front + t if self.inset else self.case.front - BUMPER

    def front_rect(self, cell: Cell) -> Rect:
        """What the front of a cell measures; a pair shares it."""
        if self.inset:
            return cell.opening.shrunk(self.gap)
        return cell.cover.shrunk(self.gap / 2.0)

    @property
    def drawer_style(self) -> Style:
        """Glass and louvres belong to doors."""
        swaps: Mapping[Style, Style] = {"glass": "shaker", "louvred": "slab"}
        return swaps.get(self.style, self.style)


def halves(rect: Rect, gap: float) -> tuple[Rect, Rect]:
    """Left and right door of a pair."""
    middle = rect.middle[0]
    return replace(rect, x1=middle - gap / 2.0), replace(rect, x0=middle + gap / 2.0)


def fitting(handle: Handle, room: float) -> Handle:
    """The handle with the largest screw distance, up to its own, that fits into `room` m."""
    lengths = [s for s in SCREWS if s <= min(handle.length, room) + 1e-9]
    return replace(handle, length=max(lengths, default=SCREWS[0]))


@dataclass(frozen=True, kw_only=True)
class Front:
    """A front with what one takes hold of.

    Attributes:
        holds: where fingers close, m; one for each handle.
        kind: what they close around.
        arm: the nearest a door's handle comes to its hinge, m.
        reach: of the handle from the face; 0 without one.
    """

    bodies: tuple[Body, ...]
    holds: tuple[Vector, ...]
    kind: Literal["handle", "knob", "edge"]
    arm: float = 0.0
    reach: float = 0.0

    def grips(self, part: str) -> tuple[Grip, ...]:
        """Frames for hands that pull straight out; twins are told apart by a letter."""
        names = [f"{part}_{self.kind}{letter}" for letter in ("", "_b")]
        if len(self.holds) > 1:
            names[0] += "_a"
        return tuple(
            Grip(name=name, kind=self.kind, position=hold, outward=OUTWARD, pull=OUTWARD)
            for name, hold in zip(names, self.holds, strict=False)
        )


def drawer_front(design: Design, rect: Rect) -> Front:
    """Front and handles of a drawer."""
    maker, back = design.maker, design.back
    x, z = rect.middle
    if design.grip in ("milled", "cut_out"):
        hold = (x, design.face, rect.z1 - (REAR if design.grip == "milled" else 0.03))
        bodies = (
            maker.milled(rect, back, "top")
            if design.grip == "milled"
            else maker.cut_out(rect, back, "top", x)
        )
        return Front(bodies=bodies, holds=(hold,), kind="edge")
    front = maker.front(design.drawer_style, rect, back)
    handle = fitting(design.handle, 0.5 * rect.width)
    if rect.height > 0.21:
        z = rect.z1 - max(0.065, design.maker.frame / 2.0)
    twins = rect.width > 0.72 and handle.span < 0.24
    spots = (x - 0.27 * rect.width, x + 0.27 * rect.width) if twins else (x,)
    metal = design.stocks["metal"]
    return Front(
        bodies=front + tuple(handle.at(s, design.face, z, "x", metal) for s in spots),
        holds=tuple((s, design.face - handle.standoff, z) for s in spots),
        kind="knob" if handle.style == "knob" else "handle",
    )


def door_front(design: Design, rect: Rect, hinge: Side) -> Front:
    """Front and handle of a door hinged at its left or right edge."""
    maker, back = design.maker, design.back
    free: Side = "right" if hinge == "left" else "left"
    edge, inwards = (rect.x1, -1.0) if free == "right" else (rect.x0, 1.0)
    if design.grip == "milled":
        hold = (edge + inwards * REAR, design.face, grip_height(rect, 0.11))
        bodies = maker.milled(rect, back, free)
        return Front(bodies=bodies, holds=(hold,), kind="edge", arm=rect.width)
    if design.grip == "cut_out":
        z = grip_height(rect, 0.11)
        bodies = maker.cut_out(rect, back, free, z)
        hold = (edge + inwards * 0.03, design.face, z)
        return Front(bodies=bodies, holds=(hold,), kind="edge", arm=rect.width)
    handle = design.handle if design.handle.style != "cup" else replace(design.handle, style="knob")
    handle = fitting(handle, 0.45 * rect.height)
    aside = max(design.grip_edge, maker.frame / 2.0 if design.style != "slab" else 0.0)
    x, z = edge + inwards * aside, grip_height(rect, handle.span)
    body = handle.at(x, design.face, z, "z", design.stocks["metal"])
    return Front(
        bodies=(*maker.front(design.style, rect, back), body),
        holds=((x, design.face - handle.standoff, z),),
        kind="knob" if handle.style == "knob" else "handle",
        arm=rect.width - aside - 3.0 * handle.radius,
        reach=handle.reach,
    )


def grip_height(rect: Rect, span: float) -> float:
    """z of a door's handle: within reach of a standing person, else near the end towards it."""
    margin = min(0.07, 0.15 * rect.height) + span / 2.0
    low, high = rect.z0 + margin, rect.z1 - margin
    if low > high:
        return rect.middle[1]
    wanted = 0.95 if rect.height > 0.8 else (low if rect.z0 > HIGH else high)
    return min(high, max(low, wanted))


def opening_angle(design: Design, front: Front, *, free_side: bool, ahead: float) -> float:
    """How far a door may open, rad: beside another cell its handle must stay before its own."""
    if free_side:
        return design.opening
    if front.reach == 0.0:
        return math.pi / 2.0
    return min(math.pi / 2.0, math.atan2(front.arm, front.reach + ahead) - 0.01)
