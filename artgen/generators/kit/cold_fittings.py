"""What hangs in the rooms of refrigerators: control bar, light strips, evaporator cover, signs."""

import numpy as np

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.generators.kit.dial import Dial
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.printed import dial_scale, digits, icon, plate, printed, words
from artgen.geometry.solid import slab, union
from artgen.textures.appliance_panel import BRANDS, LED

BAR_FRONT = 0.018
"""m; y where the control bar begins."""
BAR = 0.034
"""m; height and depth of the control bar."""
SCREEN = (0.105, 0.024)
DIAL_FACE = (0.090, 0.033)


def control_bar(room: LinedCavity, surface: str, *, front: float = BAR_FRONT) -> Body:
    """A housing under the ceiling, from wall to wall."""
    (x0, _, _), (x1, _, z1) = room.low, room.high
    low, high = (x0 + 0.001, front, z1 - BAR), (x1 - 0.001, front + BAR, z1 - 0.0005)
    solid = slab(low, high)
    return Body(solid=solid, surface=surface, density=0.45 * ABS, edge=0.0015, collision=(solid,))


def bar_plane(
    room: LinedCavity, size: tuple[float, float], *, front: float = BAR_FRONT
) -> PanelPlane:
    """A panel in the middle of the control bar's front."""
    middle = (room.low[0] + room.high[0]) / 2.0
    return PanelPlane(
        origin=(middle - size[0] / 2.0, front, room.high[2] - BAR / 2.0 - size[1] / 2.0),
        right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=size,
    )  # fmt: skip


def screen(room: LinedCavity, *, front: float = BAR_FRONT) -> Body:
    """The display's window on the control bar; wears `screen`."""
    return plate(bar_plane(room, SCREEN, front=front), "screen", density=ABS, thickness=0.0016,
                 sunk=0.0008)  # fmt: skip


def screen_print(temperature: int, led: str) -> SurfaceSpec:
    """Lit degrees and touch marks."""
    w, h = SCREEN
    ink = LED[led]
    lit = [digits((0.42 * w, 0.22 * h), f"{temperature:d}", height=0.58 * h, ink=ink),
           words((0.66 * w, 0.50 * h), "C", cap=0.28 * h, ink=ink),
           icon((0.10 * w, 0.5 * h), "power", size=0.42 * h, ink="#c8ccd0"),
           icon((0.24 * w, 0.5 * h), "sun", size=0.42 * h, ink="#c8ccd0"),
           words((0.80 * w, 0.34 * h), "-", cap=0.34 * h, ink="#c8ccd0"),
           words((0.92 * w, 0.34 * h), "+", cap=0.34 * h, ink="#c8ccd0")]  # fmt: skip
    return printed("screen", SCREEN, background="#0b0d10", marks=[], lit=lit, roughness=0.12)


def thermostat(name: str = "thermostat") -> Dial:
    """A knob from off to the coldest."""
    return Dial(name=name, center=(DIAL_FACE[0] / 2.0, 0.016), radius=0.0125, height=0.016,
                style="bar", lift=0.0008)  # fmt: skip


def thermostat_face(room: LinedCavity, dial: Dial, *, front: float = BAR_FRONT) -> Body:
    """The printed plate around the knob; wears `scale`."""
    return plate(bar_plane(room, DIAL_FACE, front=front), "scale", density=ABS,
                 thickness=0.0016, sunk=0.0008, holes=[dial.hole()])  # fmt: skip


def thermostat_print(dial: Dial) -> SurfaceSpec:
    """Numerals around the knob."""
    marks = dial_scale(dial.center, dial.radius + 0.0012, ["0", "1", "2", "3", "4", "5"],
                       cap=0.0026, ink="#26323c", start=dial.start,
                       sweep=dial.sweep or 0.0)  # fmt: skip
    marks += [words((0.012, 0.010), "MIN", cap=0.003, ink="#26323c"),
              words((DIAL_FACE[0] - 0.012, 0.010), "MAX", cap=0.003, ink="#26323c")]  # fmt: skip
    return printed("scale", DIAL_FACE, background="#e4e6e6", marks=marks)


