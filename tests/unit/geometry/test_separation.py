"""A proof of separation is never wrong; cutting bodies to where they can meet changes no volume."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import rigid
from artgen.geometry import clearance
from artgen.geometry.clearance import Mover, overlaps, shape_of_solids
from artgen.geometry.separation import (
    CLUSTER,
    SPREAD,
    carried,
    curve_index,
    inverted_poses,
    may_meet,
    surface_of,
)
from artgen.geometry.solid import Solid, cylinder, slab, tube, union
from tests.strategies import axes

Triple = tuple[float, float, float]
places = st.tuples(*[st.floats(-0.25, 0.25)] * 3)


def rack() -> Solid:
    """Three long wires on two cross wires."""
    long = [cylinder(0.003, 0.3, axis="x", segments=12).at(-0.15, y) for y in (-0.1, 0.0, 0.1)]
    cross = [cylinder(0.003, 0.22, axis="y", segments=12).at(x, -0.11) for x in (-0.14, 0.14)]
    return union([*long, *cross])


def tub() -> Solid:
    """A box open at the top."""
    return slab((-0.2, -0.2, -0.1), (0.2, 0.2, 0.2)) - slab(
        (-0.17, -0.17, -0.08), (0.17, 0.17, 0.3)
    )


def pipe() -> Solid:
    """A round tube along x."""
    return tube(0.1, 0.09, 0.2, axis="x", segments=48)


bodies = st.sampled_from([rack, pipe]).map(lambda make: make())


@st.composite
def paths(draw: st.DrawFn) -> Floats:
    """(5, 4, 4) poses along a straight line, under one rotation."""
    turn = axis_angle_matrix(draw(axes()), draw(st.floats(-3.0, 3.0)))
    start, end = np.array(draw(places)), np.array(draw(places))
    return np.array([rigid(turn, start + s * (end - start)) for s in np.linspace(0.0, 1.0, 5)])


@settings(deadline=None, max_examples=60)
@given(path=paths(), first=bodies)
def test_bodies_that_cross_are_never_proven_apart(path: Floats, first: Solid) -> None:
    """Unless one contains the other; a rack in the hollow of a tub does neither."""
    other = tub()
    one, two = surface_of(first.trimesh().triangles), surface_of(other.trimesh().triangles)
    meeting = may_meet(one, two, path)
    for pose, may in zip(path, meeting, strict=True):
        shared = (first.transformed(pose) & other).volume
        if 1e-12 < shared < first.volume * (1.0 - 1e-9):
            assert may


def test_a_rack_that_slides_in_its_tub_is_proven_apart() -> None:
    path = np.array([rigid(np.eye(3), (0.0, 0.0, z)) for z in np.linspace(0.0, 0.2, 21)])
    one, other = surface_of(rack().trimesh().triangles), surface_of(tub().trimesh().triangles)
    assert not may_meet(one, other, path).any()
    assert not may_meet(other, one, inverted_poses(path)).any()


@settings(deadline=None, max_examples=40)
@given(path=paths(), first=bodies)
def test_proofs_and_cuts_change_no_volume(path: Floats, first: Solid) -> None:
    """Cut faces are new vertices: roundings of 1e-16 m over less than 1 m2 of surface."""
    still, other = np.repeat(np.eye(4)[None], len(path), axis=0), tub()
    movers = [
        Mover(name="a", shape=shape_of_solids([first]), poses=path),
        Mover(name="b", shape=shape_of_solids([other]), poses=still),
    ]
    expected = [(first.transformed(pose) & other).volume for pose in path]
    found = np.zeros(len(path))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(clearance, "WORTH_A_PROOF", 0)
        patch.setattr(clearance, "WORTH_A_CUT", 1)
        for overlap in overlaps(movers):
            found[overlap.pose] += overlap.volume
    np.testing.assert_allclose(found, expected, rtol=0, atol=2 * clearance.NEGLIGIBLE)


def test_a_body_that_starts_inside_another_is_found_without_contact() -> None:
    """Nothing touches, so only the boolean at the first pose can see it."""
    small = slab((0.18, 0.0, 0.0), (0.19, 0.01, 0.01))
    movers = [
        Mover(name=name, shape=shape_of_solids([solid]), poses=np.eye(4)[None])
        for name, solid in (("a", small), ("b", tub()))
    ]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(clearance, "WORTH_A_PROOF", 0)
        (found,) = overlaps(movers)
    assert found.volume == pytest.approx(1e-6, rel=1e-9)


@settings(deadline=None)
@given(path=paths())
def test_carried_boxes_hold_their_carried_corners(path: Floats) -> None:
    box = np.array([[[-0.1, -0.2, 0.0], [0.1, 0.05, 0.3]]])
    corners = np.array(np.meshgrid(*box[0].T)).reshape(3, -1).T
    for pose, (lower, upper) in zip(path, carried(path, box)[:, 0], strict=True):
        moved = corners @ pose[:3, :3].T + pose[:3, 3]
        np.testing.assert_allclose(moved.min(axis=0), lower, rtol=0, atol=1e-15)
        np.testing.assert_allclose(moved.max(axis=0), upper, rtol=0, atol=1e-15)


@settings(deadline=None)
@given(path=paths())
def test_inverted_poses_undo(path: Floats) -> None:
    np.testing.assert_allclose(
        inverted_poses(path) @ path, np.repeat(np.eye(4)[None], 5, axis=0), rtol=0, atol=1e-15
    )


def test_neighbors_share_a_cluster() -> None:
    """The curve keeps the sum of the clusters' sizes far below that of a random order."""
    sphere = union([pipe(), pipe().turned("z", 1.0)]).trimesh().triangles
    shuffled = sphere[np.random.Generator(np.random.PCG64(0)).permutation(len(sphere))]
    starts = np.arange(0, len(shuffled), CLUSTER)
    lower = np.minimum.reduceat(shuffled.min(axis=1), starts)
    upper = np.maximum.reduceat(shuffled.max(axis=1), starts)
    clusters = surface_of(shuffled).clusters
    assert np.diff(clusters, axis=1).sum() < 0.7 * (upper - lower).sum()


def test_spread_interleaves_bits() -> None:
    assert [int(SPREAD[k]) for k in (0, 1, 2, 3, 127)] == [0, 1, 8, 9, int("001" * 7, 2)]
    corners = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    assert np.argsort(curve_index(corners)).tolist() == list(range(8))
