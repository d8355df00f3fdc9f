"""Near-duplicates: equal faces are at distance 0, a moved or another handle and another panel are
not; distances are those of a brute-force Chamfer over the same points."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.assembly_study.near import (
    FRONT_RAYS,
    NOWHERE,
    TAU,
    UNIT,
    chamfers,
    face_of,
    pairwise,
    twins,
)
from tests.unit.assembly.mutations import has, moved_by, part_with, with_layer

RNG = np.random.default_rng(5)


def brute(one, other):
    apart = np.linalg.norm(one[:, None] - other[None], axis=2)
    return (apart.min(axis=1).mean() + apart.min(axis=0).mean()) / 2.0


def test_chamfer_distances_are_those_of_the_definition():
    """Squares of up to 3 m2 lose 3 x 2e-16 m2 in the expansion, 3e-8 m after the root where points
    coincide; none of 20 random ones do, so 1e-12 m is left."""
    sets = RNG.uniform(-1.0, 1.0, (5, 20, 3))
    found = chamfers(sets)
    wanted = [[brute(a, b) for b in sets] for a in sets]
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-12)


def test_rays_that_meet_nothing_do_not_count():
    sets = RNG.uniform(-1.0, 1.0, (3, 20, 3))
    sets[1, 7:] = NOWHERE * UNIT
    sets[2] = NOWHERE * UNIT
    found = chamfers(sets)
    assert found[0, 1] == pytest.approx(brute(sets[0], sets[1, :7]), abs=1e-12)
    assert np.isinf(found[0, 2])
    assert found[2, 2] == 0.0


def handled(case_with):
    case = case_with(has("out", layer="handle"))
    return case, part_with(case, "out", layer="handle").name


def test_the_same_object_is_its_own_twin_and_samples_lie_on_it(case_with):
    case, name = handled(case_with)
    face = face_of(0, case.new)
    assert pairwise([face, face]).max() == 0.0
    part = sorted(case.new.seams).index(name)
    front = case.new.layer(name, "body")
    rays = face.points[part, : FRONT_RAYS**2]
    points = rays[(rays > NOWHERE).all(axis=1)] * UNIT + front.bounds.mean(axis=0)
    # Kept in steps of 0.1 mm: half a step off at most.
    assert (points >= front.bounds[0] - UNIT).all()
    assert (points <= front.bounds[1] + UNIT).all()
    assert len(points) > FRONT_RAYS**2 / 2


def test_faces_cut_into_other_triangles_are_the_same(case_with):
    """Each triangle cut into three at its middle: what rays meet differs by rounding alone."""
    case, name = handled(case_with)

    def cut(piece):
        mesh = piece.mesh
        count = len(mesh.vertices)
        middles = count + np.arange(len(mesh.faces))
        a, b, c = mesh.faces.T
        faces = np.concatenate([np.stack(t, 1) for t in
                                ((a, b, middles), (b, c, middles), (c, a, middles))])  # fmt: skip
        vertices = np.concatenate([mesh.vertices, mesh.triangles.mean(axis=1)])
        three = {k: np.concatenate([getattr(mesh, k)] * 3) for k in ("uv", "slot", "body")}
        return replace(piece, mesh=replace(mesh, vertices=vertices, faces=faces, **three))

    other = face_of(1, with_layer(case, name, "body", cut).new)
    # Points may round to neighboring steps of 0.1 mm on a front of more than 0.1 m.
    assert pairwise([face_of(0, case.new), other])[0, 1] < UNIT / 0.1


@pytest.mark.parametrize("way", [(0.0, -0.004, 0.0), (0.02, 0.0, 0.0)])
def test_a_handle_elsewhere_is_no_duplicate(case_with, way):
    """The control: 4 mm forward or 20 mm aside is more than 0.2 % of any front's diagonal."""
    case, name = handled(case_with)
    moved = with_layer(case, name, "handle", lambda p: moved_by(p, lambda v: v + way))
    assert pairwise([face_of(0, case.new), face_of(1, moved.new)])[0, 1] > TAU


def test_a_front_that_lost_its_handle_is_infinitely_far(case_with):
    case, name = handled(case_with)
    body, _, works = case.new.seams[name]
    without = replace(case.new, seams={**case.new.seams, name: (body, 0, works)})
    assert np.isinf(pairwise([face_of(0, case.new), face_of(1, without)])[0, 1])


def test_the_nearest_is_found_within_the_template_alone(cases):
    faces = [face_of(k, case.new) for k, case in enumerate(cases)]
    again = replace(faces[0], index=len(faces))
    stranger = replace(faces[0], index=len(faces) + 1, template="another")
    found = twins([*faces, again, stranger])
    assert found.nearest[again.index] == (0.0, 0)
    assert found.nearest[0] == (0.0, again.index)
    assert np.isinf(found.nearest[stranger.index][0])
    assert found.distinct == twins([*faces, stranger]).distinct
