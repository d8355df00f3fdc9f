"""Cisterns: a tank behind a pan or one hidden in a wall, flushed by buttons or a lever."""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, loft, prism, slab, tube, union, wire

Flush = Literal["dual", "single", "lever"]


@dataclass(frozen=True, kw_only=True)
class Flushed:
    """Bodies for the base, and what a hand presses."""

    base: tuple[Body, ...]
    parts: tuple[DraftPart, ...]
    joints: tuple[Joint, ...]


@dataclass(frozen=True, kw_only=True)
class Tank:
    """A cistern that stands on a pan, m.

    Attributes:
        size: width, depth and height without the lid.
        taper: how much narrower it is below, of its width.
        foot: z of its underside.
        front: y of its front.
        lid: height of its lid.
        over: how far the lid stands over.
        flush: two buttons or one in the lid, or a lever on the front.
    """

    size: tuple[float, float, float]
    taper: float
    foot: float
    front: float
    lid: float
    over: float
    flush: Flush

    def made(self, china: Stock, metal: Stock) -> Flushed:
        """Tank, lid and flush."""
        width, depth, height = self.size
        top = self.foot + height
        cap_half = (width / 2.0 + self.over - 0.004, depth / 2.0 + self.over - 0.004)
        cap = slab(
            (-cap_half[0], self._middle - cap_half[1], top),
            (cap_half[0], self._middle + cap_half[1], top + self.lid - 0.003),
        )
        bodies, lid = [self._tank(china)], self._lid(top)
        if self.flush == "lever":
            handle = SideLever(at=(-0.30 * width, self.front + 0.0005, top - 0.055), length=0.075)
            bodies += [china.piece(lid, contact=(cap,)), handle.escutcheon(metal)]
            return Flushed(
                base=tuple(bodies), parts=(handle.part(metal),), joints=(handle.joint(),)
            )
        plane = PanelPlane(
            origin=(0.0, self._middle, top + self.lid),
            right=(1.0, 0.0, 0.0),
            up=(0.0, 1.0, 0.0),
            size=(0.08, 0.06),
        )
        return _pressed(
            plane, bodies, china.piece(lid, contact=(cap,)), metal, dual=self.flush == "dual"
        )

    @property
    def _middle(self) -> float:
        return self.front + self.size[1] / 2.0

    def _tank(self, china: Stock) -> Body:
        """Narrower below, its foot drawn in."""
        width, depth, height = self.size
        narrow, shallow = width * (1.0 - self.taper), depth * (1.0 - 0.6 * self.taper)
        rings = (
            (0.96 * narrow, 0.96 * shallow, self.foot),
            (narrow, shallow, self.foot + 0.02),
            (width, depth, self.foot + height),
        )
        solid = loft([_at(_moved(_rectangle(w, d, 0.035), self._middle), z) for w, d, z in rings])
        half, front = narrow / 2.0 - 0.003, self._middle - shallow / 2.0 + 0.003
        contact = slab(
            (-half, front, self.foot + 0.02),
            (half, 2.0 * self._middle - front, self.foot + height),
        )
        return china.piece(solid, contact=(contact,))

    def _lid(self, z: float) -> Solid:
        """A cover with rounded edges."""
        width, depth, _ = self.size
        full = _rectangle(width + 2.0 * self.over, depth + 2.0 * self.over, 0.04)
        steps = ((0.0, 1.0), (0.55, 1.0), (0.85, 0.988), (1.0, 0.955))
        return loft([_at(_moved(w * full, self._middle), z + s * self.lid) for s, w in steps])


def wall_plate(
    at: tuple[float, float, float], size: tuple[float, float], *, dual: bool, metal: Stock
) -> Flushed:
    """A flush plate on a wall that looks to -y, its middle at `at`; size is width and height."""
    width, height = size
    plane = PanelPlane(
        origin=(at[0], at[1] - 0.011, at[2]),
        right=(1.0, 0.0, 0.0),
        up=(0.0, 0.0, 1.0),
        size=size,
    )
    solid = prism(rounded_rectangle(width, height, 0.012, segments=4), 0.011).at(0.0, 0.0, -0.011)
    contact = slab((-width / 2.0, -height / 2.0, -0.011), (width / 2.0, height / 2.0, -0.0045))
    body = metal.piece(plane.placed(solid), contact=(plane.placed(contact),))
    reach = (0.72 * width, 0.60 * height)
    return _pressed(plane, [], body, metal, dual=dual, field=reach)


def _pressed(
    plane: PanelPlane,
    bodies: list[Body],
    face: Body,
    metal: Stock,
    *,
    dual: bool,
    field: tuple[float, float] = (0.052, 0.044),
) -> Flushed:
    """A face with one button or two in it, over `field` around the plane's origin."""
    w, h = field
    one = PushButton(
        name="flush",
        center=(0.0, 0.0),
        size=field,
        proud=0.0035,
        travel=0.0028,
        depth=0.0015,
        force=9.0,
    )
    buttons = [one]
    if dual:
        gap = 0.0016
        wide = 0.60 * w
        buttons = [
            replace(
                one,
                name="flush_full",
                center=((wide - w) / 2.0 - gap / 2.0, 0.0),
                size=(wide - gap, h),
            ),
            replace(
                one,
                name="flush_half",
                center=(wide / 2.0 + gap / 2.0, 0.0),
                size=(w - wide - gap, h),
                force=7.0,
            ),
        ]
    ring = prism(rounded_rectangle(w + 0.014, h + 0.014, 0.3 * h, segments=5), 0.0012)
    inner = prism(rounded_rectangle(w + 0.003, h + 0.003, 0.1 * h, segments=4), 0.02)
    wells = union([plane.placed(button.well()) for button in buttons])
    bezel = metal.piece(plane.placed(ring - inner.at(0.0, 0.0, -0.01)) - wells)
    solid = face.solid - wells
    return Flushed(
        base=(*bodies, replace(face, solid=solid), bezel),
        parts=tuple(button.part(plane, metal.surface, density=2500.0) for button in buttons),
        joints=tuple(button.joint(plane, parent="base") for button in buttons),
    )


