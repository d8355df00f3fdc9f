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
    return _giou(_corners(ours), _corners(theirs))


def range_giou(ours_BP2: Tensor, theirs_BP2: Tensor) -> Tensor:
    """(B, P) generalized IoU of joint ranges, lower and upper end, in (-1, 1].

    Ranges are at least `LEAST_RANGE` long, from their middle; of ours the ends may be in any order.
    """
    return _giou(_ends(ours_BP2), _ends(theirs_BP2))


Corners = tuple[Tensor, Tensor]
"""(B, P, D) lower and upper corners in D dimensions."""


def _giou(ours: Corners, theirs: Corners) -> Tensor:
    """(B, P)."""
    lows, highs = zip(ours, theirs, strict=True)
    shared_BP = _volume(torch.minimum(*highs) - torch.maximum(*lows))
    around_BP = _volume(torch.maximum(*highs) - torch.minimum(*lows))
    each = [_volume(high - low) for low, high in (ours, theirs)]
    union_BP = each[0] + each[1] - shared_BP
    return shared_BP / union_BP - (around_BP - union_BP) / around_BP


def _ends(limits_BP2: Tensor) -> Corners:
    first_BP1, second_BP1 = full(limits_BP2)[..., :1], full(limits_BP2)[..., 1:]
    middle_BP1 = (first_BP1 + second_BP1) / 2.0
    half_BP1 = (second_BP1 - first_BP1).abs().clamp(min=LEAST_RANGE) / 2.0
    return middle_BP1 - half_BP1, middle_BP1 + half_BP1


def _corners(boxes: Articulation) -> Corners:
    half_BP3 = full(boxes.size_BP3).clamp(min=LEAST_SIDE) / 2.0
    return full(boxes.center_BP3) - half_BP3, full(boxes.center_BP3) + half_BP3


def _volume(sides_BPD: Tensor) -> Tensor:
    return sides_BPD.clamp(min=0.0).prod(dim=-1)
