"""The two halves of a suitcase: shells with rims, linings, straps, handles, and a badge."""

from collections.abc import Mapping

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.carry_handle import CarryHandle, carry_handle
from artgen.generators.kit.clamshell import (
    HalfShell,
    corner_caps,
    crossed_straps,
    half_shell,
    mirrored_body,
    rim,
    zipped_divider,
)
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, ALUMINIUM, POLYPROPYLENE, RUBBER, ZINC
from artgen.generators.kit.door_leaf import pierced
from artgen.generators.kit.printed import plate, printed, words
from artgen.generators.kit.suitcase_params import SuitcaseParams
from artgen.generators.kit.telescope import Telescope, pocket, pocket_room

SHELL_DENSITY = {"zip": 560.0, "frame": 640.0}
"""kg/m3; the shell is drawn 3.2 mm thick where 1.6 mm of polycarbonate are enough."""
BRANDS = ("VOYANT", "ALTUR", "Nordvik", "KESTRA", "Halden", "PORTANE")
"""Invented."""
BADGE = (0.062, 0.016)
"""m."""


def stocks_of(p: SuitcaseParams) -> dict[str, Stock]:
    """What each piece is made of."""
    return {
        "shell": Stock(surface="shell", density=SHELL_DENSITY[p.closure], edge=0.0),
        "lining": Stock(surface="lining", density=260.0, edge=0.0),
        "strap": Stock(surface="strap", density=500.0, edge=0.0),
        "plastic": Stock(surface="plastic", density=ABS, edge=0.0),
        "hub": Stock(surface="hub", density=POLYPROPYLENE, edge=0.0),
        "rubber": Stock(surface="rubber", density=RUBBER, edge=0.0),
        "metal": Stock(surface="metal", density=0.5 * ZINC, edge=0.0),
        "tube": Stock(surface="tube", density=ALUMINIUM, edge=0.0),
        "frame": Stock(surface="tube", density=0.5 * ALUMINIUM, edge=0.0),
    }


def telescope_of(p: SuitcaseParams, rear: HalfShell, stocks: Mapping[str, Stock]) -> Telescope:
    """Behind the lining of the rear half, as far back as its top is flat."""
    foot = rear.low + 0.03
    room = rear.high - 0.034 - foot
    return Telescope(
        top=rear.high,
        foot=foot,
        y=rear.flat - 0.015,
        gauge=p.gauge,
        travel=round(min((p.reach - rear.high) / 2.0, 0.82 * room), 3),
        friction=p.handle_friction,
        stop=p.handle_stop,
        metal=stocks["tube"],
        plastic=stocks["plastic"],
        cloth=stocks["lining"],
    )


def _shell(p: SuitcaseParams, half: HalfShell, stocks: Mapping[str, Stock]) -> tuple[Body, ...]:
    """A lined half in a frame, by choice with corner caps; or with a zip's tape and its teeth."""
    shell = half_shell(half, stocks["shell"], stocks["lining"])
    if p.closure == "frame":
        caps = corner_caps(half, stocks["frame"]) if p.caps else ()
        return (*shell, *caps, rim(half, stocks["frame"], out=0.0018, deep=0.013))
    return (
        *shell,
        rim(half, stocks["strap"], out=0.0006, deep=0.0085),
        rim(half, stocks["hub"], out=0.0013, deep=0.0024),
    )


def rear_half(
    p: SuitcaseParams, rear: HalfShell, handle: Telescope, stocks: Mapping[str, Stock]
) -> tuple[Body, ...]:
    """The rear half with the pocket and guides of the handle, and straps over the clothes."""
    room = pocket_room(handle)
    shell = tuple(mirrored_body(body) for body in _shell(p, rear, stocks))
    cut = pierced(shell, room, clear=room)
    straps = crossed_straps(rear, 0.018, stocks["strap"], stocks["plastic"])
    return (*cut, *pocket(handle), *straps)


def front_half(
    p: SuitcaseParams, front: HalfShell, stocks: Mapping[str, Stock]
) -> tuple[Body, ...]:
    """The front half, its room closed by a zipped panel or held by straps."""
    shell = _shell(p, front, stocks)
    if p.inside == "divider":
        return (*shell, *zipped_divider(front, -0.010, stocks["lining"], stocks["hub"]))
    return (*shell, *crossed_straps(front, -0.018, stocks["strap"], stocks["plastic"]))


def carried(p: SuitcaseParams, rear: HalfShell, stocks: Mapping[str, Stock]) -> Works:
    """Handles on the top and on the right side."""
    room = rear.flat - 0.015 - 0.02
    sizes = {"length": p.handle_length, "girth": p.girth}
    share = 0.5 if p.closure == "frame" else 0.38
    places = [("top_handle", False, (0.0, 0.5 * room, rear.high))]
    if p.side_handle:
        side = (rear.width / 2.0, max(0.058, 0.5 * rear.depth), rear.low + share * rear.height)
        places.append(("side_handle", True, side))
    works = Works()
    for name, side_on, place in places:
        works += carry_handle(
            CarryHandle(
                name=name, place=place, side=side_on, strap=stocks["hub"],
                plastic=stocks["plastic"], **sizes,
            )
        )  # fmt: skip
    return works


def badge(p: SuitcaseParams, front: HalfShell) -> Body:
    """A plate with the maker's name, high on the face."""
    y = -front.depth - (1.7 if front.pattern == "framed" else 1.0) * front.rib
    low = (-BADGE[0] / 2.0, y, front.high - front.round - 0.062)
    plane = PanelPlane(origin=low, right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=BADGE)
    return plate(plane, "badge", density=ZINC, thickness=0.0022, sunk=0.0012)


def badge_surface(p: SuitcaseParams) -> SurfaceSpec:
    """Light letters on dark, or dark ones on metal."""
    name = BRANDS[p.brand % len(BRANDS)]
    dark = p.brand % 2 == 0
    back, ink = ("#1b1c1e", "#d9dadb") if dark else ("#c3c5c7", "#202124")
    mark = words((BADGE[0] / 2.0, BADGE[1] / 2.0), name, cap=0.0075, ink=ink)
    return printed("badge", BADGE, background=back, marks=[mark], roughness=0.3)
