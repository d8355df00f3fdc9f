"""Handling marks of ISO 780 and a maker's certificate, drawn on a Sheet."""

import math
from collections.abc import Callable, Mapping

from artgen.textures.draw import Point, Sheet

Mark = Callable[[Sheet, Point, float, str], None]


def _glass(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    """Fragile: a stemmed glass with a crack."""
    x, y = at
    bowl = [(-0.24, 0.45), (0.24, 0.45), (0.20, 0.16), (0.06, -0.02), (-0.06, -0.02), (-0.20, 0.16)]
    sheet.polygon([(x + a * size, y + b * size) for a, b in bowl], fill=fill)
    sheet.line([(x, y), (x, y - 0.36 * size)], fill=fill, width=0.07 * size)
    sheet.box((x - 0.2 * size, y - 0.42 * size), (x + 0.2 * size, y - 0.34 * size), fill=fill)
    crack = [(0.04, 0.46), (-0.04, 0.34), (0.06, 0.27), (0.0, 0.17)]
    sheet.line([(x + a * size, y + b * size) for a, b in crack], fill="#00ff00", width=0.035 * size)
    _frame(sheet, at, size, fill)


def _up(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    """This way up: two arrows on a bar."""
    x, y = at
    for side in (-0.2, 0.2):
        head = [(-0.15, 0.16), (0.15, 0.16), (0.0, 0.42)]
        sheet.polygon([(x + (side + a) * size, y + b * size) for a, b in head], fill=fill)
        low, high = (x + (side - 0.05) * size, y - 0.28 * size), (x + (side + 0.05) * size, y)
        sheet.box(low, (high[0], y + 0.18 * size), fill=fill)
    sheet.box((x - 0.38 * size, y - 0.42 * size), (x + 0.38 * size, y - 0.34 * size), fill=fill)
    _frame(sheet, at, size, fill)


def _umbrella(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    """Keep dry: an umbrella under drops."""
    x, y = at
    dome = [
        (
            x + 0.36 * size * math.cos(k * math.pi / 12.0),
            y + 0.3 * size * math.sin(k * math.pi / 12),
        )
        for k in range(13)
    ]
    sheet.polygon(dome, fill=fill)
    sheet.line([(x, y), (x, y - 0.30 * size)], fill=fill, width=0.05 * size)
    hook = (x - 0.07 * size, y - 0.30 * size)
    sheet.arc(hook, 0.09 * size, start=180.0, end=360.0, fill=fill, width=0.045 * size)
    for side in (-0.3, -0.1, 0.1, 0.3):
        top = (x + side * size, y + 0.44 * size)
        sheet.line(
            [top, (top[0] - 0.03 * size, top[1] - 0.08 * size)], fill=fill, width=0.03 * size
        )
    _frame(sheet, at, size, fill)


def _certificate(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    """The round stamp of the box's maker, with its strength."""
    x, y = at
    for share in (0.5, 0.36):
        sheet.disc(at, share * size, outline=fill, width=0.025 * size)
    for k, words in enumerate(("BOX CERT", "ECT 32", "200 LBS")):
        sheet.text((x, y + (0.13 - 0.13 * k) * size), words, height=0.075 * size, fill=fill)


def _frame(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    half = 0.54 * size
    sheet.box(
        (x - half, y - half), (x + half, y + half), outline=fill, width=0.03 * size,
        radius=0.05 * size,
    )  # fmt: skip


MARKS: Mapping[str, Mark] = {
    "certificate": _certificate,
    "glass": _glass,
    "umbrella": _umbrella,
    "up": _up,
}
