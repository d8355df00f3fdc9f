"""Predictions that are the truth, and ones whose every number is free."""

import dataclasses

import torch
from torch import Tensor

from model.batch import PRISMATIC, Articulation, Batch, Rays
from model.config import LossWeights
from model.field.volume import RayColors
from model.network.prediction import Prediction
from tests.unit.model.tiny_art import SLOTS, drawn_batch

ALL = LossWeights(rgb=1.0, mask=1.0, distance=0.1, overlap=1.0, range=1.0)
CERTAIN = 40.0
"""A logit: exp(-40) is below half an eps of float64, so cross-entropies of it are 0."""


def perfect(truth: Articulation) -> Prediction:
    """A prediction that is the truth, without doubt."""
    kinds = torch.stack([truth.type_BP == PRISMATIC, truth.type_BP != PRISMATIC], dim=-1)
    slots = truth.valid_BP.shape[1]
    parent = torch.nn.functional.one_hot(truth.parent_BP.clamp(min=0), slots)
    count = torch.nn.functional.one_hot(truth.valid_BP.sum(dim=1) - 1, SLOTS)
    return Prediction(
        articulation=truth,
        axis_BP3=truth.axis_BP3,
        origin_BP3=truth.origin_BP3,
        type_logits_BP2=CERTAIN * kinds.double(),
        parent_logits_BPP=CERTAIN * parent.double(),
        count_logits_BQ=CERTAIN * count.double(),
        limited=True,
    )


def batch_of(truth: Articulation) -> Batch:
    return dataclasses.replace(drawn_batch(0), truth=truth)


def seen(rays: Rays) -> RayColors:
    """What a perfect renderer would see."""
    distance = torch.where(rays.alpha_BR > 0.0, 2.5, 0.0).double()
    if rays.distance_BR is not None:
        distance = rays.distance_BR
    return RayColors(
        part_rgb_BPR3=rays.part_rgb_BPR3,
        part_alpha_BPR=rays.part_alpha_BPR,
        rgb_BR3=rays.rgb_BR3,
        alpha_BR=rays.alpha_BR,
        distance_BR=distance,
        part_distance_BPR=torch.zeros_like(rays.part_alpha_BPR),
    )


def leaves(truth: Articulation, seed: int) -> dict[str, Tensor]:
    """Free numbers where a prediction has numbers."""
    torch.manual_seed(seed)
    batch, slots = truth.valid_BP.shape
    states = truth.motion_BTP.shape[1]
    sizes = {
        "center_BP3": (batch, slots, 3),
        "size_BP3": (batch, slots, 3),
        "axis_BP3": (batch, slots, 3),
        "origin_BP3": (batch, slots, 3),
        "motion_BTP": (batch, states, slots),
        "limits_BP2": (batch, slots, 2),
        "type_logits_BP2": (batch, slots, 2),
        "parent_logits_BPP": (batch, slots, slots),
        "count_logits_BQ": (batch, SLOTS),
    }
    return {name: 0.3 * torch.randn(size, dtype=torch.float64) for name, size in sizes.items()}


def from_leaves(truth: Articulation, numbers: dict[str, Tensor]) -> Prediction:
    inner = ("center_BP3", "size_BP3", "motion_BTP", "limits_BP2")
    outer = (name for name in numbers if name not in inner)
    return Prediction(
        articulation=dataclasses.replace(truth, **{name: numbers[name] for name in inner}),
        limited=True,
        **{name: numbers[name] for name in outer},  # type: ignore[arg-type]
    )


def patches_of(rays: Rays | None, height: int, width: int) -> Rays:
    assert rays is not None
    return dataclasses.replace(rays, patch=(height, width))
