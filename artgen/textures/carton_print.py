"""What is printed and stuck on cartons: handling marks, names, labels, tape."""

from collections.abc import Callable, Mapping

import numpy as np

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.carton_marks import MARKS
from artgen.textures.draw import Sheet
from artgen.textures.images import Image, TextureSet
from artgen.textures.kraft import mottled

PIXELS = 640
"""Along the longer side."""
MAKERS = ("NORDPAK", "CARTEX", "Boxwell", "PAKKLINE", "Fernhoek", "KARTONAGE 7")
"""Invented."""
ROOMS = ("KITCHEN", "BEDROOM", "OFFICE", "LIVING", "BATH")
KEY = "#00ff00"
"""Never printed: where it stays, the board shows."""


def carton_print(spec: SurfaceSpec) -> TextureSet:
    """One face of a box; `spec.tile` is its size.

    `spec.detail` holds face (front, side, top), design (plain, moving, shipping, brand), ink
    (`#rrggbb`), maker (index), tape (0 or 1), mottle and seed.
    """
    width, height = spec.tile
    scale = PIXELS / max(width, height)
    pixels = (max(16, round(width * scale)), max(16, round(height * scale)))
    sheet = Sheet((width, height), pixels=pixels, background=KEY)
    FACES[str(spec.detail["face"])](sheet, spec.detail)
    printed = sheet.image().astype(float)
    rng = Stream(int(spec.detail.get("seed", 1)), "carton", str(spec.detail["face"])).generator()
    board = mottled(
        rng, (pixels[1], pixels[0]), spec.color, strength=float(spec.detail.get("mottle", 1.0))
    )
    taped, shine = _tape(spec, pixels, board)
    bare = _bare(printed)
    ink = np.where(bare > 0.999, 0.0, (printed - bare * (0.0, 255.0, 0.0)) / (1.0 - bare + 1e-9))
    mixed = bare * taped + (1.0 - bare) * np.clip(ink, 0.0, 255.0)
    color = np.clip(mixed + 0.5, 0.0, 255.0).astype(np.uint8)
    return TextureSet(color=color, roughness=shine)


def _bare(printed: Floats) -> Floats:
    """(H, W, 1) share of the key color: by how much green exceeds the other two."""
    excess = printed[..., 1] - np.maximum(printed[..., 0], printed[..., 2])
    return np.asarray(np.clip(excess / 255.0, 0.0, 1.0))[..., None]


def _tape(spec: SurfaceSpec, pixels: tuple[int, int], board: Image) -> tuple[Image, Image | None]:
    """The board under brown tape along the seam (top) or over the ends (side), and its shine."""
    face = spec.detail["face"]
    if not spec.detail.get("tape", 0) or face == "front":
        return board, None
    width, height = spec.tile
    x = (np.arange(pixels[0]) + 0.5) / pixels[0] * width
    y = height - (np.arange(pixels[1]) + 0.5) / pixels[1] * height
    if face == "top":
        torn = height - 0.024 + 0.0012 * ((np.arange(pixels[0]) * 7919) % 5 - 2) * (x % 0.01) * 60
        under = y[:, None] > torn[None, :]
    else:
        ends = (y[:, None] < 0.06) | (y[:, None] > height - 0.055)
        under = ends & (np.abs(x - width / 2.0) < 0.024)[None, :]
    tinted = np.where(under[..., None], 0.80 * board + (22.0, 14.0, 4.0), board)
    shine = np.where(under, 70, 215).astype(np.uint8)
    return np.clip(tinted, 0, 255).astype(np.uint8), shine


def _front(sheet: Sheet, detail: Mapping[str, float | str]) -> None:
    width, height = sheet.size
    unit, ink = min(0.11, 0.27 * height, 0.16 * width), str(detail["ink"])
    maker = MAKERS[int(detail["maker"]) % len(MAKERS)]
    design = str(detail["design"])
    if design == "moving":
        cap = _fitting(sheet, maker, 0.13 * height, 0.84 * width)
        sheet.text((0.5 * width, 0.78 * height), maker, height=cap, fill=ink)
        line = 0.008 * min(width, height)
        sheet.line(
            [(0.08 * width, 0.66 * height), (0.92 * width, 0.66 * height)], fill=ink, width=line
        )
        _rooms(sheet, ink)
    elif design == "brand":
        sheet.box((0.0, 0.38 * height), (width, 0.72 * height), fill=ink)
        light = "#f2ede2"
        cap = _fitting(sheet, maker, 0.19 * height, 0.86 * width)
        sheet.text((0.5 * width, 0.55 * height), maker, height=cap, fill=light)
    elif design == "shipping":
        _label(sheet, (0.30 * width, 0.60 * height), min(0.15, 0.5 * width, 0.9 * height))
    marks = ("glass", "up", "umbrella") if design != "plain" else ("up", "glass")
    for k, mark in enumerate(marks):
        at = (width - (len(marks) - k - 0.30) * 1.12 * unit, 0.5 * unit + 0.025 * height)
        MARKS[mark](sheet, at, 0.82 * unit, ink)
    sheet.text(
        (0.05 * width, 0.10 * height), f"{maker} C{23 + int(detail['maker'])}",
        height=min(0.012, 0.05 * height), fill=ink, anchor="left",
    )  # fmt: skip


