"""Keycaps of a laptop keyboard, one body a key, with one printed image over all of them."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, Decal
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.density import ABS
from artgen.geometry.solid import Solid, hull
from artgen.textures.keyboard_layout import KeyboardStyle, keyboard_keys

CHAMFER = 0.0003
"""m; of a cap's upper edges."""


@dataclass(frozen=True, kw_only=True)
class KeyInk:
    """Colors of a keyboard, `#rrggbb`, and the legends that wear the accent."""

    background: str
    modifier: str
    accent: str
    ink: str
    accents: str = ""


@dataclass(frozen=True, kw_only=True)
class Keycap:
    """The form of caps.

    Attributes:
        height: from the keyboard's floor to the top, m.
        taper: by which each flank leans in, m.
        corner: cut of the corners, m.
        smile: larger cut of the two corners that face the user, m.
    """

    height: float
    taper: float
    corner: float
    smile: float


def keycap(size: Sequence[float], cap: Keycap) -> Solid:
    """One cap centered in x and y on z = 0; flanks lean in, upper edges are chamfered; convex."""
    foot = np.array([(sx * size[0] / 2.0, sy * size[1] / 2.0) for sx in (-1, 1) for sy in (-1, 1)])
    shoulder = _outline(size, cap, inset=cap.taper)
    top = _outline(size, cap, inset=cap.taper + CHAMFER)
    rings = ((foot, 0.0), (shoulder, cap.height - CHAMFER), (top, cap.height))
    return hull(np.concatenate([np.c_[ring, np.full(len(ring), z)] for ring, z in rings]))


def _outline(size: Sequence[float], cap: Keycap, *, inset: float) -> Floats:
    """(8, 2) a rectangle with cut corners."""
    x, y = size[0] / 2.0 - inset, size[1] / 2.0 - inset
    near, far = min(cap.smile, 0.4 * y), min(cap.corner, 0.4 * y)
    right = [(x - near, -y), (x, -y + near), (x, y - far), (x - far, y)]
    return np.array(right + [(-a, b) for a, b in right])


def keycaps(
    style: KeyboardStyle, cap: Keycap, *, origin: tuple[float, float, float]
) -> tuple[Body, ...]:
    """All keys as bodies of the surface `keys`; they stand on the floor at `origin`, the lower left
    corner of the field."""
    x, y, z = origin
    image = Decal(origin=origin, right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=style.size)
    shapes: dict[tuple[float, float], Solid] = {}
    bodies = []
    for key in keyboard_keys(style):
        size = round(key.size[0], 9), round(key.size[1], 9)
        shape = shapes.setdefault(size, keycap(size, cap))
        solid = shape.at(x + key.center[0], y + key.center[1], z)
        bodies.append(Body(solid=solid, surface="keys", density=ABS, decal=image))
    return tuple(bodies)


def printed(face: SurfaceSpec, style: KeyboardStyle, ink: KeyInk) -> SurfaceSpec:
    """The surface `face` with the legends of a keyboard, named `keys`."""
    return dataclasses.replace(
        face,
        name="keys",
        recipe="keyboard",
        tile=style.size,
        detail={
            "block": style.block,
            "arrows": style.arrows,
            "pitch": style.pitch,
            "row_pitch": style.row_pitch,
            "gap": style.gap,
            "function_share": style.function_share,
            "power_key": float(style.power_key),
            **dataclasses.asdict(ink),
        },
    )
