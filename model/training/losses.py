"""What training holds a prediction to: one weighted number per term, and their sum.

Every term is a mean over what it applies to (valid slots, movable parts, turning parts, rays) and 0
where there is none; empty slots get no gradient. Squared differences of vectors are squared
lengths, so they do not change under rotation of the frame.

B objects, T states, P part slots, R rays, Q numbers of parts, X any sizes, digits a length.
"""

import dataclasses
from collections.abc import Callable

import torch
from torch import Tensor
from torch.nn import functional

from artgen.core.errors import ModelError
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation, Batch, Rays
from model.config import LossWeights
from model.field.volume import RayColors
from model.network.prediction import TYPE_OF_LOGIT, Prediction
from model.precision import full
from model.training.overlap import box_giou, range_giou

ImageDistance = Callable[[Tensor, Tensor], Tensor]
"""(X, 3, h, w) and the same again, colors in [0, 1] -> (X,) how different they look."""


def losses(
    prediction: Prediction,
    batch: Batch,
    weights: LossWeights,
    rendered: RayColors | None = None,
    *,
    perceptual: ImageDistance | None = None,
    perceptual_factor: float = 1.0,
) -> dict[str, Tensor]:
    """Weighted terms, and their sum under "total"; terms of weight 0 are left out.

    Args:
        rendered: what the batch's rays see of the prediction; None leaves the image terms out.
        perceptual: the image distance of the perceptual term; None leaves it out. The batch's rays
            are then whole patches.
        perceptual_factor: on that term's weight.

    Raises:
        ModelError: `perceptual` without patches.
    """
    terms = articulation_terms(prediction, batch.truth, weights)
    if rendered is not None and batch.rays is not None:
        terms |= image_terms(rendered, batch.rays, batch.truth.valid_BP)
        if perceptual is not None and weights.part_perceptual and perceptual_factor:
            distance = part_perceptual(rendered, batch.rays, batch.truth.valid_BP, perceptual)
            terms["part_perceptual"] = perceptual_factor * distance
    table = dataclasses.asdict(weights)
    weighted = {name: table[name] * term for name, term in terms.items() if table[name]}
    total = torch.stack(list(weighted.values())).sum() if weighted else _nothing(prediction)
    return {**weighted, "total": total}


def articulation_terms(
    prediction: Prediction, truth: Articulation, weights: LossWeights
) -> dict[str, Tensor]:
    """Terms of boxes, types, axes, origins, motions, limits, parents and count, unweighted."""
    said, held = prediction.articulation, truth.valid_BP
    moves = held & (truth.type_BP != FIXED)
    taught = moves & moved(truth, weights.unmoved)
    sign_BP1 = flips(prediction.axis_BP3, truth.axis_BP3, weights)
    motion_BPT = said.motion_BTP.transpose(1, 2)
    terms = {
        "center": squared(said.center_BP3, truth.center_BP3, held),
        "size": squared(said.size_BP3, truth.size_BP3, held),
        "overlap": mean(1.0 - box_giou(said, truth), held),
        "type": type_entropy(prediction.type_logits_BP2, truth.type_BP, moves),
        "axis": squared(sign_BP1 * prediction.axis_BP3, truth.axis_BP3, taught),
        "origin": origin_error(
            prediction.origin_BP3, truth, taught & (truth.type_BP == REVOLUTE), weights
        ),
        "motion": motion_error(sign_BP1 * motion_BPT, truth, moves, weights),
    }
    if prediction.limited:
        terms["limits"] = mean_squared(said.limits_BP2, truth.limits_BP2, moves)
        terms["range"] = mean(1.0 - range_giou(said.limits_BP2, truth.limits_BP2), moves)
    if prediction.parent_logits_BPP is not None:
        terms["parent"] = entropy(prediction.parent_logits_BPP, truth.parent_BP, moves)
    if prediction.count_logits_BQ is not None:
        count_B = held.sum(dim=1)
        terms["count"] = entropy(prediction.count_logits_BQ, count_B - 1, count_B > 0)
    return terms


def image_terms(rendered: RayColors, rays: Rays, valid_BP: Tensor) -> dict[str, Tensor]:
    """Terms of color and coverage, each part alone and all together, and of distance; unweighted.

    Colors are premultiplied, that is, over black.
    """
    everywhere = torch.ones_like(rays.alpha_BR, dtype=torch.bool)
    held = valid_BP[..., None].expand_as(rays.part_alpha_BPR)
    terms = {
        "part_rgb": mean_squared(rendered.part_rgb_BPR3, rays.part_rgb_BPR3, held),
        "part_mask": squared(
            rendered.part_alpha_BPR[..., None], rays.part_alpha_BPR[..., None], held
        ),
        "rgb": mean_squared(rendered.rgb_BR3, rays.rgb_BR3, everywhere),
        "mask": squared(rendered.alpha_BR[..., None], rays.alpha_BR[..., None], everywhere),
    }
    if rays.distance_BR is not None:
        both = (rays.distance_BR > 0.0) & (rendered.distance_BR > 0.0)
        apart = (full(rendered.distance_BR) - rays.distance_BR).abs()
        terms["distance"] = mean(apart, both)
    return terms


