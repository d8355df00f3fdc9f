"""Whistling kettles for the stove: domed body, spout with a flap, lid with a knob, handle."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit, Spring, Vector
from artgen.core.mesh import Floats
from artgen.generators.kit.aiming import aimed
from artgen.generators.kit.density import ABS, STEEL
from artgen.generators.kit.round_contact import round_boxes, square_box
from artgen.generators.kit.round_wall import revolved_room, revolved_shell, wall_ring
from artgen.generators.kit.swept import bent_line, swept, swept_boxes
from artgen.generators.kit.turned_knob import turned_knob
from artgen.geometry.solid import Solid, cone, cylinder, hull, revolve, slab, tube, union

WALL, REAL_WALL = 0.0016, 0.0009
"""m; the wall as drawn, and the steel sheet whose mass it has."""
NECK, PLUG, KNOB = 0.006, 0.010, (0.0165, 0.026)
"""m; height of the neck, depth of the lid in it, radius and height of its knob."""
ROUND = np.linspace(0.0, 1.0, 13)
STRAP = 0.0036
"""m; thickness of a swinging handle's arms."""


@dataclass(frozen=True, kw_only=True)
class StoveKettle:
    """Drawn with the spout towards -y.

    Attributes:
        radius: of the belly, m.
        height: of the body without its neck, m.
        mouth: radius of the neck, m.
        belly: 0 is conical, 1 is full.
        spout: radius of the spout's mouth, m.
        lean: of the spout above level, rad.
        handle: `swing` folds back, `arch` is fixed at both ends, `reach` at the rear alone.
        fold: how far a swinging handle folds, rad.
        flap: how far the flap opens, rad.
        grip: width and thickness of the handle, m.
        skin: surface of body and lid.
        crown: rise of the lid, m.
    """

    radius: float
    height: float
    mouth: float
    belly: float
    spout: float
    lean: float
    handle: str
    fold: float
    flap: float
    grip: tuple[float, float]
    skin: str
    crown: float

    @cached_property
    def profile(self) -> Floats:
        """(N, 2) points (radius, z) of the outside from the floor's edge to the neck's rim."""
        r, low, power = self.radius, 0.16 * self.height, 1.45 + 0.9 * self.belly
        foot = [(0.90 * r, 0.0), (0.93 * r, 0.002), (0.965 * r, 0.30 * low), (0.99 * r, 0.65 * low)]
        share = np.sin(ROUND * math.pi / 2.0)
        dome = [
            (self.mouth + (r - self.mouth) * (1.0 - s**power) ** (1.0 / power),
             low + (self.height - low) * s)
            for s in share[:-1]
        ]  # fmt: skip
        neck = [(self.mouth, self.height), (self.mouth, self.height + NECK)]
        return np.array([*foot, *dome, *neck])

    def surface_at(self, radius: float) -> float:
        """z of the dome above a distance from the axis, m."""
        dome = self.profile[4:][::-1]
        return float(np.interp(radius, dome[:, 0], dome[:, 1]))

    def radius_at(self, z: float) -> float:
        """Of the outside, m."""
        return float(np.interp(z, self.profile[:, 1], self.profile[:, 0]))

    @property
    def rim(self) -> float:
        """z of the neck's upper edge."""
        return self.height + NECK

    @property
    def aim(self) -> Vector:
        """Unit vector along the spout."""
        return 0.0, -math.cos(self.lean), math.sin(self.lean)

    @property
    def root(self) -> Vector:
        """Where the spout's axis leaves the body."""
        z = 0.60 * self.height
        return 0.0, -self.radius_at(z), z

    @property
    def spout_length(self) -> float:
        """From the root to the mouth, so that it ends above the body's edge, m."""
        return (self.rim + 0.004 - self.root[2]) / self.aim[2]

    def along(self, out: float, up: float = 0.0) -> Vector:
        """A place `out` along the spout's axis and `up` square to it, m."""
        (_, y, z), (_, dy, dz) = self.root, self.aim
        return 0.0, y + out * dy + up * dz, z + out * dz - up * dy

    @property
    def top(self) -> float:
        """z of the middle line of the handle's highest part."""
        return self.rim + self.crown + KNOB[1] + 0.052


def stove_works(k: StoveKettle) -> tuple[list[DraftPart], list[Joint]]:
    """Parts and joints; the body is the base."""
    bodies = [*_body(k), *_spout_fittings(k)]
    parts, joints = [_lid(k), _flap(k)], [_lid_joint(k), _flap_joint(k)]
    if k.handle == "swing":
        bodies.append(_lugs(k))
        parts.append(_bail(k))
        joints.append(_bail_joint(k))
        grips: tuple[Grip, ...] = ()
    else:
        bodies += _fixed_handle(k)
        grips = (_handle_grip(k),)
    return [DraftPart(name="base", label="base", bodies=tuple(bodies), grips=grips), *parts], joints


