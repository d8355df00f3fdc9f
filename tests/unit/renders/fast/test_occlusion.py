"""What is in the way of light: nothing outside, everything inside, and one side beside a wall."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from artgen.core.mesh import Floats
from artgen.geometry.solid import box
from artgen.render_job import LightRig
from renders.fast.filtered import Blur
from renders.fast.light import Shine, shine
from renders.fast.occlusion import AROUND, SHARE, Occlusion, occlusion, strewn, swept
from renders.fast.scenes import occlusions, scene_of
from tests.unit.renders.fast.made import DARK, EVEN, lamp, shot, skin


@pytest.fixture(scope="module")
def even() -> Shine:
    return shine(LightRig(name="even", lights=(), sky=EVEN), Blur())


def at(found: Occlusion, image: Floats, point: tuple[float, float, float]) -> Floats:
    """What the cell at a point holds."""
    x, y, z = ((np.array(point) - found.low) / found.cell).astype(int)
    return image[z, y, x]


@pytest.mark.parametrize("size", [(0.5, 0.5, 0.5), (1.8, 0.4, 0.4), (0.3, 0.2, 1.9)])
def test_a_closed_box_is_dark_inside_and_open_outside(
    even: Shine, size: tuple[float, float, float]
) -> None:
    """The bug: points 1/48 of the length apart left holes in grids with finer cells, so long
    cabinets were lit through their walls. A sheet of a cell stops 53 to 99 %, as 3 to 6 points fall
    into it; only exactly along the diagonal of a box light may slip through its edge."""
    block = skin(box(size), "block", "gray")
    for pixels in (64, 256):
        (found,) = occlusions([block], [shot()], [{"block": np.eye(4)}], even, size=pixels).values()
        assert np.median(found.sky[4:-4, 4:-4, 4:-4, 0]) < 0.2
        assert found.sky[0, 0, 0, 0] > 0.6


def test_a_wall_hides_the_sky_behind_it(even: Shine) -> None:
    """In front of a wall that faces -y, no light comes from +y: the gradient points to -y, and half
    of the sky is left."""
    wall = skin(box((1.0, 0.05, 1.0)), "wall", "gray")
    cloud = strewn(wall.vertices[wall.faces], 0.01)
    (found,) = occlusion([cloud], even, cells=32**3)
    mean, x, y, z = at(found, found.sky, (0.0, -0.04, 0.5))
    assert 0.4 < mean < 0.7
    assert y < -0.1
    assert abs(x) < 0.05
    assert abs(z) < 0.05


def test_a_roof_hides_a_lamp_above_it_and_none_below() -> None:
    roof = skin(box((1.0, 1.0, 0.05)), "roof", "gray")
    lamps = (lamp((0.0, 0.0, 4.0), (0.0, 0.0, 0.0), 1.0), lamp((0.0, 0.0, -4.0), (0, 0, 0), 1.0))
    light = shine(LightRig(name="two", lights=lamps, sky=DARK), Blur())
    (found,) = occlusion([strewn(roof.vertices[roof.faces], 0.01)], light, cells=32**3)
    above, below = at(found, found.lights, (0.0, 0.0, -0.03))[:2]
    assert above < 0.25
    assert below > 0.99


@given(st.integers(0, 13), st.integers(0, 2**32 - 1))
def test_sweeps_keep_light_between_none_and_all(direction: int, seed: int) -> None:
    """Shares are products and means of numbers in [0, 1], and a clear grid stops nothing."""
    opaque = np.random.default_rng(seed).random((2, 5, 6, 7), np.float32)
    arrived = swept(opaque, AROUND[direction])
    assert arrived.shape == opaque.shape
    assert arrived.min() >= 0.0
    assert arrived.max() <= 1.0 + 1e-6
    assert (swept(np.zeros_like(opaque), AROUND[direction]) == 1.0).all()


def test_a_sweep_along_an_axis_is_the_product_on_the_way() -> None:
    opaque = np.zeros((1, 3, 4, 5), np.float32)
    opaque[0, 1, 2, 3] = 0.75
    arrived = swept(opaque, np.array([1.0, 0.0, 0.0]))
    assert (arrived[0, 1, 2, :3] == 0.25).all()
    assert (arrived[0, 1, 2, 3:] == 1.0).all()
    assert (np.delete(arrived[0], 2, axis=1) == 1.0).all()


def test_the_directions_are_a_quadrature_of_degree_five() -> None:
    """Mean of x^4 over the sphere is 1/5, of x^2 y^2 1/15, of odd powers 0."""
    x, y, z = AROUND.T
    assert SHARE.sum() == pytest.approx(1.0)
    assert (SHARE * x**4).sum() == pytest.approx(1 / 5)
    assert (SHARE * x**2 * y**2).sum() == pytest.approx(1 / 15)
    assert (SHARE * x**3 * z**2).sum() == pytest.approx(0.0)


def test_points_carry_the_area_of_their_triangles() -> None:
    block = skin(box((0.5, 0.3, 0.4)), "block", "gray")
    cloud = strewn(block.vertices[block.faces], 0.02)
    assert cloud.areas.sum() == pytest.approx(2 * (0.5 * 0.3 + 0.3 * 0.4 + 0.4 * 0.5))
    assert (cloud.points.min(axis=1) >= block.vertices.min(axis=0)).all()
    assert (cloud.points.max(axis=1) <= block.vertices.max(axis=0)).all()


def test_scenes_are_shared_by_views_and_by_states_in_which_a_part_rests() -> None:
    rest, moved = np.eye(4), np.eye(4)
    moved[0, 3] = 0.1
    poses = [{"a": rest, "b": rest}, {"a": rest, "b": moved}]
    whole = [scene_of(shot(), poses[t : t + 1]) for t in range(2)]
    alone = [scene_of(shot(part="a"), poses[t : t + 1]) for t in range(2)]
    assert whole[0] != whole[1]
    assert alone[0] == alone[1]
