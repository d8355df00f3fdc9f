"""What turns an electric kettle on, and the button that lets its lid spring open."""

import math

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.kettle_jug import SLOT
from artgen.generators.kit.kettle_params import KettleParams
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.solid import Solid, box, slab

PADDLE = (0.0195, 0.0042, 0.016)
"""m; width and thickness of the lever, and how far it stands out."""

BRIDGE = 3200.0
"""kg/m3 of the lever, the bimetal's bridge that it moves included."""


def lever_slot(p: KettleParams) -> Solid:
    """What the skirt must leave free for the lever."""
    half, low, high = SLOT
    y = p.radius - 0.013
    return slab((-half, y, p.ground + low), (half, p.radius + 0.02, p.ground + high))


def lever_part(p: KettleParams) -> DraftPart:
    """A paddle that stands out of the slot and up at rest, off."""
    width, thick, out = PADDLE
    y, z = _axis(p)
    reach = p.radius + out - y
    paddle = box((width, reach, thick), at=(0.0, y + reach / 2.0, z - thick / 2.0))
    ridge = [box((width, 0.0014, 0.0012), at=(0.0, y + reach - 0.003 - 0.003 * k, z + thick / 2.0
             - 0.0004)) for k in range(3)]  # fmt: skip
    shape = paddle
    for bar in ridge:
        shape = shape | bar
    tilt = math.radians(p.switch_deg / 2.0)
    solid = shape.turned("x", tilt, about=(0.0, y, z))
    (_, _, low), (_, far, high) = solid.bounds.tolist()
    start = p.radius * 1.004 + 0.0045
    rise = (start - y) * math.tan(tilt)
    touch = slab(
        (-width / 2.0, start, max(low, z + rise - thick / 2.0)), (width / 2.0, far, high - 0.001)
    )
    grip = Grip(
        name="switch_tip", kind="lever", position=(0.0, p.radius + 0.8 * out, z + thick),
        outward=(0.0, 1.0, 0.0), pull=(0.0, 0.0, -1.0),
    )  # fmt: skip
    body = Body(solid=solid, surface="accent", density=BRIDGE, edge=0.0006, collision=(touch,))
    return DraftPart(name="switch", label="lever", bodies=(body,), grips=(grip,))


def lever_joint(p: KettleParams, parent: str) -> Joint:
    """Pressed down by +q; friction stands for its detents."""
    return Joint(
        name="switch_press", type="revolute", parent=parent, child="switch", axis=(-1.0, 0.0, 0.0),
        origin=(0.0, *_axis(p)), limit=Limit(lower=0.0, upper=math.radians(p.switch_deg)),
        friction=0.02, damping=0.0004, effort=1.0, velocity=0.6,
    )  # fmt: skip


def _axis(p: KettleParams) -> tuple[float, float]:
    _, low, high = SLOT
    return p.radius - 0.006, p.ground + (low + high) / 2.0


def power_button(p: KettleParams) -> tuple[PushButton, PanelPlane]:
    """A round button in the skirt that faces +x."""
    size, r = 0.013, p.radius * 1.004
    low = p.ground + p.skirt / 2.0 - size / 2.0
    plane = PanelPlane(
        origin=(r - 0.0006, -size / 2.0, low), right=(0.0, 1.0, 0.0), up=(0.0, 0.0, 1.0),
        size=(size, size),
    )  # fmt: skip
    button = PushButton(
        name="switch", center=(size / 2.0, size / 2.0), size=(size, size), round_cap=True,
        proud=0.0036, travel=0.0022, depth=0.0020, force=2.5,
    )  # fmt: skip
    return button, plane


def lid_button(p: KettleParams) -> tuple[PushButton, PanelPlane]:
    """A bar on top of the handle's root that lets the lid go."""
    top = p.rim - 0.0018
    width = 0.62 * p.handle_width
    start = p.hinge[0] + 0.0075
    length = min(0.020, 0.55 * p.handle_gap)
    plane = PanelPlane(
        origin=(-width / 2.0, start, top), right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0),
        size=(width, length),
    )  # fmt: skip
    button = PushButton(
        name="lid_button", center=(width / 2.0, length / 2.0), size=(width, length), proud=0.0050,
        travel=0.0034, depth=0.0025, force=4.0,
    )  # fmt: skip
    return button, plane
