"""What is screwed to a door's leaf: letter plate, spy hole, kick plate, pull handle, astragal."""

import math
from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, tube, union, upright


def kick_plate(rect: Rect, *, face: float, height: float, metal: Stock) -> Body:
    """A sheet over the foot of a leaf, with screws along its edge."""
    x0, x1, z0 = rect.x0 + 0.02, rect.x1 - 0.02, rect.z0 + 0.015
    sheet = slab((x0, face - 0.0016, z0), (x1, face, z0 + height))
    inset = 0.014
    screws = [
        cylinder(0.004, 0.001, axis="y", segments=10).at(x, face - 0.0024, z)
        for x in (x0 + inset, (x0 + x1) / 2.0, x1 - inset)
        for z in (z0 + inset, z0 + height - inset)
    ]
    return metal.piece(union([sheet, *screws]), contact=(sheet,), grain="x")


def spy_hole(
    x: float, z: float, *, faces: tuple[float, float], metal: Stock, glass: Stock
) -> list[Body]:
    """A ring with a lens on each face."""
    front, rear = faces
    ring = tube(0.012, 0.006, 0.004, axis="y", segments=20)
    lens = cylinder(0.006, 0.002, axis="y", segments=16)
    return [
        metal.piece(ring.at(x, front - 0.003, z)),
        metal.piece(ring.at(x, rear - 0.001, z)),
        glass.piece(lens.at(x, front - 0.0018, z)),
        glass.piece(lens.at(x, rear - 0.0002, z)),
    ]


@dataclass(frozen=True, kw_only=True)
class LetterPlate:
    """A plate over a slot, closed by a flap that is lifted (EN 13724: 230 to 280 by 30 to 35 mm).

    Attributes:
        middle: (x, z) of the slot.
        faces: y of the leaf's front and rear.
        width: of the slot, m.
        height: of the slot, m.
    """

    middle: tuple[float, float]
    faces: tuple[float, float]
    width: float
    height: float

    def slot(self) -> Solid:
        """What the leaf must leave free."""
        front, rear = self.faces
        return self._block(self.width, self.height, front - 0.02, rear + 0.02)

    def fixed(self, metal: Stock) -> list[Body]:
        """A frame on each face and a sleeve through the leaf."""
        front, rear = self.faces
        hole = self._block(self.width - 0.004, self.height - 0.004, front - 0.1, rear + 0.1)
        sleeve = self._block(self.width - 0.0008, self.height - 0.0008, front, rear) - hole
        plates = [
            self._rim(0.026).at(0.0, front - 0.004, 0.0) - hole,
            self._rim(0.022).at(0.0, rear, 0.0) - hole,
        ]
        return [metal.piece(solid) for solid in (*plates, sleeve)]

    def part(self, metal: Stock) -> DraftPart:
        """The flap before the front plate, hung from its upper edge."""
        (x, z), front = self.middle, self.faces[0]
        low, high = z - self.height / 2.0 - 0.008, z + self.height / 2.0 + 0.008
        half = self.width / 2.0 + 0.010
        plate = slab((x - half, front - 0.0085, low), (x + half, front - 0.0055, high - 0.004))
        bar = cylinder(0.0028, 2.0 * half, axis="x", segments=10).at(
            x - half, front - 0.0078, high - 0.0025
        )
        lip = slab((x - half, front - 0.0120, low), (x + half, front - 0.0085, low + 0.004))
        grip = Grip(
            name="letter_flap_edge",
            kind="edge",
            position=(x, front - 0.011, low),
            outward=(0.0, -1.0, 0.0),
            pull=(0.0, -1.0, 0.0),
        )
        body = metal.piece(union([plate, bar, lip]), contact=(plate,), grain="x")
        return DraftPart(name="letter_flap", label="flap", bodies=(body,), grips=(grip,))

    def joint(self, parent: str) -> Joint:
        """Lifted outwards by +q; its weight and a weak spring close it."""
        z = self.middle[1] + self.height / 2.0 + 0.0055
        return Joint(
            name="letter_flap_hinge",
            type="revolute",
            parent=parent,
            child="letter_flap",
            axis=(-1.0, 0.0, 0.0),
            origin=(0.0, self.faces[0] - 0.0078, z),
            limit=Limit(lower=0.0, upper=math.radians(80.0)),
            friction=0.01,
            damping=0.003,
            effort=3.0,
            spring=Spring(stiffness=0.05, reference=-0.4),
        )

    def _rim(self, more: float) -> Solid:
        x, z = self.middle
        outline = rounded_rectangle(
            self.height + 2.0 * more, self.width + 2.0 * more, 0.006, segments=3
        )
        return upright(prism(outline, 0.004), "y").at(x, 0.0, z)

    def _block(self, width: float, height: float, y0: float, y1: float) -> Solid:
        x, z = self.middle
        return slab(
            (x - width / 2.0, y0, z - height / 2.0), (x + width / 2.0, y1, z + height / 2.0)
        )


def pull_bars(
    x: float, z: float, *, length: float, radius: float, faces: tuple[float, float], metal: Stock
) -> tuple[list[Body], list[Grip]]:
    """A standing bar on two posts on each face, and where hands take it."""
    bodies, grips = [], []
    ways = ((faces[0], -1.0, "pull_front"), (faces[1], 1.0, "pull_rear"))
    for face, way, name in ways:
        y = face + way * 0.05
        bar = cylinder(radius, length, segments=16).at(x, y, z - length / 2.0)
        low, high = min(face, y), max(face, y)
        posts = [
            cylinder(0.75 * radius, high - low, axis="y", segments=12).at(
                x, low, z + s * 0.38 * length
            )
            for s in (-1.0, 1.0)
        ]
        r = 0.85 * radius
        contact = [slab((x - r, y - r, z - length / 2.0), (x + r, y + r, z + length / 2.0))]
        bodies.append(metal.piece(union([bar, *posts]), contact=tuple(contact)))
        grips.append(
            Grip(
                name=name,
                kind="handle",
                position=(x, y, z),
                outward=(0.0, way, 0.0),
                pull=(0.0, -1.0, 0.0),
            )
        )
    return bodies, grips
