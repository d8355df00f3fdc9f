"""Locks on a safe's door: keypad, combination dial, key; drawn on a plane of the door's face."""

import math
from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, ZINC
from artgen.generators.kit.printed import (
    area,
    dial_scale,
    digits,
    disc,
    icon,
    plate,
    printed,
    ring,
    words,
)
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cone, cylinder, prism, revolve, slab, union

KEYS = ("1", "2", "3", "4", "5", "6", "7", "8", "9", "*", "0", "#")
BRANDS = ("VARDE", "Boltwick", "KESTREL", "Arkiv", "Monolit", "Strongholm")
"""Invented; none is a maker of safes known to us."""
PAD = (0.066, 0.104)
"""m; size of a keypad."""
PLATE = 0.044
"""m; side of a key's escutcheon."""


@dataclass(frozen=True, kw_only=True)
class Lock:
    """What a lock adds to the door, and the part that it moves, if any."""

    bodies: tuple[Body, ...]
    surfaces: tuple[SurfaceSpec, ...]
    part: DraftPart | None = None
    joint: Joint | None = None


def room(kind: str, dial_size: float) -> tuple[float, float]:
    """Width and height that a lock takes on the door, m."""
    return {
        "keypad": PAD,
        "dial": (3.0 * dial_size, 3.0 * dial_size),
        "key": (PLATE, 1.4 * PLATE),
    }[kind]


def lock(kind: str, plane: PanelPlane, *, trim: str, mark: str, handle: str, size: float) -> Lock:
    """The lock on a plane of `room` m.

    Args:
        trim: surface of molded pieces.
        mark: surface of printed or engraved marks.
        handle: surface of turned metal.
        size: radius of a dial, m.
    """
    if kind == "keypad":
        return _keypad(plane, trim)
    if kind == "dial":
        return _dial(plane, handle, mark, size)
    return _key(plane, handle)


