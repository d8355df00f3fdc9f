"""The parts of a stapler: base with anvil, magazine with staples, follower, arm."""

import math
from dataclasses import replace

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, RUBBER, STEEL
from artgen.generators.kit.printed import plate
from artgen.generators.kit.stapler_design import (
    ANVIL,
    CHANNEL,
    PIN,
    SHEET,
    StaplerParams,
)
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union, upright, wire

SCALE = (0.012, 0.10)
"""m; the ruler of a long-reach stapler."""


def steel(edge: float = 0.0) -> Stock:
    """Bright sheet and pins."""
    return Stock(surface="steel", density=STEEL, edge=edge)


def base(p: StaplerParams) -> DraftPart:
    """Rubber pad, body, steel top strip, hinge ears with the pin, anvil or its recess."""
    front, rear = p.mouth - p.overhang, p.tail
    half, top = p.base_half, p.base_top
    middle = (front + rear) / 2.0
    outline = rounded_rectangle(2.0 * half, rear - front, min(p.base_round, 0.9 * half), segments=6)
    body = prism(outline, top - 0.002).at(0.0, middle, 0.002)
    pad = prism(outline * (1.0 - 0.004 / half, 1.0 - 0.006 / (rear - front)), 0.003)
    recess = cylinder(p.anvil + 0.0006, 0.01, segments=24).at(0.0, anvil_place(p), top - 0.0016)
    inner = min(p.base_round, 0.9 * half) * 0.3
    touch = (slab((-half + inner, front + inner, 0.0), (half - inner, rear - inner, top - 0.0017)),)
    bodies = [
        Body(solid=pad.at(y=middle), surface="rubber", density=RUBBER),
        Stock(surface="base", density=1500.0, edge=0.0014).piece(body - recess, contact=touch),
        *_ears(p),
        _leaf_spring(p),
    ]
    if p.inlay and p.kind != "long_reach":
        bodies.append(_inlay(p))
    if not p.anvil_turns:
        bodies.append(_anvil(p))
    if p.kind == "long_reach":
        bodies.append(_ruler(p))
    return DraftPart(name="base", label="base", bodies=tuple(bodies))


def _inlay(p: StaplerParams) -> Body:
    """A strip of bright sheet on the base between anvil and ears."""
    front, rear = anvil_place(p) + p.anvil + 0.004, -0.014
    outline = rounded_rectangle(1.1 * p.base_half, rear - front, 0.003, segments=3)
    strip = prism(outline, 0.0012).at(0.0, (front + rear) / 2.0, p.base_top - 0.0008)
    return steel(0.0002).piece(strip)


def anvil_place(p: StaplerParams) -> float:
    """y of the anvil's middle, under the staple that comes out next."""
    return p.mouth + 0.0045


def _ears(p: StaplerParams) -> list[Body]:
    """Two cheeks that hold the pin, joined below."""
    low, (a, b), z = p.base_top - 0.001, p.ear, p.pivot
    cheek = union(
        [
            slab((a, -0.009, low), (b, 0.009, z)),
            cylinder(0.009, b - a, axis="x", segments=20).at(a, 0.0, z),
        ]
    )
    ears = []
    for side in (cheek, cheek.mirrored("x")):
        x0, x1 = side.bounds[:, 0]
        box = slab((x0, -0.008, low), (x1, 0.008, z + 0.006))
        ears.append(
            Stock(surface="frame", density=STEEL * 0.7, edge=0.0006).piece(side, contact=(box,))
        )
    pin = cylinder(PIN, 2.0 * b + 0.002, axis="x", segments=14).at(-b - 0.001, 0.0, z)
    heads = [
        cylinder(1.7 * PIN, 0.0012, axis="x", segments=16).at(x, 0.0, z) for x in (b, -b - 0.0012)
    ]
    return [*ears, steel().piece(union([pin, *heads]))]


def _leaf_spring(p: StaplerParams) -> Body:
    """A bent strip on the base that lifts the magazine; low enough for the pressed one."""
    rise = 0.45 * (p.clear - 0.003)
    far = 0.42 * p.mouth
    path = [
        (0.0, -0.012, p.base_top + 0.0003),
        (0.0, far, p.base_top + rise),
        (0.0, far - 0.008, p.base_top + rise - 0.001),
    ]
    points = np.array(path)
    outline = np.concatenate([points[:, 1:], points[::-1, 1:] + (0.0, 0.0006)])[::-1]
    strip = upright(prism(_counterclockwise(outline), 0.008), "x").at(x=-0.004)
    return steel().piece(strip)


