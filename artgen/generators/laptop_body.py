"""The base of a laptop: chassis, deck, keyboard, touchpad, ports, feet, hinge knuckles."""

import numpy as np

from artgen.articulation.types import Body, Decal, DraftPart
from artgen.core.mesh import Floats
from artgen.generators.kit.density import ABS, ALUMINIUM, RUBBER
from artgen.generators.laptop_shape import LaptopShape
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, box, cylinder, hull, prism, slab, union, upright
from artgen.textures.keyboard import Key

PORT_SIZES = {
    "usb_c": (0.0090, 0.0032),
    "usb_a": (0.0130, 0.0056),
    "hdmi": (0.0150, 0.0055),
    "jack": (0.0042, 0.0042),
    "card": (0.0240, 0.0022),
}
"""Opening along y and z, m."""
PORT_DEPTH = 0.007
LIP = 0.0005
"""m of metal or dark plastic around a port's opening."""
SEAM = 0.0004


def base_part(s: LaptopShape) -> DraftPart:
    """Everything that stays on the table."""
    chassis = _chassis(s)
    bodies = [
        Body(
            solid=chassis,
            surface="shell",
            density=s.p.density,
            edge=0.0006,
            collision=_collision(s),
        ),
        *_keyboard(s),
        _touchpad(s),
        *_ports(s),
        *_feet(s),
        *_knuckles(s),
    ]
    return DraftPart(name="base", label="base", bodies=tuple(bodies))


def _chassis(s: LaptopShape) -> Solid:
    """A slab with rounded corners, thinner in front and set in below, with its recesses cut."""
    p = s.p
    whole = hull(
        np.concatenate(
            [
                _ring(s, 0.0, s.deck - s.side_height, tilted=False),
                _ring(s, 0.0, s.deck, tilted=False),
                _ring(s, p.taper, s.floor, tilted=True),
            ]
        )
    )
    cuts = [s.well_solid(), _touchpad_pocket(s), *(port.cut for port in _port_list(s))]
    cuts += _vent_cuts(s) + _speaker_cuts(s)
    notch = slab(
        (-s.half_width * 0.09, -s.half_depth - 0.01, s.deck - 0.0022),
        (s.half_width * 0.09, -s.half_depth + 0.0035, s.deck + 0.01),
    )
    return whole - union([*cuts, notch])


def _ring(s: LaptopShape, inset: float, z: float, *, tilted: bool) -> Floats:
    """The outline at height z; the underside rises towards the front by the wedge."""
    ring = rounded_rectangle(
        2 * (s.half_width - inset),
        2 * (s.half_depth - inset),
        max(0.002, s.p.corner_radius - inset / 2),
        segments=6,
    )
    rise = [s.front_rise(y) if tilted else 0.0 for y in ring[:, 1]]
    return np.column_stack([ring, z + np.array(rise)])


def _keyboard(s: LaptopShape) -> list[Body]:
    """A floor of dark plastic and one keycap a key."""
    left, front = s.keys_corner
    decal = Decal(
        origin=(left, front, s.deck), right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=s.keys_size
    )
    caps = [_keycap(s, key) for key in s.keys]
    floor = s.well_floor()
    return [
        Body(solid=floor, surface="dark", density=ABS),
        Body(solid=union(caps), surface="keys", density=ABS, decal=decal),
    ]


def _keycap(s: LaptopShape, key: Key) -> Solid:
    """A tapered cap with a chamfered top, standing on the well's floor, below the deck."""
    x, y = s.keys_corner[0] + key.corner[0], s.keys_corner[1] + key.corner[1]
    width, depth = key.size
    foot, top = s.deck - s.well_depth + 2e-4, s.deck - s.well_depth + 3e-4 + s.p.key_height
    rings = [(0.0, foot), (0.00025, top - 0.00022), (0.00055, top)]
    points = [
        (x + dx, y + dy, z)
        for inset, z in rings
        for dx in (inset, width - inset)
        for dy in (inset, depth - inset)
    ]
    return hull(points)


def _touchpad_pocket(s: LaptopShape) -> Solid:
    lower, upper = s.touchpad
    return slab((lower[0], lower[1], s.deck - 0.0008), (upper[0], upper[1], s.deck + 0.01))


def _touchpad(s: LaptopShape) -> Body:
    lower, upper = s.touchpad
    pad = slab(
        (lower[0] + SEAM, lower[1] + SEAM, s.deck - 0.0008),
        (upper[0] - SEAM, upper[1] - SEAM, s.deck - 0.00025),
    )
    return Body(solid=pad, surface="pad", density=ALUMINIUM, edge=0.0002)


class _Port:
    """An opening in a side: the cut, and the lip that lines it."""

    def __init__(self, s: LaptopShape, kind: str, side: int, y: float) -> None:
        along, high = PORT_SIZES[kind]
        middle = s.port_height
        wall = side * s.half_width
        inner = wall - side * PORT_DEPTH
        outer = wall + side * 0.02
        low, up = sorted((inner, outer))
        if kind == "jack":
            self.cut = cylinder(high / 2, up - low, axis="x", segments=16).at(low, y, middle)
            hole = cylinder(high / 2 - LIP, 1.0, axis="x", segments=16).at(-0.5, y, middle)
        else:
            radius = high * (0.49 if kind == "usb_c" else 0.12)
            self.cut = _bar(along, high, radius, low, up, y, middle)
            hole = _bar(
                along - 2 * LIP, high - 2 * LIP, max(1e-4, radius - LIP), -0.5, 0.5, y, middle
            )
        flush = wall - side * 0.0006
        a, b = sorted((inner, flush))
        ring = self.cut & slab((a, y - along, middle - high), (b, y + along, middle + high))
        bottom = slab(
            (min(inner, inner + side * 0.001), y - along, middle - high),
            (max(inner, inner + side * 0.001), y + along, middle + high),
        )
        self.lip = (ring - hole) | (ring & bottom)
        self.surface = "dark" if kind in ("card", "jack") else "metal"


