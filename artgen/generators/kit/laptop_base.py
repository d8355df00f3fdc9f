"""The lower half of a laptop: case, deck with keyboard and touchpad, sockets, vents and feet."""

from collections.abc import Sequence

from artgen.articulation.types import Body, DraftPart
from artgen.generators.kit.barrel import free_spans, pockets
from artgen.generators.kit.density import ABS, ALUMINIUM, RUBBER, STEEL
from artgen.generators.kit.keyboard import keycaps
from artgen.generators.kit.laptop_layout import (
    DECK,
    KEY_SINK,
    PLAY,
    WELL_FLOOR,
    Layout,
    Rect,
)
from artgen.generators.kit.lofted_shell import tray
from artgen.generators.kit.side_port import SOCKETS, fitting, side_port
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union

SEAM = 0.0005
"""m; around the touchpad and between its buttons."""
DUCT = 0.006
"""m; depth of what one sees of an exhaust."""
EVERYTHING = 1.0
"""m; larger than any laptop."""


def base(at: Layout) -> DraftPart:
    """Case and deck are cut from one tray, so that their outlines agree."""
    p = at.p
    whole = tray(
        x=at.width / 2.0,
        y=(0.0, at.rear),
        z=(p.foot, at.deck),
        radii=(p.corner, min(p.corner, 0.008)),
        belly=p.belly,
        nose=at.nose,
    )
    upper = slab((-EVERYTHING, -EVERYTHING, at.deck - DECK), (EVERYTHING,) * 3)
    sockets = _sockets(at)
    duct_cuts, grilles = _exhausts(at)
    slots = _speaker_slots(at)
    well = _well(at)
    pocket = pockets(at.barrels, clearance=PLAY, depth=at.radius + PLAY, rear=at.pocket_rear)
    case_cuts = [upper, well, pocket, *(cut for cut, _ in sockets), *duct_cuts, *_bottom_slots(at)]
    deck_cuts = [well, pocket, _opening(at.pad.grown(SEAM), 0.002, at), *slots]
    if p.finger_notch:
        case_cuts.append(_finger_notch(at))
        deck_cuts.append(case_cuts[-1])
    density = at.style.base_density * p.packing
    case = Body(
        solid=whole - union(case_cuts),
        surface="shell",
        density=density,
        edge=0.0004,
        collision=_contact(at),
    )
    deck = Body(
        solid=(whole & upper) - union(deck_cuts), surface="deck", density=density, edge=0.0004
    )
    bodies = [case, deck, *(body for _, own in sockets for body in own), *grilles]
    bodies += [*_keyboard(at), *_touchpad(at), *_knuckles(at), *_feet(at)]
    if slots:
        bodies.append(_speaker_cloth(at))
    if p.power == "button":
        bodies.append(_power_button(at))
    return DraftPart(name="base", label="base", bodies=tuple(bodies))


def _contact(at: Layout) -> tuple[Solid, ...]:
    """Boxes: the slab before the hinge, its thin nose, and what stands between the pockets."""
    x, (run, rise) = at.width / 2.0, at.nose
    front = at.axis_y - at.radius - PLAY
    low = at.p.foot
    boxes = [
        slab((-x, 0.0, low + 0.6 * rise), (x, run, at.deck)),
        slab((-x, run, low), (x, front, at.deck)),
    ]
    floor = at.axis_z - at.radius - PLAY
    pocket_end = min(at.pocket_rear, at.rear)
    boxes.append(slab((-x, front, low), (x, pocket_end, floor)))
    spans = free_spans(at.barrels, width=at.width)
    boxes += [slab((a, front, floor), (b, pocket_end, at.deck)) for a, b in spans]
    if at.rear > pocket_end + 0.001:
        boxes.append(slab((-x, pocket_end, low), (x, at.rear, at.deck)))
    return tuple(boxes)


def _well(at: Layout) -> Solid:
    """The recess that holds the keys, down to the lower face of its floor."""
    depth = KEY_SINK + at.p.key_height + WELL_FLOOR
    return _opening(at.well, 0.0025, at, low=at.deck - depth)


def _opening(rect: Rect, radius: float, at: Layout, *, low: float | None = None) -> Solid:
    """A rounded hole through the deck, or down to `low`."""
    bottom = at.deck - DECK if low is None else low
    outline = rounded_rectangle(*rect.size, radius, segments=3)
    return prism(outline, at.deck + 0.002 - bottom).at(*rect.middle, bottom)