def _counterclockwise(outline: Floats) -> Floats:
    x, y = outline.T
    area = float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())
    return outline if area > 0.0 else outline[::-1]


def _anvil(p: StaplerParams) -> Body:
    """A round plate with the grooves that bend the legs, straight ones and outward ones."""
    disc = cylinder(p.anvil, 0.0030, segments=24)
    grooves = [
        slab((x - 0.0028, y - 0.0007, 0.0026), (x + 0.0028, y + 0.0007, 0.004))
        for x, y in ((-0.0036, 0.0024), (0.0036, 0.0024), (-0.0050, -0.0030), (0.0050, -0.0030))
    ]
    place = (0.0, anvil_place(p), p.base_top + ANVIL - 0.0030)
    half = 0.7 * p.anvil
    box = slab((-half, -half, 0.0018), (half, half, 0.0030)).at(*place)
    return steel(0.0003).piece((disc - union(grooves)).at(*place), contact=(box,))


def anvil_part(p: StaplerParams) -> DraftPart:
    """The anvil that turns in its recess between clinching and pinning."""
    rim = (0.0, anvil_place(p) - p.anvil, p.base_top + 0.5 * ANVIL)
    grip = Grip(
        name="anvil_rim", kind="rim", position=rim, outward=(0.0, -1.0, 0.0), pull=(1.0, 0.0, 0.0)
    )
    return DraftPart(name="anvil", label="turntable", bodies=(_loose_anvil(p),), grips=(grip,))


def _loose_anvil(p: StaplerParams) -> Body:
    """The anvil cut off above the floor of its recess."""
    under = slab((-1.0, -1.0, 0.0), (1.0, 1.0, p.base_top - 0.0008))
    body = _anvil(p)
    return replace(body, solid=body.solid - under)


def _ruler(p: StaplerParams) -> Body:
    """Centimeters beside the paper stop."""
    corner = (p.base_half - 0.004 - SCALE[0], stop_span(p)[0] - 0.002, p.base_top)
    plane = PanelPlane(origin=corner, right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=SCALE)
    return plate(plane, "scale", density=ABS, thickness=0.0006, radius=0.001, sunk=0.0003)


def stop_span(p: StaplerParams) -> tuple[float, float]:
    """y from and to of the paper stop's way."""
    start = p.mouth + 0.05 + 0.04 * p.stop_place
    return start, start + SCALE[1] - 0.012


def paper_stop(p: StaplerParams) -> DraftPart:
    """A fence across the base: a bar under the magazine and two posts beside the arm."""
    y, low = stop_span(p)[0], p.base_top + 0.0009
    x0 = p.arm_half[1] + 0.0055
    bar = slab((-x0 - 0.004, y, low), (x0 + 0.004, y + 0.010, low + 0.0016))
    posts = [slab((s - 0.004, y, low), (s + 0.004, y + 0.003, low + 0.011)) for s in (-x0, x0)]
    piece = Stock(surface="base", density=ABS, edge=0.0006).piece(
        union([bar, *posts]), contact=(bar, *posts)
    )
    at = (x0, y, low + 0.008)
    grip = Grip(
        name="paper_stop_post",
        kind="edge",
        position=at,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 1.0, 0.0),
    )
    return DraftPart(name="paper_stop", label="pusher", bodies=(piece,), grips=(grip,))


