"""Beverage refrigerators: glass doors before lit shelves of bottles and cans."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Latch, Precondition
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit import cold_fittings as fittings
from artgen.generators.kit.beverage_design import (
    COVER,
    MOST_SLIDING,
    BeverageParams,
    mullion_carries_gaskets,
    rails_hold_gasket,
)
from artgen.generators.kit.bottles import label_print, ranks, stand
from artgen.generators.kit.flat_shelf import FlatShelf
from artgen.generators.kit.lined_cavity import LinedCavity

PARAMS = BeverageParams
INKS = (("#b3161c", "#fbf7ee"), ("#0e4c92", "#f2f4f6"), ("#f1e6c8", "#2b2119"),
        ("#0f6b3c", "#f6f1dc"), ("#1a1b1e", "#d9b45a"), ("#e58a13", "#fff8ea"),
        ("#f5f5f2", "#b3161c"))  # fmt: skip
"""Ground and ink of labels."""


def build(p: BeverageParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the doors are shut; shelves slide out behind an open door."""
    base = _base_bodies(p)
    doors: list[DraftPart] = []
    shelves: list[DraftPart] = []
    hinges: list[Joint] = []
    slides: list[Joint] = []
    rules: list[Precondition] = []
    for number, (leaf, (_, room)) in enumerate(zip(p.leaves, p.rooms, strict=True)):
        base += leaf.hinge_plates("metal")
        works = p.glazed(leaf)
        doors.append(DraftPart(name=leaf.name, label="door", bodies=works.bodies(),
                               grips=(works.works.grip(),)))  # fmt: skip
        latch = Latch(force=p.latch, reach=0.05)
        hinges.append(leaf.swing(upper=p.upper(leaf), friction=p.friction, latch=latch))
        base += _room_bodies(p, room, number)
        for k, shelf in enumerate(p.shelves(room)):
            base += shelf.ledges((room.low[0], room.high[0]), "liner")
            bodies = (*shelf.bodies("plate", "trim_wire"), *_stock(p, room, shelf, k, number))
            if not p.slides or len(slides) >= MOST_SLIDING:
                base += bodies
                continue
            name = f"shelf_{number * 10 + k + 1}"
            shelves.append(DraftPart(name=name, label="shelf", bodies=bodies,
                                     grips=(shelf.grip(name),)))  # fmt: skip
            slides.append(shelf.joint(name, travel=p.travel * (shelf.back - shelf.front),
                                      friction=p.slide_friction))  # fmt: skip
            rules.append(Precondition(joint=slides[-1].name, requires=hinges[-1].name,
                                      at_least=p.clear_at(leaf)))  # fmt: skip
    knobs, turns = _knobs(p)
    parts = [DraftPart(name="base", label="base", bodies=tuple(base)), *doors, *shelves, *knobs]
    worn = {body.surface for part in parts for body in part.bodies}
    specs = (*matched(p, surfaces).values(), *_prints(p))
    return Draft(
        category="beverage_refrigerator",
        parts=tuple(parts),
        joints=(*hinges, *slides, *turns),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
        preconditions=tuple(rules),
    )


def matched(p: BeverageParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """Surfaces by role: frames under a printed border are black, wire shelves have no plate."""
    looks = dict(surfaces)
    if p.frame == "black_glass":
        looks["frame"] = replace(surfaces["trim"], name="frame", color=(0.006, 0.006, 0.007))
    source = {"wire": "trim_wire", "slats": "wood", "glass": "pane"}[p.shelf]
    looks["plate"] = replace(surfaces[source], name="plate")
    if p.shelf == "glass":
        looks["trim_wire"] = replace(surfaces["shelf_trim"], name="trim_wire")
    return looks


def _base_bodies(p: BeverageParams) -> list[Body]:
    """Case, compressor, feet, grille, coil, sign."""
    c = p.case
    bodies = [
        *c.bodies(p.rooms, shell="shell", liner="liner"),
        *c.compressor(metal="works", mass=p.compressor),
        *c.feet("rubber", radius=0.018),
        *c.grille("grille", bars=p.bars, upright_bars=p.upright_bars),
    ]
    if p.coil:
        bodies += c.coil("works", legs=8)
    if p.has_canopy:
        bodies += fittings.sign_box(c.half, _sign_span(p), p.leaves[0].front, "shell")
    return bodies


def _sign_span(p: BeverageParams) -> tuple[float, float]:
    return p.door_span[1] + 0.010, p.case.top


def _room_bodies(p: BeverageParams, room: LinedCavity, number: int) -> list[Body]:
    """Control bar, light, cover, and what stands on the floor before the step."""
    bodies = [
        fittings.control_bar(room, "trim"),
        *fittings.light(room, p.led),
        fittings.evaporator_cover(room, "cover", bottom=p.case.step[1], thickness=COVER),
    ]
    if number == 0 and p.control == "digital":
        bodies.append(fittings.screen(room))
    if number == 0 and p.control == "dial":
        bodies.append(fittings.thermostat_face(room, fittings.thermostat()))
        bodies[0] = replace(bodies[0], solid=bodies[0].solid - fittings.bar_plane(
            room, fittings.DIAL_FACE).placed(fittings.thermostat().hole()))  # fmt: skip
    return bodies


def _stock(
    p: BeverageParams, room: LinedCavity, shelf: FlatShelf, k: int, number: int
) -> tuple[Body, ...]:
    """Containers on one shelf."""
    kind = p.kind_on(room, k, number)
    if kind == "none":
        return ()
    low, high = (shelf.left + 0.010, shelf.front + 0.012), (shelf.right - 0.010, shelf.back - 0.01)
    places = ranks(kind, low, high, most=p.ranks_on(k + number))
    glass = "can" if kind in ("can", "slim_can") else "bottle"
    return stand(kind, places, shelf.top + 0.0003, glass=glass, label=f"label_{kind}", cap="cap")


def _knobs(p: BeverageParams) -> tuple[list[DraftPart], list[Joint]]:
    """The thermostat's knob."""
    if p.control != "dial":
        return [], []
    dial, plane = fittings.thermostat(), fittings.bar_plane(p.rooms[0][1], fittings.DIAL_FACE)
    return [dial.part(plane, "knob", "mark", density=900.0)], [dial.joint(plane, parent="base")]


def _prints(p: BeverageParams) -> list[SurfaceSpec]:
    """Labels, sign, scale or display."""
    kinds = sorted({kind for kind in (*p.stock, "can") if kind != "none"})
    made = []
    for k, kind in enumerate(kinds):
        ground, ink = INKS[p.label_colors[k % len(p.label_colors)] % len(INKS)]
        made.append(label_print(f"label_{kind}", kind, number=p.label + k, ground=ground, ink=ink))
    if p.has_canopy:
        size = fittings.sign_plane(p.case.half, _sign_span(p), 0.0).size
        made.append(fittings.sign_print(p.sign, size, p.label))
    made.append(fittings.screen_print(p.temperature, "white"))
    made.append(fittings.thermostat_print(fittings.thermostat()))
    return made


INVARIANTS: Mapping[str, Callable[[BeverageParams], bool]] = {
    check.__name__: check for check in (rails_hold_gasket, mullion_carries_gaskets)
}
