"""The jug of an electric kettle: skirt, wall, pouring lip with its filter, handle, gauge."""

import math
from dataclasses import replace

from artgen.articulation.types import Body, Vector
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS, GLASS, POLYPROPYLENE, STAINLESS
from artgen.generators.kit.kettle_params import KettleParams
from artgen.generators.kit.power_base import SOCKET
from artgen.generators.kit.round_contact import round_boxes
from artgen.generators.kit.round_wall import wall_ring
from artgen.generators.kit.swept import bent_line, swept, swept_boxes
from artgen.generators.kit.vessel import Vessel
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, hull, prism, revolve, slab, tube, union

SLOT = (0.0115, 0.0035, 0.0225)
"""m; half width of the switch's slot in the skirt, and its lower and upper edge above it."""
COLLAR = 0.012
"""m; height of the ring around a metal or glass jug's rim."""
DENSITIES = {"steel": STAINLESS, "plastic": POLYPROPYLENE, "glass": GLASS, "retro": STAINLESS}
WALLS = {"steel": "sheet", "plastic": "molded", "glass": "glass", "retro": "painted"}
"""Surface of the wall."""
REAL_WALL = {"steel": 0.0006, "plastic": 0.0028, "glass": 0.0030, "retro": 0.0007}
"""m; what the wall's mass is that of, however thick it is drawn."""
EAR = 0.004
"""m; half height of the lid hinge's ears, and their thickness."""


def jug_bodies(p: KettleParams, wells: list[Solid]) -> list[Body]:
    """All of the jug but its printed plates; `wells` are cut out for buttons and the switch."""
    shell = DENSITIES[p.form] * REAL_WALL[p.form] / p.wall
    wall = Body(
        solid=p.jug.shell(),
        surface=WALLS[p.form],
        density=shell,
        collision=_wall_contact(p),
    )
    trim = [_skirt(p, wells), *_handle(p, wells)]
    if p.form != "plastic":
        trim.append(_collar(p))
    return [wall, *trim, *_inside(p), *_lamp(p)]


def _wall_contact(p: KettleParams) -> tuple[Solid, ...]:
    """A ring of wedges from the skirt's foot to the rim, the floor, and the lip."""
    low, top = p.jug.rings[0], p.rim - 0.0004
    mouth = p.mouth
    slope = (mouth - low.half[0]) / (p.rim - low.z)
    bow = max(r.half[0] - low.half[0] - slope * (r.z - low.z) for r in p.jug.rings)
    middle = 0.5 * (low.half[0] + mouth) + bow
    levels = [(low.z, low.half[0] - p.wall, low.half[0])]
    if bow > 0.002:
        z = 0.5 * (low.z + p.rim)
        levels.append((z, middle - bow - p.wall, middle))
    levels.append((top, mouth - p.wall, mouth))
    floor = round_boxes(p.radius - 0.002, p.ground + 0.012, p.jug.ground)
    foot = round_boxes(p.radius - 0.002, p.ground, p.ground + 0.012)[2:]
    return (*wall_ring(levels, count=8), *floor, *_around_socket(foot[0]), _lip_contact(p))


def _around_socket(foot: Solid) -> tuple[Solid, ...]:
    """Two of the four boxes around the connector's socket that carry the jug."""
    (x0, y0, z0), (x1, y1, z1) = foot.bounds.tolist()
    return (
        slab((x0, y0, z0), (-SOCKET, y1, z1)),
        slab((SOCKET, y0, z0), (x1, y1, z1)),
    )


def _lip_contact(p: KettleParams) -> Solid:
    """The beak, outside the round of the mouth."""
    low = p.jug.at_height(p.rim - 0.3 * p.height)
    r, half = p.mouth, 0.22 * p.mouth
    points = [(x, y, p.rim - 0.0004) for x, y in ((-half, -r), (half, -r), (0.0, -r - p.lip))]
    points += [(0.0, -low.half[1] - low.lip, low.z), (0.0, -low.half[1] + 0.001, low.z)]
    return hull(points)


def _skirt(p: KettleParams, wells: list[Solid]) -> Body:
    """The foot ring with the floor above it, and the socket below."""
    r, z, top = p.radius * 1.004, p.ground, p.ground + p.skirt - 0.0006
    outline = [
        (0.0, top - 0.004), (r - 0.004, top - 0.004), (r - 0.004, z), (r - 0.0015, z),
        (r, z + 0.002), (r, top - 0.001), (r - 0.001, top), (0.0, top),
    ]  # fmt: skip
    ring = tube(SOCKET + 0.002, SOCKET, p.skirt - 0.006, segments=28).at(z=z + 0.0015)
    solid = revolve(outline, segments=56) | ring
    for well in wells:
        solid = solid - well
    return Body(solid=solid, surface="trim", density=ABS)


def _collar(p: KettleParams) -> Body:
    """A ring around the rim that follows the lip."""
    low = p.rim - COLLAR
    rings = [p.jug.at_height(z) for z in (low, p.rim - 0.5 * COLLAR)] + [p.jug.mouth]
    wider = [
        type(r)(z=r.z, half=(r.half[0] + 0.0011, r.half[1] + 0.0011), lip=r.lip + 0.0004)
        for r in rings
    ]
    ring = Vessel(rings=tuple(wider), wall=p.wall + 0.0011, floor=0.0, segments=56)
    return Body(solid=ring.shell(), surface="trim", density=ABS)


