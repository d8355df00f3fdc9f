"""A drawing sheet in meters for decals: shapes, text, LED digits and icons.

Recipes for keyboards, panels, labels and screens draw with it. Everything is drawn four times finer
in each direction and averaged, so edges are smooth; coordinates start at the lower left corner, x
to the right, y up, like a `Decal`. The only font is the one inside Pillow.

    sheet = Sheet((0.40, 0.06), pixels=(512, 80), background="#1b1b1d")
    sheet.box((0.02, 0.01), (0.10, 0.05), fill="#303236", radius=0.004)
    sheet.text((0.06, 0.03), "START", height=0.008, fill="#e8e8e8")
    sheet.digits((0.15, 0.02), "1:25", height=0.02, fill="#ff3b20")
    draw_icon(sheet, (0.25, 0.03), "power", size=0.015, fill="#e8e8e8")  # of textures.icons
    TextureSet(color=sheet.image())
"""

import math
from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from PIL import Image as Pillow
from PIL import ImageDraw, ImageFont

from artgen.core.errors import UsageError
from artgen.textures.images import Image

FINER = 4
"""Drawn pixels per image pixel and direction."""
CAP_HEIGHT = 0.69
"""Height of a capital of Pillow's font as a share of the size asked for (138 px at 200).
"""
Point = tuple[float, float]
Anchor = Literal["left", "middle", "right"]

SEGMENTS = {
    "0": "abcdef",
    "1": "bc",
    "2": "abged",
    "3": "abgcd",
    "4": "fgbc",
    "5": "afgcd",
    "6": "afgedc",
    "7": "abc",
    "8": "abcdefg",
    "9": "abcdfg",
    "-": "g",
    "E": "afged",
    "H": "bcefg",
    "C": "afed",
    " ": "",
}
"""Lit bars of a seven-segment digit: a on top, clockwise to f, g across."""
BARS: Mapping[str, tuple[Point, Point]] = {
    "a": ((0.0, 1.0), (0.5, 1.0)),
    "b": ((0.5, 0.5), (0.5, 1.0)),
    "c": ((0.5, 0.0), (0.5, 0.5)),
    "d": ((0.0, 0.0), (0.5, 0.0)),
    "e": ((0.0, 0.0), (0.0, 0.5)),
    "f": ((0.0, 0.5), (0.0, 1.0)),
    "g": ((0.0, 0.5), (0.5, 0.5)),
}
"""Ends of each bar for a digit of height 1."""


