"""Filled bottles and cans in rows: what stands on a shelf and is not taken off it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.articulation.types import Body, Decal
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.printed import Point, area, disc, printed, words
from artgen.geometry.solid import Solid, cylinder, revolve, slab, union

SEGMENTS = 10
PITCH_PLAY = 0.006
"""m; between neighbors."""


@dataclass(frozen=True, kw_only=True)
class Container:
    """A container of a trade size, shares of its height and radius.

    Attributes:
        radius: m.
        height: m.
        profile: (share of radius, share of height) up its side.
        label: lower and upper end of its label, shares of the height.
        cap: share of the height where the cap begins; 1 has none.
        density: effective one, filled, kg/m3.
        whole: the print covers the whole side: a can.
    """

    radius: float
    height: float
    profile: tuple[tuple[float, float], ...]
    label: tuple[float, float]
    cap: float
    density: float
    whole: bool = False


JAR = ((0.92, 0.0), (1.0, 0.04), (1.0, 0.76), (0.88, 0.84), (0.88, 1.0))
LONGNECK = ((0.90, 0.0), (1.0, 0.02), (1.0, 0.56), (0.80, 0.66), (0.48, 0.75), (0.42, 1.0))
WINE = ((0.90, 0.0), (1.0, 0.02), (1.0, 0.60), (0.86, 0.67), (0.42, 0.74), (0.38, 1.0))
PET = ((0.74, 0.0), (1.0, 0.06), (1.0, 0.70), (0.42, 0.89), (0.40, 1.0))
CAN = ((0.78, 0.0), (1.0, 0.06), (1.0, 0.90), (0.84, 0.97), (0.84, 1.0))
CONTAINERS: Mapping[str, Container] = {
    "longneck": Container(radius=0.0305, height=0.229, profile=LONGNECK, label=(0.16, 0.46),
                          cap=0.955, density=1270.0),
    "wine": Container(radius=0.0375, height=0.300, profile=WINE, label=(0.14, 0.46), cap=0.80,
                      density=1330.0),
    "pet": Container(radius=0.0325, height=0.232, profile=PET, label=(0.30, 0.55), cap=0.915,
                     density=980.0),
    "jar": Container(radius=0.0370, height=0.112, profile=JAR, label=(0.14, 0.66), cap=0.86,
                     density=1250.0),
    "can": Container(radius=0.0330, height=0.1155, profile=CAN, label=(0.07, 0.89), cap=1.0,
                     density=960.0, whole=True),
    "slim_can": Container(radius=0.0265, height=0.134, profile=CAN, label=(0.07, 0.89), cap=1.0,
                          density=970.0, whole=True),
}  # fmt: skip
"""Longneck of 0.33 l, Bordeaux bottle of 0.75 l, PET bottle of 0.5 l, cans of 0.33 and 0.25 l."""
NAMES = ("ALPINA", "Brisk", "KOLA-9", "Sundrop", "NORD", "Limo", "OAK ALE", "Fjord")


def shape(kind: str) -> Solid:
    """Standing on z = 0."""
    c = CONTAINERS[kind]
    outline = [(0.0, 0.0), *((r * c.radius, z * c.height) for r, z in c.profile), (0.0, c.height)]
    return revolve(outline, segments=SEGMENTS)


def ranks(kind: str, low: Point, high: Point, *, most: tuple[int, int]) -> list[Point]:
    """Places (x, y) of as many as fit on a shelf, front rank first, `most` (columns, ranks)."""
    pitch = 2.0 * CONTAINERS[kind].radius + PITCH_PLAY
    columns = min(most[0], int((high[0] - low[0]) / pitch))
    deep = min(most[1], int((high[1] - low[1]) / pitch))
    start = (low[0] + high[0] - pitch * (columns - 1)) / 2.0
    return [
        (start + pitch * i, low[1] + pitch * (j + 0.5)) for j in range(deep) for i in range(columns)
    ]


def stand(
    kind: str,
    places: Sequence[Point],
    z: float,
    *,
    glass: str,
    label: str,
    cap: str,
    way: float = 1.0,
) -> tuple[Body, ...]:
    """Containers of one kind on a level; each wears its print to the front (-y), or to the back
    where `way` is -1."""
    if not places:
        return ()
    c = CONTAINERS[kind]
    flesh = union([shape(kind).at(x, y, z) for x, y in places])
    contact = [_rank_box(c, [place for place in places if place[1] == y], z)
               for y in sorted({y for _, y in places})]  # fmt: skip
    bodies = [Body(solid=flesh, surface=glass, density=c.density, collision=tuple(contact))]
    low, high = (share * c.height for share in c.label)
    if c.cap < 1.0:
        top = c.profile[-1][0] * c.radius + 0.0008
        crown = cylinder(top, (1.0 - c.cap) * c.height + 0.001, segments=SEGMENTS)
        caps = union([crown.at(x, y, z + c.cap * c.height) for x, y in places])
        bodies.append(Body(solid=caps, surface=cap, density=1500.0))
    sleeve = cylinder(1.012 * c.radius, high - low, segments=SEGMENTS)
    for x, y in places:
        bodies.append(
            Body(
                solid=sleeve.at(x, y, z + low),
                surface=label,
                density=c.density,
                decal=Decal(
                    origin=(x - way * 1.02 * c.radius, y, z + low),
                    right=(way, 0.0, 0.0),
                    up=(0.0, 0.0, 1.0),
                    size=label_size(kind),
                ),
            )
        )
    return tuple(bodies)


def _rank_box(c: Container, rank: Sequence[Point], z: float) -> Solid:
    """One box of a rank of neighbors, up to where they grow narrow."""
    xs, y, half = [x for x, _ in rank], rank[0][1], 0.85 * c.radius
    low, high = (min(xs) - half, y - half, z), (max(xs) + half, y + half, z + 0.6 * c.height)
    return slab(low, high)


def label_size(kind: str) -> Point:
    """(width, height) of a label seen from the front, m."""
    c = CONTAINERS[kind]
    return 2.04 * c.radius, (c.label[1] - c.label[0]) * c.height


def label_print(name: str, kind: str, *, number: int, ground: str, ink: str) -> SurfaceSpec:
    """The print of one brand."""
    w, h = label_size(kind)
    word = NAMES[number % len(NAMES)]
    cap = min(0.30 * h, 0.62 * w / (0.75 * len(word)))
    marks = [
        area((0.0, 0.0), (w, 0.09 * h), ink=ink),
        area((0.0, 0.91 * h), (w, h), ink=ink),
        disc((w / 2.0, 0.72 * h), min(0.13 * h, 0.16 * w), ink=ink),
        words((w / 2.0, 0.36 * h), word, cap=cap, ink=ink),
        words((w / 2.0, 0.18 * h), "0.33 L", cap=0.35 * cap, ink=ink),
    ]
    return printed(name, (w, h), background=ground, marks=marks, roughness=0.3)
