"""The algebra against closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from artgen.core.errors import GeometryError
from artgen.geometry.measure import open_edges, total_volume
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import (
    box,
    chamfered_box,
    cone,
    cylinder,
    hull,
    prism,
    revolve,
    slab,
    tube,
    union,
    wire,
)

SIDES = st.tuples(*[st.floats(0.01, 2.0)] * 3)
PLACES = st.tuples(*[st.floats(-2.0, 2.0)] * 3)
EXACT = {"rtol": 1e-12}
"""A volume is a sum of some hundred float64 products of meter-sized numbers: 100 * 2.2e-16."""


@given(SIDES, PLACES)
def test_a_box_has_its_volume_and_stands_where_it_was_put(size: tuple, at: tuple) -> None:
    solid = box(size, at=at)
    assert_allclose(solid.volume, math.prod(size), rtol=1e-9)  # sides are differences of corners
    assert_allclose(solid.bounds[0], np.array(at) - (size[0] / 2, size[1] / 2, 0), atol=1e-14)


@given(SIDES, PLACES, PLACES)
def test_inclusion_and_exclusion(size: tuple, here: tuple, there: tuple) -> None:
    a, b = box(size, at=here), box(size, at=there)
    assert_allclose((a | b).volume, a.volume + b.volume - (a & b).volume, rtol=1e-9, atol=1e-12)
    assert_allclose((a - b).volume, a.volume - (a & b).volume, rtol=1e-9, atol=1e-12)


@given(SIDES, st.floats(-7, 7), st.sampled_from("xyz"), PLACES)
def test_turning_and_mirroring_keep_volume_and_orientation(size, angle, axis, about) -> None:
    solid = box(size).turned(axis, angle, about=about).mirrored(axis)
    assert_allclose(solid.volume, math.prod(size), rtol=1e-9)
    assert total_volume(solid.trimesh()) > 0.0


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_round_bars_lie_along_their_axis_with_a_polygon_s_volume(axis: str) -> None:
    sides = 24
    area = 0.5 * sides * 0.1**2 * math.sin(2 * math.pi / sides)
    bar = cylinder(0.1, 0.7, axis=axis, segments=sides)
    assert_allclose(bar.volume, area * 0.7, **EXACT)
    assert_allclose(bar.bounds[:, "xyz".index(axis)], [0.0, 0.7], atol=1e-15)
    pipe = tube(0.1, 0.05, 0.7, axis=axis, segments=sides)
    assert_allclose(pipe.volume, 0.75 * bar.volume, **EXACT)


def test_a_turned_profile_agrees_with_the_bar_and_the_cone() -> None:
    outline = [(0.0, 0.0), (0.1, 0.0), (0.05, 0.3), (0.0, 0.3)]
    lathe, taper = revolve(outline, segments=32), cone(0.1, 0.05, 0.3, segments=32)
    # The outline is rounded to 1e-8 m: 2 * 0.5e-8 / 0.05 of the radius, and 0.5e-8 / 0.3 of height.
    assert_allclose(lathe.volume, taper.volume, rtol=3e-7)


@given(st.floats(0.001, 0.04))
def test_a_chamfered_box_loses_twelve_prisms_and_counts_corners_once(cut: float) -> None:
    """Each edge loses a triangle of cut^2/2 along it; at a corner three of them meet: the classic
    result is V = abc - 2 cut^2 (a + b + c) + (16/3) cut^3."""
    a, b, c = 0.1, 0.2, 0.3
    expected = a * b * c - 2 * cut**2 * (a + b + c) + 16 / 3 * cut**3
    assert_allclose(chamfered_box((a, b, c), cut).volume, expected, rtol=1e-10)


def test_wires_weigh_what_round_wire_weighs() -> None:
    """The section's area equals the circle's, and mitres keep length along the axis: V = pi r^2
    L."""
    path = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)]
    assert_allclose(wire(path, 0.01).volume, math.pi * 1e-4 * 3.0, rtol=1e-12)
    ring = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    assert_allclose(wire(ring, 0.01, closed=True, sides=8).volume, math.pi * 1e-4 * 4, rtol=1e-12)


def test_every_shape_is_closed_and_outward() -> None:
    shapes = [
        box((1, 2, 3)) - cylinder(0.3, 3),
        prism(rounded_rectangle(1.0, 0.5, 0.1), 0.2, holes=[rounded_rectangle(0.5, 0.2, 0.05)]),
        wire([(0, 0, 0), (1, 0, 0), (1, 1, 0)], 0.05),
        hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]),
        union([box((1, 1, 1)), box((1, 1, 1), at=(0.5, 0.5, 0.5))]),
    ]
    for shape in shapes:
        mesh = shape.trimesh()
        assert open_edges(mesh.faces) == 0
        assert_allclose(total_volume(mesh), shape.volume, **EXACT)


def test_empty_shapes_are_refused_with_their_numbers() -> None:
    with pytest.raises(GeometryError, match="upper must exceed lower"):
        slab((0, 0, 0), (1, 0, 1))
    with pytest.raises(GeometryError, match="height must be positive"):
        prism([(0, 0), (1, 0), (0, 1)], 0.0)
    with pytest.raises(GeometryError, match="corner radius 0.3"):
        rounded_rectangle(0.5, 0.5, 0.3)
    with pytest.raises(GeometryError, match="chamfer"):
        chamfered_box((1, 1, 0.1), 0.05)
