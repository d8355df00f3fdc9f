"""Images come back as they were, to the rounding that the codec states."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from artgen.core.errors import ShardError
from artgen.dataset import codec

DEPTHS = hnp.arrays(
    np.float32,
    hnp.array_shapes(min_dims=2, max_dims=2, max_side=8),
    elements=st.one_of(st.just(0.0), st.floats(0.125, 128.0, width=32)),
)


@given(DEPTHS)
def test_a_depth_is_off_by_half_a_step_and_one_rounding_at_most(depth):
    span = codec.depth_range(depth)
    back = span.decode(codec.read_gray16(codec.png(span.encode(depth))))
    np.testing.assert_array_equal(back == 0, depth == 0)
    # Half of a step of (far - near) / 65534, and the rounding of the result to float32 (2^-24).
    bound = (span.far - span.near) / 131068 + span.far * 2.0**-24
    assert np.abs(back - depth.astype(np.float64)).max() <= bound * (1 + 1e-9)


@given(DEPTHS)
def test_encoding_a_decoded_depth_gives_the_same_codes(depth):
    """The ends of the range are values of the image, so that the second range equals the first; and
    a float32 rounding is either below half a step, or the step is so fine that codes hit values."""
    span = codec.depth_range(depth)
    codes = span.encode(depth)
    back = span.decode(codes)
    assert codec.depth_range(back) == span
    np.testing.assert_array_equal(codec.depth_range(back).encode(back), codes)


DIRECTIONS = hnp.arrays(np.float64, (4, 3), elements=st.floats(-1, 1)).filter(
    lambda rows: np.linalg.norm(rows, axis=1).min() > 1e-3
)


@given(DIRECTIONS)
def test_normals_keep_their_codes_and_are_off_by_half_a_code_at_most(directions):
    normal = (directions / np.linalg.norm(directions, axis=1, keepdims=True)).astype(np.float32)
    codes = codec.normal_codes(normal)
    back = codec.decoded_normals(codes)
    assert np.abs(back - normal).max() <= 1 / 254 + 2.0**-22  # a few float32 roundings
    np.testing.assert_array_equal(codec.normal_codes(back), codes)


def test_axis_aligned_normals_and_background_are_exact():
    normal = np.float32([[1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, 0]])
    np.testing.assert_array_equal(codec.decoded_normals(codec.normal_codes(normal)), normal)


@given(hnp.arrays(np.uint8, st.tuples(st.integers(1, 9), st.integers(1, 9), st.just(4))))
def test_rgba_is_bit_equal_even_under_alpha_zero(image):
    """Without libwebp's `exact` the color of transparent pixels is rewritten."""
    np.testing.assert_array_equal(codec.read_rgba(codec.webp(image)), image)


@pytest.mark.parametrize("alpha", [0, 255])
def test_a_constant_alpha_comes_back(alpha):
    image = np.full((3, 4, 4), alpha, np.uint8)
    np.testing.assert_array_equal(codec.read_rgba(codec.webp(image)), image)


@given(hnp.arrays(np.uint8, st.tuples(st.integers(1, 9), st.integers(1, 9))))
def test_part_ids_are_bit_equal(image):
    np.testing.assert_array_equal(codec.read_gray8(codec.png(image)), image)


def test_a_strip_too_long_for_webp_is_refused():
    with pytest.raises(ShardError, match="16383"):
        codec.webp(np.zeros((codec.WEBP_LIMIT + 1, 1, 4), np.uint8))
