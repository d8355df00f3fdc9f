"""The kinds of faucets, each put together from the same works."""

import math
from collections.abc import Callable, Mapping

from artgen.articulation.types import Body
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.faucet_params import FaucetParams
from artgen.generators.kit.faucet_works import (
    SEAM,
    Works,
    flange,
    lift_rod,
    metal,
    mixer,
    nut,
    post,
    pull_out_spout,
    seat,
    swivel_ring,
    swivel_spout,
    valve,
)
from artgen.generators.kit.round_contact import round_boxes
from artgen.generators.kit.spout import SpoutPath, aerator, gooseneck, slab_spout
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, revolve, slab


def basin_mixer(p: FaucetParams) -> Works:
    """A low body with a cast spout and one lever on top."""
    r, top = p.body_radius, p.body_height
    middle = top - 0.020
    nose = 0.62 * r
    cast, hull = slab_spout(
        reach=p.basin_reach,
        root=(1.5 * r, 0.030),
        tip=(1.35 * r, 0.017),
        z=(middle, middle + p.spout_rise),
        start=0.0,
    )
    foot = (0.0, -p.basin_reach + nose + 0.004, middle + p.spout_rise - 0.004)
    collar, mesh = aerator(foot, (0.0, 0.0, -1.0), 0.0112, 0.013)
    fixed = (
        *flange(max(p.flange, r + 0.006), r),
        post(r, 0.004, top),
        metal(0.0).piece(cast, contact=(hull,)),
        metal(0.0).piece(collar),
        Body(solid=mesh, surface="mesh", density=1200.0),
    )
    works = Works(fixed=fixed) + mixer(p, seat(top), r, length=p.lever_length)
    return works + lift_rod(r, 0.62 * top) if p.lift_rod else works


def kitchen_mixer(p: FaucetParams) -> Works:
    """A low spout on a sleeve that swivels about the body, one lever on top."""
    r, low = p.body_radius, 0.45 * p.body_height
    high = low + 0.042
    top, bore = high + 0.011, 0.55 * r
    z = (low + high) / 2.0
    tip = z + 0.006 + max(0.0, p.spout_rise)
    path = SpoutPath(
        corners=((-bore - 0.004, z), (-p.reach, tip), (-p.reach - 0.004, tip - 0.034)),
        bends=(0.018,),
        radius=min(p.tube, 0.0125),
    )
    ring = (swivel_ring(r, low + SEAM, high, bore + SEAM),)
    core = cylinder(bore + SEAM, 1.0, segments=32)
    fixed = (
        *flange(max(p.flange, r + 0.006), r),
        post(r, 0.004, low),
        post(bore, low, high + SEAM),
        post(r, high + SEAM, top),
    )
    spout = swivel_spout(p, path, ring, cut=core)
    return Works(fixed=fixed) + spout + mixer(p, seat(top), r, length=p.lever_length)


def arc_mixer(p: FaucetParams) -> Works:
    """A tall arc that swivels on the body, with a lever at the right and perhaps a spray head."""
    r, top = p.body_radius, p.body_height + 0.02
    barrel = 0.78 * r
    z, end = 0.55 * top, r + 0.016
    side = PanelPlane(
        origin=(end, 0.0, z), right=(0.0, -1.0, 0.0), up=(0.0, 0.0, -1.0), size=(0.1, 0.1)
    )
    arm = cylinder(barrel, end, axis="x", segments=28).at(z=z)
    pulled = p.pull_out and p.curve == "arc"
    drop = p.head + p.pull + 0.020 if pulled else p.drop
    peak = max(p.arch, 0.5 * p.reach + drop + 0.125)
    path = _neck(p, top, peak, drop=drop)
    ring = (swivel_ring(0.94 * r, top + SEAM, top + 0.016),)
    fixed = (
        *flange(max(p.flange, r + 0.006), r),
        post(r, 0.004, top),
        metal(0.001).piece(arm, contact=round_boxes(barrel, 0.0, end, axis="x", at=(0.0, z))),
    )
    spout = pull_out_spout if pulled else swivel_spout
    handle = mixer(p, side, barrel, length=0.85 * p.lever_length)
    return Works(fixed=fixed) + spout(p, path, ring) + handle


