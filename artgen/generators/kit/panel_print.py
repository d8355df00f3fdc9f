"""What is printed on a control panel: brand, scales, signs, keys, and a lit display."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.dial import Dial
from artgen.generators.kit.printed import (
    Point,
    area,
    dial_scale,
    digits,
    icon,
    line,
    printed,
    words,
)
from artgen.generators.kit.push_button import PushButton
from artgen.textures.appliance_panel import LED

SCALES: Mapping[str, tuple[str, ...]] = {
    "power": ("100", "300", "450", "600", "800"),
    "timer": ("0", "5", "10", "15", "20", "25", "30"),
    "oven": ("0", "50", "100", "150", "200", "250"),
    "left": ("0", "1", "2", "3", "4", "5", "6"),
    "right": ("0", "1", "2", "3", "4", "5", "6"),
}
"""Numerals around a dial by the first word of its name: W, minutes, degrees Celsius, steps."""
FUNCTIONS = ("power", "sun", "star", "drop", "leaf", "pot")
"""Signs around the function selector of an oven."""
PROGRAMS = ("Off", "Cotton", "Eco 40", "Mix", "Wool", "Quick 30", "Rinse", "Spin")
"""Words around the program selector of a washer."""
TURN = math.radians(300.0)
"""What the scale of a dial without stops covers."""
KEYS = ("POPCORN", "PIZZA", "POTATO", "REHEAT", "DEFROST", "1", "2", "3", "4", "5", "6", "7", "8",
        "9", "CLOCK", "0", "POWER", "TIMER", "SOUP", "RICE", "FISH", "MELT", "GRILL",
        "ADD 30")  # fmt: skip
TOUCH = {"touch_left": ("power", "sun", "clock"), "touch_right": ("leaf", "lock", "star", "play")}
GLYPHS = ("play", "pause", "clock", "lock")


@dataclass(frozen=True, kw_only=True)
class PanelPrint:
    """The marks of one panel.

    Attributes:
        cells: name to (center, size) of what the panel carries, m.
        dials: that stand on it.
        buttons: that are pressed.
        ink: color of the print.
        key: color of membrane keys.
        brand: the maker's word.
        tagline: below it, perhaps empty.
        time: shown by the display.
        led: color of the display.
    """

    cells: Mapping[str, tuple[Point, Point]]
    dials: Sequence[Dial]
    buttons: Sequence[PushButton]
    ink: str
    key: str
    brand: str
    tagline: str
    time: str
    led: str

    def surface(self, name: str, size: Point, face: SurfaceSpec) -> SurfaceSpec:
        """The surface of a foil of `size` on the color of `face`."""
        marks = [*self._brand(), *self._buttons()]
        for dial in self.dials:
            marks += self._scale(dial)
        for cell, glyphs in TOUCH.items():
            if cell in self.cells:
                marks += self._touch(cell, glyphs)
        if "keys" in self.cells:
            marks += self._keys()
        window, lit = self._display() if "display" in self.cells else ([], [])
        return printed(
            name, size, background=srgb_hex(face.color), marks=[*marks, *window], lit=lit,
            roughness=max(0.16, face.roughness), metallic=face.metallic,
        )  # fmt: skip

    def _brand(self) -> list[str]:
        (u, v), (w, h) = self.cells["brand"]
        cap = min(0.105 * w, 0.38 * h, 0.012)
        made = [words((u, v + (0.4 * cap if self.tagline else 0.0)), self.brand, cap=cap,
                      ink=self.ink)]  # fmt: skip
        if self.tagline:
            made.append(words((u, v - 1.1 * cap), self.tagline, cap=0.38 * cap, ink=self.ink))
        return made

    def _display(self) -> tuple[list[str], list[str]]:
        """(the dark window, its lit digits and signs)."""
        (u, v), (w, h) = self.cells["display"]
        color = LED[self.led]
        half = (0.42 * w, min(0.34 * h, 0.26 * w))
        tall = min(1.0 * half[1], 0.46 * half[0])
        low = v - 0.30 * half[1] - tall / 2.0
        start = (u - 0.33 * len(self.time) * tall, low)
        window = area((u - half[0], v - half[1]), (u + half[0], v + half[1]), ink="#050607",
                      radius=0.002)  # fmt: skip
        lit = [digits(start, self.time, height=tall, ink=color)]
        sign = 0.34 * half[1]
        for k, glyph in enumerate(("lock", "drop", "clock")):
            place = (u + (k - 1) * 2.4 * sign, v + 0.66 * half[1])
            lit.append(icon(place, glyph, size=sign, ink=color))
        return [window], lit

    def _scale(self, dial: Dial) -> list[str]:
        kind = dial.name.split("_")[0]
        sweep = dial.sweep or TURN
        if kind in SCALES:
            cap = min(0.0045, 0.19 * dial.radius)
            return dial_scale(dial.center, dial.radius + 0.0022, SCALES[kind], cap=cap,
                              ink=self.ink, start=dial.start, sweep=sweep)  # fmt: skip
        if kind == "function":
            spots = _around(dial, len(FUNCTIONS), sweep, dial.radius + 0.0075)
            size, pairs = min(0.0085, 0.36 * dial.radius), zip(spots, FUNCTIONS, strict=True)
            return [icon(at, g, size=size, ink=self.ink) for at, g in pairs]
        return self._programs(dial, sweep)

    def _programs(self, dial: Dial, sweep: float) -> list[str]:
        """Words beside a program selector, a tick before each."""
        cap = min(0.0040, 0.17 * dial.radius)
        inner = _around(dial, len(PROGRAMS), sweep, dial.radius + 0.0020)
        outer = _around(dial, len(PROGRAMS), sweep, dial.radius + 0.0050)
        far = _around(dial, len(PROGRAMS), sweep, dial.radius + 0.0065)
        marks = []
        for a, b, place, word in zip(inner, outer, far, PROGRAMS, strict=True):
            aside = (place[0] - dial.center[0]) / dial.radius
            anchor = "left" if aside > 0.5 else "right" if aside < -0.5 else "middle"
            drop = 0.0 if anchor != "middle" else math.copysign(0.8 * cap, b[1] - a[1])
            marks.append(line([a, b], width=0.18 * cap, ink=self.ink))
            marks.append(
                words((place[0], place[1] + drop), word, cap=cap, ink=self.ink, anchor=anchor)
            )
        return marks

    def _buttons(self) -> list[str]:
        marks = []
        for button, glyph in zip(self.buttons, GLYPHS, strict=False):
            if button.name == "release_button":
                continue
            (u, v), (_, h) = button.center, button.size
            marks.append(icon((u, v + 1.15 * h), glyph, size=min(0.009, 0.8 * h), ink=self.ink))
        return marks

    def _touch(self, cell: str, glyphs: Sequence[str]) -> list[str]:
        """Signs of touch keys in a row."""
        (u, v), (w, h) = self.cells[cell]
        size = min(0.011, 0.2 * h)
        places = [u + ((k + 0.5) / len(glyphs) - 0.5) * 0.84 * w for k in range(len(glyphs))]
        return [
            icon((x, v), g, size=size, ink=self.ink) for x, g in zip(places, glyphs, strict=True)
        ]

    def _keys(self) -> list[str]:
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
            marks.append(area((x - half[0], y - half[1]), (x + half[0], y + half[1]), ink=self.key,
                              radius=0.002))  # fmt: skip
            text = KEYS[k % len(KEYS)]
            cap = min(0.42 * dv, 0.0046 if len(text) < 3 else 0.12 * du)
            marks.append(words((x, y), text, cap=cap, ink="#f4f5f6"))
        return marks


def _around(dial: Dial, count: int, sweep: float, radius: float) -> list[Point]:
    """Places along the scale, clockwise from the pointer's rest."""
    angles = [dial.start - sweep * k / (count - 1) for k in range(count)]
    u, v = dial.center
    return [(u + radius * math.cos(a), v + radius * math.sin(a)) for a in angles]
