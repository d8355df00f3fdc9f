"""Vessels, round walls and bails: closed forms of volume, rooms that stay open, hoops that rest."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.mesh import Floats
from artgen.generators.kit.bail import FALL, Bail, lying
from artgen.generators.kit.round_wall import BULGE, KEPT, offset_inwards, revolved_shell, wall_ring
from artgen.generators.kit.vessel import CORNERS_OUT, ROUND_WEDGES, Ring, Vessel
from artgen.geometry.solid import union, wire

radii = st.floats(0.05, 0.25)
heights = st.floats(0.08, 0.4)
walls = st.floats(0.0006, 0.004)


def polygon_area(radius: float, corners: int) -> float:
    """Of a regular polygon whose corners lie on a circle, m2."""
    return corners / 2.0 * radius**2 * math.sin(2.0 * math.pi / corners)


def round_vessel(radius: float, height: float, wall: float) -> Vessel:
    """Upright and round, its floor twice as thick as its wall."""
    rings = tuple(Ring(z=z, half=(radius, radius)) for z in (0.0, 0.4 * height, height))
    return Vessel(rings=rings, wall=wall, floor=2.0 * wall)


@settings(deadline=None, max_examples=25)
@given(radius=radii, height=heights, wall=walls)
def test_a_round_shell_weighs_what_two_prisms_differ_by(
    radius: float, height: float, wall: float
) -> None:
    vessel = round_vessel(radius, height, wall)
    outer, inner = (polygon_area(r, vessel.segments) for r in (radius, radius - wall))
    expected = outer * height - inner * (height - 2.0 * wall)
    # Differences of volumes up to 0.1 m3 lose 1e-16 of them; shells hold 1e-5 m3 and more.
    assert vessel.shell().volume == pytest.approx(expected, rel=1e-9)


@settings(deadline=None, max_examples=25)
@given(radius=radii, height=heights, wall=walls)
def test_a_revolved_shell_of_an_upright_profile_is_the_same_vessel(
    radius: float, height: float, wall: float
) -> None:
    shell = revolved_shell([(radius, 0.0), (radius, height)], wall, floor=2.0 * wall, segments=40)
    same = round_vessel(radius, height, wall).shell()
    # manifold3d rounds outlines to 1e-8 m, on both sides of a wall.
    assert shell.volume == pytest.approx(same.volume, rel=2e-8 / wall)


@settings(deadline=None, max_examples=25)
@given(foot=radii, mouth=radii, height=heights, wall=walls)
def test_profiles_move_inwards_square_to_themselves(
    foot: float, mouth: float, height: float, wall: float
) -> None:
    outer = np.array([(foot, 0.0), (mouth, height)])
    along = (outer[1] - outer[0]) / np.linalg.norm(outer[1] - outer[0])
    moved = offset_inwards(outer, wall) - outer
    np.testing.assert_allclose(moved @ along, 0.0, atol=1e-15)
    np.testing.assert_allclose(moved @ (-along[1], along[0]), wall, rtol=1e-12)


@settings(deadline=None, max_examples=25)
@given(radius=radii, wall=walls)
def test_wedges_of_a_round_wall_take_circular_segments_at_most(radius: float, wall: float) -> None:
    """Their inner faces are chords whose corners lie outside of the room, so what they take of it
    is ten circular segments, less where the plates are thinner than those are high."""
    rings = tuple(Ring(z=z, half=(radius, radius)) for z in (0.0, 0.3))
    vessel = Vessel(rings=rings, wall=wall, floor=0.002, segments=120)
    wedges, room = vessel.wall_collision(), vessel.inside()
    out = CORNERS_OUT[ROUND_WEDGES] * radius
    inner = radius - wall
    half = math.acos((inner + out) * math.cos(math.pi / ROUND_WEDGES) / inner)
    segments = ROUND_WEDGES * (half - math.sin(half) * math.cos(half)) / math.pi
    taken = (room & union(wedges)).volume / (room & vessel.outside()).volume
    # The room has 120 corners, so its area is 2 pi^2 / (3 * 120^2) less than a circle's.
    assert taken <= segments * (1.0 + 5e-4) + 1e-9
    corners = np.concatenate([wedge.trimesh().vertices for wedge in wedges])
    assert np.hypot(*corners[:, :2].T).max() <= radius + out + 0.0015


@settings(deadline=None, max_examples=25)
@given(radius=radii, wall=walls)
def test_wedges_of_a_wall_with_corners_leave_the_room_open(radius: float, wall: float) -> None:
    rings = tuple(Ring(z=z, half=(radius, 0.8 * radius), power=5.0) for z in (0.0, 0.3))
    vessel = Vessel(rings=rings, wall=wall, floor=0.002, segments=120)
    taken = vessel.inside() & union(vessel.wall_collision())
    assert taken.volume <= 0.03 * (vessel.inside() & vessel.outside()).volume


@settings(deadline=None, max_examples=25)
@given(radius=radii, wall=walls, height=heights, taper=st.floats(0.7, 1.0))
def test_contact_rings_leave_what_they_state_open(
    radius: float, wall: float, height: float, taper: float
) -> None:
    levels = [(0.0, taper * (radius - wall), taper * radius), (height, radius - wall, radius)]
    pieces = wall_ring(levels)
    mid = taper + (1.0 - taper) / 2.0
    for share, (z, inner, _) in zip((taper, mid, 1.0), [levels[0], (height / 2.0, 0.0, 0.0),
                                                        levels[1]], strict=True):  # fmt: skip
        inner = share * (radius - wall) if inner == 0.0 else inner
        corners = np.concatenate([piece.trimesh().vertices for piece in pieces])
        at_level = corners[np.abs(corners[:, 2] - z) < 1e-9]
        if len(at_level):
            reach = np.hypot(*at_level[:, :2].T)
            assert reach.max() <= share * radius + BULGE + 1e-9
            count = len(pieces)
            least = np.sort(reach)[: 2 * count].min()
            area = polygon_area(float(least), count)
            # Thin walls cap how far chords may stand out, so a piece never leaves its bulge.
            assert area >= min(KEPT, polygon_area(share * radius, count) / math.pi
                               / (share * radius) ** 2) * math.pi * inner**2 * 0.99  # fmt: skip


def rim(radius: float, z: float) -> Floats:
    """(60, 3) a circle at a height."""
    angle = 2.0 * math.pi * np.arange(60) / 60
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(60, z)], axis=1)


@pytest.mark.parametrize("reach", [0.10, 0.12, 0.135])
def test_a_bail_falls_until_its_hoop_meets_the_rim(reach: float) -> None:
    """The hoop at rest clears the rim's bead; 2 degrees lower it runs into it."""
    bail = Bail(span=0.150, reach=reach, height=0.24, wire=0.002, grip=None, grip_length=0.08)
    line, bead = rim(0.14, 0.255), 0.003
    angle = bail.rest(line, bead, side=-1.0)
    ring, hoop = wire(line, bead, sides=16, closed=True), bail.hoop(hook=0.001)
    assert (lying(hoop, bail, angle) & ring).is_empty
    assert not (lying(hoop, bail, angle - FALL) & ring).is_empty
