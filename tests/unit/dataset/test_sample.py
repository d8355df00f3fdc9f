"""A Sample that contradicts itself cannot be made, or at the latest not be written."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import ShardError
from artgen.dataset.image_checks import check_images
from artgen.dataset.sample import BACKGROUND, LEFT_OUT, Cameras, transparent_cleared
from tests.unit.dataset.scenes import made_meta, made_sample

IMAGES = ("rgba", "part_id", "depth", "normal", "part_rgba", "part_depth", "part_normal")


@settings(deadline=None)
@given(st.sampled_from(IMAGES), st.integers(0, 2))
def test_an_image_of_another_shape_is_refused(name, axis):
    sample = made_sample()
    longer = np.repeat(getattr(sample, name), 2, axis=axis)
    with pytest.raises(ShardError, match="shape"):
        replace(sample, **{name: longer})


@pytest.mark.parametrize("name", IMAGES)
def test_an_image_of_another_type_is_refused(name):
    sample = made_sample()
    with pytest.raises(ShardError, match=f"{name} is float64"):
        replace(sample, **{name: getattr(sample, name).astype(np.float64)})


@pytest.mark.parametrize("name", ["bounds", "type", "axis", "origin", "motion", "parent", "limits"])
def test_a_target_of_another_shape_is_refused(name):
    sample = made_sample()
    longer = np.repeat(getattr(sample.targets, name), 2, axis=-1)
    with pytest.raises(ShardError, match=rf"targets\.{name} has shape"):
        replace(sample, targets=replace(sample.targets, **{name: longer}))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axis": lambda a: 2 * a}, "axis lengths"),
        ({"motion": lambda a: a + 2}, "motion reaches"),
        ({"bounds": lambda a: a[:, ::-1]}, "upper bound"),
        ({"type": lambda a: a + 2}, "joint types"),
        ({"movable": lambda a: ~a}, "movable"),
        ({"origin": lambda a: a * np.nan}, "finite"),
    ],
)
def test_a_target_out_of_its_range_is_refused(change, words):
    sample = made_sample()
    changed = {name: edit(getattr(sample.targets, name)) for name, edit in change.items()}
    with pytest.raises(ShardError, match=words):
        replace(sample, targets=replace(sample.targets, **changed))


def _scaled(matrix):
    matrix[..., :3, :3] *= 1.001


def _mirrored(matrix):
    matrix[..., 0, :3] *= -1


def _transposed(matrix):
    matrix[:] = np.swapaxes(matrix, -1, -2).copy()


@pytest.mark.parametrize("spoil", [_scaled, _mirrored, _transposed])
def test_a_camera_that_is_not_a_rigid_motion_is_refused(spoil):
    cameras = made_sample().cameras
    matrix = cameras.camera_from_world.copy()
    spoil(matrix)
    with pytest.raises(ShardError, match="camera_from_world"):
        Cameras(intrinsics=cameras.intrinsics, camera_from_world=matrix, size=cameras.size)


@pytest.mark.parametrize("asset_id", ["a.b", "Laptop_1", "", "../x", "x" * 65])
def test_an_asset_id_that_cannot_name_members_is_refused(asset_id):
    with pytest.raises(ShardError, match="asset id"):
        replace(made_meta("laptop_000000", 2), asset_id=asset_id)


@pytest.mark.parametrize("parts", [0, 128])
def test_a_count_of_parts_that_ids_cannot_tell_apart_is_refused(parts):
    with pytest.raises(ShardError, match=f"{parts} parts, expected 1 to 127"):
        made_meta("laptop_000000", parts)


def _color_under_alpha(sample):
    rgba = np.array(sample.part_rgba)
    rgba[..., 3] = 0
    rgba[..., 0] = 9
    return {"part_rgba": rgba}


def _unknown_id(sample):
    return {"part_id": np.where(sample.part_id == 0, np.uint8(200), sample.part_id)}


def _left_out_without_a_name(sample):
    return {"part_id": np.where(sample.part_id == 0, np.uint8(LEFT_OUT), sample.part_id)}


def _background_with_depth(sample):
    return {"part_id": np.full_like(sample.part_id, BACKGROUND)}


def _other_depth(sample):
    return {"depth": np.where(sample.depth > 0, sample.depth + np.float32(0.5), 0)}


def _long_normals(sample):
    return {"normal": sample.normal * np.float32(1.01)}


def _infinite_depth(sample):
    return {"depth": np.where(sample.depth > 0, sample.depth, np.float32(np.inf))}


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (_color_under_alpha, "alpha 0"),
        (_unknown_id, r"part ids \[200\]"),
        (_left_out_without_a_name, r"part ids \[254\]"),
        (_background_with_depth, "background elsewhere"),
        (_other_depth, "differs from that of the part"),
        (_long_normals, "normals must be unit"),
        (_infinite_depth, "background is 0 m"),
    ],
)
def test_images_that_contradict_each_other_are_refused(spoil, words):
    sample = made_sample()
    check_images(sample)
    with pytest.raises(ShardError, match=words):
        check_images(replace(sample, **spoil(sample)))


def test_clearing_changes_transparent_pixels_alone():
    rgba = np.random.default_rng(0).integers(0, 3, (8, 8, 4), dtype=np.uint8)
    cleared = transparent_cleared(rgba)
    visible = rgba[..., 3] > 0
    np.testing.assert_array_equal(cleared[visible], rgba[visible])
    assert not cleared[~visible].any()


def test_camera_from_centered_takes_targets_where_the_world_matrix_takes_world_points():
    """Two roundings of sums of numbers below 10: 1e-14 is four times their worst."""
    sample = made_sample()
    point = np.array([0.3, -0.2, 0.5, 1.0])
    in_world = point + np.append(sample.center, 0)
    np.testing.assert_allclose(
        sample.camera_from_centered @ point,
        sample.cameras.camera_from_world @ in_world,
        rtol=0,
        atol=1e-14,
    )


def test_arrays_of_a_sample_are_read_only():
    with pytest.raises(ValueError, match="read-only"):
        made_sample().rgba[:] = 0
