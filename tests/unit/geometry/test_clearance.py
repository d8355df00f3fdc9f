"""Clearance: the box filter never hides what exact booleans would find."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.mesh import Floats, TriMesh
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import rigid
from artgen.geometry.clearance import (
    NEGLIGIBLE,
    WORTH_A_CUT,
    Mover,
    Overlap,
    Shape,
    carried,
    inverted_poses,
    overlaps,
    shape_of_mesh,
    shape_of_solids,
)
from artgen.geometry.solid import Solid, cylinder, slab, tube, union
from tests.strategies import axes, mesh_of

Triple = tuple[float, float, float]
REST: Floats = np.eye(4)[None]


def cube() -> Solid:
    """10 cm a side, from the origin."""
    return slab((0.0, 0.0, 0.0), (0.1, 0.1, 0.1))


def mover(name: str, *solids: Solid, poses: Floats = REST) -> Mover:
    """A mover of some solids."""
    return Mover(name=name, shape=shape_of_solids(solids), poses=poses)


def shifts(*offsets: tuple[float, float, float]) -> Floats:
    """(K, 4, 4) translations."""
    return np.array([rigid(np.eye(3), offset) for offset in offsets])


sides = st.floats(0.01, 0.2)
places = st.floats(-0.2, 0.2)
corners = st.tuples(places, places, places)
sizes = st.tuples(sides, sides, sides)


@settings(deadline=None)
@given(low_a=corners, size_a=sizes, low_b=corners, size_b=sizes)
def test_boxes_share_the_product_of_their_common_sides(
    low_a: Triple, size_a: Triple, low_b: Triple, size_b: Triple
) -> None:
    """A sum of some 30 tetrahedra of at most 8e-3 m3, each off by an ulp: 1e-16; we allow 1e-15."""
    a, b = np.array([low_a, np.add(low_a, size_a)]), np.array([low_b, np.add(low_b, size_b)])
    common = (np.minimum(a[1], b[1]) - np.maximum(a[0], b[0])).clip(min=0.0).prod()
    found = list(overlaps([mover("a", slab(*a)), mover("b", slab(*b))]))
    if common > NEGLIGIBLE:
        (overlap,) = found
        assert overlap.volume == pytest.approx(common, abs=1e-15, rel=1e-9)
    else:
        assert found == []


@settings(deadline=None, max_examples=60)
@given(axis=axes(), angle=st.floats(-3.0, 3.0), place=corners, thickness=st.floats(0.002, 0.05))
def test_the_filter_drops_no_overlap(
    axis: Triple, angle: float, place: Triple, thickness: float
) -> None:
    """Turned boards and a pipe against a block: the same volume as a boolean of everything."""
    boards = [slab((0.0, 0.0, k * 0.08), (0.2, 0.15, k * 0.08 + thickness)) for k in range(2)]
    parts = [*boards, tube(0.1, 0.09, 0.2, axis="x").at(0.0, -0.2, 0.0)]
    pose = rigid(axis_angle_matrix(axis, angle), place)
    expected = sum((part.transformed(pose) & cube()).volume for part in parts)
    found = list(overlaps([mover("turned", *parts, poses=pose[None]), mover("block", cube())]))
    volume = sum(overlap.volume for overlap in found)
    # Transforming by the relative pose rounds once more: 1e-16 m over faces of 0.05 m2 at most.
    assert volume == pytest.approx(expected, abs=3 * NEGLIGIBLE)


def test_touching_boxes_do_not_overlap() -> None:
    assert list(overlaps([mover("a", cube()), mover("b", cube().at(0.1))])) == []


def test_each_pose_is_told() -> None:
    path = shifts((0.3, 0.0, 0.0), (0.06, 0.0, 0.0), (0.02, 0.0, 0.0))
    still = np.repeat(REST, 3, axis=0)
    found = list(overlaps([mover("a", cube(), poses=path), mover("b", cube(), poses=still)]))
    assert [(o.pose, o.first, o.second) for o in found] == [(1, "a", "b"), (2, "a", "b")]
    assert [o.volume for o in found] == pytest.approx([0.04 * 0.01, 0.08 * 0.01], rel=1e-12)


@settings(deadline=None, max_examples=60)
@given(start=corners, way=corners, size=sizes, axis=axes(), angle=st.floats(-3.0, 3.0))
def test_a_slide_meets_what_its_poses_meet_one_by_one(
    start: Triple, way: Triple, size: Triple, axis: Triple, angle: float
) -> None:
    """A bar through a frame, or past it: shadows along the way decide for all poses at once."""
    frame = tube(0.1, 0.07, 0.2, axis="x")
    turn = axis_angle_matrix(axis, angle)
    path = np.array([rigid(turn, np.add(start, np.multiply(t, way))) for t in np.linspace(0, 1, 5)])
    bar, still = slab((0.0, 0.0, 0.0), size), np.repeat(REST, 5, axis=0)
    found = overlaps([mover("bar", bar, poses=path), mover("frame", frame, poses=still)])
    volumes = np.zeros(5)
    for overlap in found:
        volumes[overlap.pose] = overlap.volume
    expected = [(bar.transformed(pose) & frame).volume for pose in path]
    # As in the test of the filter; a shadow of 1e-12 m2 over 0.4 m of bar is less.
    np.testing.assert_allclose(volumes, expected, rtol=0, atol=3 * NEGLIGIBLE)


def test_only_listed_pairs_are_looked_at() -> None:
    movers = [mover(name, cube()) for name in "abc"]
    assert [(o.first, o.second) for o in overlaps(movers, [(0, 2)])] == [("a", "c")]
    assert len(list(overlaps(movers))) == 3


def test_a_body_inside_another_overlaps_with_its_whole_volume() -> None:
    small = slab((0.04, 0.04, 0.04), (0.06, 0.06, 0.06))
    (found,) = overlaps([mover("a", cube()), mover("b", small)])
    assert found == Overlap(pose=0, first="a", second="b", volume=pytest.approx(8e-6, rel=1e-12))


def test_a_mesh_gives_one_body_a_number() -> None:
    boards = (((0.0, 0.0, 0.0), (0.1, 0.1, 0.1)), ((0.1, 0.0, 0.0), (0.2, 0.1, 0.1)))
    shape = shape_of_mesh(mesh_of(boards))
    assert [body.status().name for body in shape.bodies] == ["NoError", "NoError"]
    assert [body.volume() for body in shape.bodies] == pytest.approx([1e-3, 1e-3], rel=1e-12)
    np.testing.assert_array_equal(shape.rest, boards)


def test_an_open_body_keeps_its_place_with_a_status() -> None:
    whole = mesh_of((((0.0, 0.0, 0.0), (0.1, 0.1, 0.1)), ((0.1, 0.0, 0.0), (0.2, 0.1, 0.1))))
    holed = TriMesh(vertices=whole.vertices, faces=whole.faces[1:], body=whole.body[1:])  # type: ignore[index]
    assert [body.status().name for body in shape_of_mesh(holed).bodies] == [
        "NotManifold",
        "NoError",
    ]


@settings(deadline=None, max_examples=30)
@given(axis=axes(), angle=st.floats(-3.0, 3.0), place=corners)
def test_boxes_of_moved_bodies_are_those_of_their_moved_vertices(
    axis: Triple, angle: float, place: Triple
) -> None:
    pose = rigid(axis_angle_matrix(axis, angle), place)
    shape: Shape = shape_of_solids([cube(), cube().at(0.5, 0.2, 0.1)])
    moved = [cube().transformed(pose), cube().at(0.5, 0.2, 0.1).transformed(pose)]
    expected = np.array([solid.bounds for solid in moved])
    # Four roundings of numbers below 1 m.
    np.testing.assert_allclose(shape.boxes(pose[None])[0], expected, rtol=0, atol=1e-15)


@settings(deadline=None, max_examples=40)
@given(
    axis=axes(), angle=st.floats(-3.0, 3.0), start=corners, end=corners, make=st.sampled_from("rp")
)
def test_cutting_bodies_to_where_they_can_meet_changes_no_volume(
    axis: Triple, angle: float, start: Triple, end: Triple, make: str
) -> None:
    """A rack or pipe on its way through a tub, at enough poses for a cut. It brings new vertices:
    roundings of 1e-16 m over less than 1 m2 of surface, far below what is dropped as negligible."""
    moved, still = (rack() if make == "r" else pipe()), tub()
    turn = axis_angle_matrix(axis, angle)
    steps = np.linspace(0.0, 1.0, WORTH_A_CUT + 2)[:, None]
    path = np.array([rigid(turn, point) for point in start + steps * np.subtract(end, start)])
    other = np.repeat(REST, len(path), axis=0)
    found = np.zeros(len(path))
    for overlap in overlaps([mover("a", moved, poses=path), mover("b", still, poses=other)]):
        found[overlap.pose] += overlap.volume
    expected = [(moved.transformed(pose) & still).volume for pose in path]
    np.testing.assert_allclose(found, expected, rtol=0, atol=2 * NEGLIGIBLE)


def test_a_wedge_that_only_the_cut_body_shows_is_no_overlap() -> None:
    """The wall and the seal of a kettle, 0.1 mm apart: manifold3d 3.5.4 finds 2e-9 m3 in common
    once the wall is cut, and nothing between the whole bodies."""
    wall, seal = kettle_body("wall"), kettle_body("seal")
    for count in (1, WORTH_A_CUT):
        still = np.repeat(REST, count, axis=0)
        movers = [Mover(name=n, shape=s, poses=still) for n, s in (("wall", wall), ("seal", seal))]
        assert list(overlaps(movers)) == []


def kettle_body(name: str) -> Shape:
    """A body of wall_and_seal.json, whose vertices are whole multiples of 1e-7 m."""
    kept = json.loads((Path(__file__).parent / "wall_and_seal.json").read_text())
    vertices = np.array(kept[f"{name}_vertices"]).reshape(-1, 3) / 1e7
    return shape_of_mesh(
        TriMesh(vertices=vertices, faces=np.array(kept[f"{name}_faces"]).reshape(-1, 3))
    )


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


@settings(deadline=None)
@given(axis=axes(), angle=st.floats(-3.0, 3.0), place=corners)
def test_carried_boxes_hold_their_carried_corners(
    axis: Triple, angle: float, place: Triple
) -> None:
    pose = rigid(axis_angle_matrix(axis, angle), place)
    box = np.array([[[-0.1, -0.2, 0.0], [0.1, 0.05, 0.3]]])
    points = np.array(np.meshgrid(*box[0].T)).reshape(3, -1).T @ pose[:3, :3].T + pose[:3, 3]
    lower, upper = carried(pose[None], box)[0, 0]
    # Six products and sums of numbers below 0.5 a coordinate, twice over.
    np.testing.assert_allclose(points.min(axis=0), lower, rtol=0, atol=2e-15)
    np.testing.assert_allclose(points.max(axis=0), upper, rtol=0, atol=2e-15)


@settings(deadline=None)
@given(axis=axes(), angle=st.floats(-3.0, 3.0), place=corners)
def test_inverted_poses_undo(axis: Triple, angle: float, place: Triple) -> None:
    """Rodrigues' entries carry some 4 roundings of numbers up to 2, so R^T R is off by up to
    2 * 3 * 4 * 1.1e-16 = 2.7e-15."""
    pose = rigid(axis_angle_matrix(axis, angle), place)[None]
    np.testing.assert_allclose(inverted_poses(pose) @ pose, REST, rtol=0, atol=2.7e-15)