class Sheet:
    """A rectangle of `size` m drawn upon; later shapes cover earlier ones.

    Colors are sRGB `#rrggbb`. Lengths in m, angles in degrees, counter-clockwise from +x.
    """

    def __init__(self, size: Point, *, pixels: tuple[int, int], background: str) -> None:
        if min(size) <= 0.0 or min(pixels) < 1:
            raise UsageError(f"a sheet of {size} m and {pixels} pixels is empty; both must be > 0")
        self.size = size
        self._scale = (pixels[0] * FINER / size[0], pixels[1] * FINER / size[1])
        self._picture = Pillow.new("RGB", (pixels[0] * FINER, pixels[1] * FINER), background)
        self._draw = ImageDraw.Draw(self._picture)

    def image(self) -> Image:
        """(H, W, 3) sRGB, the average of the finer drawing."""
        return np.asarray(self._picture.reduce(FINER)).copy()

    def box(
        self,
        lower: Point,
        upper: Point,
        *,
        fill: str | None = None,
        outline: str | None = None,
        width: float = 0.0,
        radius: float = 0.0,
    ) -> None:
        """A rectangle between two corners, its own corners rounded by `radius`."""
        (left, bottom), (right, top) = self._pixel(lower), self._pixel(upper)
        self._draw.rounded_rectangle(
            (left, top, max(right - 1.0, left), max(bottom - 1.0, top)),
            radius=self._length(radius),
            fill=fill,
            outline=outline,
            width=self._stroke(width),
        )

    def picture(self, lower: Point, upper: Point, image: Image) -> None:
        """An (H, W, 3) image stretched between two corners."""
        (left, bottom), (right, top) = self._pixel(lower), self._pixel(upper)
        extent = max(1, round(right) - round(left)), max(1, round(bottom) - round(top))
        placed = Pillow.fromarray(image).resize(extent, Pillow.Resampling.BICUBIC)
        self._picture.paste(placed, (round(left), round(top)))

    def disc(
        self,
        center: Point,
        radius: float,
        *,
        fill: str | None = None,
        outline: str | None = None,
        width: float = 0.0,
    ) -> None:
        """A filled circle, a ring, or both."""
        box = self._around(center, radius)
        self._draw.ellipse(box, fill=fill, outline=outline, width=self._stroke(width))

    def arc(
        self, center: Point, radius: float, *, start: float, end: float, fill: str, width: float
    ) -> None:
        """A piece of a ring from `start` to `end` degrees; `width` lies inside the radius."""
        box = self._around(center, radius)
        self._draw.arc(box, -end, -start, fill=fill, width=self._stroke(width))

    def line(self, points: Sequence[Point], *, fill: str, width: float) -> None:
        """A polyline with round joints."""
        placed = [self._pixel(point) for point in points]
        self._draw.line(placed, fill=fill, width=self._stroke(width), joint="curve")

    def polygon(self, points: Sequence[Point], *, fill: str) -> None:
        """A filled outline."""
        self._draw.polygon([self._pixel(point) for point in points], fill=fill)

    def text(
        self, at: Point, words: str, *, height: float, fill: str, anchor: Anchor = "middle"
    ) -> None:
        """Words at half height on `at`, beginning, centered or ending there; `height` of capitals.

        Glyphs of the built-in font: Latin letters, digits, punctuation. Draw symbols as icons.
        """
        font = ImageFont.load_default(size=max(4.0, height * self._scale[1] / CAP_HEIGHT))
        x, y = self._pixel(at)
        baseline = y + 0.5 * height * self._scale[1]
        side = {"left": "ls", "middle": "ms", "right": "rs"}[anchor]
        self._draw.text((x, baseline), words, font=font, fill=fill, anchor=side)

    def text_width(self, words: str, *, height: float) -> float:
        """How long `text` would be, m."""
        font = ImageFont.load_default(size=max(4.0, height * self._scale[1] / CAP_HEIGHT))
        return float(font.getlength(words)) / self._scale[0]

    def digits(
        self, at: Point, words: str, *, height: float, fill: str, unlit: str | None = None
    ) -> float:
        """Seven-segment digits with their lower left corner at `at`; returns their length, m.

        Args:
            words: characters of SEGMENTS, or `:` and `.`.
            unlit: color of the dark bars, which stay invisible if None.
        """
        x, y = at
        for word in words:
            if word in ":.":
                self._dots((x, y), word, height=height, fill=fill)
                x += 0.3 * height
                continue
            if word not in SEGMENTS:
                raise UsageError(f"digit {word!r} of {words!r} is not one of {''.join(SEGMENTS)}:.")
            for name, ends in BARS.items():
                if (color := fill if name in SEGMENTS[word] else unlit) is not None:
                    self._bar((x, y), ends, height=height, fill=color)
            x += 0.75 * height
        return x - at[0] - 0.25 * height

    def _dots(self, at: Point, word: str, *, height: float, fill: str) -> None:
        radius = 0.06 * height
        for level in (0.28, 0.72) if word == ":" else (0.0,):
            self.disc((at[0] + radius, at[1] + level * height + radius), radius, fill=fill)

    def _bar(self, at: Point, ends: tuple[Point, Point], *, height: float, fill: str) -> None:
        (ax, ay), (bx, by) = ends
        along = (0.09, 0.0) if ay == by else (0.0, 0.09)  # gaps at the corners
        low = (at[0] + height * (ax + along[0]), at[1] + height * (ay + along[1]))
        high = (at[0] + height * (bx - along[0]), at[1] + height * (by - along[1]))
        self.line([low, high], fill=fill, width=0.1 * height)

    def _pixel(self, point: Point) -> Point:
        return point[0] * self._scale[0], (self.size[1] - point[1]) * self._scale[1]

    def _around(self, center: Point, radius: float) -> tuple[float, float, float, float]:
        x, y = self._pixel(center)
        across, up = radius * self._scale[0], radius * self._scale[1]
        return x - across, y - up, x + across - 1.0, y + up - 1.0

    def _length(self, meters: float) -> float:
        return meters * min(self._scale)

    def _stroke(self, meters: float) -> int:
        return max(1, math.floor(self._length(meters) + 0.5))
