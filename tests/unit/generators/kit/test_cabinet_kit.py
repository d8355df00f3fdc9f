"""Fronts, handles, runners, hinges, stands: each is what its measures say."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.articulation.types import Body
from artgen.core.errors import GeometryError
from artgen.generators.kit.basin import basin, tap
from artgen.generators.kit.board import Stock
from artgen.generators.kit.cabinet_hinge import (
    AXIS_AHEAD,
    butt_hinge,
    cup_hinge,
    hinge_heights,
)
from artgen.generators.kit.carcass import shelf_heights
from artgen.generators.kit.drawer import (
    LENGTHS,
    PLAY,
    DrawerBox,
    drawer_box,
    fixed_runners,
    longest,
    moving_runners,
)
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.front_panel import FrontMaker
from artgen.generators.kit.handle import STYLES, Handle
from artgen.generators.kit.stand import STANDS, Stand
from artgen.geometry.solid import Solid, slab, union

WOOD = Stock(surface="wood", density=700.0)
METAL = Stock(surface="metal", density=7850.0, edge=0.0)
MAKER = FrontMaker(
    stock=WOOD,
    pane=Stock(surface="glass", density=2500.0, edge=0.0),
    thickness=0.02,
    frame=0.06,
    pitch=0.04,
    bars=2,
    grain="z",
)
FRONT = Rect(x0=-0.3, x1=0.15, z0=0.2, z1=0.8)
FACE = [[-0.3, 0.08, 0.2], [0.15, 0.1, 0.8]]
"""Bounds of a front over FRONT whose rear lies at y = 0.1."""


def bounds_of(bodies: tuple[Body, ...]) -> np.ndarray:
    boxes = np.array([body.solid.bounds for body in bodies])
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


@pytest.mark.parametrize("style", ["slab", "shaker", "grooved", "fluted", "glass", "louvred"])
def test_fronts_fill_their_rectangle_and_bodies_do_not_overlap(style: str) -> None:
    bodies = MAKER.front(style, FRONT, 0.1)
    assert bounds_of(bodies) == pytest.approx(np.array(FACE), abs=1e-9)
    for a, b in itertools.combinations(bodies, 2):
        assert (a.solid & b.solid).volume <= 1e-15
    contact = union(piece for body in bodies for piece in body.collision)
    assert contact.bounds == pytest.approx(np.array(FACE))


@pytest.mark.parametrize("style", ["shaker", "glass", "louvred"])
def test_fronts_too_low_for_a_frame_are_slabs(style: str) -> None:
    (body,) = MAKER.front(style, Rect(x0=0.0, x1=0.5, z0=0.0, z1=0.15), 0.0)
    assert body.solid.volume == pytest.approx(0.5 * 0.15 * 0.02)


@pytest.mark.parametrize("edge", ["left", "right", "top"])
def test_milled_grips_are_hidden_behind_the_face(edge: str) -> None:
    """Fingers find 17 mm of pocket behind the lip, and the rear stays whole for the box."""
    (body,) = MAKER.milled(FRONT, 0.1, edge)
    assert body.solid.bounds == pytest.approx(np.array(FACE), abs=1e-12)
    ahead = {"top": (-0.075, 0.089, 0.8 - 0.035), "left": (-0.3 + 0.035, 0.089, 0.5)}
    ahead["right"] = (0.15 - 0.035, 0.089, 0.5)
    finger = np.array(ahead[edge])
    assert (_ball(0.004).at(*finger) & body.solid).is_empty


def _ball(size: float) -> Solid:
    return slab((-size / 2,) * 3, (size / 2,) * 3)


@pytest.mark.parametrize("edge", ["left", "right", "top"])
def test_cut_outs_open_at_their_edge(edge: str) -> None:
    at = -0.075 if edge == "top" else 0.5
    (body,) = MAKER.cut_out(FRONT, 0.1, edge, at)
    x = {"left": -0.295, "right": 0.145, "top": at}[edge]
    z = 0.795 if edge == "top" else at
    assert (_ball(0.006).at(x, 0.09, z) & body.solid).is_empty
    assert body.solid.volume > 0.98 * 0.45 * 0.6 * 0.02


handles = st.builds(
    Handle,
    style=st.sampled_from(sorted(STYLES)),
    length=st.sampled_from([0.064, 0.128, 0.32]),
    radius=st.floats(0.0045, 0.0065),
    standoff=st.floats(0.024, 0.034),
)


@settings(deadline=None, max_examples=30)
@given(handles, st.sampled_from(["x", "z"]))
def test_handles_stand_on_the_face_and_are_as_large_as_they_say(handle: Handle, way: str) -> None:
    body = handle.at(0.1, -0.2, 0.5, way, METAL)
    lower, upper = body.solid.bounds
    along = 0 if way == "x" else 2
    assert len(body.solid.pieces()) == 1
    assert upper[1] == pytest.approx(-0.2, abs=1e-6)
    # Bars are polygons whose corners or sides reach their radius within 12 %.
    assert -0.2 - lower[1] == pytest.approx(handle.reach, abs=0.12 * handle.radius + 1e-6)
    assert (upper - lower)[along] == pytest.approx(handle.span, abs=0.3 * handle.radius)
    for piece in body.collision:
        assert (piece.bounds[0] >= lower - 0.002).all()
        assert (piece.bounds[1] <= upper + 0.002).all()


@pytest.mark.parametrize("runner", ["metal", "wood"])
def test_runners_keep_their_play_over_the_travel_and_stop_behind(runner: str) -> None:
    opening = Rect(x0=-0.25, x1=0.25, z0=0.3, z1=0.5)
    box = DrawerBox(opening=opening, front=-0.2, length=0.4, wall=0.015, runner=runner)
    moving = [b.solid for b in (*drawer_box(box, WOOD, WOOD), *moving_runners(box, METAL))]
    fixed = [b.solid for b in fixed_runners(box, METAL, WOOD)]
    for q in (0.0, 0.1, 0.35):
        gaps = [
            m.at(0.0, -q, 0.0).manifold.min_gap(f.manifold, 0.01) for m in moving for f in fixed
        ]
        assert min(gaps) >= min(PLAY, 0.0012) - 1e-12
    pushed = [m.at(0.0, 2.0 * PLAY, 0.0) & f for m in moving for f in fixed]
    assert sum(shared.volume for shared in pushed) > 1e-8


def test_runners_come_in_lengths_that_are_sold() -> None:
    assert longest(0.437) == pytest.approx(0.40)
    assert longest(0.40) == pytest.approx(0.40)
    assert longest(0.05) == LENGTHS[0]


@settings(deadline=None)
@given(
    st.floats(0.2, 1.8),
    st.lists(st.floats(0.0, 1.8), max_size=4).map(tuple),
)
def test_hinges_are_enough_and_on_the_door(height: float, shelves: tuple[float, ...]) -> None:
    heights = hinge_heights(0.1, 0.1 + height, taken=shelves)
    assert len(heights) >= 2 + (height > 0.9)
    assert all(0.1 < z < 0.1 + height for z in heights)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_hinge_halves_stay_apart_while_they_turn(sign: float) -> None:
    cup = cup_hinge(
        edge=0.0, jamb=sign * 0.016, sign=sign, back=0.02, face=0.022, z=0.5, stock=METAL
    )
    butt = butt_hinge(jamb=0.0, gap=0.0026, sign=sign, face=0.0, z=0.5, stock=METAL)
    for hinge, pivot in ((cup, (0.0, 0.0, 0.0)), (butt, (sign * 0.0013, -AXIS_AHEAD, 0.0))):
        for q in np.linspace(0.0, 1.9, 12):
            for door, base in itertools.product(hinge.door, hinge.base):
                turned = door.solid.turned("z", -sign * float(q), about=pivot)
                assert turned.manifold.min_gap(base.solid.manifold, 0.01) >= 0.001 - 1e-9


@pytest.mark.parametrize("name", sorted(STANDS))
@pytest.mark.parametrize("width", [0.45, 1.8])
def test_stands_fill_the_height_under_the_body(name: str, width: float) -> None:
    stand = Stand(
        width=width, front=-0.2, back=0.2, height=0.16, inset=0.06, splay=0.03, girth=0.035
    )
    bodies = STANDS[name](stand, WOOD, METAL)
    lower, upper = bounds_of(bodies)
    assert upper[2] == pytest.approx(0.16, abs=1e-9)
    assert abs(lower[2]) < 0.0006  # Bent rods touch the floor with a polygon's side or corner.
    assert (np.abs([lower[0], upper[0]]) <= width / 2.0 + 1e-9).all()
    assert lower[1] >= -0.2 - 1e-9
    assert upper[1] <= 0.2 + 1e-9


def test_shelves_lie_in_rows_of_pin_holes() -> None:
    room = Rect(x0=0.0, x1=0.5, z0=0.1, z1=1.5)
    rows = np.array([(z - 0.1) / 0.032 for z in shelf_heights(room, 0.3)])
    assert len(rows) == 4
    assert np.abs(rows - rows.round()).max() < 1e-9
    assert shelf_heights(Rect(x0=0.0, x1=0.5, z0=0.0, z1=0.25), 0.3) == ()


def test_empty_boards_are_refused() -> None:
    with pytest.raises(GeometryError, match="empty"):
        WOOD.board((0.0, 0.0, 0.0), (0.5, 0.0, 0.018))


def test_bars_are_centered_between_their_screws() -> None:
    handle = Handle(style="bar", length=0.128, radius=0.005, standoff=0.03)
    body = handle.at(0.0, 0.0, 0.0, "x", METAL)
    assert body.solid.bounds[:, 0].sum() == pytest.approx(0.0, abs=1e-12)
    assert math.isclose(body.solid.extent[0], handle.span)


def test_basins_are_open_and_stand_on_their_place() -> None:
    bowl, waste = basin((0.5, 0.35, 0.12), (0.1, 0.0, 0.8), WOOD, METAL)
    room = slab((-0.09, -0.11, 0.825), (0.29, 0.11, 0.95))
    assert bowl.solid.bounds[0] == pytest.approx([-0.15, -0.175, 0.8])
    assert (room & union([bowl.solid, waste.solid, *bowl.collision])).is_empty
    pipe = tap((0.1, 0.2, 0.8), rise=0.25, reach=0.15, metal=METAL)
    assert len(pipe.solid.pieces()) == 1
    assert (pipe.solid & bowl.solid).is_empty
