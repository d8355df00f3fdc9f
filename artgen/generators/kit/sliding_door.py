"""Doors that slide past each other between top and bottom tracks, set into an opening."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.front_panel import FrontMaker, Style
from artgen.geometry.solid import Solid, cylinder, prism, slab, tube

Fill = Literal["panel", "mirror", "glass"]
LIP, CHANNEL, RAIL = 0.002, 0.034, 0.0075
"""Sheet of the tracks; how far the top channel hangs down; height of the bottom rails, m."""
BETWEEN = 0.006
"""m; from the rear of one door to the face of the next."""
PLAY = 0.002
"""m; around a door at rest."""
OVERLAP = 0.026
"""m; of neighboring doors."""
PULL = 0.022
"""Radius of a round finger pull, m."""


@dataclass(frozen=True, kw_only=True)
class SlidingDoor:
    """One door: where it is at rest, its track (0 is the foremost), its way and its look.

    Attributes:
        way: +1 opens towards +x, -1 towards -x.
        fills: its fields from bottom to top.
        framed: fields in a frame of profiles with a full-height grip; else one board with a round
            finger pull.
    """

    x0: float
    x1: float
    track: int
    way: float
    travel: float
    fills: tuple[Fill, ...]
    framed: bool


@dataclass(frozen=True, kw_only=True)
class SlidingSet:
    """The doors of one opening.

    Attributes:
        front: y of the opening's front edge.
        tracks: how many lie behind each other.
        thickness: of the doors, m.
        profile: width of stiles, m.
        friction: N.
        maker: of doors without a frame.
        style: of doors without a frame.
        stocks: `front` for panels, `profile`, `track`, `mirror`, `pane`, `metal`.
    """

    opening: Rect
    front: float
    tracks: int
    thickness: float
    profile: float
    friction: float
    doors: tuple[SlidingDoor, ...]
    maker: FrontMaker
    style: Style
    stocks: dict[str, Stock]

    @property
    def pitch(self) -> float:
        """From one track to the next, m."""
        return self.thickness + BETWEEN

    @property
    def depth(self) -> float:
        """From the opening's front edge to the rear of the tracks."""
        return self.tracks * self.pitch + 2.0 * LIP

    def face(self, track: int) -> float:
        """y of the face of doors on a track."""
        return self.front + LIP + BETWEEN / 2.0 + track * self.pitch


def even_doors(
    opening: Rect, fills: tuple[tuple[Fill, ...], ...], *, tracks: int, mirrored: bool, framed: bool
) -> tuple[SlidingDoor, ...]:
    """Doors that close the opening side by side, each on a track of its own or two by turns."""
    count = len(fills)
    width = (opening.width - 2.0 * PLAY + (count - 1) * OVERLAP) / count
    starts = [opening.x0 + PLAY + k * (width - OVERLAP) for k in range(count)]
    return tuple(
        SlidingDoor(
            x0=x,
            x1=x + width,
            track=(tracks - 1 - k % tracks) if mirrored else k % tracks,
            way=1.0 if k < count / 2.0 else -1.0,
            travel=width - OVERLAP,
            fills=fills[k],
            framed=framed,
        )
        for k, x in enumerate(starts)
    )


def sliding_works(doors: SlidingSet, number: int) -> Works:
    """Doors with their joints, and the tracks in the base."""
    works = Works(base=_tracks(doors))
    for k, door in enumerate(doors.doors):
        name = f"door_{number}{'abc'[k]}"
        bodies = _framed(doors, door) if door.framed else _board(doors, door)
        works += Works(
            parts=(
                DraftPart(
                    name=name, label="door", bodies=bodies, grips=(_grip(doors, door, name),)
                ),
            ),
            joints=(
                Joint(
                    name=f"{name}_slide",
                    type="prismatic",
                    parent="base",
                    child=name,
                    axis=(door.way, 0.0, 0.0),
                    limit=Limit(lower=0.0, upper=door.travel),
                    friction=doors.friction,
                    damping=1.5 * doors.friction,
                    effort=120.0,
                    velocity=1.0,
                ),
            ),
        )
    return works


def _tracks(doors: SlidingSet) -> tuple[Body, ...]:
    """A channel of sheet above, rails on a plate below."""
    o, stock = doors.opening, doors.stocks["track"]
    back = doors.front + doors.depth
    plates = [
        slab((o.x0, doors.front, o.z1 - LIP), (o.x1, back, o.z1)),
        slab((o.x0, doors.front, o.z0), (o.x1, back, o.z0 + LIP)),
    ]
    lips = []
    for track in range(doors.tracks + 1):
        y = doors.face(track) - BETWEEN / 2.0 - LIP / 2.0
        lips.append(slab((o.x0, y, o.z1 - CHANNEL), (o.x1, y + LIP, o.z1 - LIP)))
    for track in range(doors.tracks):
        y = doors.face(track) + doors.thickness / 2.0
        lips.append(slab((o.x0, y - 0.002, o.z0 + LIP), (o.x1, y + 0.002, o.z0 + RAIL)))
    return tuple(stock.piece(solid, contact=(solid,), grain="x") for solid in plates + lips)