def _body(k: StoveKettle) -> list[Body]:
    """Shell and spout of one sheet, and the sandwich bottom."""
    density = STEEL * REAL_WALL / WALL
    room = revolved_room(k.profile, WALL)
    out, wide = k.spout_length, 1.55 * k.spout
    taper = (wide - k.spout) / out
    pipe = cone(wide + 0.03 * taper, k.spout, out + 0.03, segments=32)
    bore = cone(wide + 0.05 * taper - WALL, k.spout - WALL - 0.0004, out + 0.051, segments=32)
    pipe, bore = (
        aimed(solid, k.along(start), k.aim) for solid, start in ((pipe, -0.03), (bore, -0.05))
    )
    lip = aimed(tube(k.spout + 0.0008, k.spout - 0.0006, 0.003, segments=32),
                k.along(out - 0.003), k.aim)  # fmt: skip
    shell = ((revolved_shell(k.profile, WALL) | (pipe - room)) - bore) | lip
    split = 0.58 * k.height
    lower = [(0.0, k.radius * 0.98 - WALL, k.radius * 0.98), _level(k, 0.16 * k.height),
             _level(k, split)]  # fmt: skip
    upper = [_level(k, split), _level(k, 0.85 * k.height), (k.rim, k.mouth - WALL, k.mouth)]
    contact = (
        *wall_ring(lower, count=8, bulge=0.003), *wall_ring(upper, count=6, bulge=0.003),
        *round_boxes(0.97 * k.radius, 0.0, WALL), *_spout_contact(k),
    )  # fmt: skip
    disc = revolve(
        [(0.0, 0.0), (0.84 * k.radius, 0.0), (0.84 * k.radius, 0.0008), (0.0, 0.0008)], segments=48
    )
    return [
        Body(solid=shell, surface=k.skin, density=density, collision=contact),
        Body(solid=disc, surface="metal", density=STEEL),
    ]


def _level(k: StoveKettle, z: float) -> tuple[float, float, float]:
    r = k.radius_at(z)
    return z, r - WALL, r


def _spout_contact(k: StoveKettle) -> tuple[Solid, ...]:
    """A stair of boxes along the pipe."""
    count = 5
    boxes = []
    for j in range(count):
        out = k.spout_length * (j + 0.6) / count
        x, y, z = k.along(out)
        half = 0.72 * (1.55 + (1.0 - 1.55) * out / k.spout_length) * k.spout
        boxes.append(slab((x - half, y - half, z - half), (x + half, y + half, z + half)))
    return tuple(boxes[:-1])


def _spout_fittings(k: StoveKettle) -> list[Body]:
    """Ears for the flap's pin."""
    hinge = _flap_axis(k)
    ears = []
    for s in (-1.0, 1.0):
        a, b = sorted((s * 0.0052, s * 0.0075))
        barrel = cylinder(0.0030, b - a, axis="x", segments=16).at(a, hinge[1], hinge[2])
        foot = k.along(k.spout_length - 0.006, k.spout - 0.0005)
        post = [(x, foot[1] + dy, foot[2] + dz) for x in (a, b) for dy in (-0.003, 0.004)
                for dz in (-0.002, 0.002)]  # fmt: skip
        rings = [(x, y, z) for x in (a, b) for _, y, z in barrel.trimesh().vertices]
        ears.append(hull([*post, *rings]))
    return [Body(solid=union(ears), surface="metal", density=STEEL)]


def _flap_axis(k: StoveKettle) -> Vector:
    return k.along(k.spout_length + 0.0035, k.spout + 0.0080)


def _flap(k: StoveKettle) -> DraftPart:
    """A cup over the spout's mouth with a whistle in it, and a thumb piece behind its pin."""
    start, r = k.spout_length + 0.0010, k.spout + 0.0026
    cup = revolve(
        [(0.0, 0.0), (r, 0.0), (r, 0.0035), (r - 0.002, 0.0065), (0.45 * r, 0.0085),
         (0.45 * r, 0.0105), (0.40 * r, 0.0115), (0.0, 0.0115)], segments=32,
    )  # fmt: skip
    hole = cylinder(0.0022, 0.02, segments=12).at(z=-0.001)
    cap = aimed(cup - hole, k.along(start), k.aim)
    axis = _flap_axis(k)
    barrel = cylinder(0.0028, 0.0084, axis="x", segments=16).at(-0.0042, axis[1], axis[2])
    near, far = k.along(start + 0.0005, 0.6 * r), k.along(start + 0.0060, 0.6 * r)
    arm = hull([(x, y, z) for x in (-0.0042, 0.0042)
                for _, y, z in (near, far, *barrel.trimesh().vertices.tolist())])  # fmt: skip
    tip = k.along(k.spout_length + 0.0095, k.spout + 0.0162)
    waist = k.along(k.spout_length + 0.0060, k.spout + 0.0118)
    thumb = _bar(axis, waist, 0.0042) | _bar(waist, tip, 0.0080)
    middle = k.along(start + 0.006)
    half = 0.6 * r
    touch = slab(
        (-half, middle[1] - 0.62 * r, middle[2] - 0.1 * r), (half, middle[1], middle[2] + 0.62 * r)
    )
    bodies = (
        Body(solid=cap | arm, surface="trim", density=ABS, collision=(touch,)),
        Body(solid=thumb, surface="trim", density=ABS, edge=0.0006),
    )
    grip = Grip(name="flap_thumb_piece", kind="lever", position=tip, outward=(0.0, 0.0, 1.0),
                pull=(0.0, 1.0, 0.0))  # fmt: skip
    return DraftPart(name="flap", label="flap", bodies=bodies, grips=(grip,))


