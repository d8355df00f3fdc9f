"""Image metrics in closed form and against a plain loop."""

import math

import numpy as np
import pytest

from artgen.core.errors import ModelError
from model.evaluation.images import MOST_DB, image_scores, mask_iou, over_white, psnr, ssim

GRAY = np.full((24, 24, 3), 0.5)
ALL = np.ones((24, 24), bool)


def noise(seed: int = 0) -> np.ndarray:
    return np.random.Generator(np.random.PCG64(seed)).random((24, 24, 3))


def test_an_offset_of_a_tenth_is_20_db() -> None:
    assert psnr(GRAY + 0.1, GRAY) == pytest.approx(20.0, abs=1e-13)
    assert psnr(GRAY, GRAY) == MOST_DB


def test_foreground_alone() -> None:
    mask = np.zeros((24, 24), bool)
    mask[:12] = True
    wrong = GRAY.copy()
    wrong[:12] += 0.1
    found = image_scores(wrong, GRAY, mask, mask)
    assert found.psnr_foreground == pytest.approx(20.0, abs=1e-13)
    assert found.psnr == pytest.approx(20.0 + 10.0 * math.log10(2.0), abs=1e-13)
    assert found.lpips is None
    assert image_scores(GRAY, GRAY, mask, np.zeros_like(mask)).psnr_foreground is None


def test_ssim_of_constant_images_is_its_luminance_term() -> None:
    """(2 a b + C1) / (a^2 + b^2 + C1) with C1 = 0.01^2, as all variances are 0."""
    found = ssim(GRAY + 0.2, GRAY)
    assert found == pytest.approx((2 * 0.35 + 1e-4) / (0.25 + 0.49 + 1e-4), abs=1e-12)
    assert ssim(GRAY[:8], GRAY[:8]) is None


def test_ssim_against_a_plain_loop() -> None:
    """Wang et al. 2004 with Gaussian weights of 1.5 px on 11 x 11 px, over inner pixels."""
    first, second = noise(1), noise(2)
    grid = np.arange(11) - 5
    weights = np.exp(-(grid**2) / (2.0 * 1.5**2))
    window = np.outer(weights, weights) / weights.sum() ** 2
    values = []
    for channel in range(3):
        for row in range(5, 19):
            for column in range(5, 19):
                x = first[row - 5 : row + 6, column - 5 : column + 6, channel]
                y = second[row - 5 : row + 6, column - 5 : column + 6, channel]
                mx, my = (window * x).sum(), (window * y).sum()
                vx, vy = (window * x * x).sum() - mx * mx, (window * y * y).sum() - my * my
                vxy = (window * x * y).sum() - mx * my
                top = (2 * mx * my + 1e-4) * (2 * vxy + 9e-4)
                values.append(top / ((mx * mx + my * my + 1e-4) * (vx + vy + 9e-4)))
    assert ssim(first, second) == pytest.approx(np.mean(values), abs=1e-10)  # float64 sums.


def test_masks() -> None:
    left, top = np.zeros((4, 4), bool), np.zeros((4, 4), bool)
    left[:, :2], top[:2] = True, True
    assert mask_iou(left, top) == 4 / 12
    assert mask_iou(left & ~left, left) == 0.0
    assert mask_iou(left & ~left, left & ~left) is None


def test_alpha_goes_over_white() -> None:
    rgba = np.dstack([GRAY * 0.0, np.full((24, 24), 0.25)])
    rgb, mask = over_white(rgba)
    assert np.array_equal(rgb, np.full((24, 24, 3), 0.75))
    assert mask is not None
    assert not mask.any()


def test_an_image_without_alpha_has_no_mask() -> None:
    """It would be all foreground, and share every pixel with any other such image."""
    rgb, mask = over_white(GRAY)
    assert mask is None
    assert image_scores(rgb, GRAY, None, None).psnr == MOST_DB
    half = ALL.copy()
    half[:12] = False
    found = image_scores(GRAY, GRAY, mask, half)
    assert found.mask_iou is None
    assert found.psnr_foreground == MOST_DB


def test_another_size_is_refused() -> None:
    with pytest.raises(ModelError, match="24 x 12 px is compared with one of 24 x 24"):
        image_scores(GRAY[:12], GRAY, ALL[:12], ALL)


def test_a_perceptual_distance_is_asked_where_there_is_one() -> None:
    assert image_scores(GRAY, GRAY, ALL, ALL, perceptual=lambda a, b: 0.25).lpips == 0.25
