"""The numbers of one laptop: what the rule draws, and where everything sits for it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from artgen.generators.kit.barrel import Barrels, one_long_hinge, two_hinges
from artgen.generators.kit.keyboard import Keycap
from artgen.textures.keyboard_layout import KeyboardStyle

INCH = 0.0254
ASPECTS: Mapping[str, float] = {"16:9": 16.0 / 9.0, "16:10": 1.6, "3:2": 1.5}
PLAY = 0.001
"""m; between the lid, its barrels and the base, wherever the lid stands."""
DECK = 0.0012
"""Thickness of the top plate, m."""
KEY_SINK = 0.0003
"""m by which the keys stay below the palm rest, so that the lid cannot touch them."""
WELL_MARGIN = 0.0012
"""From the outermost keys to the wall of the well, m."""
WELL_FLOOR = 0.0004
FULL_PITCH = 0.01905
"""m; three quarters of an inch, the pitch of full-size keys."""
SMALL_BEZEL = 0.7
"""Growth of the side bezels for each inch below 13.3."""
LEAST_PALM = 0.066
"""m from the keyboard to the front edge."""


@dataclass(frozen=True, kw_only=True)
class LaptopParams:
    """What the rule draws; lengths in m unless they are shares."""

    style: str
    screen_inch: float
    aspect: str
    bezel_side: float
    bezel_top: float
    chin: float
    thickness: float
    lid_thickness: float
    corner: float
    belly: float
    nose_run: float
    nose_rise: float
    gap: float
    foot: float
    hinge: str
    hinge_radius: float
    hinge_length: float
    hinge_place: float
    opening_deg: float
    hold: float
    block: float
    keyboard: str
    arrows: str
    keycap: str
    key_gap: float
    key_height: float
    row_pitch: float
    function_share: float
    side_margin: float
    deck_rear: float
    power: str
    pad: str
    pad_share: float
    pad_aspect: float
    speakers: str
    vent_share: float
    feet: str
    ports_left: int
    ports_right: int
    bezel: str
    seal: str
    logo: str
    finger_notch: bool
    two_tone: bool
    dark_well: bool
    packing: float
    picture: int


@dataclass(frozen=True, kw_only=True)
class Style:
    """A kind of laptop: thinnest and thickest base and lid (m), effective densities (kg/m3).

    A base is a shell around boards, battery and air. 1.29 kg in 304 x 212 x 16.1 mm and 1.4 kg in
    323 x 218 x 17.9 mm give 1240 and 1110 kg/m3 over all; thick cases hold more air.
    """

    base: tuple[float, float]
    lid: tuple[float, float]
    base_density: float
    lid_density: float
    bezel: float
    ports: tuple[str, ...]


STYLES: Mapping[str, Style] = {
    "ultrabook": Style(
        base=(0.0090, 0.0128), lid=(0.0038, 0.0052), base_density=1480.0, lid_density=1280.0,
        bezel=1.0, ports=("usb_c", "usb_c", "audio", "usb_c"),
    ),
    "business": Style(
        base=(0.0125, 0.0172), lid=(0.0050, 0.0068), base_density=1080.0, lid_density=1120.0,
        bezel=1.35, ports=("usb_c", "usb_a", "hdmi", "audio", "ethernet"),
    ),
    "gaming": Style(
        base=(0.0165, 0.0205), lid=(0.0058, 0.0076), base_density=1030.0, lid_density=1000.0,
        bezel=1.2, ports=("usb_a", "audio", "ethernet", "usb_a"),
    ),
    "chromebook": Style(
        base=(0.0122, 0.0160), lid=(0.0060, 0.0080), base_density=900.0, lid_density=950.0,
        bezel=1.8, ports=("usb_c", "usb_a", "audio", "card"),
    ),
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Rect:
    """From (x0, y0) to (x1, y1), m."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.x1 - self.x0, self.y1 - self.y0

    @property
    def middle(self) -> tuple[float, float]:
        """Its center."""
        return (self.x0 + self.x1) / 2.0, (self.y0 + self.y1) / 2.0

    def grown(self, by: float) -> "Rect":
        """Larger by `by` on each side."""
        return Rect(x0=self.x0 - by, y0=self.y0 - by, x1=self.x1 + by, y1=self.y1 + by)


