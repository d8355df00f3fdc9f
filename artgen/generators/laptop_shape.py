"""The measures of a laptop that its base and lid share, all in metres, hinge at the back (+y)."""

from dataclasses import dataclass
from functools import cached_property

from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab
from artgen.textures.keyboard import Key, keyboard_keys, keyboard_units

LID_GAP = 0.0008
"""m between deck and closed lid; rubber bumpers bridge less than half of it."""
KEY_SLACK = 0.0007
"""m by which the well is deeper than a key is high."""
WALL_SHARE = 0.62
"""Share of the chassis's height that is a plumb side wall; below it the underside is set in."""
MARGIN = 0.0016
"""m of well around the keys."""


@dataclass(frozen=True, kw_only=True)
class LaptopParams:
    """Drawn by `category_rules/laptop.toml`, where each is explained."""

    width: float
    depth_ratio: float
    base_thickness: float
    lid_thickness: float
    corner_radius: float
    wedge: float
    taper: float
    bezel_side: float
    bezel_top: float
    bezel_chin: float
    key_gap: float
    key_height: float
    key_pitch: float
    touchpad_width: float
    touchpad_share: float
    foot_height: float
    density: float
    hinge_friction: float
    hinge_width: float
    hinge_place: float
    opening_deg: int
    hinges: str
    feet: str
    logo: str
    speakers: str
    ports_left: int
    ports_right: int
    port_kinds: tuple[str, ...]
    vents: int
    numpad: bool
    screen_seed: int
    webcam: bool


