"""Control panels of ovens and washers, upright beside the door or lying above it: what they carry,
how it is printed, and the dials and buttons that stand on them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.articulation.types import Body, DraftPart, Joint
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.generators.kit.dial import Dial, DialStyle
from artgen.generators.kit.panel_print import PanelPrint
from artgen.generators.kit.printed import Point, plate
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.solid import Solid, slab
from artgen.textures.appliance_panel import BRANDS

CELLS: Mapping[str, Mapping[str, float]] = {
    "keypad": {"brand": 1.15, "display": 1.5, "keys": 4.6, "buttons": 1.3},
    "dials": {"brand": 1.25, "power_dial": 3.2, "timer_dial": 3.2},
    "jog": {"brand": 1.15, "display": 1.5, "keys": 1.7, "power_dial": 2.7, "buttons": 1.3},
    "knobs": {"function_knob": 3.0, "brand": 1.6, "display": 2.6, "oven_knob": 3.0},
    "touch": {"brand": 2.2, "touch_left": 1.8, "display": 2.6, "touch_right": 2.2},
    "timer": {"brand": 1.8, "function_knob": 2.2, "timer_dial": 2.2, "oven_knob": 2.2},
    "range": {"left_front_knob": 1.0, "left_rear_knob": 1.0, "oven_knob": 1.1, "brand": 0.9,
              "display": 1.2, "function_knob": 1.1, "right_rear_knob": 1.0,
              "right_front_knob": 1.0},
    "range_plain": {"left_front_knob": 1.0, "left_rear_knob": 1.0, "right_rear_knob": 1.0,
                    "right_front_knob": 1.0, "brand": 1.1, "oven_knob": 1.3},
    "washer": {"brand": 1.5, "program_knob": 1.9, "display": 1.6, "buttons": 1.7},
    "washer_right": {"brand": 1.5, "display": 1.6, "buttons": 1.7, "program_knob": 1.9},
    "washer_touch": {"brand": 1.4, "touch_left": 1.5, "display": 1.8, "touch_right": 1.9},
}  # fmt: skip
"""What a panel carries from its upper or left end, and how much of its length each takes."""
RELEASE = 1.5
SWEEP = math.radians(270.0)
LEAST = 0.012
"""m; radius of the smallest dial."""
PLATE = 0.0012
"""m; thickness of the printed foil as drawn, half of it inside the panel."""
SUNK = 0.0006
RECESS, RECESS_BORDER = 0.0125, 0.003
"""m; depth of the core behind the foil, and how far the foil reaches over it."""


@dataclass(frozen=True, kw_only=True)
class ControlPanel:
    """A panel's face and what is on it.

    Attributes:
        plane: its face.
        kind: key of `CELLS`.
        buttons: that are pressed, in the cell `buttons`.
        release: whether a large button at its end opens the door.
        dial: form of the dials.
        dial_share: radius of a dial as a share of its cell.
        brand: index of the brand's word.
        time: shown by the display.
        led: color of the display.
        endless: dials turn on without stops.
        tagline: small words below the brand.
    """

    plane: PanelPlane
    kind: str
    buttons: int
    release: bool
    dial: DialStyle
    dial_share: float
    brand: int
    time: str
    led: str
    endless: bool = False
    tagline: str = ""

    @property
    def upright(self) -> bool:
        """Higher than wide."""
        return self.plane.size[1] > self.plane.size[0]

    @cached_property
    def cells(self) -> dict[str, tuple[Point, Point]]:
        """Name to (center, size) on the face."""
        shares = dict(CELLS[self.kind]) | ({"release": RELEASE} if self.release else {})
        along, across = max(self.plane.size), min(self.plane.size)
        ends = np.cumsum([0.0, *shares.values()]) / sum(shares.values()) * along
        cells = {}
        for name, low, high in zip(shares, ends[:-1], ends[1:], strict=True):
            middle, length = float(low + high) / 2.0, float(high - low)
            if self.upright:
                cells[name] = ((across / 2.0, along - middle), (across, length))
            else:
                cells[name] = ((middle, across / 2.0), (length, across))
        return cells

    @cached_property
    def dials(self) -> list[Dial]:
        """Knobs on their shafts."""
        found: list[Dial] = []
        for name, (center, size) in self.cells.items():
            if name.endswith(("dial", "knob")):
                radius = max(LEAST, self.dial_share * min(size))
                found.append(
                    Dial(name=name, center=center, radius=radius, height=0.6 * radius + 0.008,
                         style=self.dial, label="knob" if name.endswith("knob") else "dial",
                         sweep=None if self.endless else SWEEP, lift=PLATE - SUNK)
                )  # fmt: skip
        return found

    @cached_property
    def push_buttons(self) -> list[PushButton]:
        """Buttons in a row, and the release."""
        made = []
        if "buttons" in self.cells:
            (u, v), (w, h) = self.cells["buttons"]
            pitch, size = 0.86 * w / self.buttons, min(0.014, 0.42 * h)
            for k in range(self.buttons):
                x = u + (k - (self.buttons - 1) / 2.0) * pitch
                made.append(
                    PushButton(name=f"button_{k + 1}", center=(x, v - 0.14 * h),
                               size=(min(0.8 * pitch, 3.0 * size), size), proud=0.003)
                )  # fmt: skip
        if self.release:
            center, (w, h) = self.cells["release"]
            made.append(
                PushButton(name="release_button", center=center, size=(0.80 * w, 0.66 * h),
                           proud=0.0045, travel=0.004, depth=0.005, force=9.0)
            )  # fmt: skip
        return made

    def cut(self, block: Solid) -> Solid:
        """The panel's block with a recess for its core."""
        return block - self._recess()

    def core(self, surface: str) -> Body:
        """What fills the recess behind the foil: sharp-edged, with room for shafts and caps."""
        solid = self._recess()
        for hole in self._holes:
            solid = solid - self.plane.placed(hole)
        return Body(solid=solid, surface=surface, density=0.5 * ABS)

    def foil(self) -> Body:
        """The printed face."""
        return plate(self.plane, "panel_print", density=ABS, thickness=PLATE, radius=0.003,
                     sunk=SUNK, holes=self._holes)  # fmt: skip

    def parts(self, knob: str, mark: str, cap: str) -> list[DraftPart]:
        """Dials and buttons."""
        return [
            *(dial.part(self.plane, knob, mark, density=ABS) for dial in self.dials),
            *(button.part(self.plane, cap, density=ABS) for button in self.push_buttons),
        ]

    def joints(self) -> list[Joint]:
        """Theirs."""
        movers: Sequence[Dial | PushButton] = [*self.dials, *self.push_buttons]
        return [mover.joint(self.plane, parent="base") for mover in movers]

    def print(self, face: SurfaceSpec) -> SurfaceSpec:
        """The surface of the foil, printed on the color of `face`."""
        light = sum(face.color) / 3.0 > 0.18
        marks = PanelPrint(
            cells=self.cells,
            dials=self.dials,
            buttons=self.push_buttons,
            ink="#26282b" if light else "#e4e6e8",
            key="#5d6165" if light else "#64686d",
            brand=BRANDS[self.brand],
            tagline=self.tagline,
            time=self.time,
            led=self.led,
        )
        return marks.surface("panel_print", self.plane.size, face)

    def _recess(self) -> Solid:
        (w, h), b = self.plane.size, RECESS_BORDER
        return self.plane.placed(slab((b, b, -RECESS), (w - b, h - b, 0.0)))

    @cached_property
    def _holes(self) -> list[Solid]:
        return [
            *(dial.hole() for dial in self.dials),
            *(button.well() for button in self.push_buttons),
        ]
