"""Fronts, handles and works told apart by where bodies lie."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.articulation.canonical import canonicalize
from artgen.articulation.types import Grip, Joint, Limit
from artgen.assembly.build import sharp
from artgen.assembly.licence import OURS
from artgen.assembly.piece import body_boxes, body_volumes, joined, picked, piece_of_part, weighed
from artgen.assembly.source import side_of, source_of_draft, source_of_object
from artgen.assembly.split import split_bodies
from tests.made import drafted, finished

GRIP = Grip(name="g", kind="handle", position=(0.0, -0.03, 0.3), outward=(0.0, -1.0, 0.0),
            pull=(0.0, -1.0, 0.0))  # fmt: skip
SLIDE = Joint(
    name="slide",
    type="prismatic",
    parent="base",
    child="drawer",
    axis=(0.0, -1.0, 0.0),
    limit=Limit(lower=0.0, upper=0.3),
    friction=5.0,
    damping=1.0,
    effort=50.0,
)
HINGE = replace(SLIDE, type="revolute", axis=(0.0, 0.0, -1.0), origin=(-0.202, -0.005, 0.0))
FRONT = [(-0.2, 0.0, 0.1), (0.2, 0.02, 0.5)]
BAR = [(-0.06, -0.035, 0.29), (0.06, -0.025, 0.31)]
POSTS = [[(-0.05, -0.025, 0.295), (-0.04, 0.0, 0.305)], [(0.04, -0.025, 0.295), (0.05, 0.0, 0.305)]]
SIDES = [[(-0.19, 0.02, 0.12), (-0.178, 0.4, 0.3)], [(0.178, 0.02, 0.12), (0.19, 0.4, 0.3)]]
BOTTOM = [(-0.178, 0.02, 0.13), (0.178, 0.4, 0.136)]
KNUCKLE = [(-0.206, -0.009, 0.14), (-0.2, 0.012, 0.2)]


def boxes(*listed):
    return np.array(listed, float)


def test_a_drawer_is_front_handle_and_box():
    split = split_bodies(boxes(FRONT, BAR, *POSTS, *SIDES, BOTTOM), SLIDE, [GRIP])
    assert (split.front, split.handle, split.works) == ((0,), (1, 2, 3), (4, 5, 6))


def test_hinges_belong_to_the_works_even_before_the_front():
    split = split_bodies(boxes(FRONT, BAR, *POSTS, KNUCKLE), HINGE, [GRIP])
    assert (split.front, split.handle, split.works) == ((0,), (1, 2, 3), (4,))


def test_without_grips_what_stands_out_is_a_handle():
    split = split_bodies(boxes(FRONT, BAR, *POSTS, KNUCKLE), HINGE, [])
    assert (split.handle, split.works) == ((1, 2, 3), (4,))


def test_a_frame_with_a_pane_is_one_front():
    stile, rail = 0.06, 0.06
    frame = [
        [(-0.2, 0, 0.1), (-0.2 + stile, 0.02, 0.5)], [(0.2 - stile, 0, 0.1), (0.2, 0.02, 0.5)],
        [(-0.14, 0, 0.1), (0.14, 0.02, 0.1 + rail)], [(-0.14, 0, 0.44), (0.14, 0.02, 0.5)],
        [(-0.14, 0.008, 0.16), (0.14, 0.012, 0.44)],
    ]  # fmt: skip
    split = split_bodies(boxes(*frame, KNUCKLE), HINGE, [])
    assert split.front == (0, 1, 2, 3, 4)


def test_what_shows_no_front_is_not_split():
    rack = [(-0.2, 0.0, 0.1), (0.2, 0.4, 0.3)]
    assert split_bodies(boxes(rack), SLIDE, []) is None


@pytest.mark.parametrize(
    ("joint", "side"),
    [
        (SLIDE, "out"),
        (replace(SLIDE, axis=(1.0, 0.0, 0.0)), "along"),
        (HINGE, "left"),
        (replace(HINGE, origin=(0.2, 0.0, 0.0)), "right"),
        (replace(HINGE, axis=(1.0, 0.0, 0.0), origin=(0.0, 0.0, 0.1)), "bottom"),
        (replace(HINGE, axis=(1.0, 0.0, 0.0), origin=(0.0, 0.0, 0.5)), "top"),
        (replace(HINGE, axis=(0.0, 1.0, 0.0)), "turn"),
    ],
)
def test_sides(joint, side):
    assert side_of(joint, np.array(FRONT)) == side


@pytest.fixture(scope="module", params=["cabinet", "storage_furniture"])
def both(request):
    """One object as a draft taken apart and as a finished object taken apart."""
    draft = canonicalize(drafted(request.param, 0))
    made = source_of_draft(draft, id="made", rounder=sharp)
    read = source_of_object(finished(request.param, 0), id="read", licence=OURS, dataset="artgen")
    return made, read


def test_drafts_and_finished_objects_are_taken_apart_alike(both):
    made, read = both
    assert [m.name for m in made.members] == [m.name for m in read.members]
    for one, other in zip(made.members, read.members, strict=True):
        assert (one.kind, one.side, one.label) == (other.kind, other.side, other.label)
        for a, b in zip(one.pieces, other.pieces, strict=True):
            assert np.abs(a.bounds - b.bounds).max() < 2e-7
            assert len(a.densities) == len(b.densities)


def test_nothing_is_lost_when_an_object_is_taken_apart(both):
    """Volumes, masses, collision pieces and grips of the parts are those of their pieces."""
    read = both[1]
    obj = finished(read.category, 0)
    for part, member in zip(obj.parts[1:], read.members, strict=True):
        whole = joined(member.pieces)
        assert body_volumes(whole.mesh).sum() == pytest.approx(body_volumes(part.mesh).sum())
        assert weighed(whole).mass == pytest.approx(part.mass.mass, rel=1e-9)
        assert len(whole.collision) == len(part.collision)
        assert {g.name for g in whole.grips} == {g.name for g in part.grips}


def test_picked_bodies_are_numbered_in_the_order_asked_for():
    piece = piece_of_part(finished("cabinet", 0).parts[1])
    order = [len(piece.densities) - 1, 0]
    found = picked(piece, order)
    assert np.allclose(body_boxes(found.mesh), body_boxes(piece.mesh)[order])
    assert found.densities == tuple(piece.densities[k] for k in order)
