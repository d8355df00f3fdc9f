"""Toolboxes: latches free a lid on a piano hinge; a tray lifts out from below it."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from artgen.articulation.types import (
    Body,
    Draft,
    DraftPart,
    Grip,
    Joint,
    Limit,
    Precondition,
)  # fmt: skip
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.case_handle import CaseHandle
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import POLYPROPYLENE, STEEL
from artgen.generators.kit.draw_latch import DrawLatch
from artgen.generators.kit.piano_hinge import piano_hinge
from artgen.generators.kit.printed import plate, printed, words
from artgen.generators.kit.sheet_tub import WALL, folded, panels
from artgen.geometry.solid import slab

SEAM, PIN = 0.0012, 0.0035
"""m; air between the halves, radius of the hinge's knuckles."""
BRANDS = ("HARDT", "Norwick", "TORVAL", "Brecht & Son", "IRONA")
"""Invented; none is a maker of tools known to us."""


@dataclass(frozen=True, kw_only=True)
class ToolboxParams:
    """What the rule draws; fields are the keys of [sample]."""

    width: float
    depth: float
    height: float
    lid: float
    sheet: float
    edge: float
    opening_deg: float
    knuckles: int
    latches: int
    latch_width: float
    handle: str
    grip_length: float
    rod: float
    has_tray: bool
    tray_depth: float
    dividers: int
    ribs: int
    brand: int
    drag: float


PARAMS = ToolboxParams