def part_perceptual(
    rendered: RayColors, rays: Rays, valid_BP: Tensor, distance: ImageDistance
) -> Tensor:
    """Mean image distance over the patches of valid parts that show the part, or should.

    Raises:
        ModelError: the rays are no whole patches.
    """
    if rays.patch is None:
        raise ModelError(
            "a perceptual loss compares patches, these rays are single ones; set data.patch_px, or "
            "weights.part_perceptual to 0"
        )
    size = rays.patch
    shown = torch.unflatten(rays.part_alpha_BPR, 2, (-1, size[0] * size[1])).amax(dim=-1) > 0.0
    held = shown & valid_BP[..., None]
    ours, theirs = (
        _patches(rgb, size)[held] for rgb in (rendered.part_rgb_BPR3, rays.part_rgb_BPR3)
    )
    if not len(ours):
        return ours.sum()
    return distance(full(ours), full(theirs)).mean()


def moved(truth: Articulation, least: float) -> Tensor:
    """(B, P): whether a part's motion varies over the states by `least` or more."""
    spread_BP = truth.motion_BTP.amax(dim=1) - truth.motion_BTP.amin(dim=1)
    return spread_BP >= least


def flips(axis_BP3: Tensor, true_BP3: Tensor, weights: LossWeights) -> Tensor:
    """(B, P, 1) sign by which axis and motion are read; 1 unless they are free to flip together."""
    along = (axis_BP3.detach() * true_BP3).sum(dim=-1, keepdim=True)
    free = weights.axis_sign == "free"
    return torch.where(along < 0.0, -1.0, 1.0) if free else torch.ones_like(along)


def origin_error(
    origin_BP3: Tensor, truth: Articulation, turns_BP: Tensor, weights: LossWeights
) -> Tensor:
    """Mean squared distance of axis points to the true one, or to the true axis."""
    apart = full(origin_BP3) - truth.origin_BP3
    if weights.origin_to == "line":
        along = (apart * truth.axis_BP3).sum(dim=-1, keepdim=True)
        apart = apart - along * truth.axis_BP3
    return mean(apart.square().sum(dim=-1), turns_BP)


def motion_error(
    motion_BPT: Tensor, truth: Articulation, moves_BP: Tensor, weights: LossWeights
) -> Tensor:
    """Mean squared difference of motions, in their own unit or as paths of the parts' corners."""
    apart_BPT = full(motion_BPT) - truth.motion_BTP.transpose(1, 2)
    if weights.motion_as == "paths":
        apart_BPT = apart_BPT * path_lengths(truth)[..., None]
    return mean(apart_BPT.square().mean(dim=-1), moves_BP)


def path_lengths(truth: Articulation) -> Tensor:
    """(B, P) radii that the corners of a part's box travel a unit of motion, root mean square.

    A unit is a full turn, or two radii; the square of a corner's distance to the axis has the mean
    of that of the box's middle plus those of the half sides across the axis.
    """
    axis_BP3 = truth.axis_BP3
    arm_BP3 = truth.center_BP3 - truth.origin_BP3
    arm_BP3 = arm_BP3 - (arm_BP3 * axis_BP3).sum(dim=-1, keepdim=True) * axis_BP3
    across_BP3 = (truth.size_BP3 / 2.0).square() * (1.0 - axis_BP3.square())
    turned_BP = 2.0 * torch.pi * (arm_BP3.square() + across_BP3).sum(dim=-1).sqrt()
    return torch.where(truth.type_BP == REVOLUTE, turned_BP, 2.0)


def type_entropy(logits_BP2: Tensor, type_BP: Tensor, moves_BP: Tensor) -> Tensor:
    """Mean cross-entropy of the joint type over movable parts."""
    place = {kind: index for index, kind in enumerate(TYPE_OF_LOGIT)}
    target_BP = torch.where(type_BP == PRISMATIC, place[PRISMATIC], place[REVOLUTE])
    return entropy(logits_BP2, target_BP, moves_BP)


def entropy(logits_XQ: Tensor, target_X: Tensor, held_X: Tensor) -> Tensor:
    """Mean cross-entropy where held; targets elsewhere may be anything."""
    target = torch.where(held_X, target_X, 0).flatten()
    each = functional.cross_entropy(full(logits_XQ).flatten(0, -2), target, reduction="none")
    return mean(each, held_X.flatten())


def squared(ours_XD: Tensor, theirs_XD: Tensor, held_X: Tensor) -> Tensor:
    """Mean squared length of the difference where held."""
    return mean((full(ours_XD) - theirs_XD).square().sum(dim=-1), held_X)


def mean_squared(ours_XD: Tensor, theirs_XD: Tensor, held_X: Tensor) -> Tensor:
    """Mean squared difference of the last axis's numbers where held."""
    return mean((full(ours_XD) - theirs_XD).square().mean(dim=-1), held_X)


def mean(values_X: Tensor, held_X: Tensor) -> Tensor:
    """Mean of the held values; 0, with a gradient of 0, where none is held."""
    return torch.where(held_X, values_X, 0.0).sum() / held_X.sum().clamp(min=1)


def _patches(rgb_BPR3: Tensor, size: tuple[int, int]) -> Tensor:
    """(B, P, patches, 3, h, w)."""
    return torch.unflatten(rgb_BPR3, 2, (-1, *size)).movedim(-1, 3)


def _nothing(prediction: Prediction) -> Tensor:
    return prediction.type_logits_BP2.sum() * 0.0
