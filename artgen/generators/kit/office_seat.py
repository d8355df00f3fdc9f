"""Seats of office chairs: the mechanism on the column, the pan, the cushion, levers below."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cushion import pad, piping, plan, upholstered
from artgen.geometry.solid import Solid, box, cylinder, hull, slab, union

BOX = (0.130, 0.190, 0.040)
"""m; the mechanism's housing, centered a little behind the column."""
BACK = 0.100
"""m; y of the housing's rear face."""
TILT = (0.066, 0.020)
"""m; the pivot of the back behind the column and above the housing's bottom."""
POCKET = 0.020
"""m; how far a lever reaches into the housing."""
PAN = 0.014
CORE = 0.0139
"""m; half side of the free square around the column's head."""


@dataclass(frozen=True, kw_only=True)
class OfficeSeat:
    """A seat above the column, facing -y.

    Attributes:
        base: z of the mechanism's lower face, m.
        socket: depth and radius of the hole for the column's head, m.
        width: of the cushion, m.
        depth: of the cushion, m.
        thickness: of the cushion at its edge, m.
        crown: how much thicker it is in the middle.
        fall: how far its front edge falls (waterfall), m.
        dish: how far its middle lies lower than its sides, m.
        corner: radius of its corners in plan, front and rear, m.
        panel: whether an inner seam runs around the top.
        knob: whether a knob for the tilt's tension stands below.
    """

    base: float
    socket: tuple[float, float]
    width: float
    depth: float
    thickness: float
    crown: float
    fall: float
    dish: float
    corner: tuple[float, float]
    panel: bool
    knob: bool

    @property
    def pan(self) -> float:
        """z of the pan's lower face, m."""
        return self.base + BOX[2]

    @property
    def top(self) -> float:
        """z of the highest point of the cushion, m."""
        return self.pan + PAN + self.thickness + self.crown

    @property
    def rear(self) -> float:
        """y of the cushion's rear edge, m."""
        return self.middle + self.depth / 2.0

    @property
    def middle(self) -> float:
        """y of the cushion's middle, m; the column stands a little behind it."""
        return -0.025

    @property
    def tilt(self) -> tuple[float, float, float]:
        """A point of the axis that the back tilts about, m."""
        return (0.0, TILT[0], self.base + TILT[1])

    def bodies(
        self, cover: Stock, cord: Stock, shell: Stock, steel: Stock, levers: tuple[int, ...]
    ) -> list[Body]:
        """All that is fixed to the pan; `levers` are the sides (-1 right of the sitter, 1 left)."""
        return [
            self._housing(steel, levers),
            self._pan(shell),
            *self._cushion(cover, cord),
            *(self._knob(shell) if self.knob else ()),
        ]

    def _housing(self, steel: Stock, levers: tuple[int, ...]) -> Body:
        x, y = BOX[0] / 2.0, BACK - BOX[1]
        ease = 0.012
        corners = [
            (sx * (x - e), sy, z)
            for sx in (-1, 1)
            for sy, z, e in ((y, self.pan, 0), (BACK, self.pan, 0), (y + 0.03, self.base, ease),
                             (BACK - 0.01, self.base, ease), (y, self.pan - 0.015, 0),
                             (BACK, self.base + 0.012, 0))
        ]  # fmt: skip
        hole = cylinder(self.socket[1], self.socket[0], segments=24).at(z=self.base - 1e-4)
        solid = hull(corners) - hole
        for side in levers:
            pocket = slab((x - POCKET - 0.008, -0.022, self.base + 0.006),
                          (x + 0.01, 0.002, self.pan - 0.006))  # fmt: skip
            solid = solid - (pocket if side > 0 else pocket.mirrored("x"))
        low, high = self.base + 0.004, self.pan
        flank = slab((CORE, y + 0.006, low), (x - POCKET - 0.010, BACK - 0.004, high))
        front = slab((-CORE, y + 0.006, low), (CORE, -CORE, high))
        rear = slab((-CORE, CORE, low), (CORE, BACK - 0.004, high))
        return steel.piece(solid, contact=(flank, flank.mirrored("x"), front, rear))

    def _pan(self, shell: Stock) -> Body:
        outline = self._outline(0.030)
        steps = [(0.030, 0.0), (0.010, 0.003), (0.0, PAN - 0.002), (0.0, PAN)]
        solid = pad(outline, steps, self._on_pan)
        w, d = self.width / 2.0 - 0.03, self.depth / 2.0 - 0.03
        flat = slab((-w, self.middle - 0.6 * d, self.pan), (w, self.middle + d, self.pan + PAN))
        return replace(shell, edge=0.0).piece(solid, contact=(flat,))

    def _cushion(self, cover: Stock, cord: Stock) -> list[Body]:
        outline = self._outline(0.0)
        reach = min(self.width, self.depth) / 2.0
        steps = upholstered(
            self.thickness,
            roll=0.45 * self.thickness,
            crown=self.crown,
            reach=reach,
            rings=(2, 4, 3),
            under=(0.35,),
        )
        solid = pad(outline, steps, self._on_cushion)
        w, d = self.width / 2.0 - 0.012, self.depth / 2.0
        low, tip = self.pan + PAN, w - 0.5 * self.corner[0]
        front, split = self.middle - d, self.middle - 0.62 * d
        rear, high = self.middle + d - 0.008, low + self.thickness - 0.003
        easing = 0.7 * self.corner[1]
        main = slab((-w + easing, split, low), (w - easing, rear, high))
        wide = slab((-w, split, low), (w, rear - easing, high - 0.001))
        nose = slab((-tip, front + 0.01, low - 0.3 * self.fall),
                    (tip, split, low + self.thickness - 0.55 * self.fall))  # fmt: skip
        seam = piping(outline, (0.0003, 0.50 * self.thickness), self._on_cushion, 0.0024)
        bodies = [cover.piece(solid, contact=(main, wide, nose)), cord.piece(seam)]
        if self.panel:
            step = steps[-3]
            bodies.append(cord.piece(piping(outline, step, self._on_cushion, 0.0020)))
        return bodies

    def _outline(self, inset: float) -> Floats:
        front, rear = self.corner
        radii = tuple(max(r - inset, 0.01) for r in (front, front, rear, rear))
        return plan(self.width - 2.0 * inset, self.depth - 2.0 * inset, radii, segments=4)

    def _on_pan(self, flat: Floats) -> Floats:
        return self._formed(flat, self.pan, 0.0)

    def _on_cushion(self, flat: Floats) -> Floats:
        rise = np.clip(flat[:, 2] / (self.thickness + self.crown), 0.0, 1.0)
        return self._formed(flat, self.pan + PAN, self.dish * rise)

    def _formed(self, flat: Floats, low: float, dish: Floats | float) -> Floats:
        """Front edge bent down, middle pressed in, rear edge lifted."""
        x, y, z = flat.T
        forward = np.clip((-y / (self.depth / 2.0) - 0.35) / 0.65, 0.0, 1.0)
        across = 1.0 - np.clip(2.0 * x / self.width, -1.0, 1.0) ** 2
        along = 1.0 - np.clip(2.0 * y / self.depth, -1.0, 1.0) ** 2
        height = low + z - self.fall * forward**2 - dish * across * along
        return np.c_[x, y + self.middle, height]

    def _knob(self, shell: Stock) -> list[Body]:
        """The knob that sets the tilt's tension, under the front."""
        front = BACK - BOX[1] + 0.008
        knob = cylinder(0.021, 0.026, segments=10).at(0.0, front, self.base - 0.020)
        stem = cylinder(0.008, 0.022, segments=12).at(0.0, front, self.base)
        touch = box((0.028, 0.028, 0.024), at=(0.0, front, self.base - 0.019))
        return [replace(shell, edge=0.0).piece(union([knob, stem]), contact=(touch,))]

    def lever_part(self, name: str, side: int, reach: float, rod: Stock, grip: Stock) -> DraftPart:
        """A rod out of the housing's pocket that ends in a paddle, drawn to +x and mirrored."""
        z, y = self.base + 0.018, -0.010
        start = BOX[0] / 2.0 - POCKET
        knee, drop = BOX[0] / 2.0 + 0.030, 0.024
        path = [(start, z), (knee, z), (knee + 0.03, z - drop), (reach, z - drop)]
        legs = [_bar(a, b, 0.0035, y) for a, b in pairwise(path)]
        paddle = hull([
            (px, y + sy * w, z - drop + sz * t)
            for px, w, t in ((reach - 0.055, 0.007, 0.006), (reach, 0.014, 0.0045),
                             (reach + 0.008, 0.010, 0.0035))
            for sy in (-1, 1) for sz in (-1, 1)
        ])  # fmt: skip
        touch = slab(
            (reach - 0.05, y - 0.008, z - drop - 0.004), (reach, y + 0.008, z - drop + 0.004)
        )
        pivot = cylinder(0.006, 0.012, axis="y", segments=12).at(start, y - 0.006, z)
        solids = [union([*legs, pivot]), paddle, touch]
        if side < 0:
            solids = [solid.mirrored("x") for solid in solids]
        hold = Grip(
            name=f"{name}_paddle",
            kind="lever",
            position=(side * (reach - 0.02), y, z - drop),
            outward=(float(side), 0.0, 0.0),
            pull=(0.0, 0.0, 1.0),
        )
        bodies = (rod.piece(solids[0]), grip.piece(solids[1], contact=(solids[2],)))
        return DraftPart(name=name, label="lever", bodies=bodies, grips=(hold,))

    def lever_joint(self, name: str, side: int) -> Joint:
        """Pulled up by +q; a spring brings it back."""
        return Joint(
            name=f"{name}_pull",
            type="revolute",
            parent="seat",
            child=name,
            axis=(0.0, -float(side), 0.0),
            origin=(side * (BOX[0] / 2.0 - POCKET), -0.010, self.base + 0.018),
            limit=Limit(lower=0.0, upper=0.13),
            friction=0.05,
            damping=0.02,
            effort=6.0,
            spring=Spring(stiffness=5.0, reference=-0.12),
        )


def _bar(a: tuple[float, float], b: tuple[float, float], radius: float, y: float) -> Solid:
    """A stubby bar of square section between two points (x, z)."""
    return hull([
        (px, y + sy * radius, pz + sz * radius)
        for px, pz in (a, b) for sy in (-1, 1) for sz in (-1, 1)
    ])  # fmt: skip
