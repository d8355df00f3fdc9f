"""What slides and folds in a printer: cassette, output tray, carriage, rear feed cover."""

import math

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Precondition
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ABS
from artgen.generators.kit.printer_base import ROD, rod_place
from artgen.generators.kit.printer_design import GAP, PrinterParams
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import cylinder, prism, slab, union, upright

INKS = ("ink_black", "ink_cyan", "ink_magenta", "ink_yellow")
TRAY = 0.005
"""m; thickness of tray plates."""


def cassette_part(p: PrinterParams) -> DraftPart:
    """A paper drawer: pan, guides, a stack of paper, a front with a grip below."""
    z0, z1 = p.cassette[0] + GAP, p.cassette[1] - GAP
    half, y0, y1 = p.cassette_half - GAP, p.front, p.cassette_rear - 0.004
    wall, high = 0.0025, z0 + 0.62 * (z1 - z0)
    pan = [
        slab((-half, y0 + 0.008, z0), (half, y1, z0 + wall)),
        slab((-half, y0 + 0.008, z0 + wall), (-half + wall, y1, high)),
        slab((half - wall, y0 + 0.008, z0 + wall), (half, y1, high)),
        slab((-half, y1 - wall, z0 + wall), (half, y1, high)),
    ]
    front = slab((-half, y0, z0), (half, y0 + 0.012, z1))
    outline = rounded_rectangle(0.016, 0.110, 0.0075, segments=4)
    scoop = upright(prism(outline, 0.02), "y").at(0.0, y0 - 0.0125, z0 + 0.45 * (z1 - z0))
    depth = min(0.297, y1 - y0 - 0.035)
    x = p.paper_width / 2.0
    top = z0 + wall + p.stack * (high - z0 - wall)
    paper = slab((-x, y1 - 0.006 - depth, z0 + wall), (x, y1 - 0.006, top))
    guides = [
        slab(
            (s * (x + 0.0035) - 0.002, y1 - 0.12, z0 + wall),
            (s * (x + 0.0035) + 0.002, y1 - 0.05, high),
        )
        for s in (-1.0, 1.0)
    ]
    tone = "trim" if p.two_tone else "case"
    bodies = (
        *(Stock(surface="inside", density=ABS, edge=0.0).piece(s, contact=(s,)) for s in pan),
        Stock(surface=tone, density=ABS, edge=0.0012).piece(front - scoop, contact=(front,)),
        Body(solid=paper, surface="paper", density=780.0, collision=(paper,)),
        Stock(surface="trim", density=ABS, edge=0.0).piece(union(guides)),
    )
    at = (0.0, y0 + 0.004, z0 + 0.45 * (z1 - z0))
    grip = Grip(
        name="cassette_grip",
        kind="handle",
        position=at,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )
    return DraftPart(name="cassette", label="drawer", bodies=bodies, grips=(grip,))


def cassette_joint(p: PrinterParams) -> Joint:
    """Out to the user by +q."""
    return _slide("cassette_slide", "cassette", p.cassette_travel * p.depth, p.cassette_friction)


def _slide(name: str, child: str, travel: float, friction: float) -> Joint:
    return Joint(
        name=name,
        type="prismatic",
        parent="base",
        child=child,
        axis=(0.0, -1.0, 0.0),
        limit=Limit(lower=0.0, upper=travel),
        friction=friction,
        damping=6.0,
        effort=80.0,
        velocity=1.0,
    )


