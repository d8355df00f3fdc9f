"""Control panels of ovens and washers, upright beside the door or lying above it: what they carry,
how it is printed, and the dials and buttons that stand on them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.articulation.types import Body, DraftPart, Joint
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.generators.kit.dial import Dial, DialStyle
from artgen.generators.kit.printed import (
    Point,
    area,
    dial_scale,
    digits,
    icon,
    plate,
    printed,
    words,
)
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.solid import Solid
from artgen.textures.appliance_panel import BRANDS, LED

CELLS: Mapping[str, Mapping[str, float]] = {
    "keypad": {"brand": 0.9, "display": 1.5, "keys": 4.6, "buttons": 1.3},
    "dials": {"brand": 1.0, "power_dial": 3.2, "timer_dial": 3.2},
    "jog": {"brand": 0.9, "display": 1.5, "keys": 1.7, "power_dial": 2.7, "buttons": 1.3},
    "knobs": {"function_knob": 3.0, "brand": 1.6, "display": 2.6, "oven_knob": 3.0},
    "touch": {"brand": 2.2, "touch_left": 1.8, "display": 2.6, "touch_right": 2.2},
    "timer": {"brand": 1.8, "function_knob": 2.2, "timer_dial": 2.2, "oven_knob": 2.2},
    "range": {"left_front_knob": 1.0, "left_rear_knob": 1.0, "oven_knob": 1.1, "brand": 0.9,
              "display": 1.2, "function_knob": 1.1, "right_rear_knob": 1.0,
              "right_front_knob": 1.0},
    "range_plain": {"left_front_knob": 1.0, "left_rear_knob": 1.0, "right_rear_knob": 1.0,
                    "right_front_knob": 1.0, "brand": 1.1, "oven_knob": 1.3},
    "washer": {"brand": 1.5, "program_knob": 1.9, "display": 1.6, "buttons": 1.7},
    "washer_right": {"brand": 1.5, "display": 1.6, "buttons": 1.7, "program_knob": 1.9},
    "washer_touch": {"brand": 1.4, "touch_left": 1.5, "display": 1.8, "touch_right": 1.9},
}  # fmt: skip
"""What a panel carries from its upper or left end, and how much of its length each takes."""
RELEASE = 1.5
SCALES: Mapping[str, tuple[str, ...]] = {
    "power": ("100", "300", "450", "600", "800"),
    "timer": ("0", "5", "10", "15", "20", "25", "30"),
    "oven": ("0", "50", "100", "150", "200", "250"),
    "function": ("0", "I", "II", "III", "IV", "V", "VI"),
    "program": ("0", "90", "60", "40", "30", "20", "E"),
    "left": ("0", "1", "2", "3", "4", "5", "6"),
    "right": ("0", "1", "2", "3", "4", "5", "6"),
}
"""Numerals around a dial by the first word of its name: W, minutes, degrees Celsius, steps."""
SWEEP = math.radians(270.0)
TURN = math.radians(300.0)
"""What the scale of a dial without stops covers."""
LEAST = 0.012
"""m; radius of the smallest dial."""
KEYS = ("POPCORN", "PIZZA", "POTATO", "REHEAT", "DEFROST", "1", "2", "3", "4", "5", "6", "7", "8",
        "9", "CLOCK", "0", "POWER", "TIMER")  # fmt: skip
TOUCH = {"touch_left": ("power", "sun", "clock"), "touch_right": ("leaf", "lock", "star", "play")}
GLYPHS = ("play", "pause", "clock", "lock")
PLATE = 0.0012
"""m; thickness of the printed foil as drawn, half of it inside the panel."""
SUNK = 0.0006


@dataclass(frozen=True, kw_only=True)
class ControlPanel:
    """A panel's face and what is on it.

    Attributes:
        plane: its face.
        kind: key of `CELLS`.
        buttons: that are pressed, in the cell `buttons`.
        release: whether a large button at its end opens the door.
        dial: form of the dials.
        dial_share: radius of a dial as a share of its cell.
        brand: index of the brand's word.
        time: shown by the display.
        led: color of the display.
        endless: dials turn on without stops.
    """

    plane: PanelPlane
    kind: str
    buttons: int
    release: bool
    dial: DialStyle
    dial_share: float
    brand: int
    time: str
    led: str
    endless: bool = False

    @property
    def upright(self) -> bool:
        """Higher than wide."""
        return self.plane.size[1] > self.plane.size[0]

    @cached_property
    def cells(self) -> dict[str, tuple[Point, Point]]:
        """Name to (center, size) on the face."""
        shares = dict(CELLS[self.kind]) | ({"release": RELEASE} if self.release else {})
        along, across = max(self.plane.size), min(self.plane.size)
        ends = np.cumsum([0.0, *shares.values()]) / sum(shares.values()) * along
        cells = {}
        for name, low, high in zip(shares, ends[:-1], ends[1:], strict=True):
            middle, length = float(low + high) / 2.0, float(high - low)
            if self.upright:
                cells[name] = ((across / 2.0, along - middle), (across, length))
            else:
                cells[name] = ((middle, across / 2.0), (length, across))
        return cells

    @cached_property
    def dials(self) -> list[Dial]:
        """Knobs on their shafts."""
        found: list[Dial] = []
        for name, (center, size) in self.cells.items():
            if name.endswith(("dial", "knob")):
                radius = max(LEAST, self.dial_share * min(size))
                found.append(
                    Dial(name=name, center=center, radius=radius, height=0.6 * radius + 0.008,
                         style=self.dial, label="knob" if name.endswith("knob") else "dial",
                         sweep=None if self.endless else SWEEP, lift=PLATE - SUNK)
                )  # fmt: skip
        return found

    @cached_property
    def push_buttons(self) -> list[PushButton]:
        """Buttons in a row, and the release."""
        made = []
        if "buttons" in self.cells:
            (u, v), (w, h) = self.cells["buttons"]
            pitch, size = 0.86 * w / self.buttons, min(0.014, 0.42 * h)
            for k in range(self.buttons):
                x = u + (k - (self.buttons - 1) / 2.0) * pitch
                made.append(
                    PushButton(name=f"button_{k + 1}", center=(x, v - 0.14 * h),
                               size=(min(0.8 * pitch, 3.0 * size), size), proud=0.003)
                )  # fmt: skip
        if self.release:
            center, (w, h) = self.cells["release"]
            made.append(
                PushButton(name="release_button", center=center, size=(0.80 * w, 0.66 * h),
                           proud=0.0045, travel=0.004, depth=0.005, force=9.0)
            )  # fmt: skip
        return made

    def cut(self, block: Solid) -> Solid:
        """The panel's block with room for shafts and caps."""
        for hole in self._holes:
            block = block - self.plane.placed(hole)
        return block

    def foil(self) -> Body:
        """The printed face."""
        return plate(self.plane, "panel_print", density=ABS, thickness=PLATE, radius=0.003,
                     sunk=SUNK, holes=self._holes)  # fmt: skip

    def parts(self, knob: str, mark: str, cap: str) -> list[DraftPart]:
        """Dials and buttons."""
        return [
            *(dial.part(self.plane, knob, mark, density=ABS) for dial in self.dials),
            *(button.part(self.plane, cap, density=ABS) for button in self.push_buttons),
        ]

    def joints(self) -> list[Joint]:
        """Theirs."""
        movers: Sequence[Dial | PushButton] = [*self.dials, *self.push_buttons]
        return [mover.joint(self.plane, parent="base") for mover in movers]

    def print(self, face: SurfaceSpec) -> SurfaceSpec:
        """The surface of the foil, printed on the color of `face`."""
        light = sum(face.color) / 3.0 > 0.18
        ink = "#26282b" if light else "#e4e6e8"
        marks = [self._brand(ink), *self._dial_marks(ink), *self._button_marks(ink)]
        lit: list[str] = []
        for side, glyphs in TOUCH.items():
            if side in self.cells:
                marks += self._touch_marks(side, glyphs, ink)
        if "keys" in self.cells:
            marks += self._key_marks(line="#5d6165" if light else "#64686d")
        if "display" in self.cells:
            (u, v), (w, h) = self.cells["display"]
            half, tall = (0.42 * w, 0.34 * h), 0.36 * min(h, 0.42 * w)
            marks.append(
                area((u - half[0], v - half[1]), (u + half[0], v + half[1]), ink="#050607",
                     radius=0.002)
            )  # fmt: skip
            start = (u - 0.30 * len(self.time) * tall, v - tall / 2.0)
            lit.append(digits(start, self.time, height=tall, ink=LED[self.led]))
        return printed(
            "panel_print", self.plane.size, background=srgb_hex(face.color), marks=marks, lit=lit,
            roughness=max(0.16, face.roughness), metallic=face.metallic,
        )  # fmt: skip

    @cached_property
    def _holes(self) -> list[Solid]:
        return [
            *(dial.hole() for dial in self.dials),
            *(button.well() for button in self.push_buttons),
        ]

    def _brand(self, ink: str) -> str:
        (u, v), (w, h) = self.cells["brand"]
        return words((u, v), BRANDS[self.brand], cap=min(0.105 * w, 0.38 * h, 0.012), ink=ink)

    def _dial_marks(self, ink: str) -> list[str]:
        marks = []
        for dial in self.dials:
            scale = SCALES[dial.name.split("_")[0]]
            cap = min(0.0042, 0.13 * dial.radius)
            marks += dial_scale(dial.center, dial.radius + 0.0025, scale, cap=cap, ink=ink,
                                start=dial.start, sweep=dial.sweep or TURN)  # fmt: skip
        return marks

    def _button_marks(self, ink: str) -> list[str]:
        marks = []
        for button, glyph in zip(self.push_buttons, GLYPHS, strict=False):
            if button.name == "release_button":
                continue
            (u, v), (_, h) = button.center, button.size
            marks.append(icon((u, v + 1.05 * h), glyph, size=min(0.007, 0.7 * h), ink=ink))
        return marks

    def _touch_marks(self, cell: str, glyphs: Sequence[str], ink: str) -> list[str]:
        """Signs of touch keys in a row."""
        (u, v), (w, h) = self.cells[cell]
        size = min(0.011, 0.2 * h)
        places = [u + ((k + 0.5) / len(glyphs) - 0.5) * 0.84 * w for k in range(len(glyphs))]
        return [icon((x, v), g, size=size, ink=ink) for x, g in zip(places, glyphs, strict=True)]

    def _key_marks(self, *, line: str) -> list[str]:
        """A membrane keypad: as many cells as fit at 17 x 11 mm or so."""
        (u, v), (w, h) = self.cells["keys"]
        columns = max(2, min(6, int(w / 0.027)))
        rows = max(1, min(6, int(h / 0.016), -(-len(KEYS) // columns)))
        du, dv = 0.90 * w / columns, 0.94 * h / rows
        marks = []
        for k in range(columns * rows):
            x = u + (k % columns - (columns - 1) / 2.0) * du
            y = v + ((rows - 1) / 2.0 - k // columns) * dv
            half = (0.44 * du, 0.40 * dv)
            marks.append(area((x - half[0], y - half[1]), (x + half[0], y + half[1]), ink=line,
                              radius=0.002))  # fmt: skip
            text = KEYS[k % len(KEYS)]
            cap = min(0.42 * dv, 0.0046 if len(text) < 3 else 0.12 * du)
            marks.append(words((x, y), text, cap=cap, ink="#f4f5f6"))
        return marks
