"""Storage furniture: wardrobes, desks, dressers, sideboards, hutches, bookcases, secretaries."""

from collections.abc import Callable, Mapping

from artgen.articulation.types import Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.cabinet_movers import Works
from artgen.generators.kit.furniture_make import MILLED, MOVERS, clears_gaps
from artgen.generators.kit.storage_block import Block
from artgen.generators.kit.storage_chest import (
    display_blocks,
    display_works,
    dresser_blocks,
    dresser_works,
    sideboard_blocks,
    sideboard_works,
)
from artgen.generators.kit.storage_desk import desk_blocks, desk_works, knees
from artgen.generators.kit.storage_params import StorageParams
from artgen.generators.kit.storage_secretary import flap_of, secretary_blocks, secretary_works
from artgen.generators.kit.storage_wardrobe import sliding_blocks, wardrobe_blocks, wardrobe_works

PARAMS = StorageParams

Blocks = Callable[[StorageParams], tuple[Block, ...]]
Furnish = Callable[[StorageParams, tuple[Block, ...]], Works]

KINDS: Mapping[str, tuple[Blocks, Furnish]] = {
    "wardrobe": (wardrobe_blocks, wardrobe_works),
    "sliding_wardrobe": (sliding_blocks, wardrobe_works),
    "desk": (desk_blocks, desk_works),
    "dresser": (dresser_blocks, dresser_works),
    "sideboard": (sideboard_blocks, sideboard_works),
    "hutch": (display_blocks, display_works),
    "bookcase": (display_blocks, display_works),
    "secretary": (secretary_blocks, secretary_works),
}
"""How each kind is divided into cases and cells, and what else belongs to it."""
ON_LEGS = ("dresser", "sideboard", "secretary")
LEGS = ("round_legs", "square_legs", "hairpin", "frame")


def build(p: StorageParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """One piece: cases side by side or on each other, with all that slides and turns in them."""
    blocks, furnish = KINDS[p.kind]
    works = furnish(p, blocks(p))
    base = DraftPart(name="base", label="base", bodies=works.base)
    parts = (base, *works.parts)
    used = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="storage_furniture",
        parts=parts,
        joints=works.joints,
        surfaces=tuple(spec for role, spec in surfaces.items() if role in used),
        preconditions=works.preconditions,
    )


def stand_suits_kind(p: StorageParams) -> bool:
    """Heavy pieces stand on plinths; only low ones stand on legs."""
    return p.stand in ("plinth", "panel") or p.kind in ON_LEGS


def fronts_suit_kind(p: StorageParams) -> bool:
    """Grips milled into an edge need plain fronts; glass stands over closed doors only."""
    if p.grip in MILLED and (p.style != "slab" or p.kind == "secretary"):
        return False
    if p.style == "louvred" and p.kind == "wardrobe" and p.width > 1.2:
        return False  # Some 45 slats a door make large files.
    return p.style != "glass" or p.kind in ("hutch", "bookcase")


def fronts_are_usable(p: StorageParams) -> bool:
    """Drawers hold something and doors are neither slits nor barn doors."""
    for one in KINDS[p.kind][0](p):
        for cell in one.cells:
            o, kind = cell.opening, cell.leaf.kind
            if kind == "drawer" and not (0.09 <= o.height <= 0.40 and 0.2 <= o.width <= 1.15):
                return False
            wide = o.width / 2.0 if kind == "pair" else o.width
            hinged = kind in ("pair", "door_left", "door_right")
            if hinged and not (0.21 <= wide <= 0.62 and o.height >= 0.2):
                return False
    return True


def few_moving_parts(p: StorageParams) -> bool:
    """At most nine."""
    cells = [cell for one in KINDS[p.kind][0](p) for cell in one.cells]
    extra = 2 if p.kind == "secretary" else 1
    return 1 <= extra + sum(MOVERS[c.leaf.kind] + c.leaf.inner for c in cells) <= 9


def doors_clear_their_gaps(p: StorageParams) -> bool:
    """In every case."""
    return all(clears_gaps(p, one.cells) for one in KINDS[p.kind][0](p))


def knees_have_room(p: StorageParams) -> bool:
    """0.5 m for a chair; ISO 5970 and EN 527-1 ask for more at an office desk."""
    return p.kind != "desk" or knees(p).width > 0.5


def stays_fit(p: StorageParams) -> bool:
    """The stays of a flap lie folded within the case, below the flap's upper edge."""
    if p.kind != "secretary":
        return True
    one = secretary_blocks(p)[0]
    cell = next(cell for cell in one.cells if cell.leaf.kind == "flap")
    flap = flap_of(p, one.design, cell.opening)
    deep = one.design.case.rear - flap.hinge[0]
    return flap.reach < deep and cell.opening.height > 0.28 and p.flap_arm < 0.24


INVARIANTS: Mapping[str, Callable[[StorageParams], bool]] = {
    "stand_suits_kind": stand_suits_kind,
    "fronts_suit_kind": fronts_suit_kind,
    "few_moving_parts": few_moving_parts,
    "fronts_are_usable": fronts_are_usable,
    "doors_clear_their_gaps": doors_clear_their_gaps,
    "knees_have_room": knees_have_room,
    "stays_fit": stays_fit,
}
