"""How far boxes and joint ranges overlap, with slopes: what a network is held to beside squares.

A handle a tenth off its place costs a squared length next to nothing, and all of its overlap; so
does a button's way of a few millimeters. The generalized IoU counts every part alike, and falls on
where boxes, or ranges, no longer meet.

B objects, P part slots.
"""

import torch
from torch import Tensor

from model.batch import Articulation
from model.precision import full

LEAST_SIDE = 1e-3
"""Radii. Thinner boxes count as that thick: half a millimeter of an object of a meter."""
LEAST_RANGE = 1e-3
"""In the unit of motions: a third of a degree, or two thousandths of a radius. Shorter ranges count
as that long."""


def box_giou(ours: Articulation, theirs: Articulation) -> Tensor:
    """(B, P) generalized IoU of the boxes at rest, in (-1, 1], 1 for equal ones (Rezatofighi 2019).

    Volumes are at least that of a cube of `LEAST_SIDE`, so that values and slopes are finite.
    """
    lows, highs = zip(*(_corners(boxes) for boxes in (ours, theirs)), strict=True)
    shared_BP = _volume(torch.minimum(*highs) - torch.maximum(*lows))
    around_BP = _volume(torch.maximum(*highs) - torch.minimum(*lows))
    each = [_volume(high - low) for low, high in zip(lows, highs, strict=True)]
    union_BP = each[0] + each[1] - shared_BP
    return shared_BP / union_BP - (around_BP - union_BP) / around_BP


def range_giou(ours_BP2: Tensor, theirs_BP2: Tensor) -> Tensor:
    """(B, P) generalized IoU of joint ranges, lower and upper end, in (-1, 1].

    Ranges are at least `LEAST_RANGE` long, from their middle; of ours the ends may be in any order.
    """
    (low_BP, high_BP), (true_low_BP, true_high_BP) = (
        _ends(limits_BP2) for limits_BP2 in (ours_BP2, theirs_BP2)
    )
    nearest_BP = torch.minimum(high_BP, true_high_BP) - torch.maximum(low_BP, true_low_BP)
    around_BP = torch.maximum(high_BP, true_high_BP) - torch.minimum(low_BP, true_low_BP)
    shared_BP = nearest_BP.clamp(min=0.0)
    union_BP = (high_BP - low_BP) + (true_high_BP - true_low_BP) - shared_BP
    return shared_BP / union_BP - (around_BP - union_BP) / around_BP


def _ends(limits_BP2: Tensor) -> tuple[Tensor, Tensor]:
    first_BP, second_BP = full(limits_BP2).unbind(dim=-1)
    middle_BP = (first_BP + second_BP) / 2.0
    half_BP = (second_BP - first_BP).abs().clamp(min=LEAST_RANGE) / 2.0
    return middle_BP - half_BP, middle_BP + half_BP


def _corners(boxes: Articulation) -> tuple[Tensor, Tensor]:
    half_BP3 = full(boxes.size_BP3).clamp(min=LEAST_SIDE) / 2.0
    return full(boxes.center_BP3) - half_BP3, full(boxes.center_BP3) + half_BP3


def _volume(sides_BP3: Tensor) -> Tensor:
    return sides_BP3.clamp(min=0.0).prod(dim=-1)