def bridge(p: FaucetParams) -> Works:
    """Two pillars with valves, a pipe between them, a swiveling spout on its middle."""
    half, z = p.centers / 2.0, 0.055 + 0.4 * p.bonnet
    top = z + 0.012 + p.bonnet
    pipe = cylinder(0.0095, 2.0 * half, axis="x", segments=20).at(-half, 0.0, z)
    fixed: list[Body] = [
        metal(0.0).piece(pipe, contact=round_boxes(0.0095, -half, half, axis="x", at=(0.0, z))),
        post(0.016, z - 0.018, z + 0.022),
    ]
    for x in (-half, half):
        fixed += [*flange(p.flange, 0.014, x=x), post(0.0135, 0.004, z + 0.012, x=x)]
        fixed.append(_bonnet(x, 0.0, z + 0.012, p.bonnet))
        fixed.append(nut(0.0150, 0.011, (x * 0.86 - 0.0055, 0.0, z), (1.0, 0.0, 0.0)))
    fixed.append(nut(0.0190, 0.010, (0.0, 0.0, z + 0.008), (0.0, 0.0, 1.0)))
    ring = (swivel_ring(0.0150, z + 0.022 + SEAM, z + 0.036),)
    spout = swivel_spout(
        p, _neck(p, z + 0.026, max(p.arch - 0.10, top + 0.11), drop=0.4 * p.drop), ring
    )
    return Works(fixed=tuple(fixed)) + spout + _pair(p, half, top)


def center_set(p: FaucetParams) -> Works:
    """Two valves and a spout on one plate; 102 mm (4 in) between the valves."""
    half, high = 0.0508, 0.013
    outline = rounded_rectangle(p.plate_width, 0.056, 0.0275, segments=8)
    plate = prism(outline, high - 0.0012).at(z=0.0012)
    gasket = prism(outline * 0.985, 0.0012)
    side = p.plate_width / 2.0 - 0.012
    contact = slab((-side, -0.022, 0.0), (side, 0.022, high))
    top = high + p.bonnet
    fixed: list[Body] = [
        Body(solid=gasket, surface="rubber", density=1150.0),
        metal(0.003).piece(plate, contact=(contact,)),
        post(0.0155, high - 0.002, high + 0.020),
        *(_bonnet(x, 0.0, high - 0.001, p.bonnet + 0.001) for x in (-half, half)),
    ]
    ring = (swivel_ring(0.0145, high + 0.020 + SEAM, high + 0.033),)
    path = _neck(p, high + 0.024, 0.56 * p.arch, reach=0.62 * p.reach, drop=0.30 * p.drop)
    spout = swivel_spout(p, path, ring)
    if p.fixed:
        fixed += [*(body for part in spout.parts for body in part.bodies)]
        spout = Works()
    return Works(fixed=tuple(fixed)) + spout + _pair(p, half, top)


def wall_mixer(p: FaucetParams) -> Works:
    """A bar on two unions that come out of the wall (150 mm, EN 817), its spout below."""
    half, z, wall, r = 0.075, 0.10, 0.062, 0.019
    long = half + 0.028
    bar = cylinder(r, 2.0 * long, axis="x", segments=28).at(-long, 0.0, z)
    fixed: list[Body] = [
        metal(0.001).piece(bar, contact=round_boxes(r, -long, long, axis="x", at=(0.0, z)))
    ]
    for x in (-half, half):
        union_ = cylinder(0.0125, wall, axis="y", segments=20).at(x, 0.0, z)
        rose = cylinder(p.flange + 0.004, 0.009, axis="y", segments=32).at(x, wall - 0.009, z)
        at = (z, x)
        fixed += [
            metal(0.0).piece(union_, contact=round_boxes(0.0125, r, wall, axis="y", at=at)),
            metal(0.002).piece(
                rose, contact=round_boxes(p.flange + 0.004, wall - 0.009, wall, axis="y", at=at)
            ),
            nut(0.0185, 0.014, (x, 0.024, z), (0.0, 1.0, 0.0)),
        ]
    nipple = z - r - 0.012
    fixed.append(post(0.0125, nipple, z))
    start = nipple - SEAM
    low = start - 0.044
    path = SpoutPath(
        corners=(
            (0.0, start - 0.012),
            (0.0, low),
            (-p.reach, low + 0.02 + max(0.0, p.spout_rise)),
            (-p.reach - 0.003, low - 0.012),
        ),
        bends=(0.021, 0.014),
        radius=0.0105,
    )
    sleeve = cylinder(0.0135, 0.014, segments=28).at(z=start - 0.014)
    ring = (metal(0.001).piece(sleeve, contact=round_boxes(0.0125, start - 0.014, start)),)
    works = Works(fixed=tuple(fixed)) + swivel_spout(p, path, ring)
    if p.wall_lever:
        return works + _top_lever(p, z, r)
    reach = long + p.bonnet
    ends = [
        PanelPlane(
            origin=(s * reach, 0.0, z), right=(0.0, s, 0.0), up=(0.0, 0.0, 1.0), size=(0.1, 0.1)
        )
        for s in (-1.0, 1.0)
    ]
    caps = tuple(_end_bonnet(s, long, z, p.bonnet) for s in (-1.0, 1.0))
    hot = valve(p, ends[0], "H", start=math.pi / 2.0, sense=1)
    return works + Works(fixed=caps) + hot + valve(p, ends[1], "C", start=math.pi / 2.0, sense=-1)