@dataclass(frozen=True, kw_only=True)
class SideLever:
    """A flush lever on a front that looks to -y; it points to the right.

    Attributes:
        at: of its pivot on the face, m.
        length: from the pivot to its end, m.
    """

    at: tuple[float, float, float]
    length: float

    def escutcheon(self, metal: Stock) -> Body:
        """The ring around its neck, half in the wall."""
        ring = tube(0.0165, 0.0085, 0.012, axis="y", segments=24).at(*self.at)
        return metal.piece(ring.at(0.0, -0.006, 0.0))

    def part(self, metal: Stock) -> DraftPart:
        """Neck and arm, its end drooping a little."""
        neck = cylinder(0.0068, 0.022, axis="y", segments=18).at(0.0, -0.025, 0.0)
        path = np.array(
            [(0.0, -0.022, 0.0), (0.3 * self.length, -0.024, -0.002), (self.length, -0.026, -0.010)]
        )
        arm = wire(path, 0.0062, sides=12)
        knob = prism(circle(0.0085, segments=16), 0.020).turned("y", math.pi / 2.0)
        knob = knob.at(self.length - 0.016, -0.026, -0.0095)
        contact = arm.hull().at(*self.at)
        x, y, z = self.at
        grip = Grip(
            name="flush_lever_end",
            kind="lever",
            position=(x + self.length - 0.006, y - 0.026, z - 0.0095),
            outward=(0.0, -1.0, 0.0),
            pull=(0.0, 0.0, -1.0),
        )
        body = metal.piece(union([neck, arm, knob]).at(*self.at), contact=(contact,))
        return DraftPart(name="flush_lever", label="lever", bodies=(body,), grips=(grip,))

    def joint(self) -> Joint:
        """Its end is pressed down by +q; a spring lifts it."""
        return Joint(
            name="flush_lever_turn",
            type="revolute",
            parent="base",
            child="flush_lever",
            axis=(0.0, 1.0, 0.0),
            origin=(self.at[0], 0.0, self.at[2]),
            limit=Limit(lower=0.0, upper=math.radians(32.0)),
            friction=0.06,
            damping=0.02,
            effort=5.0,
            spring=Spring(stiffness=0.8, reference=-0.35),
        )


def tiled_wall(
    width: float,
    height: float,
    *,
    front: float,
    depth: float,
    tile: tuple[float, float],
    stock: Stock,
) -> Body:
    """A piece of wall with joints between its tiles."""
    whole = slab((-width / 2.0, front, 0.0), (width / 2.0, front + depth, height))
    cut, groove = whole, 0.0012
    for k in range(-int(width / tile[0]), int(width / tile[0]) + 1):
        x = (k + 0.5) * tile[0]
        if abs(x) < width / 2.0 - 0.01:
            cut = cut - slab((x - groove, front - 1.0, -1.0), (x + groove, front + 0.0015, 9.0))
    for k in range(1, int(height / tile[1]) + 1):
        z = k * tile[1]
        if z < height - 0.01:
            cut = cut - slab((-9.0, front - 1.0, z - groove), (9.0, front + 0.0015, z + groove))
    return stock.piece(cut, contact=(whole,), grain="x")


def water_pipe(x: float, y: float, top: float, *, metal: Stock) -> Body:
    """A hose from a cistern's underside to a valve on the floor."""
    path = np.array(
        [
            (x, y, 0.05),
            (x, y, 0.15),
            (x + 0.012, y, 0.5 * top),
            (x, y, top - 0.05),
            (x, y, top + 0.004),
        ]
    )
    hose = wire(path, 0.006, sides=10)
    flange = cylinder(0.024, 0.006, segments=20).at(x, y, 0.0)
    valve = cylinder(0.011, 0.06, segments=16).at(x, y, 0.004)
    knob = cylinder(0.013, 0.02, axis="y", segments=12).at(x, y - 0.034, 0.045)
    stem = cylinder(0.005, 0.02, axis="y", segments=10).at(x, y - 0.02, 0.045)
    nut = cylinder(0.012, 0.018, segments=6).at(x, y, top - 0.018)
    pillar = slab((x - 0.008, y - 0.008, 0.0), (x + 0.008, y + 0.008, 0.06))
    return metal.piece(union([hose, flange, valve, knob, stem, nut]), contact=(pillar,))


def _rectangle(width: float, depth: float, radius: float) -> Floats:
    return rounded_rectangle(width, depth, radius, segments=5)


def _moved(plan: Floats, y: float) -> Floats:
    return np.asarray(plan + np.array((0.0, y)))


def _at(plan: Floats, z: float) -> Floats:
    return np.c_[plan, np.full(len(plan), z)]
