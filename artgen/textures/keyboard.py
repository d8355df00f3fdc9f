"""Legends of a laptop keyboard, printed over the field of all its keys."""

from collections.abc import Mapping

from artgen.core.surface import SurfaceSpec
from artgen.textures.draw import Anchor, Sheet
from artgen.textures.icons import draw_icon
from artgen.textures.images import TextureSet
from artgen.textures.keyboard_layout import Key, KeyboardStyle, keyboard_keys

PIXELS = 1024
"""Along the keyboard's width: 3 to 4 texels per mm, so that a letter of 3 mm can be read."""
SHIFTED: Mapping[str, str] = dict(
    zip("`1234567890-=[]\\;',./", '~!@#$%^&*()_+{}|:"<>?', strict=True)
)
TURNS: Mapping[str, tuple[tuple[float, float], ...]] = {
    "up": ((-0.5, -0.35), (0.5, -0.35), (0.0, 0.45)),
    "down": ((-0.5, 0.35), (0.5, 0.35), (0.0, -0.45)),
    "left": ((0.35, -0.5), (0.35, 0.5), (-0.45, 0.0)),
    "right": ((-0.35, -0.5), (-0.35, 0.5), (0.45, 0.0)),
}


def keyboard(spec: SurfaceSpec) -> TextureSet:
    """Cells in the colors of their keys, with legends; `spec.tile` is the keyboard's size.

    `spec.detail` holds the numbers of KeyboardStyle (power_key as 0 or 1) and background, modifier,
    accent and ink (`#rrggbb`); `accents` lists the legends of accented keys.
    """
    style = style_of(spec)
    width, height = style.size
    pixels = (PIXELS, max(32, round(PIXELS * height / width)))
    sheet = Sheet(style.size, pixels=pixels, background=str(spec.detail["background"]))
    for key in keyboard_keys(style):
        _paint(sheet, key, spec.detail, gap=style.gap)
        _letter(sheet, key, str(spec.detail["ink"]))
    return TextureSet(color=sheet.image())


def style_of(spec: SurfaceSpec) -> KeyboardStyle:
    """The keyboard that a surface describes."""
    detail = spec.detail
    return KeyboardStyle(
        block=str(detail["block"]),
        arrows=str(detail["arrows"]),
        pitch=float(detail["pitch"]),
        row_pitch=float(detail["row_pitch"]),
        gap=float(detail["gap"]),
        function_share=float(detail["function_share"]),
        power_key=bool(detail["power_key"]),
    )


def _paint(sheet: Sheet, key: Key, detail: Mapping[str, float | str], *, gap: float) -> None:
    """The key's color over its whole cell, so that its flanks take it too."""
    name = "background" if key.kind in ("letter", "space") else "modifier"
    if key.legend in str(detail["accents"]).split():
        name = "accent"
    (x, y), (w, h) = key.center, key.size
    low = x - (w + gap) / 2.0, y - (h + gap) / 2.0
    sheet.box(low, (x + (w + gap) / 2.0, y + (h + gap) / 2.0), fill=str(detail[name]))


def _letter(sheet: Sheet, key: Key, ink: str) -> None:
    (x, y), (w, h) = key.center, key.size
    if key.legend in TURNS:
        size = 0.0026
        corners = [(x + size * a, y + size * b) for a, b in TURNS[key.legend]]
        sheet.polygon(corners, fill=ink)
    elif key.legend == "power":
        draw_icon(sheet, key.center, "power", size=min(0.0048, 0.7 * h), fill=ink)
    elif key.legend in SHIFTED:
        sheet.text((x, y - 0.19 * h), key.legend, height=0.0027, fill=ink)
        sheet.text((x, y + 0.21 * h), SHIFTED[key.legend], height=0.0025, fill=ink)
    elif len(key.legend) == 1:
        sheet.text(key.center, key.legend, height=0.0036, fill=ink)
    elif key.kind == "modifier" and w > 0.02:
        left = key.legend in ("tab", "caps") or (key.legend == "shift" and x < 0.1)
        edge = x + (-0.40 if left else 0.40) * w
        anchor: Anchor = "left" if left else "right"
        sheet.text((edge, y - 0.18 * h), key.legend, height=0.0025, fill=ink, anchor=anchor)
    else:
        sheet.text(key.center, key.legend, height=min(0.0023, 0.4 * h), fill=ink)
