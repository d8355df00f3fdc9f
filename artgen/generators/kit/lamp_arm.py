"""Arms of desk lamps, drawn upwards from their lower joint at zero: tongue below, fork above."""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union, upright, wire

ArmStyle = Literal["parallel", "tube", "flat"]
TONGUE = 0.0080
"""m; thickness of a tongue (along x)."""
ROUND = 0.0110
"""m; radius of tongues and cheeks about their pivot."""
PLAY = 0.0008
CHEEK = 0.0030
WEB = 0.0160
"""m; from a fork's pivot to the web that joins its cheeks."""
ROD = 0.0040
SPACING = 0.0130
"""m; from the middle of a parallel arm to either rod."""


def tongue() -> Solid:
    """About a pivot at zero along x."""
    return cylinder(ROUND, TONGUE, axis="x", segments=20).at(-TONGUE / 2.0)


def fork(way: float) -> Solid:
    """Two cheeks about a pivot at zero and the web that joins them, below it (-1) or above (1)."""
    inner = TONGUE / 2.0 + PLAY
    cheek = union([
        cylinder(ROUND, CHEEK, axis="x", segments=20).at(inner),
        slab((inner, -0.0095, min(0.0, way * WEB)), (inner + CHEEK, 0.0095, max(0.0, way * WEB))),
    ])  # fmt: skip
    ends = sorted((way * WEB, way * (WEB + 0.006)))
    web = slab((-inner - CHEEK, -0.0095, ends[0] - 1e-4), (inner + CHEEK, 0.0095, ends[1]))
    return union([cheek, cheek.mirrored("x"), web])


def clamp_knob(stock: Stock, side: float) -> Body:
    """The ribbed knob that clamps a fork, at one side of a pivot at zero."""
    start = TONGUE / 2.0 + PLAY + CHEEK - 0.0003
    angles = 2.0 * math.pi * np.arange(24) / 24.0
    reach = np.where(np.arange(24) % 2 == 0, 0.0105, 0.0095)
    outline = np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=1)
    knob = upright(prism(outline, 0.009), "x").at(start + 0.0015)
    neck = cylinder(0.005, 0.003, axis="x", segments=10).at(start)
    solid = union([knob, neck])
    return stock.piece(solid if side > 0 else solid.mirrored("x"))


def bolt_head(stock: Stock, side: float) -> Body:
    """A domed bolt at the side of a fork."""
    start = TONGUE / 2.0 + PLAY + CHEEK - 0.0003
    head = cylinder(0.0055, 0.0022, axis="x", segments=12).at(start)
    return stock.piece(head if side > 0 else head.mirrored("x"))


