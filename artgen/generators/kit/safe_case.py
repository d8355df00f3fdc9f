"""The case of a safe: walls, the lip that bolts lock behind, shelves, lining, feet; its numbers."""

from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.density import RUBBER, STEEL
from artgen.geometry.profile import regular_polygon
from artgen.geometry.solid import Solid, chamfered_box, cone, prism, slab, union

AIR = 0.0005
"""m; between a hinge's knuckles and the faces."""
SHEET = 0.0015
"""m; of shelves."""
FELT = 180.0
"""Carpet, kg/m3."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """Outer walls from y = 0 (front) backwards, hinge to the side where `side` points.

    Attributes:
        half_width: outside, m.
        depth: y of the back.
        foot: z of the underside.
        top: z of the top.
        wall: thickness of sides, top, bottom and back.
        lip: y to which the front frame is thick; the door's plate lies in it.
        opening_x: half width of the opening.
        low, high: z of the opening.
        density: of the walls, kg/m3; filled ones are lighter than steel.
        corner: m, rounding.
    """

    half_width: float
    depth: float
    foot: float
    top: float
    wall: float
    lip: float
    opening_x: float
    low: float
    high: float
    density: float
    corner: float

    @property
    def inner_x(self) -> float:
        """Half width of the inside, m."""
        return self.half_width - self.wall

    @property
    def floor(self) -> float:
        """z of the inner floor."""
        return self.foot + self.wall

    @property
    def ceiling(self) -> float:
        """z of the inner ceiling."""
        return self.top - self.wall


def shell(case: Case, surface: str) -> Body:
    """Walls and lip in one piece, with boxes for them."""
    c, x = case, case.half_width
    outer = slab((-x, 0.0, c.foot), (x, c.depth, c.top))
    inside = slab((-c.inner_x, c.lip, c.floor), (c.inner_x, c.depth - c.wall, c.ceiling))
    opening = slab((-c.opening_x, -1.0, c.low), (c.opening_x, c.lip + 0.01, c.high))
    back = c.depth - c.wall
    walls = (
        slab((-x, c.lip, c.foot), (x, back, c.floor)),
        slab((-x, c.lip, c.ceiling), (x, back, c.top)),
        slab((-x, c.lip, c.floor), (-c.inner_x, back, c.ceiling)),
        slab((c.inner_x, c.lip, c.floor), (x, back, c.ceiling)),
        slab((-x, back, c.foot), (x, c.depth, c.top)),
        slab((-x, 0.0, c.foot), (x, c.lip, c.low)),
        slab((-x, 0.0, c.high), (x, c.lip, c.top)),
        slab((-x, 0.0, c.low), (-c.opening_x, c.lip, c.high)),
        slab((c.opening_x, 0.0, c.low), (x, c.lip, c.high)),
    )
    return Body(
        solid=outer - inside - opening,
        surface=surface,
        density=c.density,
        edge=c.corner,
        collision=walls,
    )


def carpet(case: Case, surface: str) -> Body:
    """The lining of the floor."""
    c = case
    solid = slab((-c.inner_x, c.lip, c.floor), (c.inner_x, c.depth - c.wall, c.floor + 0.003))
    return Body(solid=solid, surface=surface, density=FELT, collision=(solid,))


def shelves(case: Case, surface: str, *, count: int, front: float) -> list[Body]:
    """Folded sheets on four studs each, behind y = `front`, clear of what the door carries."""
    c, made = case, []
    for k in range(count):
        z = c.floor + (c.ceiling - c.floor) * (k + 1) / (count + 1)
        x, back = c.inner_x - 0.001, c.depth - c.wall - 0.001
        board = slab((-x, front, z - SHEET), (x, back, z))
        fold = slab((-x, front, z - 0.014), (x, front + SHEET, z))
        studs = [
            slab((sx * c.inner_x - 0.006, y, z - SHEET - 0.006),
                 (sx * c.inner_x + 0.006, y + 0.012, z - SHEET))
            for sx in (-1, 1)
            for y in (front + 0.03, back - 0.05)
        ]  # fmt: skip
        inside = slab((-c.inner_x, 0.0, 0.0), (c.inner_x, 5.0, 5.0))
        solid = union([board, fold, union(studs) & inside])
        made.append(Body(solid=solid, surface=surface, density=STEEL, collision=(board,)))
    return made


def anchors(case: Case, surface: str) -> Body:
    """Two hexagon bolts through the floor."""
    c, x = case, 0.45 * case.inner_x
    head = prism(regular_polygon(6, 0.0095), 0.006)
    washer = prism(regular_polygon(16, 0.013), 0.002)
    bolt = union([washer, head.at(z=0.002)]).at(0.0, 0.55 * c.depth, c.floor + 0.003)
    return Body(solid=union([bolt.at(-x), bolt.at(x)]), surface=surface, density=STEEL)


def feet(case: Case, surface: str) -> list[Body]:
    """Four rubber feet; none under a case that stands on its floor."""
    if case.foot <= 0.0:
        return []
    x, near, far = case.half_width - 0.04, 0.04, case.depth - 0.04
    made = []
    for u in (-x, x):
        for v in (near, far):
            foot = cone(0.016, 0.020, case.foot + 0.001, segments=16).at(u, v)
            touch = slab((u - 0.011, v - 0.011, 0.0), (u + 0.011, v + 0.011, case.foot))
            made.append(Body(solid=foot, surface=surface, density=RUBBER, collision=(touch,)))
    return made


def barrel_pair(
    x: float, radius: float, middle: float, *, gap: float
) -> tuple[tuple[Solid, Solid], tuple[Solid, Solid]]:
    """((knuckle of the case, its strip), (of the door, its strip)) of one hinge.

    The axis runs through (x, -radius - AIR); strips lie on the faces at y = 0, the door's beyond
    `gap` towards +x.
    """
    half, y = 0.030, -radius - AIR
    lower = cone(radius, radius, half - 0.0005, segments=18).at(x, y, middle - half)
    upper = cone(radius, radius, half - 0.0005, segments=18).at(x, y, middle + 0.0005)
    size, inner = (0.022, 0.0036, half - 0.006), 1.5 * gap + 0.0005
    strips = [
        chamfered_box(size, 0.0008).at(u, -0.0018, z)
        for u, z in ((x - 0.012, middle - half + 0.003), (x + 0.011 + inner, middle + 0.003))
    ]
    return (lower, strips[0]), (upper, strips[1])
