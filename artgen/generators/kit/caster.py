"""Casters: a hood or fork that swivels about an upright stem, and the wheel pair that rolls in it.

The wheel's contact pieces are cuboids inscribed in a regular polygon: on a floor it rolls as that
polygon does, and no format needs a file for it.
"""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import DraftPart, Joint, Vector
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, cylinder, prism, revolve, slab, union, upright

FIN = 0.0070
"""m; thickness of the web between the wheels."""
GAP = 0.0012
"""m; between a wheel and the web."""
PLAY = 0.0020
"""m; between the tread and the hood."""
SHELL = 0.0028
"""m; thickness of the hood."""
PIN = 0.0036
"""m; radius of the axle."""
STEM = 0.0055
"""m; radius of a stem of 11 mm."""
CUBOIDS = 3
"""Contact cuboids a wheel; their corners are those of a regular polygon of 12 sides."""


@dataclass(frozen=True, kw_only=True)
class CasterLook:
    """What a caster is made of."""

    hood: Stock
    tread: Stock
    hub: Stock
    stem: Stock


@dataclass(frozen=True, kw_only=True)
class Caster:
    """A twin-wheel caster that stands on z = 0 with its stem on the z axis, trailing to +y.

    Attributes:
        radius: of the wheels, m.
        width: over both wheels, m.
        trail: from the stem's axis to the axle's, m.
        stem: length of the stem above the shoulder that carries the load, m.
        hood: how far the hood reaches down behind, rad from upright; 0 leaves the wheels bare.
    """

    radius: float
    width: float
    trail: float
    stem: float
    hood: float = 1.6

    @property
    def shoulder(self) -> float:
        """Height of the shoulder that carries the load, m."""
        return self._boss_low + 0.013

    @property
    def _cover(self) -> float:
        """Outer radius of the hood, m."""
        return self.radius + PLAY + SHELL

    @property
    def _boss_low(self) -> float:
        """Where the hood's outside meets the far side of the stem, m."""
        return self.radius + math.sqrt(self._cover**2 - (self.trail - STEM) ** 2) - SHELL

    @property
    def _boss_clear(self) -> float:
        """Where a cuboid in the boss clears the corners of the wheel's contact pieces, m."""
        reach = self._contact_reach + 0.001
        return max(self._boss_low, self.radius + math.sqrt(reach**2 - (self.trail - 0.009) ** 2))

    @property
    def _contact_reach(self) -> float:
        """Radius of the polygon's corners, m."""
        return self.radius / math.cos(math.pi / (4 * CUBOIDS))

    def swivel_part(self, name: str, place: Floats, look: CasterLook) -> DraftPart:
        """Hood, web and stem; `place` is (4, 4) `object_from_caster`, a quarter turn about z."""
        boss = slab((-0.009, -0.009, self._boss_clear), (0.009, 0.009, self.shoulder))
        hood = look.hood.piece(self._hood().transformed(place), contact=(boss.transformed(place),))
        length = self.stem + self.shoulder - self._boss_low
        stem = cylinder(STEM, length, segments=8).at(z=self._boss_low).transformed(place)
        return DraftPart(name=name, label="caster", bodies=(hood, look.stem.piece(stem)))

    def wheel_part(self, name: str, place: Floats, look: CasterLook) -> DraftPart:
        """Both wheels on their axle."""
        axle = cylinder(PIN, FIN + 4.0 * GAP, axis="x", segments=8).at(-FIN / 2.0 - 2.0 * GAP)
        center = self._to_axle(place)
        contact = tuple(piece.transformed(center) for piece in self._contact())
        treads = union([axle, self._treads()]).transformed(center)
        bodies = (
            look.tread.piece(treads, contact=contact),
            look.hub.piece(self._caps().transformed(center)),
        )
        return DraftPart(name=name, label="wheel", bodies=bodies)

    def joints(self, caster: str, wheel: str, place: Floats, *, parent: str) -> tuple[Joint, Joint]:
        """The swivel about the stem and the wheels' rolling; both without end."""
        axle = self._to_axle(place)[:3, 3]
        x, y, _ = place[:3, 0]
        return (
            _endless(f"{caster}_swivel", parent, caster, (0.0, 0.0, 1.0), place[:3, 3], 0.02),
            _endless(f"{wheel}_roll", caster, wheel, (float(x), float(y), 0.0), axle, 0.004),
        )

    def _to_axle(self, place: Floats) -> Floats:
        shift = np.eye(4)
        shift[:3, 3] = (0.0, self.trail, self.radius)
        return np.asarray(place @ shift)

    def _hood(self) -> Solid:
        """A curved cover over the tread, the web below it, and the boss about the stem."""
        inner, outer = self.radius + PLAY, self._cover
        front, back = math.pi / 2.0 + 1.15, math.pi / 2.0 - max(self.hood, 0.1)
        rim = np.concatenate(
            [arc((0.0, 0.0), outer, back, front, 6), arc((0.0, 0.0), inner, front, back, 6)]
        )
        cover = upright(prism(rim, self.width), "x").at(-self.width / 2.0)
        web = prism(
            np.concatenate([arc((0.0, 0.0), outer - 0.0005, back, front, 6), arc((0.0, 0.0), 0.010,
                            front + 0.9, back - 0.5 + 2.0 * math.pi, 6)]), FIN
        )  # fmt: skip
        hole = cylinder(PIN + 0.0008, 1.0, axis="x", segments=8).at(-0.5)
        body = union([cover, upright(web, "x").at(-FIN / 2.0)]) - hole
        body = body.at(0.0, self.trail, self.radius)
        boss = cylinder(0.0125, self.shoulder - self._boss_low, segments=8).at(z=self._boss_low)
        return union([body, boss])

    def _treads(self) -> Solid:
        """Both wheels with their rounded treads."""
        w, r = self._tread, self.radius
        ease = 0.16 * w
        outline = [(0.0, 0.0), (r, 0.0), (r, w - ease), (r - ease, w), (0.0, w)]
        disc = revolve(outline, axis="x", segments=16).at(FIN / 2.0 + GAP)
        return union([disc, disc.mirrored("x")])

    def _caps(self) -> Solid:
        """The domed discs that close the wheels outside."""
        w, r = self._tread, 0.78 * self.radius
        outline = [(0.0, w), (r, w), (0.92 * r, w + 0.0012), (0.0, w + 0.0006)]
        cap = revolve(outline, axis="x", segments=14).at(FIN / 2.0 + GAP)
        return union([cap, cap.mirrored("x")])

    @property
    def _tread(self) -> float:
        return (self.width - FIN) / 2.0 - GAP

    def _contact(self) -> list[Solid]:
        """Cuboids whose corners lie on a regular polygon that touches the floor with a side."""
        step = math.pi / (4 * CUBOIDS)
        reach, half = self._contact_reach, self.width / 2.0
        turns = [step * (2 * k + 1) for k in range(CUBOIDS)]
        corners = [(half, reach * math.cos(a), reach * math.sin(a)) for a in turns]
        return [slab([-c for c in corner], corner) for corner in corners]


def _endless(
    name: str, parent: str, child: str, axis: Vector, origin: Floats, friction: float
) -> Joint:
    x, y, z = (float(c) for c in origin)
    return Joint(
        name=name,
        type="continuous",
        parent=parent,
        child=child,
        axis=axis,
        origin=(x, y, z),
        limit=None,
        friction=friction,
        damping=0.1 * friction,
        effort=60.0 * friction,
        velocity=10.0,
    )


def quarter_placed(at: Vector, quarters: int) -> Floats:
    """(4, 4) pose at a point of the floor, turned exactly by quarters about z."""
    cos, sin = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarters % 4]
    pose = np.eye(4)
    pose[:2, :2] = ((cos, -sin), (sin, cos))
    pose[:3, 3] = at
    return pose
