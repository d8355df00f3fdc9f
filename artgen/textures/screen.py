"""What a lit laptop screen shows: desktop, code editor, photo or video; 16:10, seeded."""

from collections.abc import Callable, Mapping

import numpy as np

from artgen.core.errors import UsageError
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.draw import Point, Sheet
from artgen.textures.icons import draw_icon
from artgen.textures.images import TextureSet
from artgen.textures.landscape import backdrop

PIXELS = (512, 320)
SIZE = (1.6, 1.0)
"""Drawing units: heights are shares of the screen's height."""
Hues = tuple[str, ...]
ACCENTS: Hues = ("#4c8dff", "#ff8f3f", "#32b67a", "#d9577f", "#8c6bf2", "#e0b23c", "#3fb7c9")
CODE_HUES: Hues = ("#d4d4d4", "#569cd6", "#c586c0", "#ce9178", "#6a9955", "#dcdcaa", "#9cdcfe")


def screen(spec: SurfaceSpec) -> TextureSet:
    """Emission alone: under the picture a screen is black glass.

    `detail["kind"]` is one of KINDS, `detail["seed"]` an integer.

    Raises:
        UsageError: the kind is unknown.
    """
    kind = str(spec.detail.get("kind", "desktop"))
    if kind not in KINDS:
        known = ", ".join(sorted(KINDS))
        raise UsageError(f"surface {spec.name}: no screen {kind!r}; known: {known}")
    rng = Stream(int(spec.detail.get("seed", 1)), "screen", kind).generator()
    return TextureSet(emission=KINDS[kind](rng).image())


def _desktop(rng: np.random.Generator) -> Sheet:
    """Wallpaper, a bar on top, one to three windows and a dock."""
    sheet = _paper(rng)
    _menu_bar(sheet)
    writers = (_document, _chart, _files)
    for k in range(int(rng.integers(1, 4))):
        width, height = 0.5 + 0.3 * rng.random(), 0.38 + 0.2 * rng.random()
        left = 0.08 + (1.44 - width) * rng.random()
        low = 0.17 + (0.74 - height) * rng.random()
        _window(sheet, (left, low), (left + width, low + height), bar="#e4e6ea", fill="#fbfbfc")
        writers[(k + int(rng.integers(3))) % 3](
            sheet, (left, low), (left + width, low + height - 0.05), rng
        )
    _dock(sheet, rng)
    return sheet


def _editor(rng: np.random.Generator) -> Sheet:
    """A dark editor: files on the left, colored code, a terminal below."""
    sheet = Sheet(SIZE, pixels=PIXELS, background="#1e1f26")
    sheet.box((0.0, 0.955), (1.6, 1.0), fill="#33353f")
    sheet.box((0.0, 0.0), (0.3, 0.955), fill="#262832")
    sheet.box((0.3, 0.905), (1.6, 0.955), fill="#2b2d38")
    sheet.box((0.3, 0.905), (0.52, 0.955), fill="#1e1f26")
    sheet.text((0.41, 0.93), "main.py", height=0.018, fill="#d8dae2")
    for k in range(15):
        indent = 0.03 + 0.025 * (k % 4 > 0)
        size = 0.08 + 0.13 * rng.random()
        level = 0.91 - 0.045 * k
        sheet.box((indent, level - 0.007), (indent + size, level + 0.007), fill="#8f93a3")
    _code(sheet, rng, lower=0.27, upper=0.88)
    sheet.box((0.3, 0.035), (1.6, 0.235), fill="#17181d")
    for k in range(5):
        level = 0.205 - 0.034 * k
        color = "#4ec98b" if k % 2 == 0 else "#b4b7c2"
        sheet.box((0.33, level - 0.006), (0.45 + 0.6 * rng.random(), level + 0.006), fill=color)
    sheet.box((0.0, 0.0), (1.6, 0.035), fill=_one_of(rng, ACCENTS))
    return sheet


