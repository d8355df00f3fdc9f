"""Laws of the losses: zero at the truth, means over what they apply to, and they all fall."""

import dataclasses
from collections.abc import Callable

import pytest
import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.batch import FIXED, REVOLUTE, Articulation, Batch, Rays
from model.config import Direction, LossWeights
from model.field.kinematics import world_from_rest
from model.field.plane_field import Field
from model.field.volume import RayColors, render_along
from model.network.art import Art
from model.training.losses import (
    articulation_terms,
    losses,
    motion_error,
    path_lengths,
)
from tests.unit.model.box_scenes import box_field, cabinet
from tests.unit.model.tiny_art import BEYOND, SLOTS, drawn_batch, drawn_truth, made
from tests.unit.model.training.exact import (
    ALL,
    batch_of,
    from_leaves,
    leaves,
    patches_of,
    perfect,
    seen,
)

TERMS = [
    field.name
    for field in dataclasses.fields(LossWeights)
    if field.type is float and field.name != "unmoved"
]


def test_nothing_is_lost_at_the_truth() -> None:
    batch = drawn_batch(1, rays=5)
    assert batch.rays is not None
    table = losses(perfect(batch.truth), batch, ALL, seen(batch.rays))
    assert set(table) == {
        *(
            "center",
            "size",
            "overlap",
            "type",
            "axis",
            "origin",
            "motion",
            "limits",
            "range",
            "parent",
            "count",
        ),
        *("part_rgb", "part_mask", "rgb", "mask", "distance", "total"),
    }
    # A cross-entropy of logits 40 apart is exp(-40) = 4e-18 per part.
    assert all(float(term) <= 1e-16 for term in table.values())


def test_total_is_the_sum_of_weighted_terms_and_zero_weights_leave_out() -> None:
    batch = drawn_batch(2)
    said = made(BEYOND)(batch.images, batch.truth.valid_BP)
    plain = losses(said, batch, ALL)
    double = losses(said, batch, dataclasses.replace(ALL, center=20.0, type=0.0))
    assert double["center"] == 2.0 * plain["center"]
    assert "type" not in double
    total = sum(float(term.detach()) for name, term in plain.items() if name != "total")
    # Eight positive float64 terms added in two orders.
    assert float(plain["total"].detach()) == pytest.approx(total, rel=1e-14)


def test_free_signs_forgive_an_axis_and_motion_that_flip_together() -> None:
    truth = drawn_truth(11)
    said = perfect(truth)
    flipped = dataclasses.replace(
        said,
        axis_BP3=-said.axis_BP3,
        articulation=dataclasses.replace(truth, motion_BTP=-truth.motion_BTP),
    )
    free = articulation_terms(flipped, truth, LossWeights(axis_sign="free"))
    held = articulation_terms(flipped, truth, LossWeights())
    assert float(free["axis"]) == float(free["motion"]) == 0.0
    # The difference of opposite unit vectors has length 2.
    assert float(held["axis"]) == pytest.approx(4.0, rel=1e-14)
    assert float(held["motion"]) > 0.0


def test_any_point_of_the_axis_will_do_for_a_line() -> None:
    truth = drawn_truth(12)
    said = perfect(truth)
    along = dataclasses.replace(said, origin_BP3=said.origin_BP3 + 0.7 * said.axis_BP3)
    line = articulation_terms(along, truth, LossWeights(origin_to="line"))["origin"]
    point = articulation_terms(along, truth, LossWeights())["origin"]
    assert float(line) < 1e-30
    assert float(point) == pytest.approx(0.49, rel=1e-13)


def test_terms_are_means() -> None:
    """The same objects twice lose as much as once, so weights do not depend on the batch."""
    truth = drawn_truth(13)
    numbers = leaves(truth, 13)
    twice = truth.mapped(lambda tensor: torch.cat([tensor, tensor]))
    doubled = {name: torch.cat([tensor, tensor]) for name, tensor in numbers.items()}
    once = articulation_terms(from_leaves(truth, numbers), truth, ALL)
    again = articulation_terms(from_leaves(twice, doubled), twice, ALL)
    for name, term in once.items():
        torch.testing.assert_close(again[name], term, rtol=1e-13, atol=0, msg=name)


