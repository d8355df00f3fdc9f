import dataclasses
import io
import multiprocessing

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image as Pillow

from artgen.core.surface import SurfaceSpec
from artgen.textures import texture_set
from artgen.textures.library import TextureLibrary
from artgen.textures.png import png_bytes

PLASTIC = SurfaceSpec(name="body", recipe="plastic", color=(0.1, 0.1, 0.1))
STEEL = SurfaceSpec(name="door", recipe="brushed", metallic=1.0, roughness=0.32)


@settings(deadline=None)
@given(
    arrays(np.uint8, st.tuples(st.integers(1, 9), st.integers(1, 9), st.just(3))),
    st.sampled_from([1, 2, 5, 40, 255]),
)
def test_png_keeps_every_pixel(image, values):
    image = image % values
    with Pillow.open(io.BytesIO(png_bytes(image))) as picture:
        assert np.array_equal(np.asarray(picture.convert("RGB")), image)


def test_palettes_have_eight_bits():
    """pybullet 3.2 refuses smaller ones; byte 24 of a PNG is its bit depth."""
    assert png_bytes(np.zeros((4, 4, 3), np.uint8))[24] == 8


def test_many_colors_are_kept_too():
    image = np.arange(40 * 40 * 3, dtype=np.uint32).reshape(40, 40, 3).astype(np.uint8)
    image[..., 0] = np.arange(40)[:, None]
    with Pillow.open(io.BytesIO(png_bytes(image))) as picture:
        assert picture.mode == "RGB"
        assert np.array_equal(np.asarray(picture), image)


def test_files_hold_the_recipe_s_images(tmp_path):
    library = TextureLibrary(tmp_path)
    made, read = texture_set(STEEL), library.images(STEEL)
    assert np.array_equal(made.roughness, read.roughness)
    assert np.array_equal(made.normal, read.normal)
    assert read.color is None
    assert read.emission is None


def test_orm_is_packed_as_gltf_wants_it(tmp_path):
    files = TextureLibrary(tmp_path).files(STEEL)
    with Pillow.open(files.orm) as picture:
        red, green, blue = np.moveaxis(np.asarray(picture.convert("RGB")), 2, 0)
    assert (red == 255).all()
    assert np.array_equal(green, texture_set(STEEL).roughness)
    assert (blue == 255).all()


def test_a_surface_without_images_has_no_files(tmp_path):
    files = TextureLibrary(tmp_path).files(SurfaceSpec(name="glass", recipe="plain"))
    assert set(dataclasses.astuple(files)) == {None}
    assert not list(tmp_path.glob("*.png"))


def test_equal_images_are_one_file(tmp_path):
    library = TextureLibrary(tmp_path)
    white = dataclasses.replace(PLASTIC, name="door", color=(0.8, 0.8, 0.8))
    assert library.files(PLASTIC) == library.files(white)
    assert len(list(tmp_path.glob("*.png"))) == 1


def test_two_folders_hold_the_same_bytes(tmp_path):
    for name in ("one", "two"):
        TextureLibrary(tmp_path / name).files(STEEL)
    one, two = (
        {path.name: path.read_bytes() for path in (tmp_path / name).glob("*.*")}
        for name in ("one", "two")
    )
    assert one == two


def test_files_are_written_once(tmp_path):
    library = TextureLibrary(tmp_path)
    before = {path: path.stat().st_mtime_ns for path in _pngs(library.files(STEEL))}
    after = {path: path.stat().st_mtime_ns for path in _pngs(library.files(STEEL))}
    assert before == after


def test_processes_may_share_a_folder(tmp_path):
    context = multiprocessing.get_context("spawn")
    with context.Pool(3) as pool:
        found = pool.map(_files_of, [(tmp_path, recipe) for recipe in ("plastic", "enamel") * 6])
    assert len(set(found)) == 2
    assert not list(tmp_path.glob("*.partial"))
    assert len(list(tmp_path.glob("*.png"))) == 2


def _files_of(place):
    folder, recipe = place
    return TextureLibrary(folder).files(SurfaceSpec(name="x", recipe=recipe))


def _pngs(files):
    return [path for path in dataclasses.astuple(files) if path is not None]