def _handle(p: KettleParams, wells: list[Solid]) -> list[Body]:
    """Grip, with the ears of the lid's hinge on its root, and a softer inlay on its back."""
    path = bent_line(p.handle_path, 0.030)
    bar = swept(path, p.handle_width, p.handle_thickness, round_end=p.handle == "open")
    inside = p.jug.outside()
    solid = bar - inside
    contact = [box - inside.hull() for box in swept_boxes(path, p.handle_width, p.handle_thickness)]
    for well in wells:
        solid = solid - well
    boxes = tuple(c for c in contact if not c.is_empty and c.volume > 1e-8)
    whole = tuple(_box_of(piece) for piece in boxes)
    bodies = [Body(solid=solid, surface="trim", density=0.8 * ABS, collision=whole)]
    if p.lid != "knob":
        bodies.append(Body(solid=_ears(p), surface="trim", density=ABS))
    return bodies


def _box_of(solid: Solid) -> Solid:
    return slab(*solid.bounds)


def _ears(p: KettleParams) -> Solid:
    """Two cheeks that hold the pin of the lid's hinge."""
    y, z = p.hinge
    low = z - 0.010
    cheeks = []
    for s in (-1.0, 1.0):
        a, b = sorted((s * (ear_place(p)), s * (ear_place(p) + EAR)))
        cheek = cylinder(EAR, b - a, axis="x", segments=20).at(a, y, z)
        cheeks += [cheek, slab((a, y - EAR, low), (b, y + EAR, z))]
    return union(cheeks) - p.jug.inside()


def ear_place(p: KettleParams) -> float:
    """x of an ear's inner face."""
    return max(0.0055, 0.5 * p.handle_width - EAR - 0.0005)


def _inside(p: KettleParams) -> list[Body]:
    """The heating plate with its rim, and the filter behind the lip."""
    ground, r = p.jug.ground, p.wall_at(p.jug.ground) - p.wall
    disc = revolve(
        [(0.0, ground - 0.001), (r - 0.006, ground - 0.001), (r - 0.006, ground + 0.0012),
         (r - 0.010, ground + 0.0022), (0.0, ground + 0.0022)], segments=40,
    )  # fmt: skip
    bodies = [Body(solid=disc, surface="metal", density=STAINLESS * 0.4)]
    half, low = 0.30 * p.mouth, p.rim - 0.34 * p.height
    reach = p.mouth - p.wall
    y = -math.sqrt(reach * reach - half * half)
    frame = slab((-half, y - 0.0002, low), (half, y + 0.0012, p.rim - 0.0165))
    pane = slab((-half + 0.003, y - 0.01, low + 0.003), (half - 0.003, y + 0.01, p.rim - 0.0195))
    mesh = slab((-half + 0.003, y, low + 0.003), (half - 0.003, y + 0.0008, p.rim - 0.0195))
    bar = slab((-0.0008, y - 0.0002, low + 0.003), (0.0008, y + 0.0012, p.rim - 0.0195))
    keep = p.jug.outside()
    bodies += [
        Body(solid=(((frame - pane) | bar) & keep), surface="trim", density=ABS),
        Body(solid=mesh & keep, surface="mesh", density=STAINLESS),
    ]
    return bodies


def _lamp(p: KettleParams) -> list[Body]:
    """A lens in the skirt, beside the handle."""
    angle = math.radians(64.0)
    r, z = p.radius * 1.004, p.ground + 0.5 * p.skirt
    lens = cylinder(0.0028, 0.004, axis="x", segments=16).at(r - 0.0032, 0.0, z)
    return [Body(solid=lens.turned("z", angle), surface="lamp", density=ABS)]


def side_plane(p: KettleParams, size: tuple[float, float], low: float) -> PanelPlane:
    """A plane that touches the wall at +x, from z = `low` up."""
    width, height = size
    a, b = p.wall_at(low), p.wall_at(low + height)
    lean = math.hypot(b - a, height)
    up: Vector = ((b - a) / lean, 0.0, height / lean)
    return PanelPlane(
        origin=(a, -width / 2.0, low), right=(0.0, 1.0, 0.0), up=up, size=(width, lean)
    )


def gauge_plate(p: KettleParams) -> Body:
    """The water gauge, or a short badge where there is none, at +x; it follows the wall."""
    plane = gauge_plane(p)
    wide, tall = plane.size
    pill = rounded_rectangle(wide, tall, 0.48 * min(wide, tall), segments=5)
    column = plane.placed(prism(pill, 0.030).at(wide / 2.0, tall / 2.0, -0.015))
    proud = [
        replace(ring, half=(ring.half[0] + 0.0013, ring.half[1] + 0.0013)) for ring in p.jug.rings
    ]
    solid = column & replace(p.jug, rings=tuple(proud)).outside()
    solid = solid - p.jug.inside(more=-0.5 * p.wall)
    return Body(solid=solid, surface="gauge", density=ABS, decal=plane.decal())


def gauge_plane(p: KettleParams) -> PanelPlane:
    """Where the printed plate lies."""
    if not p.gauge:
        return side_plane(p, (0.030, 0.009), p.jug.ground + 0.006)
    tall = p.gauge_share * (p.rim - p.jug.ground) - 0.02
    return side_plane(p, (0.020, tall), p.jug.ground + 0.012)
