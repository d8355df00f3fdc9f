"""What is set into the skin of a refrigerator's door: ice and water dispenser, panel, badge."""

from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.cold_leaf import ColdLeaf
from artgen.generators.kit.density import ABS
from artgen.generators.kit.printed import Point, digits, icon, line, plate, printed, words
from artgen.geometry.solid import Solid, cone, cylinder, slab, union
from artgen.textures.appliance_panel import BRANDS, LED

NICHE = 0.042
"""m; how deep the dispenser goes into the door."""
LINING = 0.0025
PADDLE = (0.052, 0.0045, 0.085)
"""m; width, thickness, height."""
PRESS = 0.11
"""rad that the paddle gives way."""
BADGE = (0.096, 0.017)
TOUCH = (0.046, 0.215)


@dataclass(frozen=True, kw_only=True)
class IceDispenser:
    """On a leaf's outer face; measures in the leaf's drawing.

    Attributes:
        low: (x, z) of its lower corner, m.
        size: width and height of the whole, panel included.
        panel: height of the printed panel at its top.
    """

    leaf: ColdLeaf
    low: Point
    size: Point
    panel: float

    @property
    def _mouth(self) -> tuple[float, float, float, float]:
        """x0, x1, z0, z1 of the niche."""
        (x, z), (w, h) = self.low, self.size
        return x + 0.010, x + w - 0.010, z + 0.012, z + h - self.panel - 0.002

    def hole(self) -> Solid:
        """Room in the skin."""
        x0, x1, z0, z1 = self._mouth
        front = self.leaf.front
        return slab((x0 - LINING, front - 0.01, z0 - LINING),
                    (x1 + LINING, front + NICHE, z1 + LINING))  # fmt: skip

    def bodies(self) -> list[Body]:
        """Bezel, lining, spouts, drip grate; surfaces `bezel`, `niche`, `metal`. In the drawing."""
        x0, x1, z0, z1 = self._mouth
        (x, z), (w, h), y = self.low, self.size, self.leaf.front
        mouth = slab((x0, y - 0.1, z0), (x1, y + NICHE - LINING, z1))
        bezel = slab((x, y - 0.0030, z), (x + w, y + 0.0005, z + h)) - mouth
        lining = self.hole() - mouth - slab((x0 - 1, y - 1, z0 - 1), (x1 + 1, y, z1 + 1))
        middle = (x0 + x1) / 2.0
        spout = union([
            slab((middle - 0.040, y + 0.004, z1 - 0.030), (middle + 0.040, y + 0.036, z1 + 0.001)),
            cone(0.009, 0.013, 0.016, segments=14).at(middle, y + 0.013, z1 - 0.044),
            cylinder(0.004, 0.012, segments=10).at(middle + 0.024, y + 0.013, z1 - 0.040),
        ])  # fmt: skip
        bars = [slab((u, y + 0.002, z0 - 0.001), (u + 0.0025, y + 0.036, z0 + 0.004))
                for u in _spread(x0 + 0.006, x1 - 0.009, 15)]  # fmt: skip
        sill = slab((x0 + 0.002, y + 0.001, z0 - 0.001), (x1 - 0.002, y + 0.004, z0 + 0.005))
        return [
            Body(solid=bezel, surface="bezel", density=ABS, edge=0.001),
            Body(solid=lining, surface="niche", density=ABS),
            Body(solid=spout, surface="niche", density=0.5 * ABS),
            Body(solid=union([*bars, sill]), surface="metal", density=ABS),
        ]

    def face(self) -> Body:
        """The printed panel; wears `dispenser`. In the object frame."""
        return plate(self.leaf.face(self._face_low, self.face_size), "dispenser", density=ABS,
                     thickness=0.0045, sunk=0.0005, radius=0.003)  # fmt: skip

    @property
    def face_size(self) -> Point:
        """Of the printed panel."""
        return self.size[0] - 0.006, self.panel - 0.006

    @property
    def _face_low(self) -> Point:
        return self.low[0] + 0.003, self.low[1] + self.size[1] - self.panel + 0.003

    def paddle(self) -> DraftPart:
        """The lever that a glass is pressed against."""
        x, y, z = self._hinge
        w, t, h = PADDLE
        solid = slab((x - w / 2.0, y, z - h), (x + w / 2.0, y + t, z - 0.0015))
        lip = slab((x - w / 2.0, y - 0.005, z - h), (x + w / 2.0, y + t, z - h + 0.006))
        body = Body(solid=union([solid, lip]), surface="paddle", density=ABS, edge=0.001,
                    collision=(solid, lip))  # fmt: skip
        grip = Grip(name="dispenser_paddle_face", kind="lever",
                    position=self.leaf.point(x, y, z - 0.7 * h), outward=(0.0, -1.0, 0.0),
                    pull=(0.0, 1.0, 0.0))  # fmt: skip
        return DraftPart(name="dispenser_paddle", label="lever",
                         bodies=(self.leaf.carried(body),), grips=(grip,))  # fmt: skip

    def joint(self) -> Joint:
        """Its lower edge gives way to the back against a spring."""
        x, y, z = self._hinge
        return Joint(
            name="dispenser_press",
            type="revolute",
            parent=self.leaf.name,
            child="dispenser_paddle",
            axis=(1.0, 0.0, 0.0),
            origin=self.leaf.point(x, y, z),
            limit=Limit(lower=0.0, upper=PRESS),
            friction=0.02,
            damping=0.004,
            effort=2.0,
            spring=Spring(stiffness=0.9, reference=-0.12),
        )

    @property
    def _hinge(self) -> tuple[float, float, float]:
        x0, x1, _, z1 = self._mouth
        return (x0 + x1) / 2.0, self.leaf.front + 0.0225, z1 - 0.0465