def build(p: ToolboxParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the lid is shut and latched, the handle lies down; +q opens, lifts and takes out."""
    handle = CaseHandle(top=p.height + SEAM + p.lid, length=p.grip_length, rod=p.rod)
    latches = latches_of(p)
    lower, upper = piano_hinge(
        length=0.9 * p.width, y=p.depth / 2.0 + PIN, z=p.height + SEAM / 2.0, radius=PIN,
        knuckles=p.knuckles | 1, leaf=0.016,
    )  # fmt: skip
    badge, print_ = brand_plate(p)
    hinge = [Body(solid=leaf, surface="metal", density=STEEL) for leaf in (lower, upper)]
    brackets = [latch.bracket("metal") for latch in latches]
    parts = [
        DraftPart(name="base", label="base", bodies=(tub(p), hinge[0], badge, *brackets)),
        lid(p, handle, [hinge[1], *(latch.catch("metal") for latch in latches)]),
        *(latch.part("metal") for latch in latches),
    ]
    joints = [lid_joint(p), *(latch.joint(parent="base") for latch in latches)]
    rules = [
        Precondition(joint="lid_hinge", requires=f"{latch.name}_flip", at_least=1.0)
        for latch in latches
    ]
    if p.handle == "folding":
        parts.append(handle.part("metal", "grip"))
        joints.append(handle.joint(parent="lid"))
    if p.has_tray:
        parts.append(tray(p))
        joints.append(tray_joint(p))
        wide = math.radians(p.opening_deg) - 0.05
        rules.append(Precondition(joint="tray_lift", requires="lid_hinge", at_least=wide))
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="toolbox", parts=tuple(parts), joints=tuple(joints), preconditions=tuple(rules),
        surfaces=tuple(s for s in (*surfaces.values(), print_) if s.name in worn),
    )  # fmt: skip


def latches_of(p: ToolboxParams) -> list[DrawLatch]:
    """One in the middle of the front, or two."""
    places = (0.0,) if p.latches == 1 else (-0.3 * p.width, 0.3 * p.width)
    return [
        DrawLatch(
            name=f"latch_{k + 1}", x=x, face=-p.depth / 2.0, seam=p.height + SEAM,
            width=p.latch_width,
        )
        for k, x in enumerate(places)
    ]  # fmt: skip


def tub(p: ToolboxParams) -> Body:
    """The lower half, with ledges for the tray."""
    x, y, z = p.width / 2.0 - WALL, p.depth / 2.0 - WALL, p.height - p.tray_depth - 0.004
    ledge = slab((x - 0.006, -y, z - 0.004), (x, y, z - 0.002))
    more = [ledge, ledge.mirrored("x")] if p.has_tray else []
    walls = panels((p.width, p.depth, p.height), 0.0)
    return folded(walls, more, surface="shell", sheet=p.sheet, edge=p.edge)


def brand_plate(p: ToolboxParams) -> tuple[Body, SurfaceSpec]:
    """The maker's name on the front, below a single latch or between two."""
    size = (0.085, 0.020)
    plane = PanelPlane(
        origin=(-size[0] / 2.0, -p.depth / 2.0, 0.32 * p.height - size[1] / 2.0),
        right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=size,
    )  # fmt: skip
    name = words((size[0] / 2.0, size[1] / 2.0), BRANDS[p.brand], cap=0.009, ink="#f2f2ee")
    surface = printed("badge", size, background="#1b1c1e", marks=[name])
    return plate(plane, surface.name, density=POLYPROPYLENE, thickness=0.0008), surface


def lid(p: ToolboxParams, handle: CaseHandle, fittings: list[Body]) -> DraftPart:
    """The upper half: ribs, saddles and, if it does not fold, the handle."""
    top, front = p.height + SEAM + p.lid, -p.depth / 2.0
    lines = [front + p.depth * (k + 1) / (p.ribs + 1) for k in range(p.ribs)]
    ribs = [
        slab((-0.42 * p.width, y - 0.004, top - 0.0005), (0.42 * p.width, y + 0.004, top + 0.0012))
        for y in lines
        if not -0.065 < y < 0.02  # Clear of the handle.
    ]
    walls = panels((p.width, p.depth, p.lid), top, down=True)
    fixed = p.handle == "arch"
    bodies = [folded(walls, ribs, surface="shell", sheet=p.sheet, edge=p.edge), *fittings]
    bodies += handle.saddles("metal", fixed=fixed)
    edge = Grip(
        name="lid_edge", kind="edge", position=(0.12 * p.width, front, top - 0.6 * p.lid),
        outward=(0.0, -1.0, 0.0), pull=(0.0, 0.0, 1.0),
    )  # fmt: skip
    if not fixed:
        return DraftPart(name="lid", label="lid", bodies=tuple(bodies), grips=(edge,))
    bodies += handle.bodies("metal", "grip", upright=True)
    return DraftPart(
        name="lid", label="lid", bodies=tuple(bodies), grips=(edge, handle.grip(upright=True))
    )


def lid_joint(p: ToolboxParams) -> Joint:
    """The piano hinge."""
    return Joint(
        name="lid_hinge", type="revolute", parent="base", child="lid",
        axis=(-1.0, 0.0, 0.0),  # +q lifts the front edge (front is -y)
        origin=(0.0, p.depth / 2.0 + PIN, p.height + SEAM / 2.0),
        limit=Limit(lower=0.0, upper=math.radians(p.opening_deg)),
        friction=p.drag, damping=0.05, effort=20.0,
    )  # fmt: skip


def tray(p: ToolboxParams) -> DraftPart:
    """An open tray with dividers on the ledges, and a bow to lift it by."""
    floor = p.height - p.tray_depth - 0.003
    size = (p.width - 2.0 * WALL - 0.003, p.depth - 2.0 * WALL - 0.004, p.tray_depth - 0.004)
    walls = tuple(wall.at(z=floor) for wall in panels(size, 0.0))
    y, half = size[1] / 2.0, size[0] / 2.0
    places = (-half + 2.0 * half * (k + 1) / (p.dividers + 1) for k in range(p.dividers))
    low, high = floor + 0.001, floor + 0.8 * size[2]
    split = [slab((x - 0.0007, -y + 0.001, low), (x + 0.0007, y - 0.001, high)) for x in places]
    body = folded(walls, split, surface="tray", sheet=p.sheet, edge=0.0008)
    rim = Grip(
        name="tray_rim", kind="rim", position=(0.0, -y + 0.001, floor + size[2]),
        outward=(0.0, 0.0, 1.0), pull=(0.0, 0.0, 1.0),
    )  # fmt: skip
    return DraftPart(name="tray", label="tray", bodies=(body,), grips=(rim,))


def tray_joint(p: ToolboxParams) -> Joint:
    """Up and out, as far as its own depth."""
    return Joint(
        name="tray_lift", type="prismatic", parent="base", child="tray", axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=0.8 * p.tray_depth), friction=16.0, damping=4.0, effort=60.0,
    )  # fmt: skip


def tray_fits(p: ToolboxParams) -> bool:
    """Half of the tub is left below the tray."""
    return not p.has_tray or p.tray_depth < 0.45 * p.height


def handle_fits(p: ToolboxParams) -> bool:
    """The handle folds down before the front edge, its saddles stand on the lid."""
    return p.depth / 2.0 > 0.060 and p.grip_length + 0.09 < p.width


INVARIANTS: Mapping[str, Callable[[ToolboxParams], bool]] = {
    check.__name__: check for check in (tray_fits, handle_fits)
}
