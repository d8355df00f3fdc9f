"""Laws of the overlap of boxes and ranges: a second implementation, right slopes, all finite."""

import dataclasses

import numpy as np
import pytest
import torch
from torch import Tensor

from model.batch import Articulation
from model.evaluation.boxes import giou_upright
from model.training.overlap import LEAST_RANGE, LEAST_SIDE, box_giou, range_giou
from tests.unit.model.tiny_art import drawn_truth


def boxes(center: Tensor, size: Tensor) -> Articulation:
    """Boxes (P, 3) as one object."""
    truth = drawn_truth(0, (len(center),), slots=len(center))
    return dataclasses.replace(truth, center_BP3=center[None], size_BP3=size[None])


def drawn(seed: int, count: int = 6) -> Articulation:
    """Boxes of sides from a tenth to all of a radius, of which many overlap."""
    torch.manual_seed(seed)
    size = 0.1 + 0.9 * torch.rand(count, 3, dtype=torch.float64)
    return boxes(0.5 * torch.randn(count, 3, dtype=torch.float64), size)


def corners(of: Articulation) -> np.ndarray:
    """(P, 2, 3)."""
    low, high = of.center_BP3 - of.size_BP3 / 2.0, of.center_BP3 + of.size_BP3 / 2.0
    return torch.stack([low[0], high[0]], dim=1).numpy()


@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_score_that_networks_are_held_to(seed: int) -> None:
    first, second = drawn(seed), drawn(seed + 100)
    scored = [giou_upright(a, b) for a, b in zip(corners(first), corners(second), strict=True)]
    # Some twenty float64 operations on volumes of 1e-3 to 10 that share no cancelling leading digit
    # but in a difference of corners: 1e4 of eps holds.
    np.testing.assert_allclose(box_giou(first, second)[0].numpy(), scored, atol=2.5e-12)


def test_cubes_in_known_places() -> None:
    """Equal: 1. Half shared along x: 1/3. A unit apart: no overlap, a third of the hull empty."""
    unit = torch.ones(3, 3, dtype=torch.float64)
    moved = torch.zeros(3, 3, dtype=torch.float64)
    moved[1, 0], moved[2, 0] = 0.5, 2.0
    found = box_giou(boxes(torch.zeros_like(moved), unit), boxes(moved, unit))
    np.testing.assert_allclose(found[0].numpy(), [1.0, 1.0 / 3.0, -1.0 / 3.0], atol=1e-15)


@pytest.mark.parametrize("seed", range(3))
def test_slopes_are_right(seed: int) -> None:
    first, second = drawn(seed), drawn(seed + 100)

    def overlap(center: Tensor, size: Tensor) -> Tensor:
        said = dataclasses.replace(first, center_BP3=center, size_BP3=size)
        return box_giou(said, second)

    inputs = [first.center_BP3.requires_grad_(), first.size_BP3.requires_grad_()]
    assert torch.autograd.gradcheck(overlap, inputs)


def test_slopes_are_right_of_boxes_apart_within_and_around() -> None:
    """Beside each other, far apart, each within the other, and thinner than counts."""
    places = [[1.5, 0.1, 0.0], [9.0, 5.0, 3.0], [0.05, 0.02, 0.01], [0.04, 0.01, 0.03], [0.1, 0, 0]]
    sides = [[0.4, 0.5, 0.6], [0.4, 0.5, 0.6], [0.2, 0.3, 0.1], [3.0, 4.0, 5.0], [0.5, 1e-4, 0.7]]
    center, size = (torch.tensor(rows, dtype=torch.float64) for rows in (places, sides))
    second = boxes(torch.zeros_like(center), torch.ones_like(size))

    def overlap(center: Tensor, size: Tensor) -> Tensor:
        return box_giou(boxes(center, size), second)

    assert torch.autograd.gradcheck(overlap, (center.requires_grad_(), size.requires_grad_()))


