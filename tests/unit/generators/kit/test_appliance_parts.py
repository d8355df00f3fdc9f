"""Handles, consoles, seals, tubs, cabinets and spray arms of appliances."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.surface import SurfaceSpec, linear_color
from artgen.generators.kit.appliance_cabinet import Cabinet, kick_plate, shell
from artgen.generators.kit.appliance_handle import bar_handle, grip_groove, pocket_room
from artgen.generators.kit.control_console import (
    ConsoleStyle,
    PanelPlane,
    console_controls,
    hex_color,
    printed,
)
from artgen.generators.kit.cutlery_basket import cup_shelf, cutlery_basket, cutlery_comb
from artgen.generators.kit.gasket import opening_gasket
from artgen.generators.kit.spray_arm import spray_arm, swept_collision
from artgen.generators.kit.washing_tub import Tub, filter_cup, tub_solid
from artgen.geometry.solid import cylinder, slab

PLAIN = SurfaceSpec(name="fascia", recipe="plain")
TUB = Tub(
    half_width=0.27,
    floor=0.15,
    ceiling=0.79,
    depth=0.5,
    wall=0.0025,
    corner=0.03,
    beads=3,
    beads_upright=True,
)


@given(st.booleans(), st.floats(0.1, 0.28), st.floats(0.010, 0.018))
@settings(deadline=None, max_examples=20)
def test_a_hand_fits_behind_a_bar(flat: bool, half: float, thickness: float) -> None:
    bar = bar_handle(half_length=half, y=-0.06, z=0.7, stand=0.03, thickness=thickness, flat=flat)
    hand = slab((-0.05, -0.0895, 0.66), (0.05, -0.0605, 0.74))
    assert (bar & hand).is_empty
    assert len(bar.pieces()) == 1
    assert bar.bounds[1, 1] == pytest.approx(-0.06)


def test_a_pocket_is_lined_and_open_to_the_front() -> None:
    room, cup = pocket_room(half_length=0.1, y=-0.06, low=0.6, high=0.65, depth=0.026, wall=0.0022)
    assert (cup - room).volume < 1e-15
    fingers = slab((-0.05, -0.07, 0.61), (0.05, -0.04, 0.64))
    assert (cup & fingers).is_empty
    assert cup.volume < 0.4 * room.volume


def test_a_grip_groove_is_undercut() -> None:
    groove = grip_groove(half_length=0.3, y=-0.06, low=0.6, high=0.626, depth=0.022)
    behind_lip = slab((-0.1, -0.048, 0.627), (0.1, -0.04, 0.631))
    lip = slab((-0.1, -0.0598, 0.627), (0.1, -0.0535, 0.631))
    assert (groove & behind_lip).volume == pytest.approx(behind_lip.volume)
    assert (groove & lip).is_empty


panels = st.tuples(st.floats(0.43, 0.60), st.floats(0.032, 0.13))
styles = st.builds(
    ConsoleStyle,
    style=st.sampled_from(["buttons", "knob", "touch"]),
    buttons=st.integers(4, 5),
    display=st.booleans(),
    brand=st.integers(0, 7),
    words=st.just("1:25"),
    led=st.just("white"),
)


@given(panels, styles)
@settings(deadline=None, max_examples=60)
def test_controls_lie_apart_on_their_panel(size: tuple[float, float], style: ConsoleStyle) -> None:
    layout = style.layout(size)
    spots = [layout.power, *layout.buttons]
    spots += [spot for spot in (layout.display, layout.knob) if spot is not None]
    boxes = np.array(
        [
            (
                np.subtract(s.center, np.multiply(0.5, s.size)),
                np.add(s.center, np.multiply(0.5, s.size)),
            )
            for s in spots
        ]
    )
    assert boxes.min() > 0.0
    assert (boxes[:, 1] < size).all()
    for i, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:i]:
            assert (np.minimum(high, other_high) <= np.maximum(low, other_low)).any()


def test_controls_stand_on_the_panel_and_the_display_is_lit() -> None:
    plane = PanelPlane(
        origin=(-0.3, -0.06, 0.7), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=(0.6, 0.11)
    )
    style = ConsoleStyle(style="buttons", buttons=5, display=True, brand=0, words="1:25", led="red")
    bodies, surfaces = console_controls(plane, style, trim=PLAIN)
    assert len(bodies) == 1 + 5 + 1
    for body in bodies:
        assert body.solid.bounds[1, 1] == pytest.approx(-0.06)  # They touch the panel's face
        assert body.solid.bounds[0, 1] < -0.06  # and stand out towards the front.
    (display,) = surfaces
    assert display.emission > 0.0
    assert bodies[-1].decal is not None
    assert bodies[-1].decal.size == display.tile


@given(st.integers(0, 0xFFFFFF))
def test_hex_colors_survive_the_way_through_linear_light(value: int) -> None:
    text = f"#{value:06x}"
    assert hex_color(linear_color(text)) == text


def test_print_contrasts_with_its_ground() -> None:
    style = ConsoleStyle(style="touch", buttons=5, display=False, brand=0, words="1:25", led="red")
    for ground in ("#0d0d0e", "#efefeb", "#3a3c3f", "#c2c3c2"):
        face = SurfaceSpec(name="fascia", recipe="plain", color=linear_color(ground))
        ink = str(printed(face, style, (0.6, 0.1)).detail["ink"])
        bright, dark = sorted((sum(linear_color(ink)) / 3, sum(face.color) / 3), reverse=True)
        assert (bright + 0.05) / (dark + 0.05) >= 4.5  # WCAG 2.2, 1.4.3.


def test_a_gasket_leaves_the_sill_free() -> None:
    seal = opening_gasket(
        left=-0.27,
        right=0.27,
        bottom=0.15,
        top=0.8,
        corner=0.03,
        width=0.009,
        thickness=0.0025,
        front=0.0,
        surface=PLAIN,
    ).solid
    assert seal.bounds[:, 1] == pytest.approx([-0.0025, 0.0])
    mouth = slab((-0.2699, -0.01, 0.1), (0.2699, 0.01, 0.769))
    assert (seal & mouth).is_empty
    assert seal.manifold.genus() == 0  # Open below.


def test_the_tub_drains_to_its_sump() -> None:
    flange = slab((-0.297, 0.0, 0.11), (0.297, 0.022, 0.82))
    tub = tub_solid(TUB, flange=flange)
    x, y = TUB.sump
    well = cylinder(0.055, 0.03, segments=24).at(x, y, TUB.floor - 0.035)
    assert (tub & well).is_empty
    assert (tub & filter_cup(TUB)).is_empty
    heights = [_ground(tub, TUB.half_width - 0.06 - d, y) for d in (0.0, 0.05, 0.1, 0.14)]
    assert heights == sorted(heights, reverse=True)
    track = slab((TUB.half_width - 0.02, 0.03, 0.151), (TUB.half_width - 0.009, 0.45, 0.2))
    assert (tub & track).is_empty


def _ground(tub: object, x: float, y: float) -> float:
    """z of the floor under a thin upright probe."""
    probe = slab((x - 1e-4, y - 1e-4, 0.05), (x + 1e-4, y + 1e-4, 0.3))
    return float((probe & tub).bounds[1, 2])  # type: ignore[operator]


def test_the_toe_recess_is_free_of_the_shell() -> None:
    cabinet = Cabinet(
        half_width=0.3, depth=0.54, foot=0.02, top=0.82, toe_height=0.11, toe_depth=0.045
    )
    toe = slab((-0.3, 0.0, 0.02), (0.3, 0.045, 0.11))
    assert (shell(cabinet) & toe).volume < 1e-15  # They touch.
    plate = kick_plate(cabinet, thickness=0.006, slots=6)
    assert plate.manifold.genus() == 6
    assert kick_plate(cabinet, thickness=0.006, slots=0).manifold.genus() == 0


@pytest.mark.parametrize("blades", [2, 3])
def test_an_arm_stays_within_its_reach(blades: int) -> None:
    arm = spray_arm(reach=0.2, blades=blades, thickness=0.011, hub=0.024, rise=0.004)
    points = arm.trimesh().vertices
    assert np.linalg.norm(points[:, :2], axis=1).max() == pytest.approx(0.2, rel=1e-3)
    again = arm.turned("z", 2.0 * math.pi / blades)
    # Nozzles and hub are polygons, whose corners move a little.
    assert (arm - again).volume < 0.01 * arm.volume
    for piece in swept_collision(reach=0.2, blades=blades, thickness=0.011, hub=0.024):
        assert np.linalg.norm(piece.trimesh().vertices[:, :2], axis=1).max() <= 0.2


def test_cutlery_holders_are_open() -> None:
    basket = cutlery_basket(length=0.225, width=0.08, height=0.115, cells=4)
    assert len(basket.pieces()) == 1
    assert basket.volume < 0.25 * np.prod(basket.extent)
    assert cup_shelf(length=0.3, width=0.09, thickness=0.004, bars=7).manifold.genus() == 7
    comb = cutlery_comb(length=0.03, width=0.4, height=0.019, teeth=10)
    assert comb.extent == pytest.approx([0.4, 0.03, 0.019])
