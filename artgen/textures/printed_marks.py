"""Anything printed on a flat face, as a list of marks: labels, dial scales, panels, badges.

`spec.detail` holds `background` (`#rrggbb`), `marks` and, for displays, `lit`: one mark a line, its
kind first, then what `MARKS` says, lengths in m from the lower left corner of the face. Lit marks
glow. `artgen.generators.kit.printed` writes such lines.
"""

from collections.abc import Callable, Mapping

from artgen.core.errors import UsageError
from artgen.core.surface import SurfaceSpec
from artgen.textures.draw import Anchor, Sheet
from artgen.textures.icons import draw_icon
from artgen.textures.images import TextureSet

PITCH = 1.4e-4
"""m a pixel; capitals of 2 mm are 14 pixels tall."""
FEWEST, MOST = 32, 768
"""Pixels along a side."""
ANCHORS: Mapping[str, Anchor] = {"left": "left", "middle": "middle", "right": "right"}
Words = list[str]


def printed_marks(spec: SurfaceSpec) -> TextureSet:
    """The print in its colors; with lit marks also what glows."""
    face = _sheet(spec, str(spec.detail["background"]))
    _draw(face, str(spec.detail.get("marks", "")))
    glowing = str(spec.detail.get("lit", ""))
    if not glowing:
        return TextureSet(color=face.image())
    _draw(face, glowing)
    lit = _sheet(spec, "#000000")
    _draw(lit, glowing)
    return TextureSet(color=face.image(), emission=lit.image())


def _sheet(spec: SurfaceSpec, background: str) -> Sheet:
    longest = max(spec.tile)
    pitch = max(PITCH, longest / MOST)
    pixels = (
        max(FEWEST, round(spec.tile[0] / pitch)),
        max(FEWEST, round(spec.tile[1] / pitch)),
    )
    return Sheet(spec.tile, pixels=pixels, background=background)


def _draw(sheet: Sheet, marks: str) -> None:
    for line in filter(None, marks.split("\n")):
        kind, *words = line.split(" ")
        if kind not in MARKS:
            raise UsageError(f"there is no mark {kind!r}; known: {', '.join(sorted(MARKS))}")
        MARKS[kind](sheet, words)


def _text(sheet: Sheet, words: Words) -> None:
    x, y, height = map(float, words[:3])
    sheet.text((x, y), " ".join(words[5:]), height=height, fill=words[4], anchor=ANCHORS[words[3]])


def _line(sheet: Sheet, words: Words) -> None:
    *ends, width = map(float, words[:-1])
    points = list(zip(ends[::2], ends[1::2], strict=True))
    sheet.line(points, fill=words[-1], width=width)


def _box(sheet: Sheet, words: Words) -> None:
    x0, y0, x1, y1, radius = map(float, words[:5])
    sheet.box((x0, y0), (x1, y1), fill=words[5], radius=radius)


def _disc(sheet: Sheet, words: Words) -> None:
    x, y, radius = map(float, words[:3])
    sheet.disc((x, y), radius, fill=words[3])


def _ring(sheet: Sheet, words: Words) -> None:
    x, y, radius, width = map(float, words[:4])
    sheet.disc((x, y), radius, outline=words[4], width=width)


def _arc(sheet: Sheet, words: Words) -> None:
    x, y, radius, start, end, width = map(float, words[:6])
    sheet.arc((x, y), radius, start=start, end=end, fill=words[6], width=width)


def _polygon(sheet: Sheet, words: Words) -> None:
    numbers = [float(word) for word in words[:-1]]
    sheet.polygon(list(zip(numbers[::2], numbers[1::2], strict=True)), fill=words[-1])


def _icon(sheet: Sheet, words: Words) -> None:
    x, y, size = map(float, words[:3])
    draw_icon(sheet, (x, y), words[4], size=size, fill=words[3])


def _digits(sheet: Sheet, words: Words) -> None:
    x, y, height = map(float, words[:3])
    sheet.digits((x, y), " ".join(words[4:]), height=height, fill=words[3])


MARKS: Mapping[str, Callable[[Sheet, Words], None]] = {
    "text": _text,  # x y cap anchor color words
    "line": _line,  # x y x y ... width color
    "box": _box,  # x0 y0 x1 y1 radius color
    "disc": _disc,  # x y radius color
    "ring": _ring,  # x y radius width color
    "arc": _arc,  # x y radius start end width color, degrees
    "polygon": _polygon,  # x y x y ... color
    "icon": _icon,  # x y size color name
    "digits": _digits,  # x y height color words
}
