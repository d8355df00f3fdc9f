"""Fronts, handles and works told apart by where bodies lie."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.articulation.canonical import canonicalize
from artgen.articulation.types import Grip, Joint, Limit
from artgen.assembly.build import sharp
from artgen.assembly.piece import body_boxes, body_volumes, joined, picked, piece_of_part, weighed
from artgen.assembly.source import (
    HANDLE_LEAVES,
    kept_within,
    named_bodies,
    side_of,
    source_of_draft,
    source_of_object,
)
from artgen.assembly.split import split_bodies
from artgen.core.licence import OURS
from artgen.geometry.convex import as_box
from tests.made import drafted, finished
from tests.unit.assembly.test_fit import piece_of

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


TRIM = [(-0.2, -0.012, 0.1), (0.2, 0.0, 0.13)]
"""Stands out before the front, but no hand takes hold of it."""


def test_bodies_that_a_source_calls_handles_are_the_handle_and_no_others():
    listed = boxes(FRONT, BAR, *POSTS, TRIM, *SIDES)
    split = split_bodies(listed, SLIDE, [], handles=[1, 2, 3])
    assert (split.front, split.handle, split.works) == ((0,), (1, 2, 3), (4, 5, 6))
    unnamed = split_bodies(listed, SLIDE, [])
    assert 4 in unnamed.handle  # The control: told by where it lies, trim is taken for a handle.


def test_a_handle_as_wide_as_its_front_is_not_the_front():
    """Its name tells; by where it lies, the thin wide rail before all else is the front."""
    rail = [(-0.2, -0.02, 0.2), (0.2, -0.015, 0.4)]
    split = split_bodies(boxes(FRONT, rail), SLIDE, [], handles=[1])
    assert (split.front, split.handle) == ((0,), (1,))
    assert split_bodies(boxes(FRONT, rail), SLIDE, []).front == (1,)


def test_what_is_called_a_handle_but_lies_within_the_front_stays_there():
    flush = [(-0.05, 0.002, 0.28), (0.05, 0.018, 0.32)]
    split = split_bodies(boxes(FRONT, flush), SLIDE, [], handles=[1])
    assert (split.front, split.handle) == ((0, 1), ())


def test_the_leaves_of_an_ingested_bundle_name_its_handles():
    runs = {"door": [{"leaf": "door_body", "bodies": [0, 2]}, {"leaf": "Handle", "bodies": [2, 3]},
                     {"leaf": "knob", "bodies": [7, 1]}]}  # fmt: skip
    found = named_bodies({"fragments": runs}, "door", HANDLE_LEAVES)
    assert found == (2, 3, 4, 7)
    assert named_bodies({"fragments": runs}, "drawer", HANDLE_LEAVES) == ()
    assert named_bodies({}, "door", HANDLE_LEAVES) == ()


def test_a_finished_object_is_taken_apart_by_the_names_of_its_leaves():
    """Two posts of a handle are called trim: without their names they were part of it."""
    obj = finished("cabinet", 0)
    plain = source_of_object(obj, id="x", licence=OURS, dataset="artgen")
    member = next(m for m in plain.members if m.handle is not None)
    part = next(p for p in obj.parts if p.name == member.name)
    boxes_ = body_boxes(part.mesh)
    own = body_boxes(member.handle.mesh)
    numbers = [k for k, box in enumerate(boxes_) if any(np.array_equal(box, b) for b in own)]
    runs = {part.name: [{"leaf": "handle", "bodies": [numbers[0], 1]}]}
    named = replace(obj, provenance={**obj.provenance, "fragments": runs})
    again = source_of_object(named, id="x", licence=OURS, dataset="artgen")
    handle = next(m for m in again.members if m.name == part.name).handle
    assert np.array_equal(body_boxes(handle.mesh), boxes_[numbers[:1]])


def test_collision_pieces_end_where_their_front_does():
    """A hollow door's pieces reach back through its lining; boxes stay boxes."""
    front = piece_of((0.0, 0.0, 0.0), (0.4, 0.02, 0.6))
    deep = piece_of((0.0, 0.0, 0.0), (0.4, 0.05, 0.6)).mesh
    aside = piece_of((0.0, 0.03, 0.0), (0.4, 0.05, 0.6)).mesh
    kept = kept_within(replace(front, collision=(deep, front.mesh, aside))).collision
    assert len(kept) == 2
    assert np.abs(kept[0].bounds - front.bounds).max() < 1e-9
    assert as_box(kept[0]) is not None
    assert kept[1] is front.mesh


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