def test_a_box_far_off_is_drawn_nearer() -> None:
    """Plain IoU is flat where boxes do not meet."""
    center = torch.tensor([[3.0, 0.0, 0.0]], dtype=torch.float64, requires_grad=True)
    size = torch.ones(1, 3, dtype=torch.float64)
    box_giou(boxes(center, size), boxes(torch.zeros_like(size), size)).sum().backward()
    assert center.grad is not None
    assert float(center.grad[0, 0]) < 0.0


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16])
@pytest.mark.parametrize("sides", [(1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)])
def test_flat_boxes_have_finite_values_and_slopes(
    sides: tuple[float, float, float], dtype: torch.dtype
) -> None:
    """A sheet, a wire and a point: as thick as `LEAST_SIDE`, so 1 on themselves."""
    size = torch.tensor([sides, sides], dtype=dtype, requires_grad=True)
    center = torch.tensor([(0.0, 0.0, 0.0), (0.0, 0.0, 0.5)], dtype=dtype, requires_grad=True)
    true = boxes(torch.zeros(2, 3, dtype=dtype), torch.tensor([sides, sides], dtype=dtype))
    found = box_giou(boxes(center, size), true)
    found.sum().backward()
    assert float(found[0, 0].detach()) == 1.0
    # Half a radius off along z: the volume between counts, (0.5 - LEAST_SIDE) of 0.5 + LEAST_SIDE;
    # six float32 products and sums.
    hull, gap = 0.5 + LEAST_SIDE, 0.5 - LEAST_SIDE
    expected = -gap / hull
    assert float(found[0, 1].detach()) == pytest.approx(expected, rel=16 * 2.0**-23)
    for tensor in (center, size):
        assert tensor.grad is not None
        assert tensor.grad.isfinite().all()


def test_a_small_part_counts_as_much_as_a_large_one() -> None:
    """Scaling both boxes leaves the overlap as it is: what squared lengths do not do."""
    large, other = drawn(7), drawn(107)
    small, far = (
        boxes(0.01 * of.center_BP3[0], 0.01 * of.size_BP3[0].clamp(min=0.2))
        for of in (large, other)
    )
    wide = [boxes(of.center_BP3[0], of.size_BP3[0].clamp(min=0.2)) for of in (large, other)]
    # The same twenty operations on rounded hundredths.
    torch.testing.assert_close(box_giou(small, far), box_giou(*wide), rtol=0.0, atol=2.5e-12)


def test_a_range_is_a_box_of_one_side() -> None:
    """Ranges longer than the least, as boxes that are a radius wide and high."""
    torch.manual_seed(0)
    ends = torch.randn(2, 40, 2, dtype=torch.float64).sort(dim=-1).values
    bars = []
    for low, high in (each.unbind(dim=-1) for each in ends):
        center = torch.stack([(low + high) / 2.0, torch.zeros(40), torch.zeros(40)], dim=1)
        side = torch.stack([(high - low).clamp(min=LEAST_RANGE), *torch.ones(2, 40)], dim=1)
        bars.append(boxes(center, side))
    # Ten float64 operations on lengths of 1e-3 to 10.
    torch.testing.assert_close(
        range_giou(ends[:1], ends[1:]), box_giou(*bars), rtol=0.0, atol=2.5e-12
    )


def test_ranges_in_known_places() -> None:
    """Equal; half of the other; in reverse; a length apart; two equal points, and two apart."""
    half = LEAST_RANGE / 2.0
    ours = [[0.0, 0.2], [0.0, 0.1], [0.2, 0.0], [0.4, 0.6], [0.3, 0.3], [0.3 + half, 0.3 + half]]
    true = [[0.0, 0.2]] * 4 + [[0.3, 0.3], [0.3 - half, 0.3 - half]]
    found = range_giou(*(torch.tensor([ends], dtype=torch.float64) for ends in (ours, true)))
    expected = [1.0, 0.5, 1.0, -1.0 / 3.0, 1.0, 0.0]
    np.testing.assert_allclose(found[0].numpy(), expected, atol=1e-12)


def test_slopes_of_ranges_are_right_and_draw_far_ones_nearer() -> None:
    """Within, around, across either end, apart, in reverse, and shorter than counts."""
    ours = [
        [0.1, 0.2],
        [-0.2, 0.5],
        [-0.1, 0.1],
        [0.2, 0.4],
        [0.7, 0.9],
        [0.25, 0.05],
        [0.1, 0.1005],
    ]
    true = torch.tensor([[[0.0, 0.3]] * len(ours)], dtype=torch.float64)
    ends = torch.tensor([ours], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(lambda said: range_giou(said, true), (ends,))
    range_giou(ends, true)[0, 4].backward()
    assert ends.grad is not None
    assert (ends.grad[0, 4] < 0.0).any()
    assert float(ends.grad[0, 4].sum()) < 0.0


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16])
def test_points_have_finite_values_and_slopes(dtype: torch.dtype) -> None:
    ends = torch.zeros(1, 3, 2, dtype=dtype, requires_grad=True)
    found = range_giou(ends, torch.tensor([[[0.0, 0.0], [0.0, 1.0], [0.5, 0.5]]]))
    found.sum().backward()
    assert ends.grad is not None
    assert ends.grad.isfinite().all()
    assert float(found[0, 0].detach()) == 1.0
