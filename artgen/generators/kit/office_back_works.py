"""What carries the back of an office chair: cheeks on the tilt's pivot, the spine, the headrest."""

from dataclasses import replace

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring
from artgen.core.mesh import Floats
from artgen.generators.kit.bent_strip import bent_strip
from artgen.generators.kit.board import Stock
from artgen.generators.kit.chair_back import ChairBack
from artgen.generators.kit.cushion import COARSE, pad, piping, plan, upholstered
from artgen.generators.kit.office_seat import BACK, BOX, OfficeSeat
from artgen.geometry.solid import Solid, cylinder, slab, union

CHEEK = 0.005
STRIP = 0.014
"""m; thickness of the spine."""
STALK = (0.036, 0.011)
"""m; section of the headrest's stalk, along x and y."""
PLAY = 0.0012


def spine(seat: OfficeSeat, back: ChairBack, stock: Stock, *, width: float) -> list[Body]:
    """Cheeks beside the housing, a bridge behind it, and a bar that rises behind the back."""
    _, y, z = seat.tilt
    sharp = replace(stock, edge=0.0)
    inner = BOX[0] / 2.0 + 0.0018
    bridge = BACK + 0.012
    rear = max(back.behind(0.0), back.behind(0.45 * back.height)) + STRIP / 2.0 - 0.004
    cheek = union([
        cylinder(0.017, CHEEK, axis="x", segments=20).at(inner, y, z),
        slab((inner, y, z - 0.012), (inner + CHEEK, bridge + 0.012, z + 0.012)),
    ])  # fmt: skip
    bolt = cylinder(0.008, 0.004, axis="x", segments=6).at(inner + CHEEK - 0.0005, y, z)
    cross = slab((-inner - CHEEK, bridge, z - 0.012), (inner + CHEEK, bridge + 0.016, z + 0.012))
    high = back.low + 0.45 * back.height
    corners = [(bridge + 0.004, z), (rear, z), (rear, high)]
    bend = min(0.045, 0.7 * (rear - bridge))
    bar = bent_strip(corners, bend=bend, thickness=STRIP, width=width, across="x")
    upright = slab((-width / 2, rear - STRIP / 2, z + 0.03), (width / 2, rear + STRIP / 2, high))
    level = slab((-width / 2, bridge + 0.004, z - STRIP / 2), (width / 2, rear, z + STRIP / 2))
    cheeks = union([cheek, cheek.mirrored("x"), cross])
    return [
        sharp.piece(cheeks, contact=(cross,)),
        sharp.piece(union([bolt, bolt.mirrored("x")])),
        stock.piece(bar, contact=(upright, level)),
        *_mounts(back, stock, rear, width),
    ]


def _mounts(back: ChairBack, stock: Stock, rear: float, width: float) -> list[Body]:
    """Blocks from the spine to the back where the back bends away from it."""
    pieces: list[Solid] = []
    for share in (0.14, 0.40):
        rise = share * back.height
        near = back.behind(rise) - 0.004
        if rear - near > 0.006:
            z, half = back.low + rise, 0.5 * width
            pieces.append(slab((-half, near, z - 0.022), (half, rear, z + 0.022)))
    solid = [replace(stock, edge=0.0).piece(union(pieces))] if pieces else []
    if back.style == "net":
        solid.append(_lumbar_bow(back, stock, rear))
    return solid


def _lumbar_bow(back: ChairBack, stock: Stock, rear: float) -> Body:
    """A cross bar behind the net that takes its frame at both sides."""
    reach = 0.5 * back.width - 0.012
    rise = 0.27 * back.height
    mid, side = back.behind(rise) + 0.012, back.behind(rise) - back.bow + 0.004
    points = [
        (-reach, side),
        (-0.45 * reach, mid + 0.002),
        (0.45 * reach, mid + 0.002),
        (reach, side),
    ]
    bow = bent_strip(points, bend=0.06, thickness=0.010, width=0.034, across="z")
    block = slab((-0.03, mid, -0.017), (0.03, rear, 0.017))
    return stock.piece(union([bow, block]).at(z=back.low + rise))


