"""The fixed body of a cabinet: case boards, dividers, back, shelves on pins."""

from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect, Separator
from artgen.geometry.solid import cylinder, slab

SHELF = 0.016
"""Thickness of loose shelves, m."""
RAIL_DEPTH = 0.07
"""Of the rails between drawers, along y."""
SETBACK = 0.010
"""From the rear edges of the sides to the back panel, m."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """The case without its fronts.

    Attributes:
        outside: sides included, from the underside of the bottom to the upper side of the top, m.
        front: y of the boards' front edges.
        back: y of their rear edges.
        board: thickness of the case's boards.
        panel: thickness of the back panel.
        top_thickness: of the top board.
        top: `between` the sides, a `cap` on them, or an `overhang` that covers the fronts' upper
            edges too.
        overhang: how far an overhanging top stands out in front of `overhang_from` and beside.
        overhang_from: y of the fronts' faces.
        foot: z to which the sides reach down; lower than `outside.z0` where they carry the case.
    """

    outside: Rect
    front: float
    back: float
    board: float
    panel: float
    top_thickness: float
    top: str
    overhang: float
    overhang_from: float
    foot: float

    @property
    def opening(self) -> Rect:
        """Clear room between the boards, in the x, z plane."""
        o, t = self.outside, self.board
        return Rect(x0=o.x0 + t, x1=o.x1 - t, z0=o.z0 + t, z1=o.z1 - self.top_thickness)

    @property
    def face(self) -> Rect:
        """What fronts may cover: all but an overhanging top."""
        o = self.outside
        top = o.z1 - self.top_thickness if self.top == "overhang" else o.z1
        return Rect(x0=o.x0, x1=o.x1, z0=o.z0, z1=top)

    @property
    def rear(self) -> float:
        """y of the back panel's inner face."""
        return self.back - SETBACK - self.panel


def case_boards(case: Case, stock: Stock, top: Stock) -> tuple[Body, ...]:
    """Sides, bottom, top."""
    o, inner, t = case.outside, case.opening, case.board
    high = o.z1 if case.top == "between" else inner.z1
    lower, upper = (case.front, case.back)
    sides = [
        stock.board((x, lower, case.foot), (x + t, upper, high), grain="z")
        for x in (o.x0, o.x1 - t)
    ]
    bottom = stock.board((inner.x0, lower, o.z0), (inner.x1, upper, inner.z0), grain="x")
    spread = {"between": -t, "cap": 0.0, "overhang": case.overhang}[case.top]
    ahead = case.overhang_from - case.overhang if case.top == "overhang" else case.front
    lid = top.board((o.x0 - spread, ahead, inner.z1), (o.x1 + spread, upper, o.z1), grain="x")
    return (*sides, bottom, lid)


def back_panel(case: Case, stock: Stock, holes: tuple[tuple[float, float], ...]) -> Body:
    """Let in between the boards, with round holes for cables at (x, z)."""
    o = case.opening
    plain = slab((o.x0, case.rear, o.z0), (o.x1, case.rear + case.panel, o.z1))
    solid = plain
    for x, z in holes:
        solid -= cylinder(0.03, 0.05, axis="y", segments=24).at(x, case.rear - 0.02, z)
    return stock.piece(solid, contact=(plain,), grain="z")


def inner_boards(case: Case, separators: list[Separator], stock: Stock) -> tuple[Body, ...]:
    """Dividers and shelves over the full depth; rails behind the fronts only."""
    bodies = []
    for separator in separators:
        place = separator.place
        rear = case.front + RAIL_DEPTH if separator.kind == "rail" else case.rear
        bodies.append(
            stock.board(
                (place.x0, case.front, place.z0),
                (place.x1, rear, place.z1),
                grain="z" if separator.kind == "divider" else "x",
            )
        )
    return tuple(bodies)


def shelf_heights(opening: Rect, pitch: float) -> tuple[float, ...]:
    """z of the undersides of loose shelves about `pitch` m apart, in steps of 32 mm."""
    count = max(0, round(opening.height / pitch) - 1)
    even = np.linspace(opening.z0, opening.z1, count + 2)[1:-1]
    rows = np.round((even - opening.z0) / 0.032)
    return tuple(float(opening.z0 + 0.032 * row) for row in rows)


def shelf_on_pins(
    opening: Rect, z: float, *, front: float, rear: float, stock: Stock, metal: Stock
) -> tuple[Body, ...]:
    """A loose shelf whose underside lies at `z`, on four pins."""
    play = 0.001
    shelf = stock.board(
        (opening.x0 + play, front, z), (opening.x1 - play, rear - play, z + SHELF), grain="x"
    )
    pins = []
    for y in (front + 0.04, rear - 0.04):
        pin = cylinder(0.0025, 0.009, axis="x", segments=8)
        pins += [
            pin.at(opening.x0, y, z - 0.0026),
            pin.at(opening.x1 - 0.009, y, z - 0.0026),
        ]
    return (shelf, *(metal.piece(pin) for pin in pins))


def door_stop(opening: Rect, x: float, door_back: float, *, play: float, stock: Stock) -> Body:
    """A magnetic catch under the board above, which stops a door that sits between the boards."""
    y = door_back + play
    return stock.board((x - 0.02, y, opening.z1 - 0.012), (x + 0.02, y + 0.016, opening.z1))