@dataclass(frozen=True)
class Layout:
    """Places of one laptop at rest; the front edge is at y = 0, the table at z = 0."""

    p: LaptopParams

    @cached_property
    def style(self) -> Style:
        """The numbers of its kind."""
        return STYLES[self.p.style]

    @cached_property
    def screen_size(self) -> tuple[float, float]:
        """Width and height of the picture."""
        ratio = ASPECTS[self.p.aspect]
        height = self.p.screen_inch * INCH / math.hypot(ratio, 1.0)
        return ratio * height, height

    @cached_property
    def width(self) -> float:
        """Of base and lid; small screens sit in wide bezels, because keys cannot shrink."""
        small = 1.0 + SMALL_BEZEL * max(0.0, 13.3 - self.p.screen_inch)
        return self.screen_size[0] + 2.0 * self.p.bezel_side * self.style.bezel * small

    @cached_property
    def keyboard(self) -> KeyboardStyle:
        """Keys as wide as a full-size keyboard, or as the case allows."""
        p = self.p
        units = 15.0 + {"compact": 0.0, "navigation": 1.0, "numpad": 4.25}[p.keyboard]
        pitch = min(FULL_PITCH, (self.width - 2.0 * p.side_margin) / units)
        return KeyboardStyle(
            block=p.keyboard,
            arrows=p.arrows,
            pitch=pitch,
            row_pitch=min(p.row_pitch, 1.04 * pitch),
            gap=p.key_gap,
            function_share=p.function_share,
            power_key=p.power == "key",
        )

    @cached_property
    def keycap(self) -> Keycap:
        """The form of its keys."""
        smile = 0.0034 if self.p.keycap == "smile" else 0.0009
        return Keycap(height=self.p.key_height, taper=0.0004, corner=0.0009, smile=smile)

    @cached_property
    def base_height(self) -> float:
        """Of the case without feet."""
        return _between(self.style.base, self.p.thickness)

    @cached_property
    def deck(self) -> float:
        """z of the palm rest."""
        return self.p.foot + self.base_height

    @cached_property
    def lid_z(self) -> tuple[float, float]:
        """z of the lid's inner and outer face."""
        low = self.deck + self.p.gap
        return low, low + _between(self.style.lid, self.p.lid_thickness)

    @cached_property
    def crown(self) -> float:
        """Radius of the lid's outer edges."""
        return 0.38 * (self.lid_z[1] - self.lid_z[0])

    @cached_property
    def radius(self) -> float:
        """Of the barrels: at least half of what they stand beside."""
        return max(self.p.hinge_radius, 0.52 * (self.lid_z[1] - self.deck))

    @cached_property
    def axis_above_deck(self) -> float:
        """A barrel sits in its groove with more than half of its height."""
        return 0.45 * self.radius

    @cached_property
    def reach(self) -> float:
        """From the axis to the rear edge of the lid's plate."""
        return self.radius + PLAY

    @cached_property
    def lid_depth(self) -> float:
        """The picture with its bezels, or more where keyboard and touchpad need it."""
        p, scale = self.p, self.style.bezel
        natural = self.screen_size[1] + (p.bezel_top + p.chin) * scale
        field = self.keyboard.size[1] - self.p.key_gap + 2.0 * WELL_MARGIN
        return max(natural, p.deck_rear + field + LEAST_PALM)

    @cached_property
    def axis_y(self) -> float:
        """y of the hinge."""
        return self.lid_depth + self.reach

    @cached_property
    def axis_z(self) -> float:
        """z of the hinge."""
        return self.deck + self.axis_above_deck

    @cached_property
    def top(self) -> float:
        """z of the lid's outer face over the hinge's axis."""
        return self.lid_z[1] - self.axis_z

    @cached_property
    def hinge_rear(self) -> float:
        """y to which the base may reach behind the axis, whatever the lid does."""
        return self.axis_y + min(0.0015, self.ledge_top - self.axis_z - PLAY)

    @cached_property
    def ledge_top(self) -> float:
        """z of the upper face of the ledge, below the rounding of the lid's edge."""
        return self.lid_z[1] - self.crown

    @cached_property
    def ledge_reach(self) -> float:
        """From the axis to the ledge, which closes the gap between lid and base beside the barrels.

        Opened beyond a right angle, the ledge's outer edge stays behind the axis by this or by the
        ledge's height over the axis, whichever is less.
        """
        return self.hinge_rear - self.axis_y + PLAY

    @cached_property
    def rear(self) -> float:
        """y of the base's rear face; an exhaust block lies behind the hinge of a gaming laptop."""
        return self.hinge_rear + (self.p.block if self.p.style == "gaming" else 0.0)

    @cached_property
    def upper(self) -> float:
        """Largest opening, rad."""
        return math.radians(self.p.opening_deg)

    @cached_property
    def arm_top(self) -> float:
        """z to which the arms between lid and barrels reach."""
        return min(self.lid_z[1] - self.crown, self.axis_z + 0.85 * self.radius)

    @cached_property
    def barrels(self) -> Barrels:
        """The knuckles."""
        p, width = self.p, self.width
        if p.hinge == "long":
            base, lid = one_long_hinge(length=p.hinge_length * width, base_length=0.010)
        else:
            base, lid = two_hinges(
                width=width - 0.016,
                place=p.hinge_place * width / 2.0,
                length=0.11 * width * p.hinge_length,
                base_length=0.007,
            )
        return Barrels(y=self.axis_y, z=self.axis_z, radius=self.radius, base=base, lid=lid)

    @cached_property
    def pocket_rear(self) -> float:
        """y to which the base is open for the lid's arms."""
        arms = self.axis_y + math.hypot(self.reach, 0.85 * self.radius) + PLAY
        return arms if self.p.style == "gaming" else max(arms, self.rear + 0.002)

    @cached_property
    def well(self) -> Rect:
        """The opening around the keys."""
        w, h = self.keyboard.size
        rear = self.axis_y - self.radius - PLAY - self.p.deck_rear
        grow = WELL_MARGIN - self.p.key_gap / 2.0
        field = Rect(x0=-w / 2.0, x1=w / 2.0, y0=rear - grow - h, y1=rear - grow)
        return field.grown(grow)

    @cached_property
    def keys_origin(self) -> tuple[float, float, float]:
        """Lower left corner of the keyboard's field on the well's floor."""
        grow = WELL_MARGIN - self.p.key_gap / 2.0
        floor = self.deck - KEY_SINK - self.p.key_height
        return self.well.x0 + grow, self.well.y0 + grow, floor

    @cached_property
    def pad(self) -> Rect:
        """Touchpad and its buttons, in the middle of the palm rest, under the letters."""
        palm = self.well.y0
        height = min(self.p.pad_share * palm, 0.095)
        width = min(height * self.p.pad_aspect, 0.46 * self.width)
        middle = -2.1 * self.keyboard.pitch if self.p.keyboard == "numpad" else 0.0
        low = 0.46 * (palm - height)
        return Rect(x0=middle - width / 2.0, x1=middle + width / 2.0, y0=low, y1=low + height)

    @cached_property
    def screen(self) -> Rect:
        """The picture in the closed lid; its upper edge is at the front."""
        w, h = self.screen_size
        top = self.p.bezel_top * self.style.bezel
        return Rect(x0=-w / 2.0, x1=w / 2.0, y0=top, y1=top + h)

    @cached_property
    def nose(self) -> tuple[float, float]:
        """Run and rise of the rounded lower front edge."""
        p = self.p
        rise = max(p.belly, p.nose_rise * self.base_height)
        return max(p.belly, p.nose_run * self.axis_y), rise


def _between(ends: tuple[float, float], share: float) -> float:
    return ends[0] + share * (ends[1] - ends[0])