def test_with_every_weight_zero_the_total_is_zero() -> None:
    batch = drawn_batch(15)
    none = LossWeights(**dict.fromkeys(TERMS, 0.0))  # type: ignore[arg-type]
    said = made(BEYOND)(batch.images, batch.truth.valid_BP)
    table = losses(said, batch, none)
    assert set(table) == {"total"}
    assert float(table["total"].detach()) == 0.0


def test_motion_counts_as_much_as_the_other_terms() -> None:
    """The scale trap: being wrong by a typical motion must cost as much as a box that is off by a
    tenth of a radius; unweighted, it would cost a twentieth of that and never be learned."""
    truth = drawn_truth(16, (4, 4))
    said = perfect(truth)
    still = dataclasses.replace(
        said, articulation=dataclasses.replace(truth, motion_BTP=torch.zeros_like(truth.motion_BTP))
    )
    shifted = dataclasses.replace(
        said, articulation=dataclasses.replace(truth, center_BP3=truth.center_BP3 + 0.1)
    )
    batch, weights = batch_of(truth), LossWeights()
    motion = losses(still, batch, weights)["motion"]
    assert float(motion) > float(losses(shifted, batch, weights)["center"])


def test_perceptual_term_sees_whole_patches_of_the_parts_that_show() -> None:
    batch = drawn_batch(17, rays=12)
    assert batch.rays is not None
    alpha = batch.rays.part_alpha_BPR.clone()
    alpha[:, 1, :6] = 0.0
    batch = dataclasses.replace(
        batch, rays=patches_of(dataclasses.replace(batch.rays, part_alpha_BPR=alpha), 2, 3)
    )
    rays = batch.rays
    assert rays is not None
    looked: list[tuple[int, ...]] = []

    def distance(ours: Tensor, theirs: Tensor) -> Tensor:
        looked.append(tuple(theirs.shape))
        first = rays.part_rgb_BPR3[0, 0, :6].reshape(2, 3, 3).movedim(-1, 0)
        torch.testing.assert_close(theirs[0], first, rtol=0, atol=0)
        return (ours - theirs).square().mean(dim=(1, 2, 3)) + 1.0

    table = losses(
        perfect(batch.truth),
        batch,
        ALL,
        seen(rays),
        perceptual=distance,
        perceptual_factor=0.5,
    )
    # Seven valid parts in two patches each, less the first patch of slot 1 in both objects.
    assert looked == [(12, 3, 2, 3)]
    assert float(table["part_perceptual"]) == ALL.part_perceptual * 0.5


def test_perceptual_term_refuses_single_rays() -> None:
    batch = drawn_batch(18, rays=4)
    assert batch.rays is not None
    same: Callable[[Tensor, Tensor], Tensor] = lambda ours, theirs: ours.sum(dim=(1, 2, 3))  # noqa: E731
    with pytest.raises(ModelError, match=r"set data\.patch_px"):
        losses(perfect(batch.truth), batch, ALL, seen(batch.rays), perceptual=same)


def along(
    field: Field, truth: Articulation, rays: Rays, *, inverse_beta: float, samples: int
) -> RayColors:
    """What the rays of a batch see."""
    ways = rays.origin_BR3, rays.direction_BR3, rays.state_BR
    return render_along(field, truth, *ways, inverse_beta=inverse_beta, samples=samples)


