"""Part slots in an arbitrary order: the ablation of the canonical one.

B objects, P part slots.
"""

import dataclasses
from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor

from artgen.core.stream import Stream
from model.batch import Articulation, Batch, Rays


def shuffled(batch: Batch) -> Batch:
    """The batch with every object's movable parts in an order that its id decides."""
    counts = batch.truth.valid_BP.sum(dim=1).tolist()
    slots = batch.truth.valid_BP.shape[1]
    rows = [_order(name, n, slots) for name, n in zip(batch.asset_ids, counts, strict=True)]
    order_BP = torch.tensor(rows, device=batch.truth.valid_BP.device)
    rays = None if batch.rays is None else _shuffled_rays(batch.rays, order_BP)
    return dataclasses.replace(batch, truth=_shuffled_truth(batch.truth, order_BP), rays=rays)


def _order(asset_id: str, count: int, slots: int) -> Sequence[int]:
    """Which part each slot receives; the base and empty slots stay."""
    movers = Stream(0, "part order", asset_id).generator().permutation(np.arange(1, count))
    return [0, *movers.tolist(), *range(count, slots)]


def _shuffled_truth(truth: Articulation, order_BP: Tensor) -> Articulation:
    slot_BP = order_BP.argsort(dim=1)
    parent_BP = truth.parent_BP.gather(1, order_BP)
    renamed_BP = slot_BP.gather(1, parent_BP.clamp(min=0))
    return Articulation(
        valid_BP=truth.valid_BP.gather(1, order_BP),
        center_BP3=_taken(truth.center_BP3, order_BP),
        size_BP3=_taken(truth.size_BP3, order_BP),
        type_BP=truth.type_BP.gather(1, order_BP),
        axis_BP3=_taken(truth.axis_BP3, order_BP),
        origin_BP3=_taken(truth.origin_BP3, order_BP),
        motion_BTP=_taken(truth.motion_BTP.transpose(1, 2), order_BP).transpose(1, 2),
        limits_BP2=_taken(truth.limits_BP2, order_BP),
        parent_BP=torch.where(parent_BP < 0, parent_BP, renamed_BP),
    )


def _shuffled_rays(rays: Rays, order_BP: Tensor) -> Rays:
    return dataclasses.replace(
        rays,
        part_rgb_BPR3=_taken(rays.part_rgb_BPR3, order_BP),
        part_alpha_BPR=_taken(rays.part_alpha_BPR, order_BP),
    )


def _taken(values_BPX: Tensor, order_BP: Tensor) -> Tensor:
    """Rows of the parts, in another order."""
    index = order_BP.view(*order_BP.shape, *[1] * (values_BPX.ndim - 2))
    return values_BPX.gather(1, index.expand_as(values_BPX))
