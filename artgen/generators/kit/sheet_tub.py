"""Open boxes folded from sheet: the five panels of a tub, or of a lid turned upside down."""

from artgen.articulation.types import Body
from artgen.generators.kit.density import STEEL
from artgen.geometry.solid import Solid, slab, union

WALL = 0.002
"""m; sheet as drawn; its density is scaled to the real one."""


def panels(size: tuple[float, float, float], at: float, *, down: bool = False) -> tuple[Solid, ...]:
    """Boxes of an open tub of outer `size`, its floor (its top, if it looks `down`) at z = `at`."""
    x, y, h = size[0] / 2.0, size[1] / 2.0, size[2]
    low, high = (at - h, at) if down else (at, at + h)
    flat = (high - WALL, high) if down else (low, low + WALL)
    side = (low, high - WALL) if down else (low + WALL, high)
    return (
        slab((-x, -y, flat[0]), (x, y, flat[1])),
        slab((-x, -y, side[0]), (x, -y + WALL, side[1])),
        slab((-x, y - WALL, side[0]), (x, y, side[1])),
        slab((-x, -y + WALL, side[0]), (-x + WALL, y - WALL, side[1])),
        slab((x - WALL, -y + WALL, side[0]), (x, y - WALL, side[1])),
    )


def folded(
    walls: tuple[Solid, ...], more: list[Solid], *, surface: str, sheet: float, edge: float
) -> Body:
    """Walls and what is pressed out of them in one piece of `sheet` m steel; touched as boxes."""
    return Body(
        solid=union([*walls, *more]),
        surface=surface,
        density=STEEL * sheet / WALL,
        edge=edge,
        collision=walls,
    )
