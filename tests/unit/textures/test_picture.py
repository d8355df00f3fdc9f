"""A surface of images from outside behaves as one of a recipe, once the library keeps them."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import UsageError
from artgen.textures import TextureSet
from artgen.textures.atlas import LINEAR
from artgen.textures.library import TextureLibrary
from artgen.textures.picture import images_hash, picture_surface

COLOR = np.arange(5 * 4 * 3, dtype=np.uint8).reshape(5, 4, 3)
ROUGH = np.full((2, 2), 99, np.uint8)


def test_a_kept_picture_is_read_back_pixel_for_pixel(tmp_path: Path) -> None:
    library = TextureLibrary(tmp_path)
    images = TextureSet(color=COLOR, roughness=ROUGH)
    spec = picture_surface("skin", images, tile=(1.0, 2.0))
    library.keep(spec, images)
    read = library.images(spec)
    assert np.array_equal(np.asarray(read.color), COLOR)
    assert np.array_equal(np.asarray(read.roughness), ROUGH)


def test_its_color_is_the_mean_of_its_image_in_linear_light() -> None:
    spec = picture_surface("skin", TextureSet(color=COLOR), tile=(1.0, 1.0))
    assert spec.color == tuple(LINEAR[COLOR].mean(axis=(0, 1)).tolist())


def test_a_library_that_does_not_hold_it_says_so(tmp_path: Path) -> None:
    spec = picture_surface("skin", TextureSet(color=COLOR), tile=(1.0, 1.0))
    with pytest.raises(UsageError, match=r"skin: its images .* TextureLibrary\.keep"):
        TextureLibrary(tmp_path).files(spec)


def test_other_images_make_another_surface() -> None:
    images = TextureSet(color=COLOR)
    for other in (
        TextureSet(color=COLOR + np.uint8(1)),
        TextureSet(emission=COLOR),
        TextureSet(color=COLOR.reshape(4, 5, 3)),
        dataclasses.replace(images, roughness=ROUGH),
    ):
        assert images_hash(other) != images_hash(images)