def _bar(
    along: float, high: float, radius: float, low: float, up: float, y: float, z: float
) -> Solid:
    """A rounded bar along x from `low` to `up`."""
    section = prism(rounded_rectangle(along, high, radius, segments=4), up - low)
    return upright(section, "x").at(low, y, z)


def _port_list(s: LaptopShape) -> list[_Port]:
    """Ports along both sides, from the back, 18 to 26 mm apart."""
    made = []
    for side, count, kinds in (
        (-1, s.p.ports_left, s.p.port_kinds[:4]),
        (1, s.p.ports_right, s.p.port_kinds[4:]),
    ):
        y = s.half_depth - 0.034
        for kind in kinds[:count]:
            along, high = PORT_SIZES[kind]
            if high + 0.0018 < s.side_height:
                made.append(_Port(s, kind, side, y - along / 2))
                y -= along + 0.009
    return made


def _ports(s: LaptopShape) -> list[Body]:
    return [Body(solid=port.lip, surface=port.surface, density=ABS) for port in _port_list(s)]


def _vent_cuts(s: LaptopShape) -> list[Solid]:
    """Slots in the underside near the back."""
    pitch = 0.0075
    start = -pitch * (s.p.vents - 1) / 2
    y = s.half_depth - 0.05 - s.p.taper
    return [
        slab(
            (start + k * pitch - 0.0016, y - 0.018, 0.0),
            (start + k * pitch + 0.0016, y, s.floor + 0.0022),
        )
        for k in range(s.p.vents)
    ]


def _speaker_cuts(s: LaptopShape) -> list[Solid]:
    """Thin slots beside the keyboard where there is room."""
    room = s.half_width - s.well_half_width - 0.009
    if s.p.speakers == "none" or room < 0.006:
        return []
    front, back = s.keys_corner[1], s.keys_corner[1] + s.keys_size[1]
    count = int((back - front) / 0.006)
    return [
        slab(
            (side * (s.well_half_width + 0.0045) - (0 if side > 0 else room), y, s.deck - 0.0008),
            (side * (s.well_half_width + 0.0045) + (room if side > 0 else 0), y + 0.0016, 1.0),
        )
        for side in (-1, 1)
        for y in np.linspace(front, back - 0.0016, count)
    ]


def _feet(s: LaptopShape) -> list[Body]:
    """Rubber feet: four discs, or two bars."""
    x, y = s.half_width - 0.030 - s.p.taper, s.half_depth - 0.022 - s.p.taper
    top, rise = s.floor + 0.0008 + s.front_rise(y), s.front_rise(-y) - s.front_rise(y)
    feet = []
    if s.p.feet == "bars":
        feet = [
            box((2 * x, 0.009, top), at=(0, y, 0)),
            box((2 * x, 0.009, top + rise), at=(0, -y, 0)),
        ]
    else:
        for side in (-1, 1):
            feet.append(cylinder(0.0065, top, segments=20).at(side * x, y, 0))
            feet.append(cylinder(0.0065, top + rise, segments=20).at(side * x, -y, 0))
    return [
        Body(
            solid=foot,
            surface="rubber",
            density=RUBBER,
            edge=0.0006,
            collision=(foot,) if s.p.feet == "bars" else (),
        )
        for foot in feet
    ]


def _knuckles(s: LaptopShape) -> list[Body]:
    """The fixed halves of the hinges: barrels on a foot, inside the lid's notches."""
    bodies = []
    for low, high in s.hinge_spans:
        left, right = low + s.hinge_gap, high - s.hinge_gap
        barrel = cylinder(s.barrel, right - left, axis="x", segments=24).at(
            left, s.axis_y, s.axis_z
        )
        foot = slab(
            (left, s.axis_y - s.barrel * 0.7, s.deck - 0.002),
            (right, s.axis_y + s.barrel * 0.9, s.axis_z),
        )
        guard = slab(
            (left, s.axis_y - s.barrel, s.deck), (right, s.axis_y + s.barrel, s.axis_z + s.barrel)
        )
        bodies.append(
            Body(
                solid=barrel | foot,
                surface="dark",
                density=2 * ABS,
                edge=0.0003,
                collision=(guard,),
            )
        )
    return bodies


def _collision(s: LaptopShape) -> tuple[Solid, ...]:
    """The chassis as one slab under the keys' tops and a frame around them is not worth its
    contacts: one box to the deck."""
    reach = s.p.taper * 0.5
    return (
        slab(
            (-s.half_width + reach, -s.half_depth + reach, s.floor + s.front_rise(0.0) * 0.5),
            (s.half_width - reach, s.half_depth - reach, s.deck),
        ),
    )