def _top_lever(p: FaucetParams, z: float, r: float) -> Works:
    """A lever on a turret in the middle of the bar."""
    wide = max(0.0205, 0.9 * p.body_radius)
    turret = post(wide, z - 0.004, z + r + 0.010)
    return Works(fixed=(turret,)) + mixer(p, seat(z + r + 0.010), wide, length=p.lever_length)


def _neck(
    p: FaucetParams, foot: float, top: float, *, drop: float, reach: float | None = None
) -> SpoutPath:
    """The tube of a swiveling spout from z = `foot`: an arc, a square one, or a swan neck."""
    over = p.reach if reach is None else reach
    radius = p.tube
    if p.curve == "square":
        nose = max(0.03, 0.35 * p.drop)
        corners = ((0.0, foot), (0.0, top), (-over, top), (-over, top - nose))
        bend = 0.55 * min(over, nose)
        return SpoutPath(corners=corners, bends=(bend, bend), radius=radius, square=p.square)
    if p.curve == "swan":
        low = top - 0.32 * over
        corners = ((0.0, foot), (0.0, top), (-0.75 * over, top - 0.02), (-over, low - 0.02))
        return SpoutPath(corners=corners, bends=(0.30 * over, 0.22 * over), radius=radius)
    outlet = max(top - over / 2.0 - drop, 0.085)
    lean = math.radians(p.lean)
    return gooseneck(foot=foot, top=top, reach=over, outlet=outlet, radius=radius, lean=lean)


def _pair(p: FaucetParams, half: float, top: float) -> Works:
    """Hot on the left, cold on the right; both open towards the user."""
    hot = valve(p, seat(top, x=-half), "H", start=math.pi, sense=1)
    return hot + valve(p, seat(top, x=half), "C", start=0.0, sense=-1)


def _bonnet_profile(height: float) -> Solid:
    profile = [(0.0, 0.0), (0.0180, 0.0), (0.0172, 0.25 * height), (0.0125, 0.60 * height),
               (0.0118, height), (0.0, height)]  # fmt: skip
    return revolve(profile, segments=28)


def _bonnet(x: float, y: float, z: float, height: float) -> Body:
    """The housing of an upright valve."""
    contact = round_boxes(0.0115, z, z + height, at=(x, y))
    return metal(0.0).piece(_bonnet_profile(height).at(x, y, z), contact=contact)


def _end_bonnet(side: float, x: float, z: float, height: float) -> Body:
    """The housing of a valve at an end of the bar."""
    laid = _bonnet_profile(height).turned("y", side * math.pi / 2.0).at(side * x, 0.0, z)
    a, b = sorted((side * x, side * (x + height)))
    return metal(0.0).piece(laid, contact=round_boxes(0.0115, a, b, axis="x", at=(0.0, z)))


KINDS: Mapping[str, Callable[[FaucetParams], Works]] = {
    "basin": basin_mixer,
    "kitchen": kitchen_mixer,
    "arc": arc_mixer,
    "bridge": bridge,
    "center_set": center_set,
    "wall": wall_mixer,
}