def _spread(low: float, high: float, count: int) -> list[float]:
    return [low + (high - low) * k / (count - 1) for k in range(count)]


def dispenser_print(size: Point, led: str) -> SurfaceSpec:
    """Water, cubes, crushed, lock, light; the chosen one glows."""
    w, h = size
    names = ("glass", "drop", "star", "lock", "sun")
    lit = [icon(((k + 0.5) * w / 5.0, 0.34 * h), name, size=0.11 * w,
                ink=LED[led] if k == 0 else "#b9bdc2") for k, name in enumerate(names)]  # fmt: skip
    lit += [words(((k + 0.5) * w / 5.0, 0.10 * h), word, cap=0.030 * w, ink="#9aa0a6")
            for k, word in enumerate(("WATER", "ICE", "CRUSH", "LOCK", "LIGHT"))]  # fmt: skip
    lit += [digits((0.16 * w, 0.62 * h), "-18", height=0.24 * h, ink=LED[led]),
            digits((0.66 * w, 0.62 * h), "4", height=0.24 * h, ink=LED[led])]  # fmt: skip
    return printed("dispenser", size, background="#0b0c0e", marks=[], lit=lit, roughness=0.1)


def touch_panel(leaf: ColdLeaf, low: Point) -> Body:
    """A strip of glass on the door with temperatures; wears `touch`."""
    return plate(leaf.face(low, TOUCH), "touch", density=ABS, thickness=0.0026, sunk=0.0006,
                 radius=0.004)  # fmt: skip


def touch_print(temperature: int, led: str) -> SurfaceSpec:
    """Degrees above symbols."""
    w, h = TOUCH
    lit = [words((w / 2.0, 0.90 * h), "FREEZER", cap=0.0034, ink="#aeb3b8"),
           digits((0.18 * w, 0.77 * h), "-18", height=0.085 * h, ink=LED[led]),
           words((w / 2.0, 0.66 * h), "FRIDGE", cap=0.0034, ink="#aeb3b8"),
           digits((0.40 * w, 0.53 * h), f"{temperature}", height=0.085 * h, ink=LED[led]),
           ]  # fmt: skip
    lit.append(line([(0.2 * w, 0.47 * h), (0.8 * w, 0.47 * h)], width=0.0006, ink="#6a6f74"))
    lit += [icon((w / 2.0, (0.38 - 0.13 * k) * h), name, size=0.010, ink="#c6cace")
            for k, name in enumerate(("leaf", "star", "lock"))]  # fmt: skip
    return printed("touch", TOUCH, background="#0a0b0d", marks=[], lit=lit, roughness=0.1)


def badge(leaf: ColdLeaf, low: Point) -> Body:
    """The maker's name; wears `badge`."""
    return plate(leaf.face(low, BADGE), "badge", density=2.0 * ABS, thickness=0.0024, sunk=0.0008,
                 radius=0.002)  # fmt: skip


def badge_print(brand: int) -> SurfaceSpec:
    """Dark letters on metal."""
    w, h = BADGE
    word = BRANDS[brand % len(BRANDS)]
    cap = min(0.52 * h, 0.8 * w / (0.8 * len(word)))
    name = words((w / 2.0, (h - cap) / 2.0), word, cap=cap, ink="#25282b")
    return printed("badge", BADGE, background="#c9cbcd", roughness=0.28, metallic=1.0,
                   marks=[name])  # fmt: skip