def _keyboard(at: Layout) -> list[Body]:
    """Floor and keys."""
    low = at.deck - KEY_SINK - at.p.key_height
    outline = rounded_rectangle(*at.well.size, 0.0025, segments=3)
    floor = prism(outline, WELL_FLOOR).at(*at.well.middle, low - WELL_FLOOR)
    keys = list(keycaps(at.keyboard, at.keycap, origin=at.keys_origin))
    return [Body(solid=floor, surface="keybed", density=ALUMINIUM), *keys]


def _touchpad(at: Layout) -> list[Body]:
    """A glass plate a hair below the palm rest; some have buttons beside it."""
    rect, sink = at.pad, 0.0002
    low, high = at.deck - DECK, at.deck - sink
    strip = min(0.014, 0.22 * rect.size[1]) if at.p.pad != "plain" else 0.0
    above = at.p.pad == "buttons_above"
    split = rect.y1 - strip if above else rect.y0 + strip
    plates = [Rect(x0=rect.x0, x1=rect.x1, y0=rect.y0 if above else split,
                   y1=split if above else rect.y1)]  # fmt: skip
    buttons = []
    if strip > 0.0:
        y0, y1 = (split + SEAM, rect.y1) if above else (rect.y0, split - SEAM)
        count = 3 if above else 2
        wide = (rect.size[0] - SEAM * (count - 1)) / count
        lefts = [rect.x0 + k * (wide + SEAM) for k in range(count)]
        buttons = [Rect(x0=x, x1=x + wide, y0=y0, y1=y1) for x in lefts]
    return [
        Body(
            solid=prism(rounded_rectangle(*r.size, 0.0014, segments=3), high - low).at(
                *r.middle, low
            ),
            surface=surface,
            density=ABS,
            edge=0.0003,
        )
        for surface, group in (("pad", plates), ("pad_button", buttons))
        for r in group
    ]


def _knuckles(at: Layout) -> list[Body]:
    """The base's share of the barrels."""
    barrels = at.barrels
    return [
        Body(
            solid=barrels.knuckle(span),
            surface="hinge",
            density=ALUMINIUM,
            edge=0.0004,
            collision=(barrels.core(span),),
        )
        for span in barrels.base
    ]


def _sockets(at: Layout) -> list[tuple[Solid, tuple[Body, ...]]]:
    """From the hinge forward on both sides, in the straight part of the wall."""
    p, placed = at.p, []
    low, high = p.foot + 0.7 * p.belly + 0.0006, at.deck - DECK - 0.0008
    room = high - low
    for side, count in ((-1.0, p.ports_left), (1.0, p.ports_right)):
        kinds = at.style.ports if side < 0.0 else tuple(reversed(at.style.ports))
        y = at.axis_y - 0.030 - (0.018 if p.style == "gaming" else 0.0)
        for kind in fitting(kinds[:count], room=room):
            half = SOCKETS[kind].width / 2.0
            y -= half
            face = side * at.width / 2.0
            placed.append(side_port(kind, face=face, y=y, z=(low + high) / 2.0))
            y -= half + 0.0065
    return placed


def _exhausts(at: Layout) -> tuple[list[Solid], list[Body]]:
    """Openings with fins in the rear face, between or beside the hinges."""
    p = at.p
    low = p.foot + p.belly + 0.0008
    high = at.deck - DECK - 0.0016
    if p.style == "gaming":
        spans = [(s * 0.27 * at.width, 0.34 * p.vent_share * at.width) for s in (-1.0, 1.0)]
    elif p.hinge == "twin" and p.style != "chromebook":
        spans = [(0.0, 0.55 * p.vent_share * at.width)]
    else:
        return [], []
    return _ducts(spans, (low, high), at.rear)


def _ducts(
    spans: Sequence[tuple[float, float]], z: tuple[float, float], rear: float
) -> tuple[list[Solid], list[Body]]:
    """Recesses about each middle x of some length, and the fins in them."""
    cuts, grilles = [], []
    (low, high), back = z, 0.0006
    for middle, length in spans:
        x0, x1 = middle - length / 2.0, middle + length / 2.0
        cuts.append(slab((x0, rear - DUCT, low), (x1, rear + 0.004, high)))
        pieces = [slab((x0, rear - DUCT, low), (x1, rear - DUCT + back, high))]
        count = max(4, round(length / 0.0054))
        for k in range(1, count):
            x = x0 + length * k / count
            pieces.append(slab((x - 0.0005, rear - DUCT, low), (x + 0.0005, rear - 0.0004, high)))
        grilles.append(Body(solid=union(pieces), surface="vent", density=ALUMINIUM))
    return cuts, grilles


