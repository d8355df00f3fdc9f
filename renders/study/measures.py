"""How far an image is from the reference: PSNR, PSNR of the foreground, FLIP."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import UsageError
from artgen.core.mesh import Floats
from artgen.imaging import Singles, display
from artgen.render_job import Shot

try:
    import flip_evaluator
except ImportError as error:
    raise UsageError(
        "the study measures FLIP with flip-evaluator, which is not installed: "
        "pip install 'artgen[study]'"
    ) from error

COVERED = 0.5
"""Alpha of the reference above which a pixel is foreground."""


@dataclass(frozen=True, kw_only=True)
class Error:
    """Errors of several images of one size.

    Attributes:
        square: mean squared error over all pixels, of sRGB in [0, 1] over white.
        foreground: the same over covered pixels.
        flip: mean FLIP over the images, at 67 px a degree.
    """

    square: float
    foreground: float
    flip: float


def shown(linear: Singles, shot: Shot, size: int) -> Floats:
    """(size, size, 3) sRGB in [0, 1] over white; what lies outside a part's window is white."""
    rgba = display(linear) / 255.0
    canvas = np.ones((size, size, 3))
    left, top, right, bottom = shot.box
    canvas[top:bottom, left:right] = rgba[..., :3] * rgba[..., 3:] + 1.0 - rgba[..., 3:]
    return canvas


def covered(linear: Singles, shot: Shot, size: int) -> NDArray[np.bool_]:
    """(size, size) where the image shows the object."""
    mask = np.zeros((size, size), bool)
    left, top, right, bottom = shot.box
    mask[top:bottom, left:right] = linear[..., 3] > COVERED
    return mask


def pooled_error(
    images: Sequence[Singles], truths: Sequence[Singles], shots: Sequence[Shot], size: int
) -> Error:
    """Of images of equal size against the truth, pooled."""
    squares, foregrounds, flips, pixels = 0.0, 0.0, 0.0, 0
    for image, truth, shot in zip(images, truths, shots, strict=True):
        one, two = shown(truth, shot, size), shown(image, shot, size)
        gap = ((one - two) ** 2).mean(axis=-1)
        mask = covered(truth, shot, size)
        squares += float(gap.mean())
        foregrounds += float(gap[mask].sum())
        pixels += int(mask.sum())
        flips += _flip(one, two)
    return Error(
        square=squares / len(images), foreground=foregrounds / pixels, flip=flips / len(images)
    )


def decibels(square: float) -> float:
    """PSNR of a mean squared error of values in [0, 1]; infinite for none."""
    return -10.0 * math.log10(square) if square > 0.0 else math.inf


def without_noise(square: float, noise: float) -> float:
    """The error that is left when the reference's own noise is taken off, never below that noise.

    Picture and reference come from other seeds, so their errors add; but what is finer than the
    reference cannot be seen by it.
    """
    return max(square - noise, noise)


def _flip(truth: Floats, image: Floats) -> float:
    _, mean, _ = flip_evaluator.evaluate(
        truth.astype(np.float32), image.astype(np.float32), "LDR", applyMagma=False
    )
    return float(mean)