def cabinets(*, rays: int) -> Batch:
    """Two cabinets in noise, and what rays through them see."""
    batch = drawn_batch(19, rays=rays, dtype=torch.float32)
    truth = cabinet(slots=SLOTS, batch=2)
    assert batch.rays is not None
    shown = along(box_field(truth), truth, batch.rays, inverse_beta=50.0, samples=16)
    targets = dataclasses.replace(
        batch.rays,
        part_rgb_BPR3=shown.part_rgb_BPR3,
        part_alpha_BPR=shown.part_alpha_BPR,
        rgb_BR3=shown.rgb_BR3,
        alpha_BR=shown.alpha_BR,
        distance_BR=shown.distance_BR,
    )
    return dataclasses.replace(batch, truth=truth, rays=targets)


@pytest.mark.parametrize("direction", ["image_from_part", "part_from_image"])
def test_a_few_steps_lower_every_term(direction: Direction) -> None:
    """Fixed batch, all heads, rendering included: every term falls below 0.8 of itself."""
    batch = cabinets(rays=24)
    rays = batch.rays
    assert rays is not None
    torch.manual_seed(0)
    art = Art(
        dataclasses.replace(BEYOND, trunk=dataclasses.replace(BEYOND.trunk, direction=direction))
    )
    optimizer = torch.optim.Adam(art.parameters(), lr=3e-3)
    history: list[dict[str, float]] = []
    for _ in range(80):
        said = art(batch.images, batch.truth.valid_BP)
        rendered = along(said.field(), batch.truth, rays, inverse_beta=10.0, samples=8)
        table = losses(said, batch, ALL, rendered)
        optimizer.zero_grad()
        table["total"].backward()
        optimizer.step()
        history.append({name: float(term.detach()) for name, term in table.items()})
    first, last = history[0], history[-1]
    assert {
        name: last[name] / first[name] for name in first if last[name] > 0.8 * first[name]
    } == {}


@pytest.mark.parametrize("seed", range(3))
def test_paths_are_those_of_the_corners(seed: int) -> None:
    """A small change of motion moves the corners of boxes as far as the term says.

    Root mean squares over the corners; the chord of an angle a falls short of its arc by a^2 / 24.
    """
    truth = drawn_truth(seed)
    step = 1e-4
    root = torch.zeros_like(truth.parent_BP).masked_fill(~truth.valid_BP, -1)
    first = dataclasses.replace(truth, parent_BP=root)
    second = dataclasses.replace(first, motion_BTP=first.motion_BTP + step)
    signs = torch.cartesian_prod(*[torch.tensor([-0.5, 0.5], dtype=torch.float64)] * 3)
    corners_BP83 = truth.center_BP3[:, :, None] + signs * truth.size_BP3[:, :, None]
    moved = [
        torch.einsum("bpij,bpkj->bpki", pose[..., :3, :3], corners_BP83) + pose[:, :, None, :3, 3]
        for pose in (world_from_rest(first)[:, 0], world_from_rest(second)[:, 0])
    ]
    went_BP = (moved[1] - moved[0]).square().sum(dim=-1).mean(dim=-1).sqrt()
    moves = truth.valid_BP & (truth.type_BP != FIXED)
    relative = (2.0 * torch.pi * step) ** 2 / 24.0 + 1e-9  # Roundings of 1 against ways of 1e-5.
    torch.testing.assert_close(
        went_BP[moves], step * path_lengths(truth)[moves], rtol=relative, atol=0
    )


def test_as_paths_a_dial_counts_less_than_a_door() -> None:
    """The same error of motion, on a part a tenth as large about an axis through its middle."""
    truth = drawn_truth(0)
    weights = LossWeights(motion_as="paths")
    turning = torch.full_like(truth.type_BP, REVOLUTE)
    door = dataclasses.replace(truth, type_BP=turning, origin_BP3=truth.center_BP3)
    dial = dataclasses.replace(door, size_BP3=0.1 * door.size_BP3)
    guess_BPT = door.motion_BTP.transpose(1, 2) + 0.01
    large, small = (motion_error(guess_BPT, own, own.valid_BP, weights) for own in (door, dial))
    # Squares: a hundredth, to some roundings of each of two dozen numbers.
    torch.testing.assert_close(small, 0.01 * large, rtol=1e-12, atol=0)