def _bottom_slots(at: Layout) -> list[Solid]:
    """Air intakes in the bottom, under the fans."""
    rows, length = 7, 0.26 * at.width * at.p.vent_share
    y0 = 0.56 * at.axis_y
    return [
        slab(
            (s * 0.24 * at.width - length / 2.0, y0 + 0.0055 * k, at.p.foot - 0.002),
            (s * 0.24 * at.width + length / 2.0, y0 + 0.0055 * k + 0.0022, at.p.foot + 0.0008),
        )
        for s in (-1.0, 1.0)
        for k in range(rows)
    ]


def _speaker_rects(at: Layout) -> list[Rect]:
    """Where the deck is slotted."""
    well = at.well
    if at.p.speakers == "sides":
        room = at.width / 2.0 - well.x1
        x0, x1 = well.x1 + 0.30 * room, at.width / 2.0 - 0.34 * room
        y0, y1 = well.y0 + 0.006, well.y1 - 0.006
        return [Rect(x0=-x1, x1=-x0, y0=y0, y1=y1), Rect(x0=x0, x1=x1, y0=y0, y1=y1)]
    if at.p.speakers == "top":
        y = well.y1 + 0.40 * at.p.deck_rear
        return [Rect(x0=-0.30 * at.width, x1=0.30 * at.width, y0=y - 0.0016, y1=y + 0.0016)]
    return []


def _speaker_slots(at: Layout) -> list[Solid]:
    """Slots across each speaker."""
    slots = []
    for rect in _speaker_rects(at):
        w, h = rect.size
        upright = h > w
        long, short = (h, w) if upright else (w, h)
        count = max(6, round(long / 0.0066))
        for k in range(count):
            middle = (k + 0.5) * long / count
            half = 0.0010 if upright else 0.0018
            if upright:
                lower = rect.x0, rect.y0 + middle - half
                upper = rect.x1, rect.y0 + middle + half
            else:
                lower = rect.x0 + middle - half, rect.y0
                upper = rect.x0 + middle + half, rect.y0 + short
            slots.append(slab((*lower, at.deck - DECK), (*upper, at.deck + 0.002)))
    return slots


def _speaker_cloth(at: Layout) -> Body:
    """What one sees through the slots."""
    plates = [
        slab((r.x0, r.y0, at.deck - DECK - 0.0004), (r.x1, r.y1, at.deck - DECK))
        for r in _speaker_rects(at)
    ]
    return Body(solid=union(plates), surface="dark", density=ABS)


def _power_button(at: Layout) -> Body:
    """A key of its own right of the speakers, behind the keyboard."""
    x = min(at.well.x1 - 0.010, at.width / 2.0 - 0.022)
    y = at.well.y1 + 0.45 * at.p.deck_rear
    solid = prism(circle(0.0042, segments=20), DECK - 0.0001).at(x, y, at.deck - DECK)
    return Body(solid=solid, surface="trim", density=STEEL, edge=0.0003)


def _finger_notch(at: Layout) -> Solid:
    """A shallow scoop in the front edge, where a finger lifts the lid."""
    radius, deep = 0.070, 0.0016
    scoop = cylinder(radius, 0.012, axis="y", segments=64)
    return scoop.at(0.0, -0.008, at.deck + radius - deep)


def _feet(at: Layout) -> list[Body]:
    """Four pads, or two strips, under the flat part of the bottom."""
    p = at.p
    front, rear = at.nose[0] + 0.012, at.axis_y - 0.014
    top = p.foot
    if p.feet == "strips":
        outline = rounded_rectangle(0.62 * at.width, 0.009, 0.0042, segments=4)
        places = [(0.0, front), (0.0, rear)]
    else:
        outline = circle(0.0075, segments=16)
        reach = 0.39 * at.width
        places = [(x, y) for y in (front, rear) for x in (-reach, reach)]
    half = 0.62 * at.width / 2.0 if p.feet == "strips" else 0.0053
    return [
        Body(
            solid=prism(outline, top).at(x, y, 0.0),
            surface="rubber",
            density=RUBBER,
            edge=0.0004,
            collision=(slab((x - half, y - 0.004, 0.0), (x + half, y + 0.004, top)),),
        )
        for x, y in places
    ]