@dataclass(frozen=True, kw_only=True)
class LampArm:
    """An arm from one pivot to the next.

    Attributes:
        style: two rods, one tube, or a flat bar.
        length: from pivot to pivot, m.
        girth: radius of a tube or half the width of a flat bar, m.
        springs: coil springs between the rods.
    """

    style: ArmStyle
    length: float
    girth: float
    springs: int

    def bodies(
        self, stock: Stock, metal: Stock, knob: Stock, cable: Stock, *, knob_side: float
    ) -> list[Body]:
        """Tongue, arm, springs, cable and fork."""
        top = self.length
        head = fork(-1.0).at(z=top)
        middle, contact = {"parallel": self._rods, "tube": self._tube, "flat": self._flat}[
            self.style
        ]()
        holds = [
            clamp_knob(knob, knob_side) if side == knob_side else bolt_head(metal, side)
            for side in (-1.0, 1.0)
        ]
        ends = [_moved(body, top) for body in holds]
        start = union([tongue(), slab((-TONGUE / 2, -ROUND, 0.0), (TONGUE / 2, ROUND, 0.032))])
        pieces = [stock.piece(union([start, middle, head]), contact=contact), *ends]
        if self.style == "parallel":
            pieces += [metal.piece(self._spring(x)) for x in _places(self.springs)]
        return [*pieces, cable.piece(self._cable())]

    def _rods(self) -> tuple[Solid, tuple[Solid, ...]]:
        low, high = 0.030, self.length - WEB - 0.020
        plate = slab(
            (-TONGUE / 2, -SPACING - 0.006, low - 0.002), (TONGUE / 2, SPACING + 0.006, low + 0.012)
        )
        end = slab(
            (-0.0078, -SPACING - 0.006, high - 0.002), (0.0078, SPACING + 0.006, high + 0.010)
        )
        neck = slab((-0.0078, -0.0095, high), (0.0078, 0.0095, self.length - WEB))
        rods = [cylinder(ROD, high - low, segments=10).at(0.0, s * SPACING, low) for s in (-1, 1)]
        wide = SPACING + 0.003
        touch = slab((-0.0035, -wide, low), (0.0035, wide, high + 0.008))
        return union([plate, end, neck, *rods]), (touch,)

    def _tube(self) -> tuple[Solid, tuple[Solid, ...]]:
        low, high, r = 0.024, self.length - WEB + 0.001, self.girth
        tube = cylinder(r, high - low, segments=16).at(z=low)
        collar = cylinder(r + 0.0018, 0.016, segments=16).at(z=low)
        end = cylinder(r + 0.0018, 0.014, segments=16).at(z=high - 0.018)
        half = 0.8 * r
        touch = slab((-half, -half, 0.006), (half, half, self.length - WEB))
        return union([tube, collar, end]), (touch,)

    def _flat(self) -> tuple[Solid, tuple[Solid, ...]]:
        low, high = 0.026, self.length - WEB + 0.001
        outline = rounded_rectangle(2.0 * self.girth, 0.013, 0.004, segments=2)
        bar = prism(outline, high - low).at(z=low)
        touch = slab((-self.girth, -0.006, low), (self.girth, 0.006, high))
        knuckle = slab((-0.0035, -0.008, 0.004), (0.0035, 0.008, low + 0.01))
        return bar, (touch, knuckle)

    def _spring(self, x: float) -> Solid:
        """A coil that is hooked to the plates of a parallel arm."""
        low, high = 0.041, min(0.041 + 0.42 * self.length, self.length - 0.06)
        turns = 12
        angles = np.linspace(0.0, 2.0 * math.pi * turns, 7 * turns + 1)
        radius = 0.0052
        coil = np.stack(
            [x + radius * np.cos(angles), radius * np.sin(angles),
             low + 0.018 + (high - low - 0.036) * angles / angles[-1]], axis=1
        )  # fmt: skip
        ends = (
            [(x, 0.0, low - 0.003), (x, 0.0, low + 0.014)],
            [(x, 0.0, high - 0.014), (x, 0.0, self.length - 0.03)],
        )
        return wire(np.concatenate([ends[0], coil, ends[1]]), 0.0010, sides=4)

    def _cable(self) -> Solid:
        """The cord along the rear of the arm, held by two clips."""
        y = {"parallel": SPACING + ROD + 0.0018, "tube": self.girth + 0.0018, "flat": 0.0083}[
            self.style
        ]
        low, high = 0.046, self.length - 0.050
        path = bent([(0.0, y - 0.002, low), (0.0, y + 0.004, low + 0.02),
                     (0.0, y + 0.006, (low + high) / 2.0), (0.0, y + 0.004, high - 0.02),
                     (0.0, y - 0.002, high)], 0.03)  # fmt: skip
        return wire(path, 0.0022, sides=6)


def _places(count: int) -> tuple[float, ...]:
    """x of springs side by side."""
    return ((), (0.0,), (-0.0078, 0.0078))[count]


def _moved(body: Body, z: float) -> Body:
    """A body without contact pieces, higher by z."""
    return replace(body, solid=body.solid.at(z=z))


def placed(bodies: list[Body], lean: float, at: tuple[float, float]) -> list[Body]:
    """Bodies drawn about zero turned to lean forward by `lean` rad, at (y, z)."""

    def put(solid: Solid) -> Solid:
        return solid.turned("x", lean).at(0.0, *at)

    return [
        replace(
            body, solid=put(body.solid), collision=tuple(put(piece) for piece in body.collision)
        )
        for body in bodies
    ]
