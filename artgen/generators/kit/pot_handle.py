"""Handles of cookware: side loops, cast lugs, loops that fold down, long handles with an eye."""

import math

import numpy as np

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit
from artgen.generators.kit.board import Stock
from artgen.generators.kit.pot_shell import PotShell
from artgen.generators.kit.swept import bent_line, swept, swept_boxes
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Solid, box, cylinder, revolve, slab, tube, union, wire

OUT = 0.0095
"""m; from the wall to the axis of a folding loop."""
EYE = 0.0010
"""m; play of a folding loop in its barrel."""


def side_loop(
    shell: PotShell,
    *,
    z: float,
    half: float,
    reach: float,
    width: float,
    thick: float,
    stock: Stock,
) -> Body:
    """A fixed loop at +x, level, `reach` beyond the wall, its feet `half` to either side.

    Args:
        width: of the bar upwards, m.
        thick: of the bar outwards, m.
    """
    root = math.sqrt(max(shell.radius**2 - half**2, 0.0)) - 0.002
    far = shell.radius + reach - thick / 2.0
    corners = [(-half, root), (-0.92 * half, far), (0.92 * half, far), (half, root)]
    path = bent_line(corners, 0.6 * reach)
    solid = _level(swept(path, width, thick)).at(z=z) - shell.outside()
    contact = tuple(_box(_level(piece).at(z=z)) for piece in swept_boxes(path, width, thick))
    return stock.piece(solid, contact=contact)


def _level(solid: Solid) -> Solid:
    """A drawing of (y, z) laid down so that its z points to +x."""
    return solid.turned("y", math.pi / 2.0)


def _box(piece: Solid) -> Solid:
    return slab(*piece.bounds)


def foot_plate(
    shell: PotShell, *, y: float, z: float, size: tuple[float, float], proud: float, stock: Stock
) -> Body:
    """A plate that hugs the wall at +x, `y` aside, with a rivet's head on either side of the wall.

    Args:
        size: along the wall and upwards, m.
        proud: how far it stands out.
    """
    window = box((0.4, size[0], size[1]), at=(0.2, y, z - size[1] / 2.0))
    plate = (shell.outside(more=proud) - shell.outside()) & window
    along = math.sqrt(shell.radius**2 - y**2)
    head = cylinder(0.0040, 0.0016, axis="x", segments=16)
    heads = [head.at(along + proud - 0.0006, y, z), head.at(along - shell.wall - 0.0014, y, z)]
    return Body(
        solid=union([plate, heads[0]]) | heads[1], surface=stock.surface, density=stock.density
    )


