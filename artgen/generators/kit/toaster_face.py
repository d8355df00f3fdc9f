"""The control face of a toaster: where levers, dials and buttons sit, and the plate around them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.dial import Dial, DialStyle
from artgen.generators.kit.printed import (
    dial_scale,
    icon,
    line,
    plate,
    printed,
    words,
)
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism

PLATE = 0.0010
"""m; thickness of the printed plate on the face."""
FUNCTIONS = (("cancel", "STOP"), ("defrost", "DEFROST"), ("reheat", "REHEAT"), ("bagel", "BAGEL"))
KEY = (0.0165, 0.0085)
"""m; size of a button."""


@dataclass(frozen=True, kw_only=True)
class ToasterFace:
    """Controls on one plane; places are (u, v) from its lower left corner, m.

    Attributes:
        plane: of the plate.
        dials: their middles.
        keys: the buttons' middles.
        slits: (u, from v, to v) of lever slits that cross the plate.
        brand: middle of the brand's word, if there is room.
    """

    plane: PanelPlane
    dials: tuple[tuple[float, float], ...]
    keys: tuple[tuple[float, float], ...]
    slits: tuple[tuple[float, float, float], ...]
    brand: tuple[float, float] | None

    def fits(self, reach: float) -> bool:
        """Whether scales of radius `reach`, buttons and slits keep apart and lie on the plate."""
        half = (KEY[0] / 2.0, KEY[1] / 2.0 + 0.003)
        pieces = [(u - reach, v - reach, u + reach, v + reach) for u, v in self.dials]
        pieces += [
            (u - half[0], v - half[1] - 0.001, u + half[0], v + half[1]) for u, v in self.keys
        ]
        pieces += [(u - 0.009, low - 0.007, u + 0.010, high) for u, low, high in self.slits]
        wide, tall = self.plane.size
        on = all(a > 0.0 and b > 0.0 and c < wide and d < tall for a, b, c, d in pieces)
        apart = all(
            a[0] > b[2] or b[0] > a[2] or a[1] > b[3] or b[1] > a[3]
            for k, a in enumerate(pieces)
            for b in pieces[:k]
        )
        return on and apart

    def make_dials(self, radius: float, height: float, style: DialStyle) -> list[Dial]:
        """One a place."""
        many = len(self.dials) > 1
        return [
            Dial(
                name=f"browning_dial_{k + 1}" if many else "browning_dial",
                center=center,
                radius=radius,
                height=height,
                style=style,
                lift=PLATE,
            )
            for k, center in enumerate(self.dials)
        ]

    def make_buttons(self, *, round_caps: bool, force: float) -> list[PushButton]:
        """One a place, named after what it does."""
        size = (0.0115, 0.0115) if round_caps else KEY
        return [
            PushButton(
                name=f"{FUNCTIONS[k][0]}_button",
                center=center,
                size=size,
                round_cap=round_caps,
                proud=0.0038,
                travel=0.0022,
                force=force,
            )
            for k, center in enumerate(self.keys)
        ]

    def cover(
        self, dials: Sequence[Dial], buttons: Sequence[PushButton], *, radius: float, sunk: float
    ) -> Body:
        """The plate with its holes, wearing the surface `panel`."""
        holes = [control.hole() for control in dials] + [control.well() for control in buttons]
        holes += [_slot(*slit) for slit in self.slits]
        return plate(
            self.plane,
            "panel",
            density=1050.0,
            thickness=PLATE + sunk,
            radius=radius,
            sunk=sunk,
            holes=holes,
        )

    def print(
        self,
        dials: Sequence[Dial],
        *,
        background: str,
        ink: str,
        brand: str,
        metallic: float,
    ) -> SurfaceSpec:
        """Scales, words under the buttons, and the brand."""
        marks: list[str] = []
        for dial in dials:
            names = [str(k + 1) for k in range(6)]
            marks += dial_scale(
                dial.center,
                dial.radius + 0.0018,
                names,
                cap=0.0026,
                ink=ink,
                start=dial.start,
                sweep=dial.sweep or 2.0 * math.pi,
            )
        for k, (u, v) in enumerate(self.keys):
            marks.append(words((u, v - 0.0087), FUNCTIONS[k][1], cap=0.0018, ink=ink))
            if k == 1:
                marks.append(icon((u, v + 0.0085), "star", size=0.0036, ink=ink))
        for u, low, high in self.slits:
            rail = [(u + 0.0075, low), (u + 0.0075, high)]
            marks += [line(rail, width=0.0004, ink=ink)]
            marks.append(icon((u + 0.0075, low - 0.004), "sun", size=0.004, ink=ink))
        if self.brand is not None:
            marks.append(words(self.brand, brand, cap=0.0045, ink=ink))
        return printed(
            "panel",
            self.plane.size,
            background=background,
            marks=marks,
            roughness=0.32,
            metallic=metallic,
        )


def _slot(u: float, low: float, high: float) -> Solid:
    outline = rounded_rectangle(0.0094, high - low + 0.002, 0.004, segments=4)
    return prism(outline, 0.02).at(u, (low + high) / 2.0, -0.01)


def stacked_face(
    *,
    end: float,
    half: float,
    low: float,
    high: float,
    levers: Sequence[tuple[float, float, float]],
    buttons: int,
    radius: float,
    full: bool,
) -> ToasterFace:
    """Dials under their levers on the end face x = `end`; buttons beside or between the dials."""
    slit_low = min(lever[1] for lever in levers)
    top = high if full else slit_low - 0.006
    plane = _end_plane(end, (-half, low), (half, top))
    dial_v = min(radius + 0.009, (slit_low - low) / 2.0)
    dials = tuple((lever[0] + half, dial_v) for lever in levers)
    if len(levers) > 1:
        keys = tuple((half, dial_v + 0.004 + 0.020 * k) for k in range(min(buttons, 2)))
        keys += tuple((half, dial_v + 0.044 + 0.020 * k) for k in range(buttons - 2) if full)
    else:
        reach = half - 0.0115
        sides = ((1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0))[:buttons]
        split = 0.0105 if buttons > 2 else 0.0
        keys = tuple((half + a * reach, dial_v + b * split + 0.002) for a, b in sides)
    slits = tuple((y + half, a - low, b - low) for y, a, b in levers) if full else ()
    room = high - max(lever[2] for lever in levers)
    brand = (half, top - low - 0.006) if full and room > 0.024 else None
    return ToasterFace(plane=plane, dials=dials, keys=keys, slits=slits, brand=brand)


def divided_face(
    *,
    end: float,
    half: float,
    low: float,
    high: float,
    lever: tuple[float, float, float],
    buttons: int,
    radius: float,
    full: bool,
) -> ToasterFace:
    """Lever on the right of the end face, dial and a column of buttons on the left."""
    right = half if full else lever[0] - 0.017
    plane = _end_plane(end, (-half, low), (right, high))
    u = (right - half) / 2.0 + half if not full else half - lever[0]
    dial_v = radius + 0.013
    first = dial_v + radius + 0.020
    keys = tuple(
        (u, first + 0.019 * k) for k in range(buttons) if first + 0.019 * k < high - low - 0.018
    )
    slits = ((lever[0] + half, lever[1] - low, lever[2] - low),) if full else ()
    return ToasterFace(
        plane=plane, dials=((u, dial_v),), keys=keys, slits=slits, brand=(u, high - low - 0.007)
    )


def broad_face(
    *, front: float, right: float, low: float, buttons: int, radius: float
) -> ToasterFace:
    """Dial and a row of buttons on the broad face y = `front`, ending at x = `right`."""
    tall = 2.0 * radius + 0.022
    wide = tall + 0.026 * buttons + 0.006
    plane = PanelPlane(
        origin=(right - wide, front, low),
        right=(1.0, 0.0, 0.0),
        up=(0.0, 0.0, 1.0),
        size=(wide, tall),
    )
    keys = tuple((0.016 + 0.026 * (buttons - 1 - k), tall / 2.0 - 0.002) for k in range(buttons))
    brand = ((wide - tall) / 2.0, tall - 0.007)
    return ToasterFace(
        plane=plane,
        dials=((wide - tall / 2.0, tall / 2.0 + 0.001),),
        keys=keys,
        slits=(),
        brand=brand,
    )


def _end_plane(x: float, lower: tuple[float, float], upper: tuple[float, float]) -> PanelPlane:
    """A rectangle of (y, z) on the face x, seen from +x."""
    return PanelPlane(
        origin=(x, lower[0], lower[1]),
        right=(0.0, 1.0, 0.0),
        up=(0.0, 0.0, 1.0),
        size=(upper[0] - lower[0], upper[1] - lower[1]),
    )
