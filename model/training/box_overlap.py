"""How far boxes overlap, with slopes: what a network is held to beside squared lengths of boxes.

A handle a tenth off its place costs a squared length next to nothing, and all of its overlap. The
generalized IoU counts every part alike, and falls on where boxes no longer meet.

B objects, P part slots.
"""

import torch
from torch import Tensor

from model.batch import Articulation
from model.precision import full

LEAST_SIDE = 1e-3
"""Radii. Thinner boxes count as that thick: half a millimeter of an object of a meter."""


def generalized_iou(ours: Articulation, theirs: Articulation) -> Tensor:
    """(B, P) generalized IoU of the boxes at rest, in (-1, 1], 1 for equal ones (Rezatofighi 2019).

    Volumes are at least that of a cube of `LEAST_SIDE`, so that values and slopes are finite.
    """
    lows, highs = zip(*(_corners(boxes) for boxes in (ours, theirs)), strict=True)
    shared_BP = _volume(torch.minimum(*highs) - torch.maximum(*lows))
    around_BP = _volume(torch.maximum(*highs) - torch.minimum(*lows))
    each = [_volume(high - low) for low, high in zip(lows, highs, strict=True)]
    union_BP = each[0] + each[1] - shared_BP
    return shared_BP / union_BP - (around_BP - union_BP) / around_BP


def _corners(boxes: Articulation) -> tuple[Tensor, Tensor]:
    half_BP3 = full(boxes.size_BP3).clamp(min=LEAST_SIDE) / 2.0
    return full(boxes.center_BP3) - half_BP3, full(boxes.center_BP3) + half_BP3


def _volume(sides_BP3: Tensor) -> Tensor:
    return sides_BP3.clamp(min=0.0).prod(dim=-1)