def magazine(p: StaplerParams) -> DraftPart:
    """A channel of sheet with a nose, the strip of staples in it, the follower's rod behind."""
    z, c = p.pivot, CHANNEL
    low, high = z - 0.0080, z + 0.0030
    edges = ((-c, -c + SHEET), (c - SHEET, c))
    walls = [slab((a, p.mouth, low), (b, 0.0, high)) for a, b in edges]
    lugs = [cylinder(0.0064, b - a, axis="x", segments=18).at(a, 0.0, z) for a, b in edges]
    floor = slab((-c, p.mouth, low), (c, -0.001, low + SHEET))
    nose = slab((-c, p.mouth, low), (c, p.mouth + 0.0012, high + 0.0012))
    exit_ = slab(
        (-c + 0.0006, p.mouth + 0.0014, low - 0.01),
        (c - 0.0006, p.mouth + 0.0026, low + SHEET + 0.001),
    )
    bore = cylinder(PIN + 0.0006, 0.1, axis="x", segments=14).at(-0.05, 0.0, z)
    channel = (union([*walls, *lugs, floor, nose]) - bore) - exit_
    front_walls = [wall & slab((-1.0, -1.0, 0.0), (1.0, -PIN - 0.001, 1.0)) for wall in walls]
    rod = cylinder(0.0011, -p.mouth - 0.006, axis="y", segments=8).at(
        0.0, p.mouth + 0.001, rod_height(p)
    )
    bodies = [
        steel(0.0).piece(channel, contact=(*front_walls, floor, nose)),
        steel().piece(_staples(p), contact=(_staples(p).hull(),)),
        steel().piece(rod - bore),
        steel().piece(_coil(p)),
    ]
    at = (0.0, p.mouth, z)
    grip = Grip(
        name="magazine_nose",
        kind="edge",
        position=at,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0 if p.tacks else -1.0),
    )
    return DraftPart(name="magazine", label="arm", bodies=tuple(bodies), grips=(grip,))


def rod_height(p: StaplerParams) -> float:
    """z of the follower's rod."""
    return p.pivot - 0.0002


def _strip(p: StaplerParams) -> tuple[float, float]:
    """y from and to of the staples."""
    start = p.mouth + 0.0016
    return start, start + max(0.010, p.staples * (-p.mouth - 0.045))


def _staples(p: StaplerParams) -> Solid:
    """The strip as one bar with a shadow line every few staples, open below like staples are."""
    y0, y1 = _strip(p)
    half, top = CHANNEL - SHEET - 0.0003, p.pivot - 0.0018
    bar = slab((-half, y0, top - 0.0048), (half, y1, top))
    count = int((y1 - y0) / 0.0032)
    lines = [
        slab((-1.0, y - 0.00015, top - 0.0004), (1.0, y + 0.00015, 1.0))
        for y in np.linspace(y0, y1, count + 2)[1:-1].tolist()
    ]
    return bar - union(lines)


def _coil(p: StaplerParams) -> Solid:
    """The last turns of the follower's spring on its rod, where it stays pressed together."""
    turns, pitch, radius = 6, 0.0013, 0.0026
    angles = np.arange(turns * 8 + 1) * math.pi / 4.0
    start = -PIN - 0.0022 - turns * pitch
    path = np.stack(
        [
            radius * np.cos(angles),
            start + pitch * angles / (2.0 * math.pi),
            rod_height(p) + radius * np.sin(angles),
        ],
        axis=1,
    )
    return wire(path, 0.00045, sides=4)


def follower(p: StaplerParams) -> DraftPart:
    """A block on the rod behind the staples, with a thumb tab."""
    y0 = _strip(p)[1] + 0.0008
    y1, half = y0 + p.follower, CHANNEL - SHEET - 0.0006
    low, high = p.pivot - 0.0063, p.pivot + 0.0016
    z = rod_height(p)
    block = slab((-half, y0, low), (half, y1, high)) - slab(
        (-0.0018, y0 - 1.0, z - 0.0018), (0.0018, y1 + 1.0, 1.0)
    )
    tab = slab((-half, y1 - 0.003, high), (half, y1, high + 0.0022)) - slab(
        (-0.0018, -1.0, z), (0.0018, 1.0, high + 0.0006)
    )
    touch = (
        slab((-half, y0, low), (-0.0018, y1, high)),
        slab((0.0018, y0, low), (half, y1, high)),
    )
    piece = Stock(surface="plastic", density=ABS, edge=0.0).piece(
        union([block, tab]), contact=touch
    )
    at = (0.0, y1, high + 0.002)
    grip = Grip(
        name="follower_tab", kind="edge", position=at, outward=(0.0, 0.0, 1.0), pull=(0.0, 1.0, 0.0)
    )
    return DraftPart(name="follower", label="pusher", bodies=(piece,), grips=(grip,))


def follower_travel(p: StaplerParams) -> float:
    """m to the rear."""
    return -PIN - 0.0120 - (_strip(p)[1] + 0.0008 + p.follower)
