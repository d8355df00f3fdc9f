"""What a surface needs: laws over surfaces that were spoiled at random."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.measure import closed
from artgen.geometry.solid import Solid, box, cylinder
from artgen.repair.meshes import Faces, planned
from artgen.validate.assembly import merged
from artgen.validate.subject import body_volumes


def arrays(*solids: Solid) -> tuple[Floats, Faces]:
    """Vertices and triangles of solids, which share no vertices."""
    mesh = merged([solid.trimesh() for solid in solids])
    return mesh.vertices, mesh.faces.astype(np.int64)


def after(vertices: Floats, faces: Faces) -> TriMesh:
    """The surface that the plan leaves."""
    plan = planned(vertices, faces)
    turned = np.where(plan.turned[:, None], faces[:, ::-1], faces)
    return TriMesh(vertices=vertices, faces=turned[~plan.dropped])


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 20), st.floats(0.0, 1.0))
def test_turned_and_doubled_triangles_leave_the_surface_that_it_was(
    seed: int, doubled: int, share: float
) -> None:
    """Whatever was turned around or repeated: closed, outward, as many triangles as before."""
    vertices, faces = arrays(cylinder(0.1, 0.3, segments=12), box((0.1, 0.2, 0.3), at=(1, 0, 0)))
    volume = body_volumes(TriMesh(vertices=vertices, faces=faces)).sum()
    rng = np.random.default_rng(seed)
    spoiled = np.where(rng.random(len(faces))[:, None] < share, faces[:, ::-1], faces)
    spoiled = np.concatenate([spoiled, spoiled[rng.integers(0, len(faces), doubled)]])
    made = after(vertices, rng.permutation(spoiled))
    assert len(made.faces) == len(faces)
    assert closed(made.faces)
    # The same determinants, summed in another order: 72 terms of at most 0.2 m3 lose 1e-15.
    np.testing.assert_allclose(body_volumes(made).sum(), volume, rtol=0, atol=1e-14)


def test_bodies_that_touch_face_to_face_are_left_alone() -> None:
    """Welded, their shared face would stand there twice; by the file's numbers it does not."""
    vertices, faces = arrays(box((1, 1, 1)), box((1, 1, 1), at=(1, 0, 0)))
    plan = planned(vertices, faces)
    assert not (plan.dropped.any())
    assert not (plan.turned.any())
    assert not (plan.open)
    assert not (plan.cavity)


def test_an_inward_box_within_another_may_be_a_cavity() -> None:
    vertices, faces = arrays(box((1, 1, 1)), box((0.5, 0.5, 0.5), at=(0, 0, 0.25)))
    faces[12:] = faces[12:, ::-1]
    plan = planned(vertices, faces)
    assert plan.cavity
    assert not (plan.dropped.any())
    assert not (plan.turned.any())


def test_a_surface_with_a_hole_is_not_turned() -> None:
    vertices, faces = arrays(box((1, 1, 1)))
    plan = planned(vertices, faces[1:, ::-1])
    assert plan.open
    assert not (plan.dropped.any())
    assert not (plan.turned.any())
