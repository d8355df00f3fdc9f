"""The door of a dishwasher: liner, dispenser, outer panel, controls, handle."""

from artgen.articulation.types import Body, DraftPart, Grip
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.appliance_handle import bar_handle, grip_groove, pocket_room
from artgen.generators.kit.control_console import (
    ConsoleStyle,
    PanelPlane,
    console_controls,
    printed,
)
from artgen.generators.kit.density import (
    ABS,
    ALUMINIUM,
    POLYPROPYLENE,
    RUBBER,
    STAINLESS,
    STEEL,
)
from artgen.generators.kit.dishwasher_layout import DishwasherParams, Layout
from artgen.generators.kit.drop_door import (
    DropDoor,
    detergent_dispenser,
    inner_body,
    pins,
    wrapped_panel,
)
from artgen.generators.kit.gasket import lip_seal
from artgen.geometry.solid import Solid, slab, union

DOOR_SHEET = 0.0006
"""m; steel of the outer panel."""
LINER_SHEET = 0.0005
LIGHT_BOARD = 500.0
"""kg/m3; furniture fronts for dishwashers are of light MDF: their hinges carry 2.5 to 8 kg."""
INSIDES = 3.4
"""kg/m2; sheet frame, insulation, wiring and latch between liner and panel."""
SPARE_INSIDES = 2.2
"""kg/m2; where a furniture front takes the outer frame's place."""
DISH = 0.011
"""m; depth of the liner's dish."""
RETURN = 0.002
"""m; thickness as drawn of the outer sheet where it wraps around the door's sides."""
SEAM = 0.0016
"""m; open joint between control panel and door panel."""
CAP = 0.014
"""m; height of the strip of hidden controls on the door's upper edge."""
GROOVE = 0.026
"""m; height of a grip groove."""
WORDS = ("1:25", "3:40", "0:49", "2:15", "3:05")


def door(
    p: DishwasherParams, at: Layout, surfaces: dict[str, SurfaceSpec]
) -> tuple[DraftPart, tuple[SurfaceSpec, ...]]:
    """(part, surfaces that it makes itself)."""
    d = at.door
    cuts, fittings = _handle(p, at)
    liner_top = d.top - (CAP if p.hidden_console else 0.0)
    dish = (at.tub.half_width - 0.040, at.track + 0.045, at.tub.ceiling - 0.045)
    narrowed = 0.0 if p.has_furniture_panel else RETURN
    inner = inner_body(d, top=liner_top, dish=dish, depth=DISH, narrowed=narrowed)
    liner = _less(inner, cuts)
    panel = _panel(p, at, cuts)
    console, own = _console(p, at, surfaces, cuts)
    bodies = (
        Body(
            solid=liner,
            surface="liner",
            density=_liner_density(p, d, liner.volume),
            collision=(slab((-d.half_width, d.seam, d.bottom), (d.half_width, d.inner, d.top)),),
        ),
        panel,
        *console,
        *fittings,
        *_inside(p, at, dish),
    )
    return DraftPart(name="door", label="door", bodies=bodies, grips=(_hold(p, at),)), own


def _hold(p: DishwasherParams, at: Layout) -> Grip:
    """The middle of the bar, or the edge that fingers hook under in a pocket or groove."""
    out, below, y = (0.0, -1.0, 0.0), at.fascia_bottom, at.door.outer
    if p.handle in ("bar", "flat_bar"):
        place = (0.0, y - 0.030 - p.handle_size / 2.0, below - 0.060)
        return Grip(name="door_handle", kind="handle", position=place, outward=out, pull=out)
    place = (0.0, y, below - (0.018 if p.handle == "pocket" else 0.0))
    return Grip(name="door_handle", kind="edge", position=place, outward=out, pull=out)


def _less(solid: Solid, cuts: tuple[Solid, ...]) -> Solid:
    for cut in cuts:
        solid = solid - cut
    return solid


def _liner_density(p: DishwasherParams, d: DropDoor, volume: float) -> float:
    """kg/m3 that gives the solid liner the mass of sheet and insides."""
    area = 2.0 * d.half_width * (d.top - d.bottom)
    insides = SPARE_INSIDES if p.has_furniture_panel else INSIDES
    return area * (STAINLESS * LINER_SHEET + insides) / volume


def _panel(p: DishwasherParams, at: Layout, cuts: tuple[Solid, ...]) -> Body:
    """The outer panel below the controls: formed sheet, or a furniture front."""
    d = at.door
    top = at.fascia_bottom - (0.0 if p.hidden_console else SEAM)
    if p.has_furniture_panel:
        solid = slab((-d.half_width, d.outer, d.skin_bottom), (d.half_width, d.seam, top))
    else:
        solid = wrapped_panel(
            d, top=top, returns=d.top - (CAP if p.hidden_console else 0.0), sheet=RETURN, edge=0.012
        )
    collision = slab((-d.half_width, d.outer, d.skin_bottom), (d.half_width, d.seam, d.top))
    furniture = p.has_furniture_panel
    return Body(
        solid=_less(solid, cuts),
        surface="panel" if furniture else "front",
        density=LIGHT_BOARD if furniture else STEEL * DOOR_SHEET / d.skin,
        edge=0.0012 if furniture else 0.0026,
        collision=(collision,),
        grain="z",
    )