def folding_tray(p: PrinterParams) -> tuple[DraftPart, Joint]:
    """A flap that closes the output bay and carries the prints when it is down."""
    z0, z1 = p.output_bay[0] + GAP, p.output_bay[1] - GAP
    half, y, r = p.bay_half - GAP, p.front, 0.0040
    leaf = slab((-half, y, z0 + r), (half, y + 2.0 * r - 0.002, z1))
    foot = cylinder(r, 2.0 * half, axis="x", segments=18).at(-half, y + r, z0 + r)
    outline = rounded_rectangle(0.016, 0.060, 0.007, segments=4)
    notch = upright(prism(outline, 0.1), "y").at(0.0, y - 0.05, z1)
    box = slab((-half, y, z0 + r), (half, y + 2.0 * r - 0.002, z1 - 0.008))
    ribs = [
        slab((x - 0.001, y + 0.004, z0 + 0.012), (x + 0.001, y + 2.0 * r, z1 - 0.012))
        for x in (-0.08, -0.04, 0.0, 0.04, 0.08)
    ]
    body = Stock(surface="case", density=ABS, edge=0.0008).piece(
        union([leaf, foot, *ribs]) - notch, contact=(box,)
    )
    at = (0.0, y + 0.003, z1 - 0.009)
    grip = Grip(
        name="output_tray_notch",
        kind="edge",
        position=at,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, -1.0, 0.0),
    )
    joint = Joint(
        name="output_tray_fold",
        type="revolute",
        parent="base",
        child="output_tray",
        axis=(1.0, 0.0, 0.0),
        origin=(0.0, y + r, z0 + r),
        limit=Limit(lower=0.0, upper=math.radians(89.0)),
        friction=0.08,
        damping=0.01,
        effort=5.0,
    )
    return DraftPart(name="output_tray", label="flap", bodies=(body,), grips=(grip,)), joint


def sliding_tray(p: PrinterParams) -> tuple[list[DraftPart], list[Joint], Precondition]:
    """A plate that slides out of the bay; a stop at its front that is raised when it is out."""
    z0, half = p.output_bay[0] + GAP, p.bay_half - GAP
    y0, y1 = p.front + 0.003, p.bay_rear - 0.022
    plate = slab((-half, y0, z0), (half, y1, z0 + TRAY))
    outline = rounded_rectangle(0.05, 0.09, 0.02, segments=5)
    scoop = prism(outline, 0.1).at(0.0, y0, z0 - 0.05)
    sides = [
        slab((s, y0 + 0.026, z0 + TRAY), (s + 0.003, y1, z0 + TRAY + 0.004))
        for s in (-half, half - 0.003)
    ]
    tray = Stock(surface="trim", density=ABS, edge=0.0).piece(
        union([plate, *sides]) - scoop, contact=(plate, *sides)
    )
    at = (0.06, y0, z0 + 0.5 * TRAY)
    out = (0.0, -1.0, 0.0)
    parts = [
        DraftPart(
            name="output_tray",
            label="tray",
            bodies=(tray,),
            grips=(Grip(name="output_tray_edge", kind="edge", position=at, outward=out, pull=out),),
        ),
        _paper_stop(p, y0, z0 + TRAY),
    ]
    joints = [
        _slide("output_tray_slide", "output_tray", min(p.tray_travel, 0.8 * (y1 - y0)), 3.0),
        Joint(
            name="paper_stop_fold",
            type="revolute",
            parent="output_tray",
            child="paper_stop",
            axis=(1.0, 0.0, 0.0),
            origin=(0.0, y0 + 0.030, z0 + TRAY + 0.0032),
            limit=Limit(lower=0.0, upper=math.radians(105.0)),
            friction=0.02,
            damping=0.002,
            effort=2.0,
        ),
    ]
    rule = Precondition(
        joint="paper_stop_fold", requires="output_tray_slide", at_least=p.stop_length + 0.036
    )
    return parts, joints, rule


def _paper_stop(p: PrinterParams, y0: float, z: float) -> DraftPart:
    """A plate lying on the tray, round about its hinge in front."""
    half, r = 0.045, 0.0022
    y, up = y0 + 0.030, z + 0.0032
    leaf = slab((-half, y, up - r), (half, y + p.stop_length, up + r - 0.0008))
    barrel = cylinder(r, 2.0 * half, axis="x", segments=14).at(-half, y, up)
    body = Stock(surface="trim", density=ABS, edge=0.0).piece(
        union([leaf, barrel]), contact=(leaf,)
    )
    at = (0.0, y + p.stop_length, up)
    grip = Grip(
        name="paper_stop_edge",
        kind="edge",
        position=at,
        outward=(0.0, 0.0, 1.0),
        pull=(0.0, 0.0, 1.0),
    )
    return DraftPart(name="paper_stop", label="flap", bodies=(body,), grips=(grip,))


