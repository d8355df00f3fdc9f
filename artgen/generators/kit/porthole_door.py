"""The round door of a front-loading washer: a ring with a glass bowl on a knuckle beside it."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Latch, Limit
from artgen.core.mesh import Floats
from artgen.generators.kit.density import ABS, GLASS, STEEL
from artgen.generators.kit.round_contact import round_boxes
from artgen.geometry.solid import Solid, box, cylinder, hull, revolve, slab, union

KNUCKLE = 0.0065
"""m; radius of the hinge's knuckles."""
ARM = 0.032
"""m; half the height of the door's knuckle."""
PLAY = 0.0015
"""m; between knuckles."""
ASIDE = 0.0080
"""m; from the ring to the pin's axis."""
HOOK = 0.014
PANE = 0.005
"""m; glass of the bowl."""


@dataclass(frozen=True, kw_only=True)
class PortholeDoor:
    """A closed door before the plane y = 0, hinged on its left.

    Attributes:
        center: z of its middle; x is 0.
        rim: outer radius of the ring.
        mouth: radius at which the glass begins, inner radius of the ring.
        lip: inner radius of the seal that the bowl lies in.
        thickness: of the ring.
        gap: between ring and cabinet.
        bowl: depth of the bowl behind the plane y = 0.
        covered: whether a tinted pane closes the ring in front of the bowl.
        grip: `scoop` behind the right edge, or a `bulge` on it.
    """

    center: float
    rim: float
    mouth: float
    lip: float
    thickness: float
    gap: float
    bowl: float
    covered: bool
    grip: str

    @property
    def front(self) -> float:
        """y of the outermost face."""
        return -self.gap - self.thickness

    @property
    def pin(self) -> tuple[float, float]:
        """(x, y) of the pin's axis."""
        return -self.rim - ASIDE, -self.gap - 0.45 * self.thickness

    def swing_radius(self, depth: float) -> float:
        """The largest radius of the bowl at y = depth that leaves the seal without touching."""
        x, y = -self.pin[0], -self.pin[1]
        reach = x + self.lip - 0.006
        return min(self.lip - 0.005, math.sqrt(reach**2 - (depth + y) ** 2) - x)

    @cached_property
    def bowl_outline(self) -> Floats:
        """(radius, y) of the bowl's wet side, from its flange to its middle."""
        d = self.bowl
        depths = (0.004, 0.25 * d, 0.55 * d, 0.80 * d, 0.94 * d)
        shrink = (0.0, 0.004, 0.010, 0.018, 0.032)
        wall = [(self.swing_radius(y) - s, y) for y, s in zip(depths, shrink, strict=True)]
        return np.array([*wall, (wall[-1][0] - 0.030, d), (0.0, d + 0.003)])

    def part(self, *, ring: str, glass: str, cover: str, trim: str, metal: str) -> DraftPart:
        """Ring, bowl, trim, perhaps a front pane, knuckle and hook; surfaces by name."""
        bodies = [
            Body(solid=self._set(self._ring()), surface=ring, density=0.45 * ABS,
                 collision=self._contact()),
            Body(solid=self._set(self._bowl()), surface=glass, density=GLASS),
            Body(solid=self._set(self._trim()), surface=trim, density=ABS),
            Body(solid=self._knuckle() | self._hook(), surface=metal, density=STEEL * 0.6),
        ]  # fmt: skip
        if self.covered:
            pane = cylinder(self.mouth + 0.012, 0.003, axis="y", segments=40)
            bodies.append(
                Body(solid=self._set(pane.at(y=self.front + 0.010)), surface=cover, density=1200.0)
            )
        if self.grip == "bulge":
            bodies.append(Body(solid=self._bulge(), surface=trim, density=0.5 * ABS, edge=0.002))
        return DraftPart(name="door", label="door", bodies=tuple(bodies), grips=(self._grip(),))

    def joint(self, *, upper: float, friction: float, latch: float) -> Joint:
        """The hinge; a hook holds the door shut."""
        return Joint(
            name="door_hinge", type="revolute", parent="base", child="door",
            axis=(0.0, 0.0, -1.0), origin=(*self.pin, 0.0), limit=Limit(lower=0.0, upper=upper),
            friction=friction, damping=0.2, effort=30.0, latch=Latch(force=latch, reach=0.05),
        )  # fmt: skip

    def lugs(self) -> Solid:
        """The cabinet's knuckles above and below the door's."""
        x, y = self.pin
        high = 0.012
        made = []
        for z in (self.center + ARM + PLAY, self.center - ARM - PLAY - high):
            made.append(cylinder(KNUCKLE, high, segments=16).at(x, y, z))
            made.append(slab((x - 0.004, y, z), (x + 0.004, 0.001, z + high)))
            made.append(box((0.016, 0.004, high), at=(x, -0.0005, z)))
        return union(made)

    def slot(self) -> Solid:
        """Room in the cabinet for the hook."""
        x, z, play = self.rim - 0.020, self.center, 0.0035
        return slab(
            (x - 0.0025 - play, -0.001, z - 0.008 - play),
            (x + 0.0025 + play, HOOK + play, z + 0.008 + play),
        )

    def dish(self) -> Solid:
        """Room for fingers behind the ring's right edge."""
        x, z = self.rim - 0.012, self.center
        mouth = [(u, -0.001, z + w) for u in (x - 0.016, x + 0.030) for w in (-0.055, 0.055)]
        ground = [(u, 0.018, z + w) for u in (x - 0.008, x + 0.014) for w in (-0.045, 0.045)]
        return hull(mouth + ground)

    def _set(self, solid: Solid) -> Solid:
        return solid.at(z=self.center)

    def _ring(self) -> Solid:
        """Domed towards the user, with a rounded rim."""
        f, b, r, m = self.front, -self.gap, self.rim, self.mouth
        outline = [
            (m, f + 0.012), (m + 0.006, f + 0.005), (m + 0.014, f + 0.001), (0.5 * (m + r), f),
            (r - 0.014, f + 0.003), (r - 0.005, f + 0.009), (r, f + 0.018), (r, b - 0.006),
            (r - 0.005, b), (m, b),
        ]  # fmt: skip
        return revolve(outline, axis="y", segments=44)

    def _trim(self) -> Solid:
        """A bright hoop inside the ring."""
        f, m = self.front, self.mouth
        outline = [(m - 0.003, f + 0.014), (m - 0.001, f + 0.009), (m + 0.004, f + 0.004),
                   (m + 0.0075, f + 0.0035), (m + 0.0075, f + 0.008), (m + 0.001, f + 0.020),
                   (m - 0.003, f + 0.020)]  # fmt: skip
        return revolve(outline, axis="y", segments=44)

    def _bowl(self) -> Solid:
        """A flange in the ring's back, and the bowl."""
        wet = self.bowl_outline
        flange, b = self.mouth + 0.008, -self.gap
        outer = [(0.0, b - 0.008), (flange, b - 0.008), (flange, b - 0.001), (wet[0][0], b)]
        dry = np.array(wet) - np.array([[PANE, 0.0]] * 3 + [[PANE * 0.8, 0.5 * PANE]] * 2
                                       + [[0.004, PANE], [0.0, PANE]])  # fmt: skip
        inner = [(0.0, b - 0.02), (dry[0][0] + 0.004, b - 0.02), *(tuple(p) for p in dry)]
        outside = revolve([*outer, *(tuple(p) for p in wet)], axis="y", segments=40)
        return outside - revolve(inner, axis="y", segments=40)

    def _contact(self) -> tuple[Solid, ...]:
        """Boxes for ring and bowl."""
        end = float(self.bowl_outline[-2][0])
        at = (self.center, 0.0)
        return (
            *round_boxes(self.rim - 0.001, self.front + 0.006, -self.gap, axis="y", at=at),
            *round_boxes(end, -self.gap, 0.97 * self.bowl, axis="y", at=at),
        )

    def _knuckle(self) -> Solid:
        x, y = self.pin
        z = self.center - ARM
        barrel = cylinder(KNUCKLE, 2.0 * ARM, segments=16).at(x, y, z)
        arm = slab((x, y - 0.004, z), (x + ASIDE + 0.014, y + 0.004, z + 2.0 * ARM))
        return barrel | arm

    def _hook(self) -> Solid:
        x, z = self.rim - 0.020, self.center
        arm = slab((x - 0.0025, -self.gap - 0.004, z - 0.006), (x + 0.0025, HOOK, z + 0.006))
        nose = slab((x - 0.0025, HOOK - 0.005, z - 0.008), (x + 0.0025, HOOK, z + 0.006))
        return arm | nose

    def _bulge(self) -> Solid:
        """A block on the right of the ring whose rear lip fingers pull."""
        x, z, f = self.rim, self.center, self.front
        return hull(
            [(x - 0.036, f + 0.002, z + w) for w in (-0.050, 0.050)]
            + [(x - 0.030, f - 0.010, z + w) for w in (-0.042, 0.042)]
            + [(x - 0.004, f - 0.010, z + w) for w in (-0.042, 0.042)]
            + [(x + 0.004, f + 0.016, z + w) for w in (-0.046, 0.046)]
            + [(x - 0.012, f + 0.020, z + w) for w in (-0.046, 0.046)]
        )

    def _grip(self) -> Grip:
        out = (0.0, -1.0, 0.0)
        depth = self.front - 0.005 if self.grip == "bulge" else self.front + 0.014
        place = (self.rim - 0.006, depth, self.center)
        if self.grip == "bulge":
            return Grip(name="door_handle", kind="handle", position=place, outward=out, pull=out)
        return Grip(name="door_edge", kind="edge", position=place, outward=out, pull=out)
