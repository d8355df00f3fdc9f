"""Masses of sheets by closed forms."""

import numpy as np
import pytest

from artgen.geometry.measure import inertia, moments, sheet_moments
from artgen.geometry.solid import box
from artgen.ingest.meshes.clean import Body, bodies_of, welded_soup
from artgen.ingest.meshes.soup import Look, Soup
from artgen.ingest.meshes.weigh import weighed

SQUARE = np.array([[[0, 0, 0], [2, 0, 0], [2, 1, 0]], [[0, 0, 0], [2, 1, 0], [0, 1, 0]]], float)
ROUND = 1e-12
"""A dozen sums of numbers of size 1 round by 1e-16 each."""


def test_a_sheet_weighs_like_the_plate_that_it_stands_for() -> None:
    """A plate of a by b by t: (b2 + t2) / 12 about x, (a2 + t2) / 12 about y, (a2 + b2) / 12."""
    found = sheet_moments(SQUARE, 0.1)
    plate = moments(box((2.0, 1.0, 0.1)).trimesh().triangles)
    assert found.volume == pytest.approx(0.2, rel=ROUND)
    np.testing.assert_allclose(found.center, [1.0, 0.5, 0.0], atol=ROUND)
    np.testing.assert_allclose(inertia(found.second), inertia(plate.second), atol=ROUND)


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), (100.0, -50.0, 25.0)])
def test_moments_about_the_center_do_not_move_with_the_sheet(
    shift: tuple[float, float, float],
) -> None:
    """A far origin costs digits: 1e4 times the size squared, of 1e-16 each."""
    here, there = sheet_moments(SQUARE, 0.1), sheet_moments(SQUARE + shift, 0.1)
    np.testing.assert_allclose(there.second, here.second, atol=1e-11)


def test_a_thin_closed_box_and_its_six_sheets_agree_to_the_order_of_the_thickness() -> None:
    """Six sheets of thickness t along the sides of a unit cube: mass 6 t, inertia of a hollow cube,
    5/18 m a2 = 5/3 t, and of the thickness itself m t2 / 12 (n n^T summed) at most."""
    mesh = box((1.0, 1.0, 1.0)).trimesh()
    found = sheet_moments(mesh.triangles, 1e-6)
    assert found.volume == pytest.approx(6e-6, rel=ROUND)
    expected = np.eye(3) * 5.0 / 18.0 * 6e-6
    np.testing.assert_allclose(inertia(found.second), expected, atol=1e-17)


def test_a_part_of_solids_and_sheets_is_a_rigid_body() -> None:
    mesh = box((1.0, 1.0, 1.0)).trimesh()
    vertices = np.concatenate([mesh.vertices, SQUARE.reshape(-1, 3) + 3.0])
    faces = np.concatenate([mesh.faces, [[8, 9, 10], [11, 12, 13]]])
    count = len(faces)
    soup = Soup(vertices=vertices, faces=faces, uv=np.zeros((count, 3, 2)),
                look=np.zeros(count, np.int64), looks=(Look(),))  # fmt: skip
    bodies: list[Body] = bodies_of(welded_soup(soup)[0], "leaf")[0]
    mass = weighed(bodies, density=500.0, thickness=0.004)
    assert mass.mass == pytest.approx(500.0 * (1.0 + 2.0 * 0.004), rel=ROUND)
