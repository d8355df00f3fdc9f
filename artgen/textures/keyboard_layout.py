"""Where the keys of a laptop keyboard sit and what is written on them: ANSI rows of 15 units."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from artgen.core.errors import UsageError

Kind = Literal["letter", "function", "modifier", "arrow", "space"]
Row = Sequence[tuple[str, float]]
"""Legends and widths in units."""

FUNCTIONS = ("esc", *(f"F{k}" for k in range(1, 13)), "ins", "del")
ROWS: tuple[Row, ...] = (
    (*((sign, 1.0) for sign in "`1234567890-="), ("back", 2.0)),
    (("tab", 1.5), *((sign, 1.0) for sign in "QWERTYUIOP[]"), ("\\", 1.5)),
    (("caps", 1.75), *((sign, 1.0) for sign in "ASDFGHJKL;'"), ("enter", 2.25)),
    (("shift", 2.25), *((sign, 1.0) for sign in "ZXCVBNM,./"), ("shift", 2.75)),
)
BOTTOM: Row = (("ctrl", 1.25), ("fn", 1.0), ("sup", 1.0), ("alt", 1.25))
NAVIGATION = ("prt", "home", "pgup", "pgdn", "end")
NUMBERS: tuple[tuple[str, float, float, float], ...] = (
    ("num", 0, 1, 1), ("/", 1, 1, 1), ("*", 2, 1, 1), ("-", 3, 1, 1),
    ("7", 0, 2, 1), ("8", 1, 2, 1), ("9", 2, 2, 1), ("+", 3, 2, 2),
    ("4", 0, 3, 1), ("5", 1, 3, 1), ("6", 2, 3, 1),
    ("1", 0, 4, 1), ("2", 1, 4, 1), ("3", 2, 4, 1), ("ent", 3, 4, 2),
    ("0", 0, 5, 1), ("00", 1, 5, 1), (".", 2, 5, 1),
)  # fmt: skip
"""Legend, column, row counted from the function row, rows it spans."""
MAIN = 15.0
"""Units of the letter block."""
APART = 0.25
"""Units between letters and numbers."""
SIDE_UNITS = {"compact": 0.0, "navigation": 1.0, "numpad": APART + 4.0}
ARROWS = ("half", "tall", "paged")


@dataclass(frozen=True, kw_only=True)
class Key:
    """A keycap: its middle and size on the keyboard, m from the lower left corner."""

    legend: str
    kind: Kind
    center: tuple[float, float]
    size: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class KeyboardStyle:
    """What a keyboard is made of.

    Attributes:
        block: `compact`, `navigation` (one more column) or `numpad`.
        arrows: `half` (four half keys), `tall` (left and right full) or `paged` (page keys above).
        pitch: from key to key along a row, m.
        row_pitch: from row to row, m.
        gap: between caps, m.
        function_share: height of the function row over that of a row.
        power_key: whether the last key of the function row switches on.
    """

    block: str
    arrows: str
    pitch: float
    row_pitch: float
    gap: float
    function_share: float
    power_key: bool

    def __post_init__(self) -> None:
        if self.block not in SIDE_UNITS or self.arrows not in ARROWS:
            raise UsageError(
                f"there is no keyboard {self.block!r} with arrows {self.arrows!r}; known: "
                f"{', '.join(SIDE_UNITS)} with {', '.join(ARROWS)}"
            )

    @property
    def units(self) -> float:
        """Width in units."""
        return MAIN + SIDE_UNITS[self.block]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the field of all cells, m."""
        return self.units * self.pitch, (5.0 + self.function_share) * self.row_pitch


def keyboard_keys(style: KeyboardStyle) -> tuple[Key, ...]:
    """All caps of a keyboard, row by row from the top; no two share a point."""
    cells = [*_function_row(style), *_letter_rows(), *_bottom_row(style), *_side(style)]
    return tuple(_cap(style, *cell) for cell in cells)


Cell = tuple[str, Kind, float, float, float, float]
"""Legend, kind, left and width in units, row and rows spanned; the function row is row 0."""


def _cap(
    style: KeyboardStyle,
    legend: str,
    kind: Kind,
    left: float,
    width: float,
    row: float,
    rows: float,
) -> Key:
    """Cells in units to meters; a cap is smaller than its cell by the gap."""
    height = style.size[1]

    def level(at: float) -> float:
        """m from the lower edge; rows after the first are full ones."""
        down = min(at, 1.0) * style.function_share + max(at - 1.0, 0.0)
        return height - down * style.row_pitch

    top, low = level(row), level(row + rows)
    x = (left + width / 2.0) * style.pitch
    return Key(
        legend=legend,
        kind=kind,
        center=(x, (top + low) / 2.0),
        size=(width * style.pitch - style.gap, top - low - style.gap),
    )


def _function_row(style: KeyboardStyle) -> list[Cell]:
    row: list[Cell] = [
        (name, "function", float(k), 1.0, 0.0, 1.0) for k, name in enumerate(FUNCTIONS)
    ]
    if style.block == "numpad":
        left = MAIN + APART
        names = NAVIGATION[1:]
        row += [(name, "function", left + k, 1.0, 0.0, 1.0) for k, name in enumerate(names)]
    elif style.block == "navigation":
        row.append((NAVIGATION[0], "function", MAIN, 1.0, 0.0, 1.0))
    if style.power_key:
        row[-1] = ("power", *row[-1][1:])
    return row


def _letter_rows() -> list[Cell]:
    cells: list[Cell] = []
    for k, row in enumerate(ROWS):
        left = 0.0
        for legend, width in row:
            kind: Kind = "letter" if len(legend) == 1 else "modifier"
            cells.append((legend, kind, left, width, 1.0 + k, 1.0))
            left += width
    return cells


def _bottom_row(style: KeyboardStyle) -> list[Cell]:
    """Modifiers, the space bar and the arrows, which end where letters and navigation end."""
    end = MAIN + (1.0 if style.block == "navigation" else 0.0)
    first = end - 3.0
    cells: list[Cell] = []
    left = 0.0
    for legend, width in BOTTOM:
        cells.append((legend, "modifier", left, width, 5.0, 1.0))
        left += width
    cells.append(("", "space", left, first - 2.0 - left, 5.0, 1.0))
    cells += [("alt", "modifier", first - 2.0, 1.0, 5.0, 1.0)]
    cells += [("ctrl", "modifier", first - 1.0, 1.0, 5.0, 1.0)]
    side = 1.0 if style.arrows == "tall" else 0.5
    for legend, column in (("left", 0.0), ("right", 2.0)):
        cells.append((legend, "arrow", first + column, 1.0, 6.0 - side, side))
    cells.append(("up", "arrow", first + 1.0, 1.0, 5.0, 0.5))
    cells.append(("down", "arrow", first + 1.0, 1.0, 5.5, 0.5))
    if style.arrows == "paged":
        cells.append(("pgup", "modifier", first, 1.0, 5.0, 0.5))
        cells.append(("pgdn", "modifier", first + 2.0, 1.0, 5.0, 0.5))
    return cells


def _side(style: KeyboardStyle) -> list[Cell]:
    if style.block == "numpad":
        left = MAIN + APART
        return [
            (legend, "modifier" if len(legend) > 2 else "letter", left + column, 1.0, row, rows)
            for legend, column, row, rows in NUMBERS
        ]
    if style.block == "navigation":
        names = NAVIGATION[1:]
        return [(name, "modifier", MAIN, 1.0, 1.0 + k, 1.0) for k, name in enumerate(names)]
    return []
