"""What faucets are put together from: look, flange, valves, swiveling spouts, spray heads."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit, Vector
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.aiming import aimed
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.faucet_params import FaucetParams
from artgen.generators.kit.mixer_handle import MixerHandle
from artgen.generators.kit.round_contact import round_boxes, square_box
from artgen.generators.kit.spout import SpoutPath, aerator
from artgen.generators.kit.valve_handle import ValveHandle
from artgen.geometry.profile import regular_polygon
from artgen.geometry.solid import Solid, cone, cylinder, prism, revolve, slab, tube, union

CAST = 3900.0
"""kg/m3; brass 8400 with the waterways and chambers that are not modelled."""
SEAM = 0.0010
"""m; between what is fixed and what swivels on it."""


@dataclass(frozen=True, kw_only=True)
class Works:
    """Pieces of a faucet: fixed bodies, moving parts, their joints, surfaces only they wear."""

    fixed: tuple[Body, ...] = ()
    parts: tuple[DraftPart, ...] = ()
    joints: tuple[Joint, ...] = ()
    surfaces: tuple[SurfaceSpec, ...] = ()

    def __add__(self, other: "Works") -> "Works":
        return Works(
            fixed=self.fixed + other.fixed,
            parts=self.parts + other.parts,
            joints=self.joints + other.joints,
            surfaces=self.surfaces + other.surfaces,
        )


def metal(edge: float = 0.0008) -> Stock:
    """The body's finish."""
    return Stock(surface="metal", density=CAST, edge=edge)


def trim(edge: float = 0.0006) -> Stock:
    """The handles' finish."""
    return Stock(surface="trim", density=CAST, edge=edge)


def seat(z: float, *, x: float = 0.0, y: float = 0.0) -> PanelPlane:
    """A round seat that looks up; its frame is the object's."""
    return PanelPlane(origin=(x, y, z), right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=(0.1, 0.1))


def flange(radius: float, bore: float, *, x: float = 0.0, y: float = 0.0) -> tuple[Body, ...]:
    """A gasket and an escutcheon on the deck around a body of radius `bore`."""
    gasket = cylinder(radius - 0.001, 0.0012, segments=28).at(x, y)
    profile = [(0.0, 0.0012), (radius, 0.0012), (radius, 0.0034), (0.5 * (radius + bore), 0.0062),
               (bore, 0.0074), (0.0, 0.0074)]  # fmt: skip
    ring = revolve(profile, segments=32).at(x, y)
    return (
        Body(solid=gasket, surface="rubber", density=1150.0),
        metal(0.0).piece(ring, contact=round_boxes(radius, 0.0, 0.0034, at=(x, y))),
    )


def post(radius: float, low: float, high: float, *, x: float = 0.0, y: float = 0.0) -> Body:
    """An upright round piece of the body."""
    solid = cylinder(radius, high - low, segments=32).at(x, y, low)
    return metal(0.0010).piece(solid, contact=round_boxes(radius, low, high, at=(x, y)))


def nut(radius: float, height: float, at: Vector, axis: Vector) -> Body:
    """A hexagon around a pipe."""
    return metal(0.0006).piece(aimed(prism(regular_polygon(6, radius), height), at, axis))


def mixer(p: FaucetParams, plane: PanelPlane, radius: float, *, length: float) -> Works:
    """A single lever on a seat."""
    handle = MixerHandle(
        name="lever",
        radius=radius,
        height=max(p.cap, 1.32 * radius),
        length=length,
        rise=math.radians(p.lever_rise),
        style=p.lever,
        swing=math.radians(p.swing),
        lift=math.radians(p.lift),
    )
    parts = handle.parts(plane, metal(), trim(), ("hot_mark", "cold_mark"))
    return Works(parts=parts, joints=handle.joints(plane, parent="base"))


def valve(p: FaucetParams, plane: PanelPlane, letter: str, *, start: float, sense: int) -> Works:
    """A handle on a seat."""
    name = {"H": "hot_handle", "C": "cold_handle"}[letter]
    size = 1.35 * p.valve_size if p.valve == "lever" else p.valve_size
    turn = 90.0 if p.valve == "lever" else p.valve_turn
    handle = ValveHandle(
        name=name,
        letter=letter,
        size=size,
        height=p.valve_height,
        style=p.valve,
        turn=math.radians(turn),
        sense=sense,
        start=start,
    )
    index = handle.index(f"{name}_index")
    part = handle.part(plane, trim(), metal(0.0), index.name)
    joint = handle.joint(plane, parent="base")
    return Works(parts=(part,), joints=(joint,), surfaces=(index,))