def carriage_part(p: PrinterParams) -> DraftPart:
    """The carriage on its rod with ink cartridges under its lid, parked at the right."""
    y, z = rod_place(p)
    x1 = p.works_half - 0.008
    x0 = x1 - (0.058 if p.cartridges == 2 else 0.078)
    low, high = p.works[0] + 0.0095, min(p.works[0] + 0.046, p.top - 0.006)
    y0 = y - 0.062
    body = slab((x0, y0, low), (x1, y + 0.010, high - 0.010))
    bore = cylinder(ROD + 0.0012, 1.0, axis="x", segments=16).at(-0.5, y, z)
    step = (x1 - x0 - 0.006) / p.cartridges
    front = slab((x0, y0, low), (x1, y - ROD - 0.002, high - 0.010))
    bodies = [
        Stock(surface="inside", density=800.0, edge=0.001).piece(body - bore, contact=(front,))
    ]
    for k, ink in enumerate(INKS[: p.cartridges]):
        a = x0 + 0.003 + k * step
        tank = slab((a + 0.0006, y0 + 0.004, high - 0.012), (a + step - 0.0006, y - 0.010, high))
        tag = slab(
            (a + 0.0016, y0 + 0.0032, high - 0.009), (a + step - 0.0016, y0 + 0.016, high + 0.0004)
        )
        bodies += [
            Stock(surface="inside", density=900.0, edge=0.0008).piece(tank, contact=(tank,)),
            Body(solid=tag, surface=ink, density=ABS),
        ]
    at = ((x0 + x1) / 2.0, y0 + 0.02, high)
    grip = Grip(
        name="carriage_top",
        kind="edge",
        position=at,
        outward=(0.0, 0.0, 1.0),
        pull=(-1.0, 0.0, 0.0),
    )
    return DraftPart(name="carriage", label="carriage", bodies=tuple(bodies), grips=(grip,))


def carriage_joint(p: PrinterParams) -> Joint:
    """To the left along the rod by +q."""
    width = 0.058 if p.cartridges == 2 else 0.078
    return Joint(
        name="carriage_slide",
        type="prismatic",
        parent="base",
        child="carriage",
        axis=(-1.0, 0.0, 0.0),
        limit=Limit(lower=0.0, upper=2.0 * p.works_half - width - 0.030),
        friction=1.5,
        damping=2.0,
        effort=30.0,
        velocity=1.0,
    )


def feed_cover(p: PrinterParams) -> tuple[DraftPart, Joint]:
    """The cover of the rear feed, which stands up as the paper's support."""
    z, thick, half = p.top + GAP, 0.005, p.bay_half + 0.010
    y0, y1 = p.rear + 0.006, p.back - 0.003
    plate = slab((-half, y0, z), (half, y1, z + thick))
    ribs = [
        slab((x - 0.002, y0 + 0.015, z - 0.001), (x + 0.002, y1 - 0.015, z))
        for x in (-0.07, 0.0, 0.07)
    ]
    body = Stock(surface="case", density=ABS, edge=0.0012).piece(
        union([plate, *ribs]), contact=(plate,)
    )
    at = (0.0, y0, z + thick)
    grip = Grip(
        name="feed_cover_edge",
        kind="edge",
        position=at,
        outward=(0.0, 0.0, 1.0),
        pull=(0.0, 0.0, 1.0),
    )
    joint = Joint(
        name="feed_cover_hinge",
        type="revolute",
        parent="base",
        child="feed_cover",
        axis=(-1.0, 0.0, 0.0),
        origin=(0.0, y1, z),
        limit=Limit(lower=0.0, upper=math.radians(100.0)),
        friction=0.04,
        damping=0.004,
        effort=3.0,
    )
    return DraftPart(name="feed_cover", label="cover", bodies=(body,), grips=(grip,)), joint