def _photo(rng: np.random.Generator) -> Sheet:
    """A landscape between the dark panels of a photo program."""
    sheet = Sheet(SIZE, pixels=PIXELS, background="#202124")
    sheet.picture((0.0, 0.2), (1.28, 0.95), backdrop(rng, (320, 188)))
    sheet.box((1.28, 0.0), (1.6, 1.0), fill="#2a2b2f")
    for k in range(7):
        level, share = 0.66 - 0.08 * k, rng.random()
        sheet.box((1.32, level - 0.004), (1.56, level + 0.004), fill="#5a5c63")
        sheet.disc((1.34 + 0.2 * share, level), 0.012, fill="#e4e5e8")
    heights = 0.03 + 0.13 * rng.random(13)
    outline = [(1.32 + 0.02 * k, 0.74 + float(h)) for k, h in enumerate(heights)]
    sheet.polygon([(1.32, 0.74), *outline, (1.56, 0.74)], fill="#8b93a5")
    for k in range(7):
        left = 0.03 + 0.178 * k
        small = backdrop(rng, (40, 30))
        sheet.picture((left, 0.04), (left + 0.16, 0.16), small)
    return sheet


def _video(rng: np.random.Generator) -> Sheet:
    """A film in full width with black bars, a progress line and its buttons."""
    sheet = Sheet(SIZE, pixels=PIXELS, background="#060607")
    sheet.picture((0.0, 0.11), (1.6, 0.89), backdrop(rng, (400, 195)))
    share = 0.2 + 0.6 * rng.random()
    sheet.box((0.05, 0.172), (1.55, 0.182), fill="#b9bcc2", radius=0.005)
    sheet.box((0.05, 0.172), (0.05 + 1.5 * share, 0.182), fill="#ff3b30", radius=0.005)
    sheet.disc((0.05 + 1.5 * share, 0.177), 0.014, fill="#ff3b30")
    draw_icon(sheet, (0.08, 0.055), "pause", size=0.06, fill="#f2f2f4")
    minutes, seconds = int(120 * share), int(rng.integers(60))
    sheet.text((0.16, 0.055), f"{minutes}:{seconds:02d} / 2:00:00", height=0.026, fill="#f2f2f4",
               anchor="left")  # fmt: skip
    return sheet


KINDS: Mapping[str, Callable[[np.random.Generator], Sheet]] = {
    "desktop": _desktop,
    "editor": _editor,
    "photo": _photo,
    "video": _video,
}


def _paper(rng: np.random.Generator) -> Sheet:
    sheet = Sheet(SIZE, pixels=PIXELS, background="#000000")
    sheet.picture((0.0, 0.0), SIZE, backdrop(rng, PIXELS))
    return sheet


def _menu_bar(sheet: Sheet) -> None:
    sheet.box((0.0, 0.96), (1.6, 1.0), fill="#f1f2f5")
    sheet.disc((0.04, 0.98), 0.011, fill="#2b2d33")
    for k, word in enumerate(("Files", "Edit", "View", "Window")):
        sheet.text((0.075 + 0.105 * k, 0.98), word, height=0.018, fill="#2b2d33", anchor="left")
    sheet.text((1.58, 0.98), "10:42", height=0.018, fill="#2b2d33", anchor="right")


def _dock(sheet: Sheet, rng: np.random.Generator) -> None:
    count = int(rng.integers(7, 11))
    half = 0.045 * count + 0.015
    sheet.box((0.8 - half, 0.02), (0.8 + half, 0.12), fill="#dfe3ea", radius=0.025)
    names = ("play", "sun", "clock", "leaf", "star", "drop", "power")
    for k in range(count):
        x = 0.8 - half + 0.06 + 0.09 * k
        color = ACCENTS[(k + int(rng.integers(3))) % len(ACCENTS)]
        sheet.box((x - 0.034, 0.036), (x + 0.034, 0.104), fill=color, radius=0.016)
        draw_icon(sheet, (x, 0.07), names[k % len(names)], size=0.038, fill="#ffffff")


