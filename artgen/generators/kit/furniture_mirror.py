"""Mirrors on furniture: framed panes of several outlines, fixed to a chest or swinging on posts."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.geometry.profile import arc, circle, rectangle, rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, upright

POST, GAP = 0.032, 0.004
"""Side of a post, and the air between it and a swinging frame, m."""
SWING = math.radians(14.0)
"""How far a mirror swings to either side of upright."""


@dataclass(frozen=True, kw_only=True)
class Mirror:
    """A mirror that stands on a top.

    Attributes:
        shape: key of OUTLINES.
        width: of the frame, m.
        border: width of the frame's bars, m.
        y: middle of the frame's depth.
        z: of the top that it stands on.
    """

    shape: str
    width: float
    height: float
    border: float
    y: float
    z: float
    wood: Stock
    glass: Stock
    metal: Stock


def fixed_mirror(m: Mirror) -> tuple[Body, ...]:
    """A frame that stands on the top, with two battens behind it."""
    frame = _framed(m, m.z)
    battens = [
        m.wood.board((x - 0.02, m.y + 0.0125, m.z - 0.12), (x + 0.02, m.y + 0.0275, m.z + 0.3))
        for x in (-0.25 * m.width, 0.25 * m.width)
    ]
    return (*frame, *battens)


def swinging_mirror(m: Mirror) -> Works:
    """A frame between two posts on a foot board, held at any angle by the friction of its knobs."""
    low = m.z + 0.045
    middle = low + m.height / 2.0
    posts: list[Body] = []
    for sign in (-1.0, 1.0):
        inner = sign * (m.width / 2.0 + GAP)
        outer = inner + sign * POST
        x0, x1 = sorted((inner, outer))
        half = POST / 2.0
        posts.append(
            m.wood.board((x0, m.y - half, m.z), (x1, m.y + half, middle + 0.09), grain="z")
        )
        posts.append(m.wood.board((x0, m.y - 0.07, m.z), (x1, m.y + 0.07, m.z + 0.03), grain="y"))
        screw = cylinder(0.014, 0.018, axis="x", segments=18)
        posts.append(m.metal.piece(screw.at(outer if sign > 0.0 else outer - 0.018, m.y, middle)))
        boss = cylinder(0.010, GAP - 0.001, axis="x", segments=16)
        posts.append(
            m.metal.piece(boss.at(inner - GAP + 0.001 if sign > 0.0 else inner, m.y, middle))
        )
    bar = slab(
        (-m.width / 2.0 - GAP, m.y - 0.01, m.z), (m.width / 2.0 + GAP, m.y + 0.01, m.z + 0.022)
    )
    posts.append(m.wood.piece(bar, contact=(bar,), grain="x"))
    grip = Grip(
        name="mirror_edge",
        kind="edge",
        position=(0.0, m.y - 0.0125, low + m.border / 2.0),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 1.0, 0.0),  # The lower edge is pushed back; the upper one comes forward.
    )
    joint = Joint(
        name="mirror_tilt",
        type="revolute",
        parent="base",
        child="mirror",
        axis=(1.0, 0.0, 0.0),
        origin=(0.0, m.y, middle),
        limit=Limit(lower=-SWING, upper=SWING),
        friction=1.2,
        damping=0.3,
        effort=15.0,
    )
    part = DraftPart(name="mirror", label="head", bodies=_framed(m, low), grips=(grip,))
    return Works(parts=(part,), joints=(joint,), base=tuple(posts))


def _framed(m: Mirror, low: float) -> tuple[Body, ...]:
    """Frame, pane and backing; the contact is one plate."""
    outline = OUTLINES[m.shape]
    outer, inner = outline(m.width, m.height, 0.0), outline(m.width, m.height, m.border)
    middle = low + m.height / 2.0

    def standing(flat: Solid, y: float) -> Solid:
        return upright(flat, "y").turned("y", -math.pi / 2.0).at(0.0, y, middle)

    frame = standing(prism(outer, 0.025, holes=[inner]), m.y - 0.0125)
    pane = standing(prism(inner, 0.004), m.y - 0.004)
    backing = standing(prism(inner, 0.003), m.y)
    plate = slab((-m.width / 2.0, m.y - 0.0125, low), (m.width / 2.0, m.y + 0.0125, low + m.height))
    contact = (plate,) if m.shape == "rectangle" else (standing(prism(outer, 0.025), m.y - 0.0125),)
    flat = Stock(surface=m.wood.surface, density=m.wood.density, edge=0.0)
    return (
        m.wood.piece(frame, contact=contact, grain="z"),
        m.glass.piece(pane),
        flat.piece(backing, grain="z"),
    )


def _rectangle(width: float, height: float, inset: float) -> Floats:
    return rectangle(width - 2.0 * inset, height - 2.0 * inset)


def _soft(width: float, height: float, inset: float) -> Floats:
    radius = max(0.02, 0.09 - inset)
    return rounded_rectangle(width - 2.0 * inset, height - 2.0 * inset, radius, segments=6)


def _arch(width: float, height: float, inset: float) -> Floats:
    """Upright sides under a half circle."""
    half, top = width / 2.0 - inset, height / 2.0
    crown = arc((0.0, top - width / 2.0), half, 0.0, math.pi, 18)
    return np.concatenate([[(-half, -top + inset), (half, -top + inset)], crown])


def _round(width: float, height: float, inset: float) -> Floats:
    size = min(width, height) / 2.0 - inset
    return circle(1.0, segments=36) * (size * width / min(width, height), size)


OUTLINES: Mapping[str, Callable[[float, float, float], Floats]] = {
    "rectangle": _rectangle,
    "soft": _soft,
    "arch": _arch,
    "round": _round,
}
"""Outline of a frame, `inset` m within its outer edge, centered; x across, y up."""