@dataclass(frozen=True)
class LaptopShape:
    """Measures that follow from the params."""

    p: LaptopParams

    @property
    def half_width(self) -> float:
        """Half the extent along x."""
        return self.p.width / 2.0

    @property
    def half_depth(self) -> float:
        """Half the extent along y."""
        return self.p.width * self.p.depth_ratio / 2.0

    @property
    def floor(self) -> float:
        """Height of the chassis's underside at the back."""
        return self.p.foot_height

    @property
    def deck(self) -> float:
        """Height of the palm rest."""
        return self.floor + self.p.base_thickness

    @property
    def lid_bottom(self) -> float:
        """Height of the screen's face when closed."""
        return self.deck + LID_GAP

    @property
    def lid_top(self) -> float:
        """Height of the closed laptop."""
        return self.lid_bottom + self.p.lid_thickness

    @property
    def barrel(self) -> float:
        """Radius of the hinge barrels and of the lid's rear edge."""
        return self.p.lid_thickness / 2.0

    @property
    def axis_z(self) -> float:
        """Height of the hinge axis: the middle of the lid."""
        return self.lid_bottom + self.barrel

    @property
    def axis_y(self) -> float:
        """Where the hinge axis lies: the lid's rear edge turns on itself, over the deck."""
        return self.half_depth - self.barrel - 0.0012

    @property
    def side_height(self) -> float:
        """Height of the plumb side wall."""
        return WALL_SHARE * self.p.base_thickness

    @property
    def port_height(self) -> float:
        """Height of the ports' middle."""
        return self.deck - self.side_height / 2.0

    def front_rise(self, y: float) -> float:
        """How far the underside at y lies above `floor`."""
        share = (self.half_depth - y) / (2.0 * self.half_depth)
        return self.p.wedge * self.p.base_thickness * WALL_SHARE * share

    @cached_property
    def has_numpad(self) -> bool:
        """Drawn, and the width has room for it."""
        units, _ = keyboard_units(True)
        return self.p.numpad and units * self.p.key_pitch + 0.030 <= self.p.width

    @cached_property
    def keys_size(self) -> tuple[float, float]:
        """Width and depth of the field of keys."""
        across, deep = keyboard_units(self.has_numpad)
        return across * self.p.key_pitch, deep * self.p.key_pitch * 0.98

    @property
    def keys_corner(self) -> tuple[float, float]:
        """Left front corner of the field of keys."""
        width, depth = self.keys_size
        return -width / 2.0, self.half_depth - 0.028 - depth

    @cached_property
    def keys(self) -> list[Key]:
        """Every key, relative to `keys_corner`."""
        return keyboard_keys(self.keys_size, numpad=self.has_numpad, gap=self.p.key_gap)

    @property
    def well_depth(self) -> float:
        """From the deck to the floor that keys stand on."""
        return self.p.key_height + KEY_SLACK

    @property
    def well_half_width(self) -> float:
        """Half the well's extent along x."""
        return self.keys_size[0] / 2.0 + MARGIN

    def well_solid(self) -> Solid:
        """What the keyboard takes from the chassis."""
        return self._well(self.deck - self.well_depth, self.deck + 0.01)

    def well_floor(self) -> Solid:
        """The sheet under the keys."""
        bottom = self.deck - self.well_depth
        return self._well(bottom - 0.0004, bottom + 0.0002)

    def _well(self, low: float, high: float) -> Solid:
        width, depth = self.keys_size
        outline = rounded_rectangle(width + 2 * MARGIN, depth + 2 * MARGIN, 0.0022, segments=3)
        middle = self.keys_corner[1] + depth / 2.0
        return prism(outline, high - low).at(0.0, middle, low)

    @property
    def touchpad(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Lower and upper corner on the deck."""
        front, back = -self.half_depth, self.keys_corner[1] - MARGIN
        depth = self.p.touchpad_share * (back - front - 0.010)
        middle = (front + back) / 2.0
        half = self.p.touchpad_width * self.p.width / 2.0
        return (-half, middle - depth / 2.0), (half, middle + depth / 2.0)

    @property
    def hinge_gap(self) -> float:
        """Between a knuckle and the walls of the lid's notch."""
        return 0.0008

    @property
    def hinge_spans(self) -> tuple[tuple[float, float], ...]:
        """Where along x the lid is notched for a knuckle."""
        if self.p.hinges == "long":
            half = 0.60 * self.half_width
            return ((-half, half),)
        half = self.p.hinge_width * self.p.width / 2.0
        middle = self.p.hinge_place * self.half_width
        return ((-middle - half, -middle + half), (middle - half, middle + half))

    def lid_segments(self) -> list[tuple[float, float]]:
        """Where along x the lid reaches to the axis."""
        edges = [-self.half_width, *(x for span in self.hinge_spans for x in span), self.half_width]
        return list(zip(edges[::2], edges[1::2], strict=True))

    @property
    def notch_front(self) -> float:
        """Where the lid's notches end towards the front."""
        return self.axis_y - self.barrel - 0.0016

    def notch(self, span: tuple[float, float]) -> Solid:
        """What a knuckle takes from the lid."""
        return slab(
            (span[0], self.notch_front, self.deck),
            (span[1], self.half_depth + 0.01, self.lid_top + 0.01),
        )


def keyboard_fits(p: LaptopParams) -> bool:
    """Keys leave 7 mm at each side, and a palm rest of 55 mm in front."""
    shape = LaptopShape(p)
    palm = shape.keys_corner[1] + shape.half_depth
    return shape.well_half_width + 0.007 <= shape.half_width and palm >= 0.055


def hinges_fit(p: LaptopParams) -> bool:
    """Knuckles stay clear of the corners and of each other."""
    shape = LaptopShape(p)
    outer = shape.hinge_spans[-1][1]
    return outer <= shape.half_width - p.corner_radius - 0.006 and (
        p.hinges == "long" or shape.hinge_spans[1][0] > 0.03
    )


def weight_is_plausible(p: LaptopParams) -> bool:
    """0.9 to 3.3 kg by the volume of base and lid."""
    area = p.width * p.width * p.depth_ratio
    return 0.95 <= area * (0.80 * p.base_thickness * p.density + p.lid_thickness * 1150) <= 3.2