def _window(sheet: Sheet, lower: Point, upper: Point, *, bar: str, fill: str) -> None:
    (left, low), (right, top) = lower, upper
    sheet.box((left - 0.006, low - 0.01), (right + 0.006, top), fill="#3c4149", radius=0.02)
    sheet.box(lower, upper, fill=fill, radius=0.016)
    sheet.box((left, top - 0.05), upper, fill=bar, radius=0.016)
    for k, color in enumerate(("#ff5f57", "#febc2e", "#28c840")):
        sheet.disc((left + 0.025 + 0.027 * k, top - 0.025), 0.009, fill=color)


def _document(sheet: Sheet, lower: Point, upper: Point, rng: np.random.Generator) -> None:
    (left, low), (right, top) = lower, upper
    sheet.box((left + 0.04, top - 0.05), (left + 0.25, top - 0.025), fill="#2c2f36")
    count = int((top - low - 0.09) / 0.026)
    for k in range(count):
        level = top - 0.08 - 0.026 * k
        reach = 0.45 if k % 6 == 5 else 0.85 + 0.15 * rng.random()
        end = left + 0.04 + (right - left - 0.08) * reach
        sheet.box((left + 0.04, level - 0.005), (end, level + 0.005), fill="#8d929c")


def _chart(sheet: Sheet, lower: Point, upper: Point, rng: np.random.Generator) -> None:
    (left, low), (right, top) = lower, upper
    color, count = _one_of(rng, ACCENTS), 9
    step = (right - left - 0.08) / count
    for k in range(count):
        height = (top - low - 0.09) * (0.2 + 0.8 * rng.random())
        x = left + 0.04 + step * k
        sheet.box((x, low + 0.04), (x + 0.7 * step, low + 0.04 + height), fill=color)
    sheet.line([(left + 0.04, low + 0.04), (right - 0.04, low + 0.04)], fill="#4a4e57", width=0.004)


def _files(sheet: Sheet, lower: Point, upper: Point, rng: np.random.Generator) -> None:
    (left, low), (right, top) = lower, upper
    sheet.box((left, low), (left + 0.14, top), fill="#eceef2")
    for k in range(6):
        level = top - 0.04 - 0.035 * k
        sheet.box((left + 0.02, level - 0.006), (left + 0.11, level + 0.006), fill="#9aa0ab")
    columns, rows = int((right - left - 0.16) / 0.11), int((top - low - 0.03) / 0.12)
    for k in range(columns * rows):
        x, y = left + 0.2 + 0.11 * (k % columns), top - 0.06 - 0.12 * (k // columns)
        color = "#6db3f2" if rng.random() < 0.6 else _one_of(rng, ACCENTS)
        sheet.box((x - 0.033, y - 0.025), (x + 0.033, y + 0.025), fill=color, radius=0.006)
        sheet.box((x - 0.028, y - 0.052), (x + 0.028, y - 0.042), fill="#8d929c")


def _code(sheet: Sheet, rng: np.random.Generator, *, lower: float, upper: float) -> None:
    """Lines of words as colored bars, indented like code."""
    indent = 0
    for k in range(int((upper - lower) / 0.031)):
        level = upper - 0.031 * k
        sheet.box((0.325, level - 0.005), (0.345, level + 0.005), fill="#50535f")
        indent = int(np.clip(indent + rng.integers(-1, 2), 0, 4))
        x = 0.38 + 0.045 * indent
        for _ in range(int(rng.integers(0, 7))):
            size = 0.03 + 0.1 * rng.random()
            color = _one_of(rng, CODE_HUES)
            sheet.box((x, level - 0.008), (x + size, level + 0.008), fill=color, radius=0.004)
            x += size + 0.02


def _one_of(rng: np.random.Generator, options: Hues) -> str:
    return options[int(rng.integers(len(options)))]
