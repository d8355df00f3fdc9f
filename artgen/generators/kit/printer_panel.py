"""The control panel of a printer: a plate with display, icons and buttons that may tilt."""

import math

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.generators.kit.printed import area, digits, disc, icon, line, plate, printed, words
from artgen.generators.kit.printer_base import recess_depth
from artgen.generators.kit.printer_design import GAP, PrinterParams
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.solid import Solid, cylinder, slab, union
from artgen.textures.appliance_panel import BRANDS, LED

THICK = 0.012
"""m; of a tilting panel; its upper edge is round about the hinge."""
SKIN = 0.0012
"""m; the printed plate on it."""
NAMES = (("power_button", "power"), ("start_button", "play"), ("cancel_button", "pause"))


def panel_plane(p: PrinterParams) -> PanelPlane:
    """The printed face."""
    width, height = p.panel_size
    y = p.front - (0.0 if p.tilts else SKIN)
    low = p.top - 0.0015 - GAP - height
    return PanelPlane(
        origin=(-width / 2.0, y, low),
        right=(1.0, 0.0, 0.0),
        up=(0.0, 0.0, 1.0),
        size=(width, height),
    )


def buttons(p: PrinterParams) -> list[PushButton]:
    """From the right end of the panel to the left."""
    width, height = p.panel_size
    return [
        PushButton(
            name=NAMES[k][0],
            center=(width - 0.016 - 0.022 * k, 0.46 * height),
            size=(0.013, 0.013),
            round_cap=True,
            proud=0.0030,
            travel=0.0016,
            depth=0.0020,
            force=1.6,
        )
        for k in range(p.buttons)
    ]


def recess(p: PrinterParams) -> list[Solid]:
    """What the base's front must leave free for a tilting panel, or for the buttons of a fixed
    one."""
    plane = panel_plane(p)
    if not p.tilts:
        return [plane.placed(button.well()) for button in buttons(p)]
    half, deep = p.panel_size[0] / 2.0 + GAP, recess_depth(p)
    low = plane.origin[2] - GAP
    return [slab((-half, p.front - 0.01, low), (half, p.front + deep, p.top + 0.01))]


def panel_part(p: PrinterParams) -> DraftPart:
    """A tilting panel."""
    width = p.panel_size[0]
    plane, keys = panel_plane(p), buttons(p)
    low, y, z = plane.origin[2], p.front, hinge_height(p)
    flat = slab((-width / 2.0, y + SKIN, low), (width / 2.0, y + THICK, z))
    top = cylinder((THICK - SKIN) / 2.0, width, axis="x", segments=20).at(
        -width / 2.0, y + (THICK + SKIN) / 2.0, z
    )
    wells = union([plane.placed(key.well()) for key in keys])
    box = slab((-width / 2.0, y, low), (width / 2.0, y + THICK - 0.001, z + 0.001))
    bodies = (
        Body(
            solid=union([flat, top]) - wells,
            surface="trim",
            density=700.0,
            edge=0.0008,
            collision=(box,),
        ),
        _skin(p, keys, back=True),
    )
    grip = Grip(
        name="control_panel_edge",
        kind="edge",
        position=(0.0, y + 0.002, low),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )
    return DraftPart(name="control_panel", label="flap", bodies=bodies, grips=(grip,))


def fixed_panel(p: PrinterParams) -> tuple[Body, ...]:
    """A printed plate on the base's front."""
    return (_skin(p, buttons(p), back=False),)


def _skin(p: PrinterParams, keys: list[PushButton], *, back: bool) -> Body:
    """The plate; a tilting panel carries it flush with the front."""
    plane = panel_plane(p)
    holes = [key.well() for key in keys]
    sunk = SKIN if back else 0.0
    return plate(plane, "panel", density=ABS, thickness=SKIN, radius=0.003, sunk=sunk, holes=holes)


def hinge_height(p: PrinterParams) -> float:
    """z of the tilt's axis."""
    return p.top - 0.0015 - GAP - (THICK - SKIN) / 2.0


def panel_joint(p: PrinterParams) -> Joint:
    """The lower edge swings out and up; friction holds it."""
    return Joint(
        name="control_panel_tilt",
        type="revolute",
        parent="base",
        child="control_panel",
        axis=(-1.0, 0.0, 0.0),
        origin=(0.0, p.front + (THICK + SKIN) / 2.0, hinge_height(p)),
        limit=Limit(lower=0.0, upper=math.radians(p.panel_tilt)),
        friction=0.20,
        damping=0.01,
        effort=6.0,
    )


def panel_print(p: PrinterParams) -> SurfaceSpec:
    """Brand, a lit display with a menu, marks beside the buttons."""
    width, height = p.panel_size
    ink, glow = "#d9dcde", LED[p.led]
    marks = [words((0.012, 0.80 * height), BRANDS[p.brand], cap=0.0048, ink=ink, anchor="left")]
    for k, key in enumerate(buttons(p)):
        marks.append(
            icon((key.center[0], key.center[1] + 0.0125), NAMES[k][1], size=0.0045, ink=ink)
        )
    left, right = 0.010, width - 0.030 - 0.022 * p.buttons
    low, high = 0.14 * height, 0.66 * height
    screen = min(0.078, right - left)
    lit = [area((left, low), (left + screen, high), ink="#0c1626", radius=0.001)]
    tall = high - low
    for k, name in enumerate(("drop", "leaf", "sun", "clock")):
        x = left + (k + 0.5) * screen / 4.0
        half = 0.36 * screen / 4.0
        tile = ((x - half, low + 0.36 * tall), (x + half, high - 0.10 * tall))
        lit.append(area(*tile, ink="#1f3f63", radius=0.0012))
        middle = (x, (tile[0][1] + tile[1][1]) / 2.0)
        lit.append(icon(middle, name, size=min(0.008, 1.2 * half), ink=glow))
    lit.append(
        digits((left + 0.05 * screen, low + 0.08 * tall), "10:42", height=0.16 * tall, ink=glow)
    )
    lit.append(
        line(
            [(left + 0.5 * screen, low + 0.16 * tall), (left + 0.94 * screen, low + 0.16 * tall)],
            width=0.0006,
            ink="#5b7fa6",
        )
    )
    marks.append(
        area(
            (left - 0.001, low - 0.001),
            (left + screen + 0.001, high + 0.001),
            ink="#030405",
            radius=0.0015,
        )
    )
    for k in range(2):
        marks.append(disc((right + 0.006, low + (0.3 + 0.4 * k) * tall), 0.0012, ink="#4a4d52"))
    return printed(
        "panel",
        (width, height),
        background="#17181b",
        marks=marks,
        lit=lit,
        roughness=0.18,
        emission=1.0,
    )
