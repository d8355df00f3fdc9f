"""Foamed doors of refrigerators: skin, end caps, dished liner, gasket, bins on the inside."""

from collections.abc import Sequence
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.cold_case import boxes_outside
from artgen.generators.kit.cold_leaf import SEAL_PLAY, ColdLeaf
from artgen.generators.kit.density import ABS
from artgen.generators.kit.door_pull import DoorPull
from artgen.geometry.solid import Solid, slab, union

CAP = 0.010
"""m; height of the plastic caps at both ends."""
LINER = 0.004
RIM = 0.028
"""m; width of the liner's raised rim."""
AIR = 0.007
"""m; between the rim and the room's walls."""


@dataclass(frozen=True, kw_only=True)
class InsulatedDoor:
    """What is built on a leaf.

    Attributes:
        near: x of the room's wall at the hinge, in the leaf's drawing, m.
        far: x of the wall, or of what else its inside has to turn past, at the free edge.
        low: z of the room's floor in the drawing.
        high: z of its ceiling.
        rim: y up to which the liner's rim reaches into the room.
        bins: z of the floor and height of each bin on the inside.
        bin_depth: y up to which bins reach.
        foam: effective density, kg/m3.
        holes: what is cut out of the skin, in the drawing.
    """

    leaf: ColdLeaf
    pull: DoorPull
    near: float
    far: float
    low: float
    high: float
    rim: float
    bins: tuple[tuple[float, float], ...]
    bin_depth: float
    foam: float
    holes: tuple[Solid, ...] = ()

    @property
    def sides(self) -> tuple[float, float]:
        """x of the rim's outer sides."""
        free = min(self.far, self.leaf.free_reach(self.bin_depth, beside=self.far)) - AIR
        return self.near + AIR, free

    def corners(self) -> list[tuple[float, float]]:
        """(x, y) of what stands out inside: what must be out of a bin's way."""
        d, (x0, x1) = self.leaf, self.sides
        seal, deep = d.seal_inset, self.bin_depth if self.bins else self.rim
        return [(0.0, d.back), (d.width, d.back), (seal, -SEAL_PLAY), (d.width - seal, -SEAL_PLAY),
                (x0, self.rim), (x1, self.rim), (x0 + RIM - 0.003, deep),
                (x1 - RIM + 0.003, deep)]  # fmt: skip

    def bodies(self) -> list[Body]:
        """In the leaf's drawing; surfaces front, cap, liner, seal, bin, handle."""
        d = self.leaf
        return [
            *self._shell(), *self._inside(), d.gasket("seal"),
            *[self._bin(z, height) for z, height in self.bins], *self.pull.bodies(),
        ]  # fmt: skip

    def _shell(self) -> list[Body]:
        d = self.leaf
        y0, y1 = d.front, d.back - LINER
        skin = slab((0.0, y0, CAP), (d.width, y1, d.length - CAP))
        caps = union([
            slab((0.001, y0 + 0.001, 0.0), (d.width - 0.001, y1, CAP)),
            slab((0.001, y0 + 0.001, d.length - CAP), (d.width - 0.001, y1, d.length)),
        ]) - d.bores()  # fmt: skip
        for room in (*self.pull.room(), *self.holes):
            skin, caps = skin - room, caps - room
        contact = [d.slab(front=y0, back=d.back)]
        for hole in self.holes:
            contact = [rest for piece in contact for rest in boxes_outside(piece, hole)]
        return [
            Body(
                solid=skin, surface="front", density=self.foam, edge=0.005, collision=tuple(contact)
            ),
            Body(solid=caps, surface="cap", density=ABS),
        ]

    def _inside(self) -> list[Body]:
        """The liner's plate and its rim."""
        d, (x0, x1) = self.leaf, self.sides
        plate = d.slab(front=d.back - LINER, back=d.back, inset=0.002)
        z0, z1, y = self.low + AIR, self.high - AIR, d.back - 0.001
        bars = (
            slab((x0, y, z0), (x0 + RIM, self.rim, z1)),
            slab((x1 - RIM, y, z0), (x1, self.rim, z1)),
            slab((x0 + RIM, y, z0), (x1 - RIM, self.rim, z0 + RIM)),
            slab((x0 + RIM, y, z1 - RIM), (x1 - RIM, self.rim, z1)),
        )
        return [
            Body(solid=plate, surface="liner", density=ABS),
            Body(solid=union(bars), surface="liner", density=0.35 * ABS, edge=0.006,
                 collision=bars),
        ]  # fmt: skip

    def _bin(self, z: float, height: float) -> Body:
        """A trough between the rim's sides with a rail along its upper edge."""
        (x0, x1), e = self.sides, 0.003
        x0, x1, y0, y1 = x0 + RIM - e, x1 - RIM + e, self.leaf.back - 0.001, self.bin_depth
        pieces = (
            slab((x0, y0, z), (x1, y1, z + e)),
            slab((x0, y1 - e, z), (x1, y1, z + height)),
            slab((x0, y0, z), (x0 + e, y1, z + 0.7 * height)),
            slab((x1 - e, y0, z), (x1, y1, z + 0.7 * height)),
        )
        rail = slab((x0, y1 - 2.2 * e, z + height - 0.006), (x1, y1, z + height))
        return Body(solid=union([*pieces, rail]), surface="bin", density=ABS,
                    collision=pieces)  # fmt: skip


def basket(low: Sequence[float], high: Sequence[float], *, wall: float, surface: str) -> Body:
    """The open box behind a drawer's front, in the object frame."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    pieces = (
        slab((x0, y0, z0), (x1, y1, z0 + wall)),
        slab((x0, y0, z0), (x0 + wall, y1, z1)),
        slab((x1 - wall, y0, z0), (x1, y1, z1)),
        slab((x0, y1 - wall, z0), (x1, y1, z1)),
        slab((x0, y0, z0), (x1, y0 + wall, z1)),
    )
    return Body(solid=union(pieces), surface=surface, density=0.8 * ABS, edge=0.0015,
                collision=pieces)  # fmt: skip
