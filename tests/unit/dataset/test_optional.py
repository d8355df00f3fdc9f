"""What a sample holds only where it was asked for: absent, whole, in parts, and refused."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import ShardError
from artgen.dataset.image_checks import check_images
from artgen.dataset.members import EncodedSample, decoded, encoded
from artgen.dataset.sample import BACKGROUND, OPTIONAL_IMAGES, Sample
from artgen.dataset.slots import to_slots
from tests.unit.dataset.scenes import assert_same, made_sample, with_extras


def back(written: EncodedSample, **chosen) -> Sample:
    return decoded(dict(written.members).__getitem__, where="here", **chosen)


@settings(max_examples=20)
@given(
    names=st.sets(st.sampled_from([*OPTIONAL_IMAGES, "stated_cameras"])),
    height=st.integers(1, 20),
    seed=st.integers(0, 1000),
)
def test_any_of_them_come_back_bit_equal_and_the_others_stay_absent(names, height, seed):
    full = with_extras(made_sample(height=height, seed=seed))
    absent = {*OPTIONAL_IMAGES, "stated_cameras"} - names
    once = back(encoded(replace(full, **dict.fromkeys(absent))))
    for name in OPTIONAL_IMAGES:
        if name in names:
            np.testing.assert_array_equal(getattr(once, name), getattr(full, name), strict=True)
        else:
            assert getattr(once, name) is None
    assert (once.stated_cameras is None) == ("stated_cameras" not in names)
    again = encoded(once)
    assert_same(back(again), once)
    assert encoded(back(again)) == again


def test_a_sample_without_them_has_the_members_it_would_have_anyway():
    plain, full = encoded(made_sample()), encoded(with_extras(made_sample()))
    kept = dict(full.members)
    for name, data in plain.members:
        if name not in ("meta.json", "arrays.npz"):
            assert kept.pop(name) == data
    extra = {"albedo.webp", "roughness.png", "flow.exr", "linear.exr"}
    assert {name.split(".", 1)[1] for name in kept if name[0] == "s"} == extra


def test_some_states_and_views_are_those_of_the_whole():
    written = encoded(with_extras(made_sample(states=3, views=3)))
    whole, some = back(written), back(written, states=[2, 0], views=[1])
    for name in OPTIONAL_IMAGES:
        np.testing.assert_array_equal(getattr(some, name), getattr(whole, name)[[2, 0]][:, [1]])
    poses = whole.stated_cameras.camera_from_world[[2, 0]][:, [1]]
    np.testing.assert_array_equal(some.stated_cameras.camera_from_world, poses)
    np.testing.assert_array_equal(
        some.stated_cameras.intrinsics, whole.stated_cameras.intrinsics[[1]]
    )


def test_slots_leave_them_as_they_are():
    full = with_extras(made_sample(parts=4))
    for slots in (2, 8):
        slotted = to_slots(full, slots)
        check_images(slotted)
        for name in OPTIONAL_IMAGES:
            np.testing.assert_array_equal(getattr(slotted, name), getattr(full, name))
        assert slotted.stated_cameras is full.stated_cameras


@pytest.mark.parametrize("name", OPTIONAL_IMAGES)
def test_another_shape_or_type_is_refused(name):
    full = with_extras(made_sample())
    array = getattr(full, name)
    with pytest.raises(ShardError, match=rf"{name} has shape"):
        replace(full, **{name: np.repeat(array, 2, axis=1)})
    with pytest.raises(ShardError, match=rf"{name} is float64"):
        replace(full, **{name: array.astype(np.float64)})


def test_stated_cameras_of_another_shape_or_size_are_refused():
    full = with_extras(made_sample())
    stated = full.stated_cameras
    fewer = replace(stated, camera_from_world=stated.camera_from_world[:1])
    with pytest.raises(ShardError, match=r"stated_cameras\.camera_from_world has shape"):
        replace(full, stated_cameras=fewer)
    with pytest.raises(ShardError, match="stated_cameras are"):
        replace(full, stated_cameras=replace(stated, size=(1, 1)))


@pytest.mark.parametrize("name", ["albedo", "roughness", "flow"])
def test_a_label_on_the_background_is_refused_when_written(name):
    full = with_extras(made_sample())
    assert (full.part_id == BACKGROUND).any()
    spoilt = getattr(full, name).copy()
    spoilt[full.part_id == BACKGROUND] = 1
    with pytest.raises(ShardError, match=f"{name} is not 0 on the background"):
        encoded(replace(full, **{name: spoilt}))


def test_flow_after_the_last_state_and_numbers_that_are_not_finite_are_refused():
    full = with_extras(made_sample())
    flow = np.ones_like(full.flow) * (full.part_id != BACKGROUND)[..., None]
    with pytest.raises(ShardError, match="flow of the last state"):
        encoded(replace(full, flow=flow))
    with pytest.raises(ShardError, match="linear holds"):
        encoded(replace(full, linear=np.full_like(full.linear, np.inf)))
