"""Laws of rotations, kinematics, inertia and sweeps: inverse, associativity, invariance.

Angles come in three regimes: anywhere, within 1e-7 of where formulas are singular (0, half a turn,
a turn), and extremes of many turns.
"""

import math
from dataclasses import replace

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Joint
from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix, quaternion
from artgen.core.transform import apply, inverted, rigid
from artgen.geometry.clearance import Mover, overlaps, shape_of_solids
from artgen.geometry.measure import combined, moments
from artgen.geometry.solid import chamfered_box, slab
from tests.strategies import Vector, axes, trees, vectors

EPS = float(np.finfo(np.float64).eps)


def angles() -> st.SearchStrategy[float]:
    """rad, in three regimes."""
    singular = st.sampled_from([0.0, math.pi, -math.pi, 2 * math.pi, math.pi / 2])
    near = st.tuples(singular, st.floats(-1e-7, 1e-7)).map(sum)
    return st.one_of(st.floats(-math.pi, math.pi), near, st.floats(-1e3, 1e3))


def frames() -> st.SearchStrategy[Floats]:
    """Rigid (4, 4) matrices."""
    return st.tuples(axes(), angles(), vectors()).map(
        lambda t: rigid(axis_angle_matrix(t[0], t[1]), t[2])
    )


@given(axes(), angles(), angles())
def test_turns_about_one_axis_add_up(axis: Vector, one: float, other: float) -> None:
    together = axis_angle_matrix(axis, one) @ axis_angle_matrix(axis, other)
    # Sine of a sum of angles up to 2e3 rad errs by half an ulp of the sum; products by some ulp.
    bound = 16 * EPS + 2 * EPS * (abs(one) + abs(other))
    assert np.abs(together - axis_angle_matrix(axis, one + other)).max() <= bound


@given(axes(), angles())
def test_a_turn_back_undoes_it_and_is_the_transpose(axis: Vector, angle: float) -> None:
    there, back = axis_angle_matrix(axis, angle), axis_angle_matrix(axis, -angle)
    assert np.abs(there @ back - np.eye(3)).max() <= 16 * EPS
    assert np.array_equal(back, there.T)


@given(axes(), angles())
def test_the_axis_stays_and_the_trace_tells_the_angle(axis: Vector, angle: float) -> None:
    matrix = axis_angle_matrix(axis, angle)
    assert np.abs(matrix @ axis - axis).max() <= 8 * EPS
    assert abs(np.trace(matrix) - (1 + 2 * math.cos(angle))) <= 16 * EPS
    w = quaternion(axis, angle)[0]
    assert abs(np.trace(matrix) - (4 * w * w - 1)) <= 16 * EPS


@given(frames(), frames(), frames())
def test_rigid_motions_associate_and_invert(a: Floats, b: Floats, c: Floats) -> None:
    size = 1.0 + sum(np.abs(frame[:3, 3]).max() for frame in (a, b, c))
    assert np.abs((a @ b) @ c - a @ (b @ c)).max() <= 64 * EPS * size
    assert np.abs(inverted(a @ b) - inverted(b) @ inverted(a)).max() <= 64 * EPS * size


def moved_joint(joint: Joint, frame: Floats) -> Joint:
    """The joint as seen from another frame; a slide's point carries no meaning and stays."""
    x, y, z = frame[:3, :3] @ joint.axis
    norm = math.sqrt(x * x + y * y + z * z)
    origin = apply(frame, joint.origin) if joint.type != "prismatic" else joint.origin
    ox, oy, oz = (float(value) for value in origin)
    return replace(joint, axis=(x / norm, y / norm, z / norm), origin=(ox, oy, oz))


@given(st.data(), trees(), frames())
def test_kinematics_does_not_depend_on_the_frame(
    data: st.DataObject, tree: tuple[Joint, ...], frame: Floats
) -> None:
    state = {j.name: data.draw(angles()) for j in tree if j.mimic is None}
    poses = forward_kinematics("part_0", tree, state)
    seen = forward_kinematics("part_0", [moved_joint(j, frame) for j in tree], state)
    for name, pose in poses.items():
        carried = frame @ pose @ inverted(frame)
        # Slides of up to 2e3 m and four products of matrices with such entries, each of three
        # terms; a normalized axis is off by 2 ulp, which such a slide multiplies.
        size = 1.0 + 4 * 2e3 + 2 * np.abs(frame[:3, 3]).max()
        assert np.abs(seen[name] - carried).max() <= 32 * EPS * size


