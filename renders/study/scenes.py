"""The three objects that the study renders: matte, glassy, metallic."""

import math
from collections.abc import Callable, Mapping
from pathlib import Path

from artgen.articulation.types import Body, Draft, DraftPart, Joint, Limit
from artgen.core.jsonio import fill_folder_atomically
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.export import Bundle, read_bundle, write_bundle
from artgen.export.layout import MANIFEST
from artgen.finish import finish
from artgen.generators import load_builder
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ABS, GLASS, STEEL
from artgen.geometry.solid import cylinder
from artgen.pipeline import Toolbox, rounded
from artgen.rules import load_rule, sample
from artgen.rules.load import rules_folder
from artgen.rules.surfaces import load_palette, surface_spec
from artgen.run_folder import RunFolder

SEED = 2026
"""Of the two objects that our rules draw."""
OAK = {"wood": "oak_natural", "drawer_box": "birch_ply", "metal": "black_metal"}
STEELS = {
    "front": "stainless_brushed",
    "side": "plastic_light_gray",
    "tub": "tub_stainless",
    "liner": "tub_stainless",
    "fascia": "stainless_brushed",
    "handle": "stainless_brushed",
}
COLD = {
    "white": "enamel_white",
    "glass": "glass_clear",
    "seal": "rubber_gray",
    "metal": "aluminium_silver",
    "bottle": "plastic_dark_gray",
    "carton": "mdf_sage",
}
"""Role to an entry of the palette."""


def cabinet() -> Draft:
    """A sideboard of matte oak with drawers and doors: fine texture, nothing mirrors."""
    return _drawn("cabinet", 1, OAK)


def dishwasher() -> Draft:
    """A dishwasher with a front and a tub of brushed steel, wire racks inside."""
    return _drawn("dishwasher", 0, STEELS)


def fridge() -> Draft:
    """A drinks cooler built here and drawn from no rule: white carcass, bottles, a glass door."""
    width, depth, height, wall = 0.55, 0.50, 0.85, 0.035
    x, back, front = width / 2.0, depth / 2.0, -depth / 2.0
    white = Stock(surface="white", density=60.0, edge=0.003)  # sheet around foam
    shelf = Stock(surface="metal", density=STEEL, edge=0.0)
    carcass = (
        white.board((-x, front, 0.0), (x, back, 0.08)),
        white.board((-x, front, height - wall), (x, back, height)),
        white.board((-x, front, 0.08), (wall - x, back, height - wall)),
        white.board((x - wall, front, 0.08), (x, back, height - wall)),
        white.board((wall - x, back - wall, 0.08), (x - wall, back, height - wall)),
    )
    shelves = tuple(
        shelf.board((wall - x, front + 0.06, z), (x - wall, back - wall, z + 0.006))
        for z in (0.33, 0.57)
    )
    door, swing = _glass_door(x=x, front=front, low=0.085, high=height)
    palette = load_palette(rules_folder())
    return Draft(
        category="fridge",
        parts=(
            DraftPart(name="base", label="base", bodies=(*carcass, *shelves, *_bottles(x - wall))),
            door,
        ),
        joints=(swing,),
        surfaces=tuple(surface_spec(role, palette[entry]) for role, entry in COLD.items()),
    )


def _glass_door(*, x: float, front: float, low: float, high: float) -> tuple[DraftPart, Joint]:
    """A frame of four rails around one pane, hinged on the left."""
    frame = Stock(surface="white", density=ABS, edge=0.002)
    pane = Stock(surface="glass", density=GLASS, edge=0.0)
    seal = Stock(surface="seal", density=1150.0, edge=0.0)
    metal = Stock(surface="metal", density=2700.0, edge=0.002)
    rail, thick, gap = 0.05, 0.03, 0.006
    near, far = front - gap - thick, front - gap
    middle = (near + far) / 2.0
    bodies = (
        frame.board((-x, near, low), (x, far, low + rail)),
        frame.board((-x, near, high - rail), (x, far, high)),
        frame.board((-x, near, low + rail), (rail - x, far, high - rail)),
        frame.board((x - rail, near, low + rail), (x, far, high - rail)),
        pane.board((rail - x, middle - 0.002, low + rail), (x - rail, middle + 0.002, high - rail)),
        seal.board((-x + 0.01, far, low + 0.01), (rail - x, far + 0.004, high - 0.01)),
        metal.board((x - 0.035, near - 0.03, 0.35), (x - 0.02, near, 0.65)),
    )
    hinge = Joint(
        name="door_hinge",
        type="revolute",
        parent="base",
        child="door",
        axis=(0.0, 0.0, -1.0),  # +q turns the right edge to the front
        origin=(-x, near, 0.0),
        limit=Limit(lower=0.0, upper=math.radians(110.0)),
        friction=1.0,
        damping=0.2,
        effort=20.0,
    )
    return DraftPart(name="door", label="door", bodies=bodies), hinge


def _bottles(x: float) -> tuple[Body, ...]:
    """Rows of bottles on every shelf, cartons between them."""
    bottle = Stock(surface="bottle", density=1000.0, edge=0.0)
    carton = Stock(surface="carton", density=1000.0, edge=0.001)
    pieces = []
    for row, z in enumerate((0.08, 0.336, 0.576)):
        for k in range(5):
            at = -x + 0.06 + k * (2.0 * x - 0.12) / 4.0
            if (k + row) % 3 == 2:
                pieces.append(carton.board((at - 0.032, -0.08, z), (at + 0.032, -0.01, z + 0.17)))
            else:
                body = cylinder(0.032, 0.13).at(at, -0.06, z)
                neck = cylinder(0.013, 0.06).at(at, -0.06, z + 0.13)
                pieces.append(bottle.piece(body | neck, contact=(body,)))
    return tuple(pieces)


SCENES: Mapping[str, Callable[[], Draft]] = {
    "matte_cabinet": cabinet,
    "glass_door_fridge": fridge,
    "brushed_steel_dishwasher": dishwasher,
}


def made_bundles(root: Path) -> dict[str, Bundle]:
    """Scene to its bundle below `root`; made where it is missing."""
    missing = [name for name in SCENES if not (root / name / MANIFEST).exists()]
    if missing:
        tools = Toolbox(RunFolder(root), "study")
        with tools.blender:
            for name in missing:
                _make(name, root / name, tools)
    return {name: read_bundle(root / name) for name in SCENES}


def _make(name: str, folder: Path, tools: Toolbox) -> None:
    obj = finish(
        SCENES[name](),
        asset_id=name,
        rounder=lambda bodies: rounded(bodies, tools),
    )
    fill_folder_atomically(
        folder,
        lambda partial: write_bundle(obj, partial, library=tools.textures, worker=tools.blender),
    )


def _drawn(category: str, index: int, looks: Mapping[str, str]) -> Draft:
    """What the rule draws, in surfaces that are chosen here."""
    builder, rule, palette = (
        load_builder(category),
        load_rule(category),
        load_palette(rules_folder()),
    )
    drawn = sample(
        rule,
        Stream(SEED, category, index),
        params_type=builder.params_type,
        invariants=builder.invariants,
    )
    chosen: dict[str, SurfaceSpec] = {
        role: surface_spec(role, palette[entry]) for role, entry in looks.items()
    }
    return builder.build(drawn.params, {**drawn.surfaces, **chosen})