def _bar(start: Vector, end: Vector, half: float) -> Solid:
    """A flat bar `half` m to either side."""
    return hull(
        [(x, y + dy, z + dz) for x in (-half, half) for _, y, z in (start, end)
         for dy in (-0.0014, 0.0014) for dz in (-0.0014, 0.0014)]
    )  # fmt: skip


def _flap_joint(k: StoveKettle) -> Joint:
    """Turned up and back; a spring shuts it."""
    return Joint(
        name="flap_hinge", type="revolute", parent="base", child="flap", axis=(-1.0, 0.0, 0.0),
        origin=_flap_axis(k), limit=Limit(lower=0.0, upper=k.flap), friction=0.006, damping=0.0005,
        effort=0.6, spring=Spring(stiffness=0.01, reference=-0.8),
    )  # fmt: skip


def _lid(k: StoveKettle) -> DraftPart:
    low, r, inner = k.rim + 0.0008, k.mouth + 0.0055, k.mouth - WALL - 0.0012
    rise = [(0.92 * r * math.cos(a), low + 0.0030 + k.crown * math.sin(a))
            for a in np.linspace(0.0, math.pi / 2.0, 8)]  # fmt: skip
    rise[-1] = (0.0, rise[-1][1])
    outline = [(0.0, low - PLUG), (inner - 0.001, low - PLUG), (inner, low - PLUG + 0.001),
               (inner, low), (r - 0.001, low), (r, low + 0.001), (r, low + 0.0022),
               (r - 0.0008, low + 0.0030), *rise]  # fmt: skip
    hollow = cylinder(inner - 0.0018, PLUG, segments=40).at(z=low - PLUG - 0.001)
    top = low + 0.0030 + k.crown - 0.0010
    knob, contact = turned_knob(*KNOB)
    bodies = (
        Body(
            solid=revolve(outline, segments=48) - hollow, surface=k.skin, density=3200.0,
            collision=(*round_boxes(r, low, low + 0.003),
                       square_box(0.85 * inner, low - PLUG, low)),
        ),
        Body(solid=knob.at(z=top), surface="grip", density=ABS,
             collision=tuple(piece.at(z=top) for piece in contact)),
    )  # fmt: skip
    grip = Grip(name="lid_knob", kind="knob", position=(0.0, 0.0, top + 0.7 * KNOB[1]),
                outward=(0.0, 0.0, 1.0), pull=(0.0, 0.0, 1.0))  # fmt: skip
    return DraftPart(name="lid", label="lid", bodies=bodies, grips=(grip,))


def _lid_joint(k: StoveKettle) -> Joint:
    return Joint(
        name="lid_lift", type="prismatic", parent="base", child="lid", axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=0.034), friction=0.8, damping=2.0, effort=20.0, velocity=0.5,
    )  # fmt: skip


def _fixed_handle(k: StoveKettle) -> list[Body]:
    """A strap over the lid; where it is fixed at the rear alone, it ends above the spout."""
    width, thick = k.grip
    back = 0.80 * k.radius
    foot = k.surface_at(back)
    corners = [
        (back, foot - 0.002),
        (1.05 * back, 0.45 * foot + 0.55 * k.top),
        (0.66 * back, k.top),
    ]
    if k.handle == "arch":
        ahead = _front_foot(k)
        low = k.surface_at(ahead)
        corners += [(-0.62 * ahead, k.top), (-1.02 * ahead, 0.3 * low + 0.7 * k.top),
                    (-ahead, low - 0.002)]  # fmt: skip
    else:
        corners += [(-0.62 * k.radius, k.top + 0.006)]
    path = bent_line(corners, 0.045)
    bar = swept(path, width, thick, round_end=k.handle == "reach") - revolved_room(k.profile, WALL)
    contact = tuple(b for b in swept_boxes(path, width, thick) if b.bounds[0, 2] > foot - 0.004)
    feet = [(back, foot)] + (
        [(-_front_foot(k), k.surface_at(_front_foot(k)))] * (k.handle == "arch")
    )
    plates = [_shoe(y, z, width) for y, z in feet]
    return [
        Body(solid=bar, surface="grip", density=0.8 * ABS, collision=contact),
        Body(solid=union(plates) - revolved_room(k.profile, WALL), surface="metal", density=STEEL,
             edge=0.0008),
    ]  # fmt: skip


