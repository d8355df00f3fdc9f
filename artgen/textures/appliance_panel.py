"""Control panels of household appliances: where their controls sit, and what is printed there."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.textures.draw import Anchor, Point, Sheet
from artgen.textures.icons import draw_icon
from artgen.textures.images import TextureSet
from artgen.textures.noise import smooth

BRANDS = ("NORDVAL", "Kelmar", "AQUEN", "Lindhus", "VESTA", "Orvik", "Tessel", "BRENNA")
"""Invented; none is a registered maker of household appliances known to us."""
PROGRAMS = ("Auto", "Eco 50", "Glass 40", "Quick 45", "Pots 70", "Rinse", "Night", "Care")
BUTTON_ICONS = ("leaf", "clock", "glass", "pot", "drop", "star", "sun", "lock")
LED = {"white": "#dff1ff", "red": "#ff4a2a", "blue": "#58b7ff", "amber": "#ffb347"}


@dataclass(frozen=True, kw_only=True)
class Spot:
    """A control: center and size on the panel, m from its lower left corner."""

    center: Point
    size: Point


@dataclass(frozen=True, kw_only=True)
class PanelLayout:
    """Where a panel's controls sit; absent ones are None.

    Attributes:
        power: on the left.
        display: window for digits and lamps.
        knob: program selector, in the display's place.
        buttons: on the right, from left to right; the last one starts.
        brand: left end of the word's middle line.
        cap: height of the brand's capitals.
    """

    power: Spot
    display: Spot | None
    knob: Spot | None
    buttons: tuple[Spot, ...]
    brand: Point
    cap: float


def panel_layout(
    width: float, height: float, *, style: str, buttons: int, display: bool
) -> PanelLayout:
    """Controls of a panel of `width` x `height` m in style `buttons`, `knob` or `touch`."""
    middle = 0.46 * height
    unit = min(0.012, 0.30 * height)
    first, last = 0.60 * width, width - 0.034
    pitch = min(0.034, (last - first) / max(1, buttons - 1))
    size = (min(0.022, 0.72 * pitch), 0.8 * unit)
    row = tuple(
        Spot(center=(last - pitch * (buttons - 1 - k), middle), size=size) for k in range(buttons)
    )
    center = (0.44 * width, 0.5 * height)
    window = Spot(center=center, size=(min(0.088, 0.17 * width), min(0.030, 0.46 * height)))
    dial = min(0.046, 0.62 * height)
    has_knob = style == "knob"
    return PanelLayout(
        power=Spot(center=(0.032, middle), size=(unit, unit)),
        display=window if display and not has_knob else None,
        knob=Spot(center=center, size=(dial, dial)) if has_knob else None,
        buttons=row,
        brand=(0.058, 0.5 * height),
        cap=min(0.0115, 0.32 * height, 0.0205 * width),
    )


def appliance_panel(spec: SurfaceSpec) -> TextureSet:
    """The printed fascia: brand, icons over the buttons, program names around the knob.

    `spec.detail` holds style, buttons, display (0 or 1), brand (index), brushed (0 or 1),
    background and ink (`#rrggbb`); `spec.tile` is the panel's size.
    """
    width, height = spec.tile
    layout = layout_of(spec)
    pixels = (1024, max(32, round(1024 * height / width)))
    sheet = Sheet((width, height), pixels=pixels, background=str(spec.detail["background"]))
    ink = str(spec.detail["ink"])
    brand = BRANDS[int(spec.detail["brand"]) % len(BRANDS)]
    sheet.text(layout.brand, brand, height=layout.cap, fill=ink, anchor="left")
    _print_buttons(sheet, layout, spec.detail, ink)
    if layout.knob is not None:
        _print_dial(sheet, layout.knob, height, ink)
    image = sheet.image()
    if spec.detail["brushed"]:
        shape = (image.shape[0], image.shape[1])
        streaks = smooth(Stream(1, "appliance_panel").generator(), (shape[0], 12), shape)
        image = np.clip(image * (1.0 + 0.025 * streaks[..., None]), 0, 255).astype(np.uint8)
    return TextureSet(color=image)


def layout_of(spec: SurfaceSpec) -> PanelLayout:
    """The layout that a panel's surface describes."""
    return panel_layout(
        *spec.tile,
        style=str(spec.detail["style"]),
        buttons=int(spec.detail["buttons"]),
        display=bool(spec.detail["display"]),
    )


def _print_buttons(
    sheet: Sheet, layout: PanelLayout, detail: Mapping[str, float | str], ink: str
) -> None:
    touch = detail["style"] == "touch"
    x, y = layout.power.center
    side = layout.power.size[1]
    above = 0.0 if touch else 0.5 * layout.buttons[0].size[1] + 0.75 * side
    draw_icon(sheet, (x, y + above), "power", size=side, fill=ink)
    for k, spot in enumerate(layout.buttons):
        u, v = spot.center
        last = k == len(layout.buttons) - 1
        icon = "play" if last else BUTTON_ICONS[k % len(BUTTON_ICONS)]
        draw_icon(sheet, (u, v + above), icon, size=0.9 * side, fill=ink)
        if touch:
            dash = [(u - 0.3 * spot.size[0], v - side), (u + 0.3 * spot.size[0], v - side)]
            sheet.line(dash, fill=ink, width=0.0007)


def _print_dial(sheet: Sheet, knob: Spot, height: float, ink: str) -> None:
    """Ticks and program names left and right of the knob."""
    x, y = knob.center
    reach = 0.5 * knob.size[0]
    cap = min(0.0048, 0.07 * height)
    for k, name in enumerate(PROGRAMS[:6]):
        side = -1.0 if k < 3 else 1.0
        level = (1 - k % 3) * min(0.36 * height, 0.75 * knob.size[1])
        start = (x + side * (reach + 0.004), y + 0.8 * level)
        stop = (x + side * (reach + 0.010), y + level)
        sheet.line([start, stop], fill=ink, width=0.0008)
        anchor: Anchor = "right" if side < 0 else "left"
        sheet.text((stop[0] + side * 0.003, stop[1]), name, height=cap, fill=ink, anchor=anchor)


def appliance_display(spec: SurfaceSpec) -> TextureSet:
    """A dark window with lit seven-segment digits and lamps.

    `spec.detail` holds words (characters of digits) and led (a key of LED).
    """
    width, height = spec.tile
    pixels = (256, max(32, round(256 * height / width)))
    color = LED[str(spec.detail["led"])]
    lit = Sheet((width, height), pixels=pixels, background="#000000")
    face = Sheet((width, height), pixels=pixels, background="#07080a")
    words, tall = str(spec.detail["words"]), 0.52 * height
    start = (0.34 * width, 0.5 * (height - tall))
    lit.digits(start, words, height=tall, fill=color)
    face.digits(start, words, height=tall, fill=color, unlit="#15181b")
    for k, icon in enumerate(("drop", "star")):
        at = (0.14 * width, (0.32 + 0.36 * k) * height)
        draw_icon(lit, at, icon, size=0.26 * height, fill=color if k == 0 else "#0b1418")
        draw_icon(face, at, icon, size=0.26 * height, fill=color if k == 0 else "#20262a")
    return TextureSet(color=face.image(), emission=lit.image())