def folding_loop(
    shell: PotShell, *, z: float, half: float, drop: float, radius: float, stock: Stock, name: str
) -> tuple[Body, DraftPart, Joint]:
    """(barrel on the wall, loop, joint) at +x: it hangs beside the wall and lifts until level.

    Args:
        half: half its width, m.
        drop: from the axis to the bar that a hand takes, m.
        radius: of its wire, m.
    """
    x = shell.radius + OUT
    bore, length = radius + EYE, 2.0 * (half - 2.6 * radius)
    barrel = tube(bore + 0.0022, bore, length, axis="y", segments=20).at(x, -length / 2.0, z)
    web = slab((shell.radius - 0.004, -length / 2.0, z - 0.004), (x, length / 2.0, z + 0.004))
    web = web - cylinder(bore + 0.001, 0.2, axis="y", segments=20).at(x, -0.1, z)
    plate = (shell.outside(more=0.0018) - shell.outside()) & slab(
        (0.0, -0.5 * length - 0.005, z - 0.013), (1.0, 0.5 * length + 0.005, z + 0.013)
    )
    fixed = stock.piece(
        union([barrel, web, plate]) - shell.outside(),
        contact=(
            slab((shell.radius, -length / 2.0, z - 0.004), (x - bore, length / 2.0, z + 0.004)),
        ),
    )
    corners = [(-half, 0.0), (half, 0.0), (half, -drop), (-half, -drop)]
    path = bent([(x, u, z + v) for u, v in corners], 2.0 * radius, closed=True)
    fair = 0.75 * radius
    foot = z - drop
    bars = (
        slab((x - fair, -half + radius, foot - fair), (x + fair, half - radius, foot + fair)),
        *(slab((x - fair, min(s * half, s * (half - fair)) - 0.5 * fair, z - drop),
               (x + fair, max(s * half, s * (half - fair)) + 0.5 * fair, z)) for s in (-1.0, 1.0)),
    )  # fmt: skip
    grip = Grip(name=f"{name}_bar", kind="handle", position=(x, 0.0, z - drop),
                outward=(1.0, 0.0, 0.0), pull=(1.0, 0.0, 0.0))  # fmt: skip
    loop = DraftPart(
        name=name, label="handle", grips=(grip,),
        bodies=(Body(solid=wire(path, radius, sides=10, closed=True), surface=stock.surface,
                     density=stock.density, collision=bars),),
    )  # fmt: skip
    joint = Joint(
        name=f"{name}_fold", type="revolute", parent="base", child=name, axis=(0.0, -1.0, 0.0),
        origin=(x, 0.0, z), limit=Limit(lower=0.0, upper=math.radians(88.0)), friction=0.012,
        damping=0.003, effort=2.0,
    )  # fmt: skip
    return fixed, loop, joint


def long_handle(
    shell: PotShell,
    *,
    z: float,
    length: float,
    rise: float,
    width: float,
    thick: float,
    stock: Stock,
    metal: Stock,
    ferrule: float,
) -> list[Body]:
    """A bar towards +x with an eye to hang it by, on a bracket with two rivets.

    Args:
        rise: how much higher its end is than its root, m.
        ferrule: length of the metal neck next to the wall, m.
    """
    r = shell.radius
    corners = [(r - 0.003, z), (r + ferrule + 0.012, z + 0.10 * rise), (r + length, z + rise)]
    path = bent_line(corners, 0.10)
    split = r + ferrule
    bar = swept(path, width, thick, round_end=True).turned("z", -math.pi / 2.0)
    eye = cylinder(0.0048, 0.1, segments=20).at(r + length - 0.020, 0.0, z + rise - 0.05)
    neck_path = bent_line(corners[:2], 0.10)
    neck = swept(neck_path, 0.62 * width, 0.55 * thick).turned("z", -math.pi / 2.0)
    beyond = slab((split, -1.0, -1.0), (2.0, 1.0, 1.0))
    contact = [_box(piece.turned("z", -math.pi / 2.0)) for piece in swept_boxes(path, width, thick)]
    grip_boxes = tuple(
        piece
        for piece in contact
        if split - 0.003 < piece.bounds[0, 0] and piece.bounds[1, 0] < r + length + 0.002
    )
    return [
        metal.piece(
            neck - shell.outside(), contact=(_box(neck & slab((r, -1.0, 0.0), (split, 1.0, 1.0))),)
        ),
        foot_plate(shell, y=0.013, z=z, size=(0.020, 0.026), proud=0.0020, stock=metal),
        foot_plate(shell, y=-0.013, z=z, size=(0.020, 0.026), proud=0.0020, stock=metal),
        stock.piece((bar & beyond) - eye, contact=grip_boxes),
    ]


def rim_bead(shell: PotShell, radius: float, surface: str, density: float) -> Body:
    """A bead around the rim, as enameled ware has it."""
    angles = np.linspace(0.0, 2.0 * math.pi, 13)[:-1]
    outline = np.stack(
        [shell.edge + radius * np.cos(angles), shell.height - radius + radius * np.sin(angles)],
        axis=1,
    )
    return Body(
        solid=revolve(outline, segments=56) - shell.room(), surface=surface, density=density
    )
