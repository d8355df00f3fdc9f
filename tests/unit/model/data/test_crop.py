"""The crop of training is the one of inference."""

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import ModelError
from artgen.dataset.preprocess import foreground_window, square_view
from model.data.crop import foreground_windows, square_views

INTRINSICS = np.array([[50.0, 0.0, 17.0], [0.0, 55.0, 12.5], [0.0, 0.0, 1.0]])


@settings(max_examples=40)
@given(seed=st.integers(0, 10**6), size=st.integers(1, 40))
def test_crops_are_those_of_preprocess(seed, size):
    rng = np.random.default_rng(seed)
    rgba = rng.integers(0, 256, (3, *rng.integers(4, 40, 2), 4), dtype=np.uint8)
    height, width = rgba.shape[1:3]
    for image in rgba:
        top, left = rng.integers(0, height), rng.integers(0, width)
        image[:top], image[:, :left] = 0, 0
    stacked = torch.tensor(np.tile(INTRINSICS, (3, 1, 1)))
    squares, intrinsics = square_views(torch.from_numpy(rgba), stacked, size=size)
    for k in range(3):
        expected = square_view(rgba[k], INTRINSICS, size=size)
        # Weights are float64 there and float32 here; sums of at most 40 x 40 terms below 1.
        assert np.abs(squares[k].numpy() - expected.rgba).max() < 2e-6
        np.testing.assert_allclose(intrinsics[k].numpy(), expected.intrinsics, rtol=1e-13)


@given(seed=st.integers(0, 10**6))
def test_windows_are_those_of_preprocess(seed):
    rng = np.random.default_rng(seed)
    mask = rng.random((2, 9, 13)) < 0.05
    mask[:, rng.integers(9), rng.integers(13)] = True
    for found, one in zip(foreground_windows(torch.from_numpy(mask)), mask, strict=True):
        window = foreground_window(one)
        assert found.tolist() == [window.left, window.top, window.side]


def test_an_image_without_foreground_is_named():
    rgba = torch.zeros(2, 4, 4, 4, dtype=torch.uint8)
    rgba[0, 1, 1, 3] = 255
    with pytest.raises(ModelError, match=r"images \[1\] show no foreground"):
        square_views(rgba, torch.eye(3, dtype=torch.float64).expand(2, 3, 3), size=4)
