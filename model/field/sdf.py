"""From signed distance to density, in forms that neither overflow nor cancel.

VolSDF's density is (1 / beta) times the Laplace distribution of the negative distance. ART's S3 as
printed lacks the factor 1 / beta and has the wrong sign inside (its branch falls below 0 for
s < -beta ln 2); both are read as slips of the pen.
"""

from typing import Literal

import torch
from torch import Tensor

Quadrature = Literal["point", "linear"]
"""How density becomes optical depth: its value at the sample, or its exact mean over the sample's
cell for a distance that is linear between samples."""

ALIKE = 1e-2
"""Distances closer than this, in betas, count as one: the mean density of the stretch is then the
density in its middle, wrong by ALIKE^2 / 48 at most, less than the quotient would lose to rounding.
"""


UNSEEN = 30.0
"""exp(-UNSEEN) = 9e-14 is far below what float32 tells from nothing, and counts as nothing: else
most gradients of a ray are denormal numbers, on which CPUs compute ten times slower."""


def fading(depth: Tensor) -> Tensor:
    """exp(-depth) for depth >= 0; 0 with slope 0 beyond `UNSEEN`."""
    return torch.where(depth < UNSEEN, torch.exp(-depth.clamp(max=UNSEEN)), 0.0)


def laplace_density(distance: Tensor, inverse_beta: Tensor | float) -> Tensor:
    """Density 1 / radius: half of `inverse_beta` on the surface, all of it deep inside, 0 far out.

    The exponential never grows, so no branch overflows and no gradient is inf * 0.
    """
    half = 0.5 * fading(distance.abs() * inverse_beta)
    return inverse_beta * torch.where(distance >= 0, half, 1.0 - half)


def mean_density(first: Tensor, last: Tensor, inverse_beta: Tensor | float) -> Tensor:
    """Mean of `laplace_density` over a stretch on which the distance runs linearly between two.

    The Laplace distribution's antiderivative is min(s, 0) - exp(-|s|) / 2, s in betas; its parts
    are subtracted apart, for together a part of 1e4 would swallow a part of 1.
    """
    a, b = first * inverse_beta, last * inverse_beta
    apart = (b - a).abs() > ALIKE
    gap = torch.where(apart, b - a, 1.0)
    inside = b.clamp(max=0.0) - a.clamp(max=0.0)
    tail = 0.5 * (fading(a.abs()) - fading(b.abs()))
    middle = laplace_density((first + last) / 2.0, inverse_beta)
    return torch.where(apart, inverse_beta * (inside + tail) / gap, middle)