def tilt_joint(seat: OfficeSeat, *, reach: float, preload: float) -> Joint:
    """Leans back by +q against a spring."""
    return Joint(
        name="backrest_tilt",
        type="revolute",
        parent="seat",
        child="backrest",
        axis=(-1.0, 0.0, 0.0),
        origin=seat.tilt,
        limit=Limit(lower=0.0, upper=reach),
        friction=2.0,
        damping=2.5,
        effort=150.0,
        spring=Spring(stiffness=1.6 * preload / reach, reference=-reach / 1.6),
    )


def back_grip(back: ChairBack) -> Grip:
    """The upper edge of the back, by which a chair is rolled about."""
    top = back.low + back.height
    return Grip(
        name="backrest_rim",
        kind="rim",
        position=(0.0, back.behind(back.height) - 0.01, top),
        outward=(0.0, 0.0, 1.0),
        pull=(0.0, 1.0, 0.0),
    )


def _stalk_y(back: ChairBack) -> float:
    return back.behind(back.height) + 0.008 + STALK[1] / 2.0


def headrest_guide(back: ChairBack, stock: Stock) -> list[Body]:
    """The guide behind the back's top that the stalk slides in."""
    y, top = _stalk_y(back), back.low + back.height
    hx, hy = STALK[0] / 2.0 + PLAY, STALK[1] / 2.0 + PLAY
    low, high = top - 0.090, top - 0.020
    outer = slab((-hx - 0.006, back.behind(back.height - 0.09) - 0.002, low),
                 (hx + 0.006, y + hy + 0.005, high))  # fmt: skip
    bore = slab((-hx, y - hy, low - 0.01), (hx, y + hy, high + 0.01))
    rear = slab((-hx, y + hy, low), (hx, y + hy + 0.005, high))
    return [stock.piece(outer - bore, contact=(rear,))]


def headrest(
    back: ChairBack, post: Stock, cover: Stock, cord: Stock, *, size: tuple[float, float, float]
) -> DraftPart:
    """Pad and stalk; `size` is width, height and thickness of the pad, m."""
    y, top = _stalk_y(back), back.low + back.height
    middle = top + 0.045 + size[1] / 2.0
    stalk = slab(
        (-STALK[0] / 2, y - STALK[1] / 2, top - 0.115), (STALK[0] / 2, y + STALK[1] / 2, middle)
    )
    outline = plan(size[0], size[1], 0.40 * size[1], segments=3)
    thick = 0.8 * size[2]
    steps = upholstered(
        thick,
        roll=0.35 * thick,
        crown=0.2 * size[2],
        reach=size[1] / 2.0,
        rings=COARSE,
        under=(0.6,),
    )

    def lie(flat: Floats) -> Floats:
        placed = flat[:, [0, 2, 1]].copy()
        placed[:, 1] = (
            y - STALK[1] / 2 + 0.001 - flat[:, 2] - 0.020 * (2 * flat[:, 0] / size[0]) ** 2
        )
        placed[:, 2] = middle + flat[:, 1]
        return placed

    half = 0.30 * size[0]
    touch = slab((-half, y - STALK[1] / 2 - thick, middle - 0.4 * size[1]),
                 (half, y - STALK[1] / 2, middle + 0.4 * size[1]))  # fmt: skip
    hold = Grip(
        name="headrest_pad",
        kind="handle",
        position=(0.0, y - STALK[1] / 2 - thick / 2, middle),
        outward=(0.0, -1.0, 0.0),
        pull=(0.0, 0.0, 1.0),
    )
    bodies = (
        post.piece(stalk, contact=(stalk,)),
        cover.piece(pad(outline, steps, lie), contact=(touch,)),
        cord.piece(piping(outline, (0.0004, 0.5 * thick), lie, 0.0020)),
    )
    return DraftPart(name="headrest", label="headrest", bodies=bodies, grips=(hold,))


def headrest_joint(*, travel: float) -> Joint:
    """Up by +q; its stalk is held by friction."""
    return Joint(
        name="headrest_lift",
        type="prismatic",
        parent="backrest",
        child="headrest",
        axis=(0.0, 0.0, 1.0),
        limit=Limit(lower=0.0, upper=travel),
        friction=16.0,
        damping=12.0,
        effort=70.0,
    )
