"""Canonical form is unique: independent of input order and of noise."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from artgen.articulation.canonical import canonical_order, canonical_pivot, canonicalize
from artgen.articulation.types import Body, Draft, DraftPart, Joint, Limit
from artgen.core.surface import SurfaceSpec
from artgen.geometry.solid import slab
from tests.strategies import joints

CELLS = st.permutations([(x, z) for z in range(3) for x in range(3)])


def grid_bounds(cells, noise) -> list[np.ndarray]:
    base = np.array([[0.0, 0.0, 0.0], [1.0, 0.4, 1.0]])
    fronts = [
        np.array([[x / 3, 0.0, z / 3], [(x + 1) / 3, 0.02, (z + 1) / 3]]) + shift
        for (x, z), shift in zip(cells, noise, strict=True)
    ]
    return [base, *fronts]


@given(CELLS, st.integers(0, 2**32 - 1))
def test_rows_from_low_to_high_and_left_to_right_whatever_the_input_order_and_noise(
    cells, seed
) -> None:
    """1e-6 m of noise is far below the tie of 2 % of 1.5 m, and rows are 0.33 m apart."""
    noise = np.random.Generator(np.random.PCG64(seed)).uniform(-1e-6, 1e-6, (9, 1, 3))
    order = canonical_order(grid_bounds(cells, noise))
    assert order[0] == 0
    assert [cells[i - 1] for i in order[1:]] == [(x, z) for z in range(3) for x in range(3)]


def test_front_comes_before_back() -> None:
    base = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    back = np.array([[0.0, 0.6, 0.4], [0.4, 0.9, 0.6]])
    front = np.array([[0.6, 0.0, 0.4], [1.0, 0.3, 0.6]])
    assert canonical_order([base, back, front]) == [0, 2, 1]


@given(joints(name="j", parent="a", child="b"))
def test_the_pivot_is_the_axis_point_nearest_to_zero_and_stays_on_the_axis(joint) -> None:
    moved = canonical_pivot(joint)
    axis = np.array(joint.axis)
    if joint.type == "prismatic":
        assert moved.origin == (0.0, 0.0, 0.0)
        return
    assert_allclose(np.dot(moved.origin, axis), 0.0, atol=1e-14)
    apart = np.subtract(moved.origin, joint.origin)
    assert_allclose(np.cross(apart, axis), 0.0, atol=1e-14)


def draft() -> Draft:
    def part(name: str, low, high) -> DraftPart:
        solid = slab(low, high)
        body = Body(solid=solid, surface="s", density=500.0, collision=(solid,))
        return DraftPart(name=name, label=name, bodies=(body,))

    def hinge(child: str) -> Joint:
        return Joint(
            name=f"{child}_hinge", type="revolute", parent="base", child=child,
            axis=(0.0, 0.0, 1.0), origin=(3.0, 3.0, 9.0), limit=Limit(lower=0, upper=1),
            friction=1.0, damping=0.1, effort=10.0,
        )  # fmt: skip

    return Draft(
        category="x",
        parts=(
            part("base", (3, 3, 3), (4, 4, 4)),
            part("upper", (3, 2.9, 3.6), (4, 2.99, 4)),
            part("lower", (3, 2.9, 3), (4, 2.99, 3.5)),
        ),
        joints=(hinge("upper"), hinge("lower")),
        surfaces=(SurfaceSpec(name="s", recipe="plain"),),
    )


def test_a_draft_is_grounded_centred_and_ordered_and_doing_it_twice_changes_nothing() -> None:
    once = canonicalize(draft())
    assert [part.name for part in once.parts] == ["base", "lower", "upper"]
    assert [joint.child for joint in once.joints] == ["lower", "upper"]
    boxes = np.array([body.solid.bounds for part in once.parts for body in part.bodies])
    assert_allclose(boxes[:, 0].min(axis=0), (-0.5, -0.55, 0.0), atol=1e-12)
    assert_allclose(boxes[:, 1].max(axis=0), (0.5, 0.55, 1.0), atol=1e-12)
    assert_allclose(once.joints[0].origin, (-0.5, -0.45, 0.0), atol=1e-12)
    twice = canonicalize(once)
    assert [joint.origin for joint in twice.joints] == [joint.origin for joint in once.joints]
    again = np.array([body.solid.bounds for part in twice.parts for body in part.bodies])
    assert (again == boxes).all()
