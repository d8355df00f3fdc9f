"""The storage drawer under the oven of a range: a sheet-metal box behind a front."""

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.appliance_handle import pocket_room
from artgen.generators.kit.density import ABS, STEEL
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.geometry.solid import slab

WALL = 0.0022
"""m; sheet as drawn."""
CLEAR = 0.006
"""m; beside, above and behind the box."""
LIFT = 0.0065
"""m; from the compartment's floor to the box, above its runners."""


def range_drawer(
    room: LinedCavity,
    *,
    half: float,
    face: float,
    low: float,
    high: float,
    seam: float,
    reach: float,
) -> tuple[DraftPart, Joint]:
    """A drawer in `room` whose front spans +-half and `low` to `high`, from y = face to -seam; it
    comes out by `reach` at most, behind the handle of an open door above it."""
    (x0, y0, z0), (_, y1, z1) = room.low, room.high
    x = -x0 - CLEAR
    bottom, top, back = z0 + LIFT, z0 + 0.72 * (z1 - z0), y1 - CLEAR
    walls = (
        slab((-x, y0 - 0.016, bottom), (x, back, bottom + WALL)),
        slab((-x, y0 - 0.016, bottom + WALL), (-x + WALL, back, top)),
        slab((x - WALL, y0 - 0.016, bottom + WALL), (x, back, top)),
        slab((-x + WALL, back - WALL, bottom + WALL), (x - WALL, back, top)),
    )
    block = slab((-half, face, low), (half, -seam, high))
    tall = high - low
    room_cut, cup = pocket_room(
        half_length=0.26 * half, y=face, low=high - 0.40 * tall - 0.012, high=high - 0.016,
        depth=0.6 * (-seam - face), wall=0.002,
    )  # fmt: skip
    box = walls[0] | walls[1] | walls[2] | walls[3]
    bodies = (
        Body(solid=box, surface="metal", density=STEEL * 0.0007 / WALL, collision=walls),
        Body(solid=block - room_cut, surface="front", density=160.0, edge=0.0025,
             collision=(block,)),
        Body(solid=cup, surface="trim", density=ABS),
    )  # fmt: skip
    out = (0.0, -1.0, 0.0)
    grip = Grip(name="drawer_pocket", kind="edge", position=(0.0, face, high - 0.018),
                outward=out, pull=out)  # fmt: skip
    joint = Joint(
        name="drawer_slide", type="prismatic", parent="base", child="drawer", axis=out,
        limit=Limit(lower=0.0, upper=round(min(reach, 0.7 * (back - y0)), 3)),
        friction=8.0, damping=6.0, effort=100.0, velocity=1.0,
    )  # fmt: skip
    return DraftPart(name="drawer", label="drawer", bodies=bodies, grips=(grip,)), joint
