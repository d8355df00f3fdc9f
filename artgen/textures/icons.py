"""Small pictograms for panels and screens, drawn on a Sheet."""

import math
from collections.abc import Callable, Mapping

from artgen.core.errors import UsageError
from artgen.textures.draw import Point, Sheet


def draw_icon(sheet: Sheet, at: Point, name: str, *, size: float, fill: str) -> None:
    """One of ICONS within a square of `size` m centered on `at`."""
    if name not in ICONS:
        raise UsageError(f"there is no icon {name!r}; known: {', '.join(sorted(ICONS))}")
    ICONS[name](sheet, at, size, fill)


def _power(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    sheet.arc(at, 0.42 * size, start=-235.0, end=55.0, fill=fill, width=0.1 * size)
    top, low = (at[0], at[1] + 0.5 * size), (at[0], at[1] + 0.05 * size)
    sheet.line([top, low], fill=fill, width=0.1 * size)


def _play(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    corners = [(-0.3, -0.4), (0.42, 0.0), (-0.3, 0.4)]
    sheet.polygon([(x + a * size, y + b * size) for a, b in corners], fill=fill)


def _pause(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    for side in (-0.2, 0.2):
        low, high = (x + side * size, y - 0.4 * size), (x + side * size, y + 0.4 * size)
        sheet.line([low, high], fill=fill, width=0.2 * size)


def _drop(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    sheet.disc((x, y - 0.18 * size), 0.3 * size, fill=fill)
    corners = [(-0.29, -0.1), (0.29, -0.1), (0.0, 0.5)]
    sheet.polygon([(x + a * size, y + b * size) for a, b in corners], fill=fill)


def _sun(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    sheet.disc(at, 0.2 * size, fill=fill)
    _rays(sheet, at, (0.32 * size, 0.5 * size), 8, fill, 0.09 * size)


def _star(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    _rays(sheet, at, (0.0, 0.48 * size), 6, fill, 0.09 * size)


def _clock(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    sheet.disc(at, 0.46 * size, outline=fill, width=0.1 * size)
    hands = [(x, y + 0.28 * size), (x, y), (x + 0.2 * size, y - 0.1 * size)]
    sheet.line(hands, fill=fill, width=0.09 * size)


def _leaf(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    corners = [(-0.4, -0.1), (-0.1, 0.3), (0.45, 0.42), (0.35, -0.12), (0.0, -0.35), (-0.3, -0.3)]
    sheet.polygon([(x + a * size, y + b * size) for a, b in corners], fill=fill)
    sheet.line(
        [(x - 0.48 * size, y - 0.46 * size), (x - 0.25 * size, y - 0.22 * size)],
        fill=fill,
        width=0.08 * size,
    )


def _lock(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    sheet.box((x - 0.35 * size, y - 0.45 * size), (x + 0.35 * size, y + 0.1 * size), fill=fill)
    shackle = (x, y + 0.12 * size)
    sheet.arc(shackle, 0.27 * size, start=0.0, end=180.0, fill=fill, width=0.1 * size)


def _pot(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    sheet.box((x - 0.35 * size, y - 0.35 * size), (x + 0.35 * size, y + 0.15 * size), fill=fill)
    for level, reach in ((0.08, 0.5), (0.3, 0.4)):
        ends = [(x - reach * size, y + level * size), (x + reach * size, y + level * size)]
        sheet.line(ends, fill=fill, width=0.09 * size)


def _glass(sheet: Sheet, at: Point, size: float, fill: str) -> None:
    x, y = at
    bowl = [(-0.3, 0.48), (0.3, 0.48), (0.2, 0.05), (-0.2, 0.05)]
    sheet.polygon([(x + a * size, y + b * size) for a, b in bowl], fill=fill)
    sheet.line([(x, y + 0.1 * size), (x, y - 0.42 * size)], fill=fill, width=0.09 * size)
    foot = [(x - 0.22 * size, y - 0.44 * size), (x + 0.22 * size, y - 0.44 * size)]
    sheet.line(foot, fill=fill, width=0.09 * size)


def _rays(
    sheet: Sheet, at: Point, reach: tuple[float, float], count: int, fill: str, width: float
) -> None:
    for k in range(count):
        angle = 2.0 * math.pi * k / count + math.pi / 2.0
        cos, sin = math.cos(angle), math.sin(angle)
        ends = [(at[0] + r * cos, at[1] + r * sin) for r in reach]
        sheet.line(ends, fill=fill, width=width)


ICONS: Mapping[str, Callable[[Sheet, Point, float, str], None]] = {
    "clock": _clock,
    "drop": _drop,
    "glass": _glass,
    "leaf": _leaf,
    "lock": _lock,
    "pause": _pause,
    "play": _play,
    "pot": _pot,
    "power": _power,
    "star": _star,
    "sun": _sun,
}