def _heights(doors: SlidingSet) -> tuple[float, float]:
    o = doors.opening
    return o.z0 + RAIL + PLAY, o.z1 - LIP - PLAY


def _whole(doors: SlidingSet, door: SlidingDoor) -> Solid:
    low, high = _heights(doors)
    face = doors.face(door.track)
    return slab((door.x0, face, low), (door.x1, face + doors.thickness, high))


def _board(doors: SlidingSet, door: SlidingDoor) -> tuple[Body, ...]:
    """A front with a metal cup let in near the edge that is pulled."""
    face = doors.face(door.track)
    low, high = _heights(doors)
    rect = Rect(x0=door.x0, x1=door.x1, z0=low, z1=high)
    x, _, z = _hold(doors, door)
    cup = tube(PULL, PULL - 0.002, 0.012, axis="y", segments=24).at(x, face - 0.0008, z)
    floor = cylinder(PULL, 0.001, axis="y", segments=24).at(x, face + 0.0112, z)
    hole = cylinder(PULL, 0.05, axis="y", segments=24).at(x, face - 0.0378, z)
    fronts = doors.maker.front(doors.style, rect, face + doors.thickness)
    return (
        *(replace(body, solid=body.solid - hole) for body in fronts),
        doors.stocks["metal"].piece(cup | floor),
    )


def _framed(doors: SlidingSet, door: SlidingDoor) -> tuple[Body, ...]:
    """Grooved stiles over the full height, rails between them, fields between the rails."""
    low, high = _heights(doors)
    face, t, wide = doors.face(door.track), doors.thickness, doors.profile
    profile = doors.stocks["profile"]
    left = _stile(wide, t, high - low).at(door.x0, face, low)
    right = left.at(door.x1 - door.x0 - wide)
    inner = (door.x0 + wide, door.x1 - wide)
    count = len(door.fills)
    lines = np.linspace(low + 0.045, high - 0.03, count + 1).tolist()
    rails = [
        slab((inner[0], face + 0.002, z0), (inner[1], face + t - 0.002, z1))
        for z0, z1 in [(low, lines[0]), (lines[-1], high)]
        + [(z - 0.008, z + 0.008) for z in lines[1:-1]]
    ]
    fields = []
    for k, fill in enumerate(door.fills):
        z0 = lines[k] + (0.008 if k else 0.0)
        z1 = lines[k + 1] - (0.008 if k + 1 < count else 0.0)
        fields += _field(doors, fill, Rect(x0=inner[0], x1=inner[1], z0=z0, z1=z1), face)
    return (
        profile.piece(left, contact=(_whole(doors, door),), grain="z"),
        profile.piece(right, grain="z"),
        *(profile.piece(rail, grain="x") for rail in rails),
        *fields,
    )


def _stile(wide: float, deep: float, height: float) -> Solid:
    """An upright profile with a finger groove in its face."""
    a, b, groove = 0.34 * wide, 0.74 * wide, 0.4 * deep
    outline = [(0, 0), (a, 0), (a, groove), (b, groove), (b, 0), (wide, 0), (wide, deep), (0, deep)]
    return prism(np.asarray(outline, float), height)


def _field(doors: SlidingSet, fill: Fill, place: Rect, face: float) -> list[Body]:
    """A panel, a pane, or a mirror on its backing."""
    front, middle, rear = face + 0.005, face + 0.009, face + 0.013

    def sheet(stock: Stock, y0: float, y1: float) -> Body:
        solid = slab((place.x0, y0, place.z0), (place.x1, y1, place.z1))
        return Stock(surface=stock.surface, density=stock.density, edge=0.0).piece(solid, grain="z")

    if fill == "mirror":
        return [
            sheet(doors.stocks["mirror"], front, middle),
            sheet(doors.stocks["front"], middle, rear),
        ]
    if fill == "glass":
        return [sheet(doors.stocks["pane"], front, middle)]
    return [sheet(doors.stocks["front"], front, rear)]


def _hold(doors: SlidingSet, door: SlidingDoor) -> tuple[float, float, float]:
    """In the edge that leads, at the height of a standing person's hand or the middle."""
    low, high = _heights(doors)
    aside = 0.54 * doors.profile if door.framed else 0.05
    x = door.x0 + aside if door.way > 0.0 else door.x1 - aside
    z = min(1.05, high - 0.1) if high > 1.2 else (low + high) / 2.0
    return x, doors.face(door.track), z


def _grip(doors: SlidingSet, door: SlidingDoor, name: str) -> Grip:
    return Grip(
        name=f"{name}_pull",
        kind="edge",
        position=_hold(doors, door),
        outward=(0.0, -1.0, 0.0),
        pull=(door.way, 0.0, 0.0),
    )
