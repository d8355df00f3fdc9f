"""The arm of a stapler: a shell over the magazine with its driver, soft pad and brand."""

from itertools import pairwise

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, RUBBER, ZINC
from artgen.generators.kit.printed import plate
from artgen.generators.kit.stapler_design import CHANNEL, PIN, StaplerParams, inset_convex
from artgen.generators.kit.stapler_works import steel
from artgen.geometry.solid import Solid, cylinder, prism, slab, union, upright

BADGE = (0.034, 0.0075)
"""m; the brand on the arm's side."""


def arm(p: StaplerParams) -> DraftPart:
    """The cover that is pressed: a shell over the magazine, the driver at its front, a soft pad."""
    inner, outer = p.arm_half
    wall, z = p.arm_wall, p.pivot
    shape = p.profile
    hollow = inset_convex(shape, wall)
    shell = _along_x(shape, -outer, outer)
    room = _along_x(hollow, -inner, inner)
    room = union([room, room.at(z=-0.004), room.at(z=-0.008)])
    bore = cylinder(PIN + 0.0006, 0.1, axis="x", segments=14).at(-0.05, 0.0, 0.0)
    solid = (shell - room) - bore
    ceiling = float(hollow[:, 1].max())
    front = p.arm_front + wall
    driver = slab(
        (-CHANNEL + 0.002, front + 0.0004, 0.0058),
        (CHANNEL - 0.002, front + 0.0016, ceiling + 0.001),
    )
    bodies = [
        Stock(surface="arm", density=ZINC * 0.5 if p.one_color else 1350.0, edge=0.0016).piece(
            solid.at(z=z), contact=tuple(piece.at(z=z) for piece in _arm_contact(p, hollow))
        ),
        steel().piece((driver & _along_x(inset_convex(shape, 0.5 * wall), -1.0, 1.0)).at(z=z)),
    ]
    if p.pad:
        pad = _pad(p).at(z=z)
        bodies.append(Body(solid=pad, surface="rubber", density=RUBBER, edge=0.0008))
    badge = PanelPlane(
        origin=(outer, -0.40 * -p.mouth - BADGE[0] / 2.0, z + 0.0005),
        right=(0.0, 1.0, 0.0),
        up=(0.0, 0.0, 1.0),
        size=(BADGE[0], BADGE[1]),
    )
    bodies.append(plate(badge, "badge", density=ABS, thickness=0.0012, radius=0.002, sunk=0.0008))
    at = (0.0, 0.72 * p.arm_front, z + float(shape[:, 1].max()))
    grip = Grip(
        name="arm_press", kind="lever", position=at, outward=(0.0, 0.0, 1.0), pull=(0.0, 0.0, 1.0)
    )
    return DraftPart(name="arm", label="arm", bodies=tuple(bodies), grips=(grip,))


def _along_x(outline: Floats, low: float, high: float) -> Solid:
    """An outline in (y, z) from x = `low` to `high`."""
    return upright(prism(outline, high - low), "x").at(x=low)


def _arm_contact(p: StaplerParams, hollow: Floats) -> list[Solid]:
    """Two cheeks before the pin, and the roof between them in three boxes."""
    inner, outer = p.arm_half
    ahead = slab((-1.0, -1.0, -1.0), (1.0, -PIN - 0.0010, 1.0))
    cheeks = [_along_x(p.profile, a, b) & ahead for a, b in ((-outer, -inner), (inner, outer))]
    pieces = [*cheeks]
    cuts = np.linspace(p.arm_front, -0.006, 4).tolist()
    for a, b in pairwise(cuts):
        low = max(_roof(hollow, a), _roof(hollow, b), _roof(hollow, (a + b) / 2.0))
        top = min(_roof(p.profile, a + 0.002), _roof(p.profile, b)) + 0.003
        if top > low + 0.0005:
            pieces.append(slab((-inner, a, low), (inner, b, top)))
    front = slab(
        (-inner, p.arm_front, -0.0052),
        (inner, p.arm_front + p.arm_wall, _roof(p.profile, p.arm_front + 0.002)),
    )
    return [*pieces, front]


def _roof(outline: Floats, y: float) -> float:
    """z of a convex outline's upper side at y."""
    upper = outline[np.argsort(outline[:, 0])]
    best = -1.0
    for a, b in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        if min(a[0], b[0]) <= y <= max(a[0], b[0]) and a[0] != b[0]:
            best = max(best, float(a[1] + (b[1] - a[1]) * (y - a[0]) / (b[0] - a[0])))
    return best if best > -1.0 else float(upper[:, 1].mean())


def _pad(p: StaplerParams) -> Solid:
    """A soft strip let into the roof where the hand presses."""
    outer = p.arm_half[1]
    skin = _along_x(p.profile, -0.62 * outer, 0.62 * outer)
    raised = skin.at(z=0.0007)
    window = slab((-1.0, 0.92 * p.arm_front, 0.004), (1.0, 0.45 * p.arm_front, 1.0))
    return (raised - skin.at(z=-0.0008)) & window
