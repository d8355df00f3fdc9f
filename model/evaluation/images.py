"""Distances between images: PSNR, SSIM, LPIPS where its weights are at hand, IoU of masks.

Images are (H, W, 3) float in [0, 1], sRGB, over white; masks are (H, W) bool.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skimage.metrics import structural_similarity

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats

Mask = NDArray[np.bool_]
Perceptual = Callable[[Floats, Floats], float | None]
"""LPIPS of two images, None for small ones; there is none without the real weights."""

MOST_DB = 100.0
"""PSNR of equal images, which would be infinite: an error of 1e-5 of the range."""
WINDOW = 11
"""Side of SSIM's window in scikit-image for a deviation of 1.5 px."""


@dataclass(frozen=True, kw_only=True)
class ImageScores:
    """Scores of one image; all None where it cannot be compared.

    Attributes:
        psnr: dB over all pixels.
        psnr_foreground: dB over the pixels of the true mask; None where it is empty or unknown.
        ssim: Wang et al. 2004: Gaussian window of 1.5 px, biased covariance; None for images
            smaller than the window.
        lpips: None without weights.
        mask_iou: of the whole object's masks; None where both are empty or one is unknown.
    """

    psnr: float | None = None
    psnr_foreground: float | None = None
    ssim: float | None = None
    lpips: float | None = None
    mask_iou: float | None = None


def image_scores(
    predicted: Floats,
    true: Floats,
    predicted_mask: Mask | None,
    true_mask: Mask | None,
    *,
    perceptual: Perceptual | None = None,
) -> ImageScores:
    """All scores of an image; masks are None where they are not known.

    Raises:
        ModelError: the images differ in size.
    """
    if predicted.shape != true.shape:
        raise ModelError(
            f"an image of {predicted.shape[1]} x {predicted.shape[0]} px is compared with one of "
            f"{true.shape[1]} x {true.shape[0]} px; render both with the same cameras"
        )
    inside = None if true_mask is None or not true_mask.any() else true_mask
    return ImageScores(
        psnr=psnr(predicted, true),
        psnr_foreground=None if inside is None else psnr(predicted[inside], true[inside]),
        ssim=ssim(predicted, true),
        lpips=None if perceptual is None else perceptual(predicted, true),
        mask_iou=(
            None
            if predicted_mask is None or true_mask is None
            else mask_iou(predicted_mask, true_mask)
        ),
    )


def psnr(predicted: Floats, true: Floats) -> float:
    """-10 log10 of the mean squared error, `MOST_DB` at most."""
    error = float(np.mean((predicted - true) ** 2))
    return MOST_DB if error <= 10.0 ** (-MOST_DB / 10.0) else -10.0 * math.log10(error)


def ssim(predicted: Floats, true: Floats) -> float | None:
    """Structural similarity by scikit-image, the mean over channels."""
    if min(predicted.shape[:2]) < WINDOW:
        return None
    return float(
        structural_similarity(
            true,
            predicted,
            data_range=1.0,
            channel_axis=-1,
            gaussian_weights=True,
            sigma=1.5,
            use_sample_covariance=False,
        )
    )


def mask_iou(predicted: Mask, true: Mask) -> float | None:
    """Shared pixels over the pixels of either; None where both are empty."""
    either = int((predicted | true).sum())
    return float((predicted & true).sum()) / either if either else None


def over_white(rgba: Floats) -> tuple[Floats, Mask | None]:
    """(H, W, 3) over white and (H, W) mask of an image with straight alpha; one without alpha does
    not say what the object is."""
    if rgba.shape[-1] == 3:
        return rgba, None
    alpha = rgba[..., 3:]
    return rgba[..., :3] * alpha + (1.0 - alpha), alpha[..., 0] > 0.5
