"""House doors that slide: before the wall on a rail, or into a pocket of it; to the left."""

from dataclasses import replace

from artgen.articulation.types import Body, DraftPart, Joint, Precondition
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ALUMINIUM, RUBBER, STEEL
from artgen.generators.kit.door_fittings import pull_bars
from artgen.generators.kit.door_frame import DoorFrame, skirting, wall
from artgen.generators.kit.door_leaf import pierced
from artgen.generators.kit.door_params import HARDWARE, UNDER, DoorParams, frame_free, leaf_maker
from artgen.generators.kit.flush_pull import FlushPull
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.sliding_gear import BarnGear, Pocket, hanger, slide

Made = tuple[tuple[DraftPart, ...], tuple[Joint, ...], tuple[Precondition, ...]]
IRON = Stock(surface="metal", density=STEEL, edge=0.0008)
TRACK = Stock(surface="lock", density=ALUMINIUM, edge=0.0)


def barn_door(p: DoorParams, wood: Stock, plaster: Stock) -> Made:
    """A leaf that overlaps the opening of a wall and hangs before it."""
    half = p.leaf_width / 2.0 - 0.04
    high = UNDER + p.leaf_height - frame_free(p) - 0.02
    opening = Rect(x0=-half, x1=half, z0=0.0, z1=high)
    frame = _frame(p, opening, p.depth)
    rear = -p.casing_proud - 0.012
    faces = (rear - p.leaf_thickness, rear)
    rect = Rect(x0=-half - 0.04, x1=half + 0.04, z0=UNDER, z1=UNDER + p.leaf_height)
    gear = BarnGear(
        leaf=rect, faces=faces, travel=2.0 * half - 0.02, header=(-0.020, 0.0), strap=0.20
    )
    hole = _hole(p, opening)
    left, right = gear.span
    side = (hole.x0 - left + 0.06, right - hole.x1 + 0.06)
    above = gear.top + 0.5 * p.wall_above - hole.z1
    skirts = skirting(
        hole, side=side, inset=frame_free(p) - p.lining, height=0.07, front=0.0, stock=wood
    )
    metal = replace(IRON, surface="metal")
    base = (
        wall(hole, side=side, above=above, front=0.0, back=p.depth, stock=plaster),
        *frame.bodies(wood, Stock(surface="seal", density=RUBBER)),
        *skirts,
        *gear.fixed(wood, metal, Stock(surface="seal", density=RUBBER)),
    )
    leaf = _slider(p, rect, faces, bar=True, extras=tuple(gear.straps(metal)))
    parts = (DraftPart(name="base", label="base", bodies=base), leaf, *gear.parts(metal))
    return parts, gear.joints(p.slide_friction), ()


def pocket_door(p: DoorParams, wood: Stock, plaster: Stock) -> Made:
    """A leaf in the middle of a wall that goes into a slot of it."""
    half, t = p.leaf_width / 2.0 - 0.015, p.leaf_thickness
    opening = Rect(x0=-half, x1=half, z0=0.0, z1=UNDER + p.leaf_height - 0.012)
    depth = max(p.depth, t + 0.064)
    faces = (depth / 2.0 - t / 2.0, depth / 2.0 + t / 2.0)
    rect = Rect(x0=-half - 0.027, x1=half - 0.003, z0=UNDER, z1=UNDER + p.leaf_height)
    travel, hole = 2.0 * half - 0.10, _hole(p, opening)
    pocket = Pocket(
        opening=hole,
        depth=depth,
        slot=(faces[0] - 0.006, faces[1] + 0.006),
        reach=travel + 0.04,
        beyond=(0.08, frame_free(p) - p.lining + p.wall_side),
        above=0.04 + p.wall_above,
        track=0.085 - p.lining,
    )
    side = (pocket.reach + pocket.beyond[0], pocket.beyond[1])
    skirts = skirting(
        hole, side=side, inset=frame_free(p) - p.lining, height=0.07, front=0.0, stock=wood
    )
    middle, high = depth / 2.0, hole.z1 + pocket.track - 0.004
    trolleys = [
        TRACK.piece(hanger(x, middle=middle, low=rect.z1, high=high))
        for x in (rect.x0 + 0.12, rect.x1 - 0.12)
    ]
    lining = _split_lining(p, opening, depth, faces, wood)
    trims = _frame(p, opening, depth).trims(wood)
    base = (pocket.wall(plaster), pocket.rail(TRACK), *lining, *trims, *skirts)
    leaf = _slider(p, rect, faces, bar=False, extras=tuple(trolleys))
    parts = (DraftPart(name="base", label="base", bodies=base), leaf)
    return parts, (slide(travel, p.slide_friction),), ()


def _frame(p: DoorParams, opening: Rect, depth: float) -> DoorFrame:
    return DoorFrame(
        opening=opening,
        depth=depth,
        lining=p.lining,
        stop=None,
        casing="flat" if p.casing == "square_head" else p.casing,
        casing_size=(p.casing_width, p.casing_proud),
    )


def _hole(p: DoorParams, opening: Rect) -> Rect:
    """What the lining fills of the wall."""
    t = p.lining
    return replace(opening, x0=opening.x0 - t, x1=opening.x1 + t, z1=opening.z1 + t)


def _split_lining(
    p: DoorParams, opening: Rect, depth: float, faces: tuple[float, float], wood: Stock
) -> list[Body]:
    """A whole jamb where the leaf closes; strips on both sides of the slot and under the track."""
    o, t = opening, p.lining
    near, far = faces[0] - 0.004, faces[1] + 0.004
    bodies = [wood.board((o.x1, 0.0, 0.0), (o.x1 + t, depth, o.z1))]
    for y0, y1 in ((0.0, near), (far, depth)):
        bodies.append(wood.board((o.x0 - t, y0, 0.0), (o.x0, y1, o.z1)))
        bodies.append(wood.board((o.x0 - t, y0, o.z1), (o.x1 + t, y1, o.z1 + t)))
    return bodies


def _slider(
    p: DoorParams,
    rect: Rect,
    faces: tuple[float, float],
    *,
    bar: bool,
    extras: tuple[Body, ...],
) -> DraftPart:
    """The leaf with a cup on each face, or a bar on the front and a cup on the rear."""
    bodies = leaf_maker(p).leaf(p.layout, rect, faces[0])
    x, size = rect.x1 - 0.5 * p.stile, (0.046, 0.15)
    grips = []
    pulls = [
        FlushPull(at=(x, p.handle_height), face=face, out=out, size=size, pull=-1.0)
        for face, out in zip(faces, (-1.0, 1.0), strict=True)
    ]
    for pull, name in zip(pulls, ("pull_front", "pull_rear"), strict=True):
        if bar and name == "pull_front":
            continue
        bodies = (*pierced(bodies, pull.recess()), pull.body(HARDWARE))
        grips.append(pull.grip(name))
    if bar:
        handles, taken = pull_bars(
            x, p.handle_height, length=p.pull_length, radius=0.011, faces=faces, metal=HARDWARE
        )
        bodies, grips = (*bodies, handles[0]), [replace(taken[0], pull=(-1.0, 0.0, 0.0)), *grips]
    return DraftPart(name="leaf", label="door", bodies=(*bodies, *extras), grips=tuple(grips))
