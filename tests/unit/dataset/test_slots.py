"""Cutting and padding to ART's slots."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import ShardError
from artgen.dataset.image_checks import check_images
from artgen.dataset.sample import LEFT_OUT
from artgen.dataset.slots import to_slots
from tests.unit.dataset.scenes import assert_same, made_sample


@settings(deadline=None, max_examples=30)
@given(parts=st.integers(1, 6), slots=st.integers(1, 8))
def test_the_first_slots_hold_the_first_parts_and_the_rest_is_empty(parts, slots):
    sample = made_sample(parts=parts)
    slotted = to_slots(sample, slots)
    check_images(slotted)
    kept = min(parts, slots)
    assert slotted.shape[2] == slots == slotted.meta.slots
    assert slotted.valid.tolist() == [True] * kept + [False] * (slots - kept)
    np.testing.assert_array_equal(slotted.part_rgba[:, :, :kept], sample.part_rgba[:, :, :kept])
    np.testing.assert_array_equal(slotted.targets.motion[:, :kept], sample.targets.motion[:, :kept])
    assert not slotted.part_rgba[:, :, kept:].any()
    assert not slotted.part_mask[:, :, kept:].any()
    assert not slotted.targets.bounds[kept:].any()
    assert (slotted.targets.parent[kept:] == -1).all()
    assert slotted.meta.parts_left_out == tuple(part.name for part in sample.meta.parts[kept:])


@settings(deadline=None, max_examples=20)
@given(parts=st.integers(2, 6), slots=st.integers(1, 5))
def test_pixels_keep_their_part_or_say_that_it_was_left_out(parts, slots):
    sample = made_sample(parts=parts)
    slotted = to_slots(sample, slots)
    shown = sample.part_id < slots
    np.testing.assert_array_equal(slotted.part_id[shown], sample.part_id[shown])
    lost = (sample.part_id >= slots) & (sample.part_id < parts)
    assert (slotted.part_id[lost] == LEFT_OUT).all()
    np.testing.assert_array_equal(slotted.rgba, sample.rgba)


def test_a_part_goes_with_the_part_it_hangs_on():
    """Part 1 hangs on part 3, which the cut to three slots removes: both go, part 2 moves up."""
    sample = made_sample(parts=4)
    parent = np.int8([-1, 3, 0, 0])
    slotted = to_slots(replace(sample, targets=replace(sample.targets, parent=parent)), 3)
    assert [part.name for part in slotted.meta.parts] == ["base", "door_2"]
    assert slotted.meta.parts_left_out == ("door_1", "door_3")
    assert slotted.targets.parent.tolist() == [-1, 0, -1]
    np.testing.assert_array_equal(slotted.part_depth[:, :, 1], sample.part_depth[:, :, 2])
    check_images(slotted)


def test_cutting_to_the_same_slots_again_changes_nothing():
    slotted = to_slots(made_sample(parts=5), 3)
    assert_same(to_slots(slotted, 3), slotted)


def test_no_slot_is_refused():
    with pytest.raises(ShardError, match=">= 1"):
        to_slots(made_sample(), 0)