def swivel_spout(
    p: FaucetParams, path: SpoutPath, ring: tuple[Body, ...], *, cut: Solid | None = None
) -> Works:
    """A spout that turns about the upright axis through zero, with its aerator."""
    collar, mesh = aerator(path.end, path.aim, path.radius + 0.0012, 0.013)
    collar = _drawn_back(collar, path.aim, 0.0065)
    mesh = _drawn_back(mesh, path.aim, 0.0065)
    pipe = path.solid() if cut is None else path.solid() - cut
    bodies = (
        *ring,
        metal(0.0012 if path.square else 0.0).piece(pipe, contact=path.contact()),
        metal(0.0).piece(collar),
        Body(solid=mesh, surface="mesh", density=1200.0),
    )
    return Works(parts=(_spout_part(bodies, path),), joints=(swivel_joint(p),))


def _drawn_back(solid: Solid, aim: tuple[float, float, float], by: float) -> Solid:
    return solid.at(*(-by * a for a in aim))


def _spout_part(bodies: tuple[Body, ...], path: SpoutPath) -> DraftPart:
    x, y, z = _moved(path.end, path.aim, -0.035)
    grip = Grip(
        name="spout_grip",
        kind="handle",
        position=(x, y - path.radius, z),
        outward=(0.0, -1.0, 0.0),
        pull=(1.0, 0.0, 0.0),
    )
    return DraftPart(name="spout", label="spout", bodies=bodies, grips=(grip,))


def swivel_joint(p: FaucetParams) -> Joint:
    """Turns both ways alike."""
    reach = math.radians(p.swivel)
    return Joint(
        name="spout_swivel",
        type="revolute",
        parent="base",
        child="spout",
        axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=-reach, upper=reach),
        friction=p.swivel_friction,
        damping=0.05,
        effort=10.0,
    )


def swivel_ring(radius: float, low: float, high: float, bore: float = 0.0) -> Body:
    """The foot of a swiveling spout, around a post if it has a bore."""
    if bore <= 0.0:
        profile = [(0.0, low), (radius, low), (radius, 0.6 * low + 0.4 * high),
                   (0.75 * radius, high), (0.0, high)]  # fmt: skip
        return metal(0.0).piece(
            revolve(profile, segments=32), contact=round_boxes(0.9 * radius, low, high)
        )
    sleeve = tube(radius, bore, high - low, segments=32).at(z=low)
    a, b, c = bore + 0.0002, 0.92 * radius, 0.5 * radius
    walls = (
        slab((-c, -b, low), (c, -a, high)),
        slab((-c, a, low), (c, b, high)),
        slab((-b, -c, low), (-a, c, high)),
        slab((a, -c, low), (b, c, high)),
    )
    return metal(0.0010).piece(sleeve, contact=walls)


def pull_out_spout(p: FaucetParams, path: SpoutPath, ring: tuple[Body, ...]) -> Works:
    """A swiveling spout whose end is a spray head on a hose."""
    (a, b), (c, d) = path.corners[-2:]
    leg = math.hypot(c - a, d - b) - path.bends[-1] * math.tan(0.5 * _last_turn(path)) - p.head
    travel = min(p.pull, leg - 0.018)
    aim = path.aim
    start = tuple(e - (p.head + SEAM) * w for e, w in zip(path.end, aim, strict=True))
    pipe_path = replace(path, corners=(*path.corners[:-1], (start[1], start[2])))
    bore = aimed(cylinder(0.0072, leg + 0.004, segments=14), _moved(start, aim, 0.004), _minus(aim))
    body = metal(0.0).piece(pipe_path.solid() - bore, contact=pipe_path.contact())
    spout = _spout_part((*ring, body), pipe_path)
    head = _spray_head(p, path.radius, _moved(start, aim, SEAM), aim, hose=travel + 0.012)
    joint = Joint(
        name="spray_head_pull",
        type="prismatic",
        parent="spout",
        child="spray_head",
        axis=aim,
        limit=Limit(lower=0.0, upper=travel),
        friction=6.0,
        damping=3.0,
        effort=60.0,
        velocity=1.0,
        latch=Latch(force=8.0, reach=0.008),
    )
    return Works(parts=(spout, head), joints=(swivel_joint(p), joint))


def _last_turn(path: SpoutPath) -> float:
    """Angle between the last two legs, rad."""
    a, b, c = (np.array(corner) for corner in path.corners[-3:])
    into, out = (b - a) / np.linalg.norm(b - a), (c - b) / np.linalg.norm(c - b)
    return float(np.arccos(np.clip(into @ out, -1.0, 1.0)))


def _moved(at: tuple[float, ...], aim: tuple[float, ...], by: float) -> tuple[float, float, float]:
    x, y, z = (a + by * w for a, w in zip(at, aim, strict=True))
    return x, y, z


