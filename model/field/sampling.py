"""Where samples lie on pieces of rays, and the optical depth that each of them stands for.

Letters: K segments, N samples of a segment, M coarse samples.
"""

from collections.abc import Callable
from dataclasses import dataclass

import torch
from torch import Tensor

from model.field.sdf import Quadrature, fading, laplace_density, mean_density

EVEN_SHARE = 0.2
"""Share of samples that are spread evenly whatever the coarse pass found."""
COARSE_SHARPNESS = 2.0
"""The coarse density is at least as wide as a cell over this, so that no thin wall lies unseen
between two samples."""


@dataclass(frozen=True, kw_only=True)
class Cells:
    """N neighboring cells that fill a segment, with a sample in each.

    Attributes:
        at_KN: distance of the samples along the ray.
        edges_KM: N + 1 borders of the cells.
    """

    at_KN: Tensor
    edges_KM: Tensor


def placed(
    entry_K: Tensor,
    length_K: Tensor,
    samples: int,
    *,
    generator: torch.Generator | None = None,
    coarse: int = 0,
    inverse_beta: Tensor | float = 1.0,
    distances: Callable[[Tensor], Tensor] | None = None,
) -> Cells:
    """Cells over segments, even or gathered where `distances` of M even ones show a surface.

    Args:
        distances: (K, M) places along the rays to signed distances there; asked without gradient.
        generator: draws the sample's place in its cell; None takes the middle.
    """
    edges_KM = entry_K[:, None] + length_K[:, None] * _steps(samples, entry_K)
    if coarse and distances is not None:
        with torch.no_grad():
            wide_KM = entry_K[:, None] + length_K[:, None] * _steps(coarse, entry_K)
            found_KM = distances((wide_KM[:, 1:] + wide_KM[:, :-1]) / 2.0)
            share_KM = _weights(found_KM.to(entry_K.dtype), wide_KM, inverse_beta)
        edges_KM = entry_K[:, None] + length_K[:, None] * _quantiles(share_KM, samples)
    first_KN, last_KN = edges_KM[:, :-1], edges_KM[:, 1:]
    if generator is None:
        return Cells(at_KN=(first_KN + last_KN) / 2.0, edges_KM=edges_KM)
    drawn_KN = torch.rand(
        first_KN.shape, generator=generator, device=entry_K.device, dtype=entry_K.dtype
    )
    return Cells(at_KN=torch.lerp(first_KN, last_KN, drawn_KN), edges_KM=edges_KM)


def optical_depth(
    distance_KN: Tensor, cells: Cells, inverse_beta: Tensor | float, quadrature: Quadrature
) -> Tensor:
    """(K, N) density times length of each sample's cell.

    `linear` takes the distance as linear between samples and constant before the first and after
    the last one: exact for planes however few the samples.
    """
    at_KN, edges_KM = cells.at_KN, cells.edges_KM
    first_KN, last_KN = edges_KM[:, :-1], edges_KM[:, 1:]
    if quadrature == "point":
        return laplace_density(distance_KN, inverse_beta) * (last_KN - first_KN)
    gap = at_KN[:, 1:] - at_KN[:, :-1]
    share = (edges_KM[:, 1:-1] - at_KN[:, :-1]) / torch.where(gap > 0.0, gap, 1.0)
    inner = torch.lerp(distance_KN[:, :-1], distance_KN[:, 1:], share)
    at_first = torch.cat([distance_KN[:, :1], inner], dim=1)
    at_last = torch.cat([inner, distance_KN[:, -1:]], dim=1)
    before = mean_density(at_first, distance_KN, inverse_beta) * (at_KN - first_KN)
    return before + mean_density(distance_KN, at_last, inverse_beta) * (last_KN - at_KN)


def _steps(count: int, like: Tensor) -> Tensor:
    return torch.linspace(0.0, 1.0, count + 1, dtype=like.dtype, device=like.device)


def _weights(distance_KM: Tensor, edges_KM: Tensor, inverse_beta: Tensor | float) -> Tensor:
    """(K, M) share of the samples that each coarse cell deserves; positive, of sum 1."""
    width_KM = edges_KM[:, 1:] - edges_KM[:, :-1]
    blunt_KM = COARSE_SHARPNESS / width_KM.clamp(min=torch.finfo(width_KM.dtype).tiny ** 0.25)
    sharp = blunt_KM.clamp(max=inverse_beta)
    depth_KM = laplace_density(distance_KM, sharp) * width_KM
    weight_KM = fading(depth_KM.cumsum(dim=1) - depth_KM) * -torch.expm1(-depth_KM)
    even = 1.0 / weight_KM.shape[1]
    total_K1 = weight_KM.sum(dim=1, keepdim=True)
    found = torch.where(total_K1 > 1e-6, weight_KM / total_K1.clamp(min=1e-6), even)
    return torch.lerp(found, torch.full_like(found, even), EVEN_SHARE)


def _quantiles(share_KM: Tensor, samples: int) -> Tensor:
    """(K, samples + 1) in [0, 1]: where the accumulated share, linear in cells, steps evenly."""
    count = share_KM.shape[1]
    total_KM = torch.cat([torch.zeros_like(share_KM[:, :1]), share_KM.cumsum(dim=1)], dim=1)
    total_KM = total_KM / total_KM[:, -1:]
    wanted_KN = _steps(samples, share_KM).expand(len(share_KM), -1).contiguous()
    cell_KN = torch.searchsorted(total_KM, wanted_KN, right=True).clamp(1, count) - 1
    below_KN = torch.gather(total_KM, 1, cell_KN)
    within_KN = (wanted_KN - below_KN) / torch.gather(share_KM, 1, cell_KN)
    return ((cell_KN + within_KN.clamp(0.0, 1.0)) / count).clamp(0.0, 1.0)
