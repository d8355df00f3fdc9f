"""EXR bytes hold every bit, and OpenImageIO reads them and writes what we read."""

import numpy as np
import OpenImageIO as oiio
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from artgen.core.errors import ShardError
from artgen.dataset.exr import exr, read_exr

RGBA = ("R", "G", "B", "A")
XY = ("X", "Y")
SHAPES = st.tuples(st.integers(1, 40), st.integers(1, 9))


def halves(channels: int):
    return SHAPES.flatmap(
        lambda shape: hnp.arrays(
            np.float16, (*shape, channels), elements=st.floats(-65504, 65504, width=16)
        )
    )


def by_oiio(path, names):
    source = oiio.ImageInput.open(str(path))
    spec = source.spec()
    pixels = source.read_image(format="unknown")
    source.close()
    return pixels, [spec.channelnames[k] for k in range(spec.nchannels)]


@given(halves(4))
@settings(max_examples=40)
def test_halves_come_back_bit_for_bit_and_give_the_same_bytes_again(image):
    data = exr(image, RGBA)
    back = read_exr(data, RGBA)
    assert back.dtype == np.float16
    np.testing.assert_array_equal(back.view(np.uint16), image.view(np.uint16))
    assert exr(back, RGBA) == data


@given(hnp.arrays(np.float32, st.tuples(st.integers(1, 40), st.integers(1, 9), st.just(2)),
                  elements=st.floats(-1e6, 1e6, width=32)))  # fmt: skip
@settings(max_examples=40)
def test_floats_come_back_bit_for_bit(image):
    back = read_exr(exr(image, XY), XY)
    np.testing.assert_array_equal(back.view(np.uint32), image.view(np.uint32))


@pytest.mark.parametrize(("names", "dtype"), [(RGBA, np.float16), (XY, np.float32)])
@pytest.mark.parametrize("smooth", [True, False])
def test_openimageio_sees_the_same_pixels(tmp_path, names, dtype, smooth):
    """Noise does not compress, so that both kinds of blocks are read."""
    rng = np.random.default_rng(0)
    image = (
        np.full((37, 21, len(names)), 0.25, dtype)
        if smooth
        else rng.standard_normal((37, 21, len(names))).astype(dtype)
    )
    (tmp_path / "a.exr").write_bytes(exr(image, names))
    pixels, found = by_oiio(tmp_path / "a.exr", names)
    assert sorted(found) == sorted(names)
    seen = pixels[..., [found.index(name) for name in names]]
    np.testing.assert_array_equal(seen.astype(np.float32), image.astype(np.float32))


def test_what_openimageio_writes_is_read(tmp_path):
    image = np.linspace(0, 1, 20 * 9 * 4).reshape(20, 9, 4).astype(np.float16)
    spec = oiio.ImageSpec(9, 20, 4, "half")
    spec.channelnames = RGBA
    spec.attribute("compression", "zip")
    output = oiio.ImageOutput.create(str(tmp_path / "a.exr"))
    output.open(str(tmp_path / "a.exr"), spec)
    output.write_image(image)
    output.close()
    np.testing.assert_array_equal(read_exr((tmp_path / "a.exr").read_bytes(), RGBA), image)


def test_what_is_no_exr_or_has_other_channels_is_refused():
    with pytest.raises(ShardError, match="does not begin"):
        read_exr(b"PNG, perhaps", RGBA)
    with pytest.raises(ShardError, match=r"channels \['X', 'Y'\]"):
        read_exr(exr(np.zeros((2, 2, 2), np.float32), XY), RGBA)