def _front_foot(k: StoveKettle) -> float:
    """Distance from the axis of an arch's front foot: between lid and spout."""
    return max(0.68 * k.radius, k.mouth + 0.022)


def _shoe(y: float, z: float, width: float) -> Solid:
    """The bracket that the strap is screwed to."""
    half = 0.5 * width + 0.0022
    return slab((-half, y - 0.014, z - 0.010), (half, y + 0.013, z + 0.011))


def _handle_grip(k: StoveKettle, pull: Vector = (0.0, 0.0, 1.0)) -> Grip:
    return Grip(name="kettle_handle", kind="handle", position=(0.0, 0.0, k.top),
                outward=(0.0, 0.0, 1.0), pull=pull)  # fmt: skip


def _pivot(k: StoveKettle) -> tuple[float, float]:
    """x and z of a swinging handle's pins."""
    x = 0.66 * k.radius
    return x, k.surface_at(x - 0.008) + 0.013


def _lugs(k: StoveKettle) -> Body:
    """Plates on the shoulder inside the arms, pierced for the pins."""
    x, z = _pivot(k)
    lugs = []
    for s in (-1.0, 1.0):
        a, b = sorted((s * (x - STRAP / 2.0 - 0.0010), s * (x - STRAP / 2.0 - 0.0045)))
        low = k.surface_at(x - 0.002) - 0.004
        plate = slab((a, -0.010, low), (b, 0.010, z))
        eye = cylinder(0.010, b - a, axis="x", segments=24).at(a, 0.0, z)
        lugs.append(
            (plate | eye) - cylinder(0.0040, 0.02, axis="x", segments=16).at(a - 0.008, 0.0, z)
        )
    solid = union(lugs) - revolved_room(k.profile, WALL)
    return Body(solid=solid, surface="metal", density=STEEL)


def _bail(k: StoveKettle) -> DraftPart:
    """Two flat arms and a sleeve between them, upright at rest."""
    (x, z), (_, thick) = _pivot(k), k.grip
    path = bent_line([(-x, z - 0.008), (-x, k.top), (x, k.top), (x, z - 0.008)], 0.55 * x)
    strap = swept(path, 0.015, STRAP).turned("z", math.pi / 2.0)
    pins = [cylinder(0.0032, 0.006, axis="x", segments=14).at(s * x - 0.003 - s * 0.0022, 0.0, z)
            for s in (-1.0, 1.0)]  # fmt: skip
    heads = [cylinder(0.0052, 0.0016, axis="x", segments=16).at(
                s * (x + STRAP / 2.0 + 0.0004) - 0.0008, 0.0, z) for s in (-1.0, 1.0)]  # fmt: skip
    flat = 0.45 * x + 0.006
    line = bent_line([(-flat, k.top), (flat, k.top)], 0.01)
    sleeve = swept(line, 0.9 * k.grip[0], thick).turned("z", math.pi / 2.0)
    arms = tuple(b.turned("z", math.pi / 2.0) for b in swept_boxes(path, 0.015, STRAP))
    middle = slab((-flat, -0.4 * k.grip[0], k.top - 0.45 * thick),
                  (flat, 0.4 * k.grip[0], k.top + 0.45 * thick))  # fmt: skip
    bodies = (
        Body(solid=union([strap, *pins, *heads]), surface="metal", density=STEEL,
             collision=tuple(_kept(b) for b in arms)),
        Body(solid=sleeve, surface="grip", density=ABS, collision=(middle,)),
    )  # fmt: skip
    return DraftPart(name="handle", label="handle", bodies=bodies,
                     grips=(_handle_grip(k, (0.0, 1.0, 0.0)),))  # fmt: skip


def _kept(box: Solid) -> Solid:
    return slab(*box.bounds)


def _bail_joint(k: StoveKettle) -> Joint:
    """Folds back, away from the spout; friction in the eyes holds it where it is put."""
    _, z = _pivot(k)
    return Joint(
        name="handle_swing", type="revolute", parent="base", child="handle", axis=(-1.0, 0.0, 0.0),
        origin=(0.0, 0.0, z), limit=Limit(lower=0.0, upper=k.fold), friction=0.28, damping=0.02,
        effort=4.0, latch=Latch(force=0.15, reach=0.1),
    )  # fmt: skip