def _console(
    p: DishwasherParams, at: Layout, surfaces: dict[str, SurfaceSpec], cuts: tuple[Solid, ...]
) -> tuple[tuple[Body, ...], tuple[SurfaceSpec, ...]]:
    """Fascia with its controls, on the front or on the door's upper edge."""
    d, style = at.door, _style(p)
    if p.hidden_console:
        low, high = (-d.half_width, d.seam, d.top - CAP), (d.half_width, d.inner, d.top)
        corner, up = (-d.half_width, d.seam, d.top), (0.0, 1.0, 0.0)
        size = (2.0 * d.half_width, d.inner - d.seam)
    else:
        low = (-d.half_width, d.outer, at.fascia_bottom)
        high = (d.half_width, d.seam, d.top)
        corner, up = low, (0.0, 0.0, 1.0)
        size = (2.0 * d.half_width, d.top - at.fascia_bottom)
    plane = PanelPlane(origin=corner, right=(1.0, 0.0, 0.0), up=up, size=size)
    face = printed(surfaces["fascia"], style, size)
    fascia = Body(
        solid=_less(slab(low, high), cuts),
        surface=face.name,
        density=0.35 * ABS,  # molded shell with boards behind
        edge=0.0018,
        decal=plane.decal(),
    )
    controls, own = console_controls(plane, style, trim=surfaces["trim"])
    return (fascia, *controls), (face, *own)


def _style(p: DishwasherParams) -> ConsoleStyle:
    knob = p.console == "knob" and not p.hidden_console
    return ConsoleStyle(
        style="knob" if knob else ("touch" if p.console == "touch" else "buttons"),
        buttons=min(p.buttons, 5) if p.slim else p.buttons,
        display=p.display,
        brand=p.brand,
        words=WORDS[p.program % len(WORDS)],
        led=p.led,
    )


def _handle(p: DishwasherParams, at: Layout) -> tuple[tuple[Solid, ...], tuple[Body, ...]]:
    """(room cut out of the door, bodies) of the handle, just below the controls."""
    d = at.door
    half, below = p.handle_share * d.half_width, at.fascia_bottom
    if p.handle in ("bar", "flat_bar"):
        solid = bar_handle(
            half_length=half,
            y=d.outer,
            z=below - 0.060,
            stand=0.030,
            thickness=p.handle_size,
            flat=p.handle == "flat_bar",
        )
        low, high = solid.bounds
        return (), (
            Body(
                solid=solid,
                surface="handle",
                density=0.45 * ALUMINIUM,  # drawn tube
                edge=0.0010 if p.handle == "flat_bar" else 0.0,
                collision=(slab(low, (high[0], d.outer - 0.030, high[2])),),
            ),
        )
    if p.handle == "pocket":
        room, cup = pocket_room(
            half_length=0.62 * half,
            y=d.outer,
            low=below - 0.068,
            high=below - 0.018,
            depth=d.skin + 0.014,
            wall=0.0022,
        )
        return (room,), (Body(solid=cup, surface="trim", density=ABS),)
    groove = grip_groove(
        half_length=d.half_width + 0.01,
        y=d.outer,
        low=below - GROOVE,
        high=below,
        depth=0.8 * d.skin + 0.012,
    )
    return (groove,), ()


def _inside(p: DishwasherParams, at: Layout, dish: tuple[float, float, float]) -> tuple[Body, ...]:
    """Dispenser, pins and the lip seal at the lower edge."""
    d = at.door
    ground, middle = d.inner - DISH, 0.5 * (dish[1] + dish[2])
    tray, lid, latch, cap, bar = detergent_dispenser(y=ground, x=-0.03, z=middle + 0.03, depth=DISH)
    seal = lip_seal(
        half_length=at.tub.half_width - 0.004, y=d.inner, z=at.track + 0.004, thickness=0.0014
    )
    return (
        Body(solid=tray, surface="arm", density=POLYPROPYLENE, edge=0.0012),
        Body(solid=union([lid, bar]), surface="rack_plastic", density=POLYPROPYLENE, edge=0.0007),
        Body(solid=union([latch, cap]), surface="trim", density=POLYPROPYLENE, edge=0.0006),
        Body(solid=union(pins(d)), surface="metal", density=STEEL),
        Body(solid=seal, surface="seal", density=RUBBER),
    )