def _fitting(sheet: Sheet, words: str, height: float, room: float) -> float:
    """Height of capitals, lowered until the words fit."""
    return height * min(1.0, room / sheet.text_width(words, height=height))


def _rooms(sheet: Sheet, ink: str) -> None:
    """Boxes to tick."""
    width, height = sheet.size
    cap = min(0.014, 0.055 * height)
    for k, room in enumerate(ROOMS):
        y = (0.56 - 0.085 * k) * height
        side = 1.3 * cap
        low = (0.09 * width, y - side / 2.0)
        sheet.box(low, (low[0] + side, low[1] + side), outline=ink, width=0.12 * cap)
        sheet.text((low[0] + 2.0 * side, y), room, height=cap, fill=ink, anchor="left")


def _side(sheet: Sheet, detail: Mapping[str, float | str]) -> None:
    width, height = sheet.size
    ink, design = str(detail["ink"]), str(detail["design"])
    unit = min(0.12, 0.36 * height, 0.30 * width)
    if design == "brand":
        sheet.box((0.0, 0.38 * height), (width, 0.72 * height), fill=ink)
        unit = min(unit, 0.28 * height)
    else:
        words = "FRAGILE" if design == "shipping" else "THIS SIDE UP"
        cap = min(0.030, 0.09 * height, 0.105 * width)
        sheet.text((0.5 * width, 0.36 * height), words, height=cap, fill=ink)
    x = 0.5 * width
    for sign, mark in ((-1.0, "glass"), (1.0, "up")):
        MARKS[mark](
            sheet,
            (x + sign * 0.62 * unit, (0.55 if design == "brand" else 0.62) * height),
            0.9 * unit,
            _over(design, ink),
        )
    MARKS["certificate"](sheet, (0.82 * width, 0.13 * height), min(0.06, 0.2 * height), ink)


def _over(design: str, ink: str) -> str:
    return "#f2ede2" if design == "brand" else ink


def _top(sheet: Sheet, detail: Mapping[str, float | str]) -> None:
    """Along a major flap; the seam is above."""
    width, height = sheet.size
    if detail["design"] == "plain":
        return
    ink = str(detail["ink"])
    cap = min(0.022, 0.16 * height)
    words = {"moving": "HANDLE WITH CARE", "shipping": "DO NOT CUT", "brand": "OPEN THIS SIDE"}
    sheet.text((0.5 * width, 0.45 * height), words[str(detail["design"])], height=cap, fill=ink)


def _label(sheet: Sheet, center: tuple[float, float], size: float) -> None:
    """A paper label with an address, a code and a route."""
    x, y = center[0] - size / 2.0, center[1] - 0.36 * size
    black = "#17181a"
    sheet.box((x, y), (x + size, y + 0.72 * size), fill="#f4f3ef", radius=0.01 * size)
    for k, share in enumerate((0.42, 0.55, 0.36)):
        level = y + (0.64 - 0.06 * k) * size
        sheet.line(
            [(x + 0.05 * size, level), (x + share * size, level)],
            fill="#4b4d50",
            width=0.018 * size,
        )
    sheet.text((x + 0.82 * size, y + 0.58 * size), "A7", height=0.10 * size, fill=black)
    sheet.line([(x, y + 0.46 * size), (x + size, y + 0.46 * size)], fill=black, width=0.008 * size)
    at = x + 0.08 * size
    for k in range(34):
        wide = (0.007, 0.013, 0.021)[(k * k + 3 * k) % 3] * size
        if k % 2 == 0:
            sheet.box((at, y + 0.12 * size), (at + wide, y + 0.42 * size), fill=black)
        at += wide
    sheet.text(
        (x + 0.5 * size, y + 0.06 * size), "4 027 881 350 196", height=0.04 * size, fill=black
    )


FACES: Mapping[str, Callable[[Sheet, Mapping[str, float | str]], None]] = {
    "front": _front,
    "side": _side,
    "top": _top,
}
