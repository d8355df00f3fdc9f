"""Keyboards: where every key sits, and the legends printed on them."""

from dataclasses import dataclass

from artgen.core.surface import SurfaceSpec
from artgen.textures.draw import Sheet
from artgen.textures.images import TextureSet

Row = tuple[tuple[str, float], ...]
"""Legend and width in key units, from left to right."""

ROWS: tuple[tuple[float, Row], ...] = (
    (0.62, (("esc", 1.0), *((f"F{k}", 1.0) for k in range(1, 13)), ("del", 1.0), ("", 1.0))),
    (1.0, (*((c, 1.0) for c in "`1234567890-="), ("<-", 2.0))),
    (1.0, (("tab", 1.5), *((c, 1.0) for c in "QWERTYUIOP[]"), ("\\", 1.5))),
    (1.0, (("caps", 1.75), *((c, 1.0) for c in "ASDFGHJKL;'"), ("enter", 2.25))),
    (1.0, (("shift", 2.25), *((c, 1.0) for c in "ZXCVBNM,./"), ("shift", 2.75))),
    (1.0, (("ctrl", 1.25), ("fn", 1.0), ("alt", 1.25), ("", 5.5), ("alt", 1.25), ("ctrl", 1.25))),
)
"""Height in key units and keys of each row, from the back; 15 units wide (ANSI, compact)."""
ARROWS_AT = 11.5
"""Key units from the left where the arrow cluster begins in the last row."""
NUMPAD: tuple[str, ...] = ("()=%", "7/*-", "789+", "456+", "123=", "0.,=")
NUMPAD_GAP = 0.3


@dataclass(frozen=True, kw_only=True)
class Key:
    """One key: legend, lower left corner and size in m on the keyboard; y runs to the back."""

    legend: str
    corner: tuple[float, float]
    size: tuple[float, float]


def keyboard_units(numpad: bool) -> tuple[float, float]:
    """Width and depth of a keyboard in key units."""
    return 15.0 + (NUMPAD_GAP + 4.0 if numpad else 0.0), sum(height for height, _ in ROWS)


def keyboard_keys(size: tuple[float, float], *, numpad: bool, gap: float) -> list[Key]:
    """Every key of a keyboard of `size` m, gaps taken off."""
    across, deep = keyboard_units(numpad)
    unit = (size[0] / across, size[1] / deep)
    keys = []
    y = deep
    for number, (height, row) in enumerate(ROWS):
        y -= height
        x = 0.0
        for legend, width in row:
            keys.append(_key(legend, x, y, width, height, unit, gap))
            x += width
        if number == len(ROWS) - 1:
            keys += _arrows(x, y, unit, gap)
        if numpad:
            for column, legend in enumerate(NUMPAD[number]):
                at = 15.0 + NUMPAD_GAP + column
                keys.append(_key(legend, at, y, 1.0, height, unit, gap))
    return keys


def _arrows(x: float, y: float, unit: tuple[float, float], gap: float) -> list[Key]:
    """Left, up above down, right; each half a row high."""
    width = (15.0 - x) / 3.0
    return [
        _key("<", x, y, width, 0.5, unit, gap),
        _key("v", x + width, y, width, 0.5, unit, gap),
        _key("^", x + width, y + 0.5, width, 0.5, unit, gap),
        _key(">", x + 2.0 * width, y, width, 0.5, unit, gap),
    ]


def _key(
    legend: str,
    x: float,
    y: float,
    width: float,
    height: float,
    unit: tuple[float, float],
    gap: float,
) -> Key:
    return Key(
        legend=legend,
        corner=(x * unit[0] + gap / 2.0, y * unit[1] + gap / 2.0),
        size=(width * unit[0] - gap, height * unit[1] - gap),
    )


def keyboard(spec: SurfaceSpec) -> TextureSet:
    """Legends on keys; `spec.tile` is the keyboard's size, `spec.detail` holds background and ink
    (`#rrggbb`), numpad (0 or 1) and gap (m)."""
    width, depth = spec.tile
    detail = spec.detail
    sheet = Sheet(
        (width, depth),
        pixels=(1024, max(64, round(1024 * depth / width))),
        background=str(detail["background"]),
    )
    keys = keyboard_keys((width, depth), numpad=bool(detail["numpad"]), gap=float(detail["gap"]))
    for key in keys:
        single = len(key.legend) == 1
        height = (0.26 if single else 0.17) * min(key.size[1], 0.016)
        middle = (key.corner[0] + key.size[0] / 2.0, key.corner[1] + key.size[1] / 2.0)
        if key.legend:
            sheet.text(middle, key.legend, height=height, fill=str(detail["ink"]))
    return TextureSet(color=sheet.image())
