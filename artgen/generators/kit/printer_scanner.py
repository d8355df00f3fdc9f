"""The scanner of a printer: a unit that opens over the print works, and its lid."""

import math

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ABS, GLASS
from artgen.generators.kit.lofted_shell import crown_steps, plan, stacked
from artgen.generators.kit.printer_base import case_stock
from artgen.generators.kit.printer_design import PrinterParams
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import hull, prism, slab, union

GLASS_SIZE = (0.302, 0.222)
"""m; A4 lying across, with a margin."""
UP = (-1.0, 0.0, 0.0)


def unit_part(p: PrinterParams) -> DraftPart:
    """The flatbed: a frame with its glass; below it ribs look into the print works."""
    z0, z1 = p.unit
    outline = plan(p.side, p.front, p.rear, (p.corner, 0.006))
    frame = prism(outline, z1 - z0).at(z=z0)
    room = slab(
        (-p.works_half, p.works_span[0], z0 - 0.01), (p.works_half, p.works_span[1], z0 + 0.012)
    )
    ribs = [
        slab(
            (x - 0.001, p.works_span[0] - 0.001, z0 + 0.004),
            (x + 0.001, p.works_span[1] + 0.001, z0 + 0.013),
        )
        for x in (-0.12, -0.04, 0.04, 0.12)
    ]
    bed = prism(rounded_rectangle(*GLASS_SIZE, 0.003, segments=2), 0.004)
    place = (0.0, glass_place(p), z1 - 0.0035)
    inset = 0.3 * p.corner
    touch = (
        slab((-p.side + inset, p.front + inset, z0 + 0.012), (p.side - inset, p.rear, z1)),
        slab((-p.side, p.front + p.corner, z0), (-p.works_half, p.rear, z0 + 0.012)),
        slab((p.works_half, p.front + p.corner, z0), (p.side, p.rear, z0 + 0.012)),
        slab((-p.works_half, p.front + inset, z0), (p.works_half, p.works_span[0], z0 + 0.012)),
    )
    mark = slab((-0.149, place[1] + 0.114, z1 - 0.001), (-0.139, place[1] + 0.1155, z1 + 0.0003))
    tone = "trim" if p.two_tone else "case"
    bodies = (
        case_stock(tone, 0.002).piece((frame - room) | union(ribs), contact=touch),
        Body(solid=bed.at(*place), surface="glass", density=GLASS),
        Body(solid=mark, surface="paper", density=ABS),
    )
    at = (0.0, p.front, z0 + 0.004)
    grip = Grip(
        name="scanner_unit_edge",
        kind="edge",
        position=at,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
    return DraftPart(name="scanner_unit", label="cover", bodies=bodies, grips=(grip,))


def glass_place(p: PrinterParams) -> float:
    """y of the glass's middle."""
    return (p.front + p.rear) / 2.0


def lid_part(p: PrinterParams) -> DraftPart:
    """The lid with its white pad; with a document feeder on it, a high one."""
    z0, z1 = p.cover
    body = stacked(
        x=p.side,
        y=(p.front, p.rear),
        radii=(p.corner, 0.006),
        steps=crown_steps(z0, z1, min(0.006, 0.5 * p.lid), steps=3),
    )
    width, depth = GLASS_SIZE[0] + 0.010, GLASS_SIZE[1] + 0.010
    y = glass_place(p)
    pad = slab(
        (-width / 2.0, y - depth / 2.0, z0 - 0.0005), (width / 2.0, y + depth / 2.0, z0 + 0.003)
    )
    inset = 0.3 * p.corner
    touch = (slab((-p.side + inset, p.front + inset, z0), (p.side - inset, p.rear, z1)),)
    notch = slab((-0.035, p.front - 0.01, z0 - 0.01), (0.035, p.front + 0.007, z0 + 0.0035))
    bodies = [
        case_stock("case", 0.0).piece(body - notch, contact=touch),
        Body(solid=pad, surface="paper", density=140.0),
    ]
    if p.feeds_documents:
        bodies += _feeder(p, z1)
    at = (0.0, p.front, z0 + 0.003)
    grip = Grip(
        name="scanner_lid_edge",
        kind="edge",
        position=at,
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
    return DraftPart(name="scanner_lid", label="lid", bodies=tuple(bodies), grips=(grip,))


def _feeder(p: PrinterParams, z: float) -> list[Body]:
    """A document feeder: its housing on the left, the sloping tray for originals on the right."""
    left, rear = -p.side + 0.020, p.rear - 0.030
    front, right = p.front + 0.050, -p.side + 0.150
    low = z - 0.001
    profile = [
        (left, low),
        (right, low),
        (right - 0.012, low + 0.040),
        (left + 0.016, low + 0.044),
        (left, low + 0.030),
    ]
    housing = hull([(x, y, h) for x, h in profile for y in (front, rear)])
    seam = slab((left + 0.02, front - 0.01, low + 0.022), (right + 0.01, rear + 0.01, low + 0.0232))
    end = p.side - 0.060
    tray = hull(
        [
            (x, y, h)
            for x, h in (
                (right - 0.02, low + 0.026),
                (end, low + 0.044),
                (end, low + 0.047),
                (right - 0.02, low + 0.030),
            )
            for y in (front + 0.012, rear - 0.012)
        ]
    )
    foot = slab((end - 0.014, front + 0.03, low), (end - 0.006, rear - 0.03, low + 0.0435))
    guides = [
        slab((right + 0.03, y, low + 0.030), (right + 0.10, y + 0.003, low + 0.052))
        for y in (front + 0.016, rear - 0.019)
    ]
    box = slab((left + 0.006, front, low), (right - 0.006, rear, low + 0.036))
    flat = slab((right - 0.01, front + 0.012, low + 0.036), (end, rear - 0.012, low + 0.040))
    return [
        case_stock("case", 0.002).piece(housing - seam, contact=(box,)),
        Stock(surface="trim", density=ABS, edge=0.0008).piece(union([tray, foot]), contact=(flat,)),
        Stock(surface="trim", density=ABS, edge=0.0006).piece(union(guides)),
    ]


def unit_joint(p: PrinterParams) -> Joint:
    """The unit's front goes up by +q; friction of its strut holds it."""
    return Joint(
        name="scanner_unit_hinge",
        type="revolute",
        parent="base",
        child="scanner_unit",
        axis=UP,
        origin=(0.0, p.rear, p.unit[0]),
        limit=Limit(lower=0.0, upper=math.radians(p.unit_deg)),
        friction=p.unit_friction,
        damping=0.4,
        effort=60.0,
    )


def lid_joint(p: PrinterParams) -> Joint:
    """The lid's front goes up by +q."""
    return Joint(
        name="scanner_lid_hinge",
        type="revolute",
        parent="scanner_unit",
        child="scanner_lid",
        axis=UP,
        origin=(0.0, p.rear, p.cover[0]),
        limit=Limit(lower=0.0, upper=math.radians(p.lid_opening)),
        friction=p.lid_friction,
        damping=0.1,
        effort=30.0,
    )
