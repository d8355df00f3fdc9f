"""Which pixels supervise: drawn around parts, so that small ones get as many rays as large ones."""

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.nn import functional

from artgen.core.stream import Stream
from model.data.config import DataConfig

DRAWS = 4
"""Numbers in [0, 1) a ray or patch: which image and part, mask or box, where."""


def ray_draws(config: DataConfig, stream: Stream) -> NDArray[np.float32]:
    """(K, DRAWS): K rays, or K patches."""
    count = config.rays // max(config.patch_px, 1) ** 2
    return stream.generator().random((count, DRAWS), dtype=np.float32)


def picked(mask_BNPHW: Tensor, draws_BKD: Tensor, config: DataConfig) -> tuple[Tensor, Tensor]:
    """Image and pixel of every ray.

    Every image and part that is seen in it is as likely as any other. `mask_share` of the rays go
    through the part's mask, dilated, the others through the box around that.

    Args:
        mask_BNPHW: bool, each part alone in each of N images.
        draws_BKD: (B, K, DRAWS) in [0, 1).

    Returns:
        (B, R) int64 image, and (B, R) int64 row * width + column; patches row by row.
    """
    items, images, parts, height, width = mask_BNPHW.shape
    wide = _dilated(mask_BNPHW.flatten(0, 2), config.dilation_px).view(items, images * parts, -1)
    counts_BQ = wide.sum(dim=2)
    seen_BQ = (counts_BQ > 0).float()
    chance_BQ = seen_BQ.cumsum(dim=1)
    total_B1 = chance_BQ[:, -1:]  # Rounding must not reach past the last part that is seen.
    target_BK = torch.minimum(draws_BKD[..., 0] * total_B1, total_B1 - 0.5)
    q_BK = torch.searchsorted(chance_BQ, target_BK.contiguous(), right=True)
    q_BK = q_BK.clamp(max=images * parts - 1)
    inside_BK = _in_mask(wide, counts_BQ, q_BK, draws_BKD[..., 2])
    around_BK = _in_box(wide.view(items, -1, height, width), q_BK, draws_BKD[..., 2:])
    pixel_BK = torch.where(draws_BKD[..., 1] < config.mask_share, inside_BK, around_BK)
    image_BK = q_BK // parts
    if not config.patch_px:
        return image_BK, pixel_BK
    return _patches(image_BK, pixel_BK, config.patch_px, (height, width))


def _dilated(mask_KHW: Tensor, reach: int) -> Tensor:
    if reach == 0:
        return mask_KHW
    wide, image = 2 * reach + 1, mask_KHW[:, None].float()
    image = functional.max_pool2d(image, (1, wide), 1, (0, reach))  # Lines, then columns.
    return functional.max_pool2d(image, (wide, 1), 1, (reach, 0))[:, 0] > 0.0


def _in_mask(wide_BQX: Tensor, counts_BQ: Tensor, q_BK: Tensor, draw_BK: Tensor) -> Tensor:
    """A pixel of the chosen mask, all as likely."""
    pixel_M = torch.nonzero(wide_BQX.flatten())[:, 0] % wide_BQX.shape[2]
    flat = counts_BQ.flatten()
    starts_BQ = (flat.cumsum(0) - flat).view_as(counts_BQ)
    count_BK = counts_BQ.gather(1, q_BK)
    step_BK = (draw_BK * count_BK).long().clamp(max=(count_BK - 1).clamp(min=0))
    return pixel_M[(starts_BQ.gather(1, q_BK) + step_BK).clamp(max=len(pixel_M) - 1)]


def _in_box(wide_BQHW: Tensor, q_BK: Tensor, draws_BK2: Tensor) -> Tensor:
    """A pixel of the chosen mask's box, all as likely."""
    top_BQ, high_BQ = _extent(wide_BQHW.any(dim=3))
    left_BQ, broad_BQ = _extent(wide_BQHW.any(dim=2))
    row = top_BQ.gather(1, q_BK) + (draws_BK2[..., 0] * high_BQ.gather(1, q_BK)).long()
    column = left_BQ.gather(1, q_BK) + (draws_BK2[..., 1] * broad_BQ.gather(1, q_BK)).long()
    height, width = wide_BQHW.shape[2:]
    return row.clamp(max=height - 1) * width + column.clamp(max=width - 1)


def _extent(line_BQN: Tensor) -> tuple[Tensor, Tensor]:
    """First True and how many from there to the last; zero and one where there is none."""
    places = torch.arange(line_BQN.shape[2], device=line_BQN.device)
    length = line_BQN.shape[2]
    first = torch.where(line_BQN, places, length).amin(dim=2)
    last = torch.where(line_BQN, places, -1).amax(dim=2)
    return torch.where(last < 0, 0, first), (last - first + 1).clamp(min=1)


def _patches(
    image_BK: Tensor, pixel_BK: Tensor, side: int, size: tuple[int, int]
) -> tuple[Tensor, Tensor]:
    """The patches about the pixels, moved inwards where they would reach past the image."""
    height, width = size
    top = (pixel_BK // width - side // 2).clamp(0, height - side)
    left = (pixel_BK % width - side // 2).clamp(0, width - side)
    steps = torch.arange(side, device=pixel_BK.device)
    within = (steps[:, None] * width + steps).flatten()
    pixels = (top * width + left)[..., None] + within
    return image_BK.repeat_interleave(side * side, dim=1), pixels.flatten(1)