@given(st.data(), trees())
def test_kinematics_does_not_depend_on_the_order_of_siblings(
    data: st.DataObject, tree: tuple[Joint, ...]
) -> None:
    state = {j.name: data.draw(st.floats(-1, 1)) for j in tree if j.mimic is None}
    poses = forward_kinematics("part_0", tree, state)
    assume(len(tree) > 1)
    last, before = tree[-1], tree[-2]
    follows = last.mimic is not None and last.mimic.joint == before.name
    assume(last.parent != before.child and not follows)
    swapped = forward_kinematics("part_0", [*tree[:-2], last, before], state)
    assert all(np.array_equal(poses[name], swapped[name]) for name in poses)


BLOCK = chamfered_box((0.3, 0.2, 0.1), 0.01).trimesh()


@given(frames(), st.floats(1e-3, 1e3), st.randoms(use_true_random=False))
def test_inertia_turns_with_the_body_and_scales_by_the_fifth_power(
    frame: Floats, scale: float, order: object
) -> None:
    plain = moments(BLOCK.triangles)
    moved = moments(scale * apply(frame, BLOCK.triangles))
    turn = frame[:3, :3]
    # Vertices round to an ulp of their distance, which the walls' size divides.
    bound = 64 * EPS * (1.0 + np.abs(frame[:3, 3]).max() / 0.01)
    expected = scale**5 * turn @ plain.second @ turn.T
    assert np.abs(moved.second - expected).max() <= bound * np.linalg.norm(expected, 2)
    assert abs(moved.volume / (scale**3 * plain.volume) - 1.0) <= bound
    shuffled = list(BLOCK.triangles)
    order.shuffle(shuffled)  # type: ignore[attr-defined]
    again = moments(np.array(shuffled))
    assert abs(again.volume / plain.volume - 1.0) <= len(shuffled) * EPS


@given(st.permutations(range(4)))
def test_mass_does_not_depend_on_the_order_of_pieces(order: list[int]) -> None:
    pieces = [
        (density, moments(slab((k, 0, 0), (k + 0.5, 0.2 + k, 0.3)).trimesh().triangles))
        for k, density in enumerate((700.0, 7800.0, 20.0, 2500.0))
    ]
    mass, center, tensor = combined(pieces)
    other = combined([pieces[k] for k in order])
    assert abs(other[0] / mass - 1.0) <= 8 * EPS
    assert np.abs(other[1] - center).max() <= 32 * EPS * 4
    assert np.abs(other[2] - tensor).max() <= 64 * EPS * np.linalg.norm(tensor, 2)


@given(frames(), st.floats(-0.05, 0.05), st.booleans())
def test_overlap_does_not_depend_on_the_frame_or_on_who_comes_first(
    frame: Floats, shift: float, swapped: bool
) -> None:
    one, other = slab((0, 0, 0), (0.4, 0.3, 0.2)), slab((0.39, 0.05, 0.02), (0.8, 0.25, 0.15))
    slid = rigid(np.eye(3), (shift, 0.0, 0.0))

    def volume(poses: tuple[Floats, Floats], *, turned: bool) -> float:
        movers = [
            Mover(name=name, shape=shape_of_solids([solid]), poses=pose[None])
            for name, solid, pose in zip("ab", (one, other), poses, strict=True)
        ]
        return sum(o.volume for o in overlaps(movers[::-1] if turned else movers))

    plain = volume((np.eye(4), slid), turned=False)
    seen = volume((frame, frame @ slid), turned=swapped)
    # The shared slice is 0.2 x 0.13 m wide; its thickness errs by some ulp of the coordinates.
    size = 1.0 + np.abs(frame[:3, 3]).max()
    assert abs(seen - plain) <= 0.2 * 0.13 * 64 * EPS * size + 1e-12
