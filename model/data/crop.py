"""ART's square crop of many images at once: `artgen.dataset.preprocess.square_view` on a device."""

import torch
from torch import Tensor

from artgen.core.errors import ModelError


def square_views(rgba_KHW4: Tensor, intrinsics_K33: Tensor, *, size: int) -> tuple[Tensor, Tensor]:
    """Each image cropped to the square about its foreground, at `size` x `size` px.

    Args:
        rgba_KHW4: uint8 sRGB with straight alpha.
        intrinsics_K33: float64 px.

    Returns:
        (K, S, S, 4) float32 sRGB premultiplied by alpha, and (K, 3, 3) float64 px of the crops.

    Raises:
        ModelError: an image shows no foreground.
    """
    window_K3 = foreground_windows(rgba_KHW4[..., 3] > 0)
    straight = rgba_KHW4.float() / 255.0
    color, alpha = straight[..., :3], straight[..., 3:]
    height, width = rgba_KHW4.shape[1:3]
    rows_KSH = _weights(height, window_K3[:, 1], window_K3[:, 2], size).to(straight)
    columns_KSW = _weights(width, window_K3[:, 0], window_K3[:, 2], size).to(straight)
    image_KHWC = torch.cat([color * alpha, alpha], dim=-1)
    narrow = torch.einsum("ksh,khwc->kswc", rows_KSH, image_KHWC)
    return (
        torch.einsum("ktw,kswc->kstc", columns_KSW, narrow),
        window_intrinsics(intrinsics_K33, window_K3, size=size),
    )


def foreground_windows(mask_KHW: Tensor) -> Tensor:
    """(K, 3) float64 left, top and side of the square about each mask's box, px.

    Raises:
        ModelError: a mask is empty.
    """
    rows, columns = mask_KHW.any(dim=2), mask_KHW.any(dim=1)
    if not bool(rows.any(dim=1).all()):
        empty = torch.nonzero(~rows.any(dim=1)).squeeze(1).tolist()
        raise ModelError(
            f"images {empty} show no foreground to crop to; check their alpha and their cameras"
        )
    top, bottom = _ends(rows)
    left, right = _ends(columns)
    side = torch.maximum(bottom - top, right - left)
    return torch.stack([(left + right - side) / 2, (top + bottom - side) / 2, side], dim=1)


def _ends(line_KN: Tensor) -> tuple[Tensor, Tensor]:
    """Index of the first and one past the last True of each line, float64."""
    places = torch.arange(line_KN.shape[1], device=line_KN.device)
    first = torch.where(line_KN, places, line_KN.shape[1]).amin(dim=1)
    last = torch.where(line_KN, places, -1).amax(dim=1) + 1
    return first.double(), last.double()


def window_intrinsics(intrinsics_K33: Tensor, window_K3: Tensor, *, size: int) -> Tensor:
    """(K, 3, 3) intrinsics of the images that show the windows at `size` x `size` px."""
    left, top, side = window_K3.unbind(dim=1)
    scale, zero, one = size / side, torch.zeros_like(side), torch.ones_like(side)
    rows = [scale, zero, -scale * left, zero, scale, -scale * top, zero, zero, one]
    return torch.stack(rows, dim=1).view(-1, 3, 3) @ intrinsics_K33


def _weights(length: int, start_K: Tensor, side_K: Tensor, size: int) -> Tensor:
    """(K, S, length) share of each source pixel in each target pixel: a triangle as wide as the
    coarser of the two grids; pixels outside the image have their share too, and show nothing."""
    step = side_K / size
    support = step.clamp(min=1.0)[:, None, None]
    targets = torch.arange(size, device=step.device, dtype=step.dtype) + 0.5
    center = (start_K[:, None] + targets * step[:, None])[:, :, None]
    low, high = (start_K - step - 1.0).amin(), (start_K + side_K + step + 1.0).amax()
    first = int(torch.floor(low.clamp(max=0.0)).item())
    last = int(torch.ceil(high.clamp(min=length)).item())
    sources = torch.arange(first, last, device=step.device, dtype=step.dtype) + 0.5
    weights = (1.0 - (sources - center).abs() / support).clamp(min=0.0)
    weights = weights / weights.sum(dim=2, keepdim=True)
    return weights[:, :, -first : length - first]