def light(room: LinedCavity, where: str, *, front: float = BAR_FRONT) -> list[Body]:
    """Strips of LEDs under the control bar, or up both walls behind the front; wears `led`."""
    (x0, _, z0), (x1, _, z1) = room.low, room.high
    if where == "sides":
        strips = [
            slab((x0 - 0.001, 0.004, z0 + 0.04), (x0 + 0.0022, 0.012, z1 - BAR - 0.01)),
            slab((x1 - 0.0022, 0.004, z0 + 0.04), (x1 + 0.001, 0.012, z1 - BAR - 0.01)),
        ]
    else:
        x = 0.5 * (x0 + x1)
        half, low = 0.42 * (x1 - x0), z1 - BAR
        strips = [slab((x - half, front + 0.010, low - 0.004),
                       (x + half, front + 0.026, low + 0.001))]  # fmt: skip
    return [Body(solid=union(strips), surface="led", density=ABS)]


def evaporator_cover(room: LinedCavity, surface: str, *, bottom: float, thickness: float) -> Body:
    """A panel over the back wall with slots for the cold air."""
    (x0, _, _), (x1, y1, z1) = room.low, room.high
    middle, half, top = (x0 + x1) / 2.0, 0.40 * (x1 - x0), z1 - 0.02
    sheet = slab((middle - half, y1 - thickness, bottom + 0.03), (middle + half, y1 + 0.001, top))
    slots = [
        slab((middle - 0.6 * half, y1 - thickness - 0.01, z - 0.003),
             (middle + 0.6 * half, y1 - thickness + 0.004, z + 0.003))
        for z in top - 0.06 - 0.014 * np.arange(6)
    ]  # fmt: skip
    contact = slab((middle - half, y1 - thickness, bottom + 0.03), (middle + half, y1, top))
    return Body(solid=sheet - union(slots), surface=surface, density=0.5 * ABS,
                collision=(contact,))  # fmt: skip


SIGNS = ("COLD DRINKS", "ICE COLD BEER", "REFRESH YOURSELF", "FRESH & COLD", "COOL DRINKS")
GROUNDS = ("#b3161c", "#0e4c92", "#0f6b3c", "#141518", "#d88a12")


def sign_box(half: float, span: tuple[float, float], front: float, shell: str) -> tuple[Body, Body]:
    """A light box over the doors and its lit face, which wears `sign`."""
    low, high = span
    box = slab((-half, front + 0.004, low), (half, 0.001, high))
    contact = slab((-half, front + 0.004, low), (half, 0.0, high))
    face = plate(sign_plane(half, span, front), "sign", density=ABS, thickness=0.005, sunk=0.003,
                 radius=0.006)  # fmt: skip
    return (
        Body(solid=box, surface=shell, density=0.15 * ABS, edge=0.002, collision=(contact,)),
        face,
    )


def sign_plane(half: float, span: tuple[float, float], front: float) -> PanelPlane:
    """The sign's face, 8 mm inside the box's edges."""
    return PanelPlane(
        origin=(-half + 0.008, front + 0.003, span[0] + 0.008), right=(1.0, 0.0, 0.0),
        up=(0.0, 0.0, 1.0), size=(2.0 * half - 0.016, span[1] - span[0] - 0.016),
    )  # fmt: skip


def sign_print(number: int, size: tuple[float, float], brand: int) -> SurfaceSpec:
    """Words on a lit ground."""
    w, h = size
    word = SIGNS[number % len(SIGNS)]
    cap = min(0.44 * h, 0.86 * w / (0.80 * len(word)))
    ground = GROUNDS[number % len(GROUNDS)]
    marks = [
        f"box 0 0 {w:.6f} {h:.6f} 0 {ground}",
        f"box 0 0 {w:.6f} {0.07 * h:.6f} 0 #f4f4f0",
        f"box 0 {0.93 * h:.6f} {w:.6f} {h:.6f} 0 #f4f4f0",
        words((w / 2.0, 0.36 * h + 0.05 * h), word, cap=cap, ink="#fbfbf6"),
        words((w / 2.0, 0.14 * h), BRANDS[brand % len(BRANDS)], cap=0.12 * h, ink="#fbfbf6"),
    ]
    return printed("sign", size, background=ground, marks=marks, lit=marks, emission=0.9)