def _minus(aim: tuple[float, float, float]) -> tuple[float, float, float]:
    return -aim[0] + 0.0, -aim[1] + 0.0, -aim[2] + 0.0


def _spray_head(
    p: FaucetParams,
    radius: float,
    at: tuple[float, float, float],
    aim: tuple[float, float, float],
    *,
    hose: float,
) -> DraftPart:
    """A head that widens to its nozzles, a switch on its front, the hose behind it."""
    wide, size = radius + 0.0040, p.head
    profile = [(0.0, 0.0), (radius, 0.0), (radius, 0.25 * size), (wide, 0.8 * size), (wide, size),
               (wide - 0.002, size), (wide - 0.002, size - 0.002), (0.0, size - 0.002)]  # fmt: skip
    shell = aimed(revolve(profile, segments=28), at, aim)
    nozzles = union(
        [
            cylinder(0.0013, 0.0026, segments=8).at(r * math.cos(t), r * math.sin(t), size - 0.003)
            for r, n in ((0.45 * wide, 6), (0.72 * wide, 10))
            for t in (2.0 * math.pi * np.arange(n) / n).tolist()
        ]
    )
    switch = slab((-0.005, 0.6 * radius, 0.42 * size), (0.005, wide + 0.0022, 0.72 * size))
    line = cylinder(0.0052, hose, segments=12).at(z=-hose)
    half = 0.70 * radius
    touch = slab((-half, -half, 0.0), (half, half, size))
    bodies = (
        metal(0.0).piece(shell, contact=(aimed(touch, at, aim),)),
        Body(solid=aimed(line, at, aim), surface="hose", density=1600.0),
        Body(solid=aimed(nozzles, at, aim), surface="mesh", density=1100.0),
        Body(solid=aimed(switch, at, aim), surface="mesh", density=1100.0, edge=0.0008),
    )
    grip = Grip(name="spray_head_grip", kind="handle", position=_moved(at, aim, 0.5 * size),
                outward=(0.0, -1.0, 0.0), pull=aim)  # fmt: skip
    return DraftPart(name="spray_head", label="head", bodies=bodies, grips=(grip,))


def lift_rod(radius: float, height: float) -> Works:
    """The rod behind a basin mixer that works the waste: an ear on the body, a rod in it."""
    y = radius + 0.012
    ear = union(
        [
            cylinder(0.0075, 0.016, segments=16).at(0.0, y, 0.0),
            slab((-0.0075, 0.5 * radius, 0.0), (0.0075, y, 0.016)),
        ]
    ).at(z=0.004)
    low = 0.004 + 0.016
    hole = cylinder(0.0036, 1.0, segments=12).at(0.0, y, 0.012)
    rod = union(
        [
            cylinder(0.0025, height - 0.014, segments=10).at(0.0, y, 0.014),
            cone(0.0046, 0.0062, 0.007, segments=16).at(0.0, y, height - 0.006),
            cone(0.0062, 0.0030, 0.004, segments=16).at(0.0, y, height + 0.001),
        ]
    )
    contact = (
        square_box(0.0025, low + SEAM, height - 0.006, at=(0.0, y)),
        square_box(0.0062, height - 0.006, height + 0.004, at=(0.0, y)),
    )
    up = (0.0, 0.0, 1.0)
    grip = Grip(name="lift_rod_knob", kind="knob", position=(0.0, y, height), outward=up, pull=up)
    slot = slab((-0.0006, y - 0.01, height + 0.0040), (0.0014, y + 0.01, height + 0.01))
    bar = metal(0.0).piece(rod - slot, contact=contact)
    part = DraftPart(name="lift_rod", label="knob", bodies=(bar,), grips=(grip,))
    joint = Joint(
        name="lift_rod_slide",
        type="prismatic",
        parent="base",
        child="lift_rod",
        axis=up,
        limit=Limit(lower=0.0, upper=0.028),
        friction=2.0,
        damping=2.0,
        effort=30.0,
        velocity=0.5,
    )
    box = slab((-0.0075, 0.9 * radius, 0.004), (0.0075, y + 0.005, low))
    return Works(fixed=(metal().piece(ear - hole, contact=(box,)),), parts=(part,), joints=(joint,))


def used(surfaces: Mapping[str, SurfaceSpec], works: Works) -> tuple[SurfaceSpec, ...]:
    """Surfaces that a body wears."""
    bodies = [*works.fixed, *(body for part in works.parts for body in part.bodies)]
    worn = {body.surface for body in bodies}
    return tuple(s for s in (*surfaces.values(), *works.surfaces) if s.name in worn)
