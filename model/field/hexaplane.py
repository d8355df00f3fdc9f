"""Hexa-planes: six feature images of a part's box, and what a point of the box reads from them.

ART, supplement, S1: for each pair of axes two images, the one for points where the third coordinate
is >= 0 and the one for the others; the three values read are joined.

Letters: B objects, P parts, C channels, H W rows and columns of a plane, K segments (pieces of rays
or other runs of points, each in one part's box), N points of a segment, digits a length.
"""

import torch
import torch.nn.functional as F
from torch import Tensor

from model.field.ragged import ragged
from model.precision import full, full_precision

COLUMN, ROW, SIDE = (0, 1, 0), (1, 2, 2), (2, 0, 1)
"""Of the planes xy, yz and xz: the coordinates along columns, along rows, and which picks the side.
"""
INSET = 1e-3
"""Texels that a reading stays away from the last row, so that rounding never reads a neighbor's."""
ROUNDINGS = 4
"""Of a coordinate on its way to a texel, half an epsilon of the whole image each; a reading stays
as far from the first row, where it would else read the last one of the planes before."""


def stacked(planes_BP6CHW: Tensor) -> Tensor:
    """(B * 3, C, P * H, 2 * W) one image for each object and pair of axes: parts below each other,
    the side >= 0 left of the side < 0; so that one call reads all parts."""
    batch, parts, _, channels, height, width = planes_BP6CHW.shape
    pairs = full(planes_BP6CHW).reshape(batch, parts, 3, 2, channels, height, width)
    images = pairs.permute(0, 2, 4, 1, 5, 3, 6)
    return images.reshape(batch * 3, channels, parts * height, 2 * width)


def read(
    images: Tensor, points_KN3: Tensor, slot_K: Tensor, *, parts: int, blend: float = 0.0
) -> Tensor:
    """(K, N, 3 * C) features of points, in coordinates [-1, 1] of their parts' boxes.

    Args:
        images: of `stacked`.
        slot_K: object * P + part of every segment; objects must not decrease.
        parts: P.
        blend: half width around 0 of the third coordinate over which both sides mix; 0 switches.
    """
    with full_precision(images):
        third_KN3 = points_KN3[..., SIDE]
        if blend == 0.0:
            return _one_side(images, points_KN3, slot_K, third_KN3 >= 0, parts)
        share_KN3 = (0.5 + third_KN3 / (2.0 * blend)).clamp(0.0, 1.0)
        yes = torch.ones_like(third_KN3, dtype=torch.bool)
        above = _one_side(images, points_KN3, slot_K, yes, parts)
        below = _one_side(images, points_KN3, slot_K, ~yes, parts)
        share = share_KN3.repeat_interleave(images.shape[1], dim=-1)
        return torch.lerp(below, above, share)


def _one_side(
    images: Tensor, points_KN3: Tensor, slot_K: Tensor, upper_KN3: Tensor, parts: int
) -> Tensor:
    """Features read from the side >= 0 where `upper_KN3`, else from the other."""
    batch = images.shape[0] // 3
    height, width = images.shape[2] // parts, images.shape[3] // 2
    least = ROUNDINGS * torch.finfo(points_KN3.dtype).eps / 2.0
    column = _texel(points_KN3[..., COLUMN], width, least * 2 * width) + width * ~upper_KN3
    row = _texel(points_KN3[..., ROW], height, least * parts * height)
    row = row + height * (slot_K % parts)[:, None, None]
    # grid_sample takes -1 and 1 for the outer edges of the outer texels.
    x = (2.0 * column + 1.0) / (2 * width) - 1.0
    y = (2.0 * row + 1.0) / (parts * height) - 1.0
    grid_KN32 = torch.stack([x, y], dim=-1)
    rows = ragged(slot_K // parts, batch)
    features = _sampled(images, rows.padded(grid_KN32).flatten(1, 2))
    return rows.packed(features.reshape(batch, rows.most, *grid_KN32.shape[1:2], -1))


def _texel(coordinates: Tensor, count: int, least: float) -> Tensor:
    """Texel coordinate 0 (first middle) to count - 1 (last middle) of [-1, 1]; clamped."""
    at = (coordinates + 1.0) * ((count - 1) / 2.0)
    return at.clamp(least, count - 1 - INSET) if count > 1 else torch.zeros_like(at)


def _sampled(images: Tensor, grid_BM32: Tensor) -> Tensor:
    """(B, M, 3 * C)."""
    grid = grid_BM32.transpose(1, 2).reshape(images.shape[0], 1, -1, 2)
    values: Tensor = F.grid_sample(images, grid, mode="bilinear", align_corners=False)
    batch = images.shape[0] // 3
    return values.reshape(batch, -1, grid.shape[2]).transpose(1, 2)
