"""The door of a safe: plate, cover of the boltwork, rose, maker's plate, label inside."""

from dataclasses import dataclass

from artgen.articulation.types import Body, Grip
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.boltwork import Boltwork
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import STEEL, ZINC
from artgen.generators.kit.safe_case import Case
from artgen.generators.kit.safe_lock import badge, rating_label
from artgen.generators.kit.turn_handle import SHAFT, rose
from artgen.geometry.solid import cylinder, slab

FRONT = {"right": (1.0, 0.0, 0.0), "up": (0.0, 0.0, 1.0)}
ROSE = 0.024
"""m; radius."""


@dataclass(frozen=True, kw_only=True)
class DoorFittings:
    """Middles (x, z) of handle and lock on the front at y = 0, and the lock's size, m."""

    handle: tuple[float, float]
    lock: tuple[float, float]
    size: tuple[float, float]

    @property
    def handle_plane(self) -> PanelPlane:
        """Its lower left corner is the handle's axis."""
        x, z = self.handle
        return PanelPlane(origin=(x, 0.0, z), size=(0.05, 0.05), **FRONT)

    @property
    def lock_plane(self) -> PanelPlane:
        """As large as the lock."""
        (x, z), (w, h) = self.lock, self.size
        return PanelPlane(origin=(x - w / 2.0, 0.0, z - h / 2.0), size=self.size, **FRONT)

    def edge(self, x: float) -> Grip:
        """The door's free edge, taken hold of when it stands ajar."""
        return Grip(
            name="door_edge",
            kind="edge",
            position=(x, 0.0, self.handle[1]),
            outward=(0.0, -1.0, 0.0),
            pull=(0.0, -1.0, 0.0),
        )


def door_plate(
    case: Case, works: Boltwork, at: DoorFittings, *, gap: float, side: float, dial: bool
) -> tuple[Body, ...]:
    """Plate with holes for the shafts, cover and rose, for a hinge at `side`."""
    x, low, high = case.opening_x - gap, case.low + gap, case.high - gap
    touch = slab((-x, 0.0, low), (x, case.lip, high))
    plate = touch
    drilled = [(at.handle, SHAFT + 0.0012)] + ([(at.lock, 0.0072)] if dial else [])
    for (u, v), radius in drilled:
        hole = cylinder(radius, case.lip + 0.02, axis="y", segments=16)
        plate = plate - hole.at(u, -0.01, v)
    cover, pieces = works.cover(), works.cover_collision()
    if side > 0.0:
        cover, pieces = cover.mirrored("x"), tuple(piece.mirrored("x") for piece in pieces)
    return (
        Body(solid=plate, surface="case", density=case.density, edge=0.0012, collision=(touch,)),
        Body(solid=cover, surface="inside", density=STEEL, edge=0.0, collision=pieces),
        Body(
            solid=at.handle_plane.placed(rose(ROSE)),
            surface="handle",
            density=ZINC,
            collision=(at.handle_plane.placed(slab((-0.016, -0.016, 0.0), (0.016, 0.016, 0.005))),),
        ),
    )


def door_signs(
    case: Case, works: Boltwork, at: DoorFittings, brand: int
) -> tuple[tuple[Body, ...], tuple[SurfaceSpec, ...]]:
    """The maker's plate below the upper edge, and the label on the cover."""
    wide, tall = 0.052, 0.011
    front = PanelPlane(origin=(-wide / 2.0, 0.0, case.high - 0.026), size=(wide, tall), **FRONT)
    size = (0.085, 0.052)
    back = PanelPlane(
        origin=(size[0] / 2.0, works.back, (works.low + works.high - size[1]) / 2.0),
        right=(-1.0, 0.0, 0.0),
        up=(0.0, 0.0, 1.0),
        size=size,
    )
    named, name = badge(front, brand)
    rated, label = rating_label(back, fire=case.wall > 0.02)
    return (named, rated), (name, label)