def _keypad(plane: PanelPlane, trim: str) -> Lock:
    """A housing with twelve caps, a lit window and a cover over the emergency keyhole."""
    width, height = plane.size
    box = prism(rounded_rectangle(width, height, 0.008, segments=4), 0.009)
    marks = [words((width / 2.0, height - 0.009), "ELECTRONIC LOCK", cap=0.0026, ink="#9aa0a6")]
    caps = []
    for k, word in enumerate(KEYS):
        u = width / 2.0 + 0.0175 * (k % 3 - 1)
        v = 0.072 - 0.0165 * (k // 3)
        caps.append(prism(rounded_rectangle(0.0145, 0.0125, 0.003, segments=3), 0.0016).at(u, v))
        marks.append(words((u, v), word, cap=0.0052, ink="#eef0f2"))
    lit = [area((0.014, 0.082), (0.052, 0.090), ink="#0b1210", radius=0.001)]
    lit.append(digits((0.024, 0.083), "----", height=0.006, ink="#4dff8a"))
    marks += [area((0.012, 0.080), (0.054, 0.092), ink="#08090a", radius=0.0015)]
    marks.append(disc((width - 0.009, height - 0.009), 0.0016, ink="#c33b2e"))
    surface = printed(
        "keypad_face", plane.size, background="#1c1e20", marks=marks, lit=lit, roughness=0.5
    )
    face = plate(plane, surface.name, density=ABS, thickness=0.0006, radius=0.007, sunk=0.0)
    keys = plane.placed(union(caps).at(0.0, 0.0, 0.0086))
    lifted = plane.placed(slab((0.004, 0.004, 0.0), (width - 0.004, height - 0.004, 0.0112)))
    shown = Body(
        solid=_raised(plane, face, 0.009) | keys,
        surface=surface.name,
        density=ABS,
        decal=plane.decal(),
    )
    housing = Body(
        solid=plane.placed(box.at(width / 2.0, height / 2.0)), surface=trim, density=ABS,
        edge=0.0015, collision=(lifted,),
    )  # fmt: skip
    return Lock(bodies=(housing, shown), surfaces=(surface,))


def _raised(plane: PanelPlane, body: Body, height: float) -> Solid:
    x, y, z = (height * c for c in plane.outward)
    return body.solid.at(x, y, z)


def _dial(plane: PanelPlane, handle: str, mark: str, radius: float) -> Lock:
    """A knurled dial of a hundred marks that turns freely over a ring with an index."""
    width, height = plane.size
    center = (width / 2.0, height / 2.0)
    collar = revolve(
        [(0.0072, 0.0), (1.36 * radius, 0.0), (1.30 * radius, 0.006), (1.16 * radius, 0.007),
         (1.14 * radius, 0.0024), (0.0072, 0.0024)], segments=40,
    )  # fmt: skip
    index = slab((-0.0008, 1.17 * radius, 0.006), (0.0008, 1.30 * radius, 0.0078))
    fixed = (
        Body(solid=plane.placed(collar.at(*center)), surface=handle, density=ZINC,
             collision=(_square(plane, center, 1.1 * radius, 0.0024),)),
        Body(solid=plane.placed(index.at(*center)), surface=mark, density=ZINC),
    )  # fmt: skip
    face = PanelPlane(
        origin=plane.point(center[0] - radius, center[1] - radius, 0.012),
        right=plane.right, up=plane.up, size=(2.0 * radius, 2.0 * radius),
    )  # fmt: skip
    numerals = [str((100 - 10 * k) % 100) for k in range(10)] + [""]
    scale = dial_scale(
        (radius, radius), 0.80 * radius, numerals, cap=0.085 * radius, ink="#f1f1ee",
        start=math.pi / 2.0, sweep=2.0 * math.pi,
    )  # fmt: skip
    scale.append(ring((radius, radius), 0.78 * radius, width=0.0003, ink="#c9cac8"))
    surface = printed("dial_face", face.size, background="#151617", marks=scale, roughness=0.35)
    rim = cone(1.08 * radius, radius, 0.008, segments=40).at(*center, 0.004)
    knob = cone(0.44 * radius, 0.40 * radius, 0.018, segments=18).at(*center, 0.012)
    shaft = cylinder(0.0060, 0.012, segments=12).at(*center, -0.006)
    disc_plate = plane.placed(cylinder(0.99 * radius, 0.0008, segments=40).at(*center, 0.0116))
    bodies = (
        Body(solid=plane.placed(union([rim, shaft])), surface=handle, density=ZINC,
             collision=(_square(plane, center, 0.75 * radius, 0.028, low=0.004),)),
        Body(solid=disc_plate, surface=surface.name, density=ZINC, decal=face.decal()),
        Body(solid=plane.placed(knob), surface=handle, density=ZINC, edge=0.0008),
    )  # fmt: skip
    grip = Grip(
        name="dial_knob", kind="knob", position=plane.point(*center, 0.030),
        outward=plane.outward, pull=plane.right,
    )  # fmt: skip
    x, y, z = (-c + 0.0 for c in plane.outward)
    joint = Joint(
        name="dial_turn", type="continuous", parent="door", child="dial", axis=(x, y, z),
        origin=plane.point(*center), limit=None, friction=0.03, damping=0.004, effort=1.0,
        velocity=6.0,
    )  # fmt: skip
    part = DraftPart(name="dial", label="dial", bodies=bodies, grips=(grip,))
    return Lock(bodies=fixed, surfaces=(surface,), part=part, joint=joint)


def _square(
    plane: PanelPlane, center: tuple[float, float], half: float, high: float, low: float = 0.0
) -> Solid:
    (u, v) = center
    return plane.placed(slab((u - half, v - half, low), (u + half, v + half, high)))


def _key(plane: PanelPlane, handle: str) -> Lock:
    """An escutcheon with a keyhole and the bow of a key that stays in it."""
    (w, h) = plane.size
    base = prism(rounded_rectangle(w, h, 0.012, segments=4), 0.004).at(w / 2.0, h / 2.0)
    collar = cone(0.013, 0.011, 0.006, segments=24).at(w / 2.0, h / 2.0, 0.003)
    blade = slab(
        (w / 2.0 - 0.001, h / 2.0 - 0.0045, 0.006), (w / 2.0 + 0.001, h / 2.0 + 0.0045, 0.022)
    )
    bow = prism(rounded_rectangle(0.012, 0.026, 0.0059, segments=5), 0.002)
    bow = bow.turned("y", -math.pi / 2.0).at(w / 2.0 + 0.001, h / 2.0, 0.026)
    solid = union([base, collar, blade, bow])
    touch = slab((0.004, 0.004, 0.0), (w - 0.004, h - 0.004, 0.009))
    body = Body(
        solid=plane.placed(solid), surface=handle, density=ZINC, edge=0.0006,
        collision=(plane.placed(touch),),
    )  # fmt: skip
    return Lock(bodies=(body,), surfaces=())


def badge(plane: PanelPlane, brand: int) -> tuple[Body, SurfaceSpec]:
    """The maker's plate."""
    w, h = plane.size
    marks = [words((w / 2.0, h / 2.0), BRANDS[brand], cap=0.5 * h, ink="#202224")]
    surface = printed("badge", plane.size, background="#c3c4c2", marks=marks, metallic=1.0)
    return plate(plane, surface.name, density=ZINC, thickness=0.0008), surface


def rating_label(plane: PanelPlane, *, fire: bool) -> tuple[Body, SurfaceSpec]:
    """The label inside the door: what the safe withstands."""
    w, h = plane.size
    kind = "CLASS 350  1 HOUR" if fire else "EN 14450  S1"
    marks = [
        area((0.02 * w, 0.03 * h), (0.98 * w, 0.97 * h), ink="#f4f2ea", radius=0.02 * h),
        words((0.5 * w, 0.80 * h), "SECURITY CABINET", cap=0.10 * h, ink="#1c1c1c"),
        words((0.5 * w, 0.56 * h), kind, cap=0.13 * h, ink="#a32018"),
        words((0.5 * w, 0.34 * h), "S/N 0417-2286  DO NOT REMOVE", cap=0.06 * h, ink="#333333"),
        icon((0.5 * w, 0.16 * h), "lock", size=0.16 * h, ink="#1c1c1c"),
    ]
    surface = printed("rating", plane.size, background="#d8d5c8", marks=marks, roughness=0.6)
    return plate(plane, surface.name, density=ABS, thickness=0.0004), surface
