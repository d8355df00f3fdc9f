"""Laws of the mappings from a slot's numbers to boxes, axes, motions, limits, parents, counts."""

import dataclasses

import pytest
import torch
from torch import Tensor

from model.field.kinematics import LEAST_NORM, unit
from model.network.heads import (
    REFUSED,
    ArticulationHead,
    CountHead,
    TreeHead,
    box_side,
    travel,
    within_sphere,
)
from tests.unit.model.tiny_art import BEYOND, SLOTS, STATES, TINY, held

EPS64 = torch.finfo(torch.float64).eps
NUMBERS = torch.tensor([-30.0, -3.0, -1e-8, 0.0, 1e-8, 0.4, 3.0, 30.0], dtype=torch.float64)


def test_centers_points_and_motions_are_the_papers_sigma_mapping() -> None:
    """2 sigma(x) - 1, in the form without cancellation: near zero it is x / 2 to the last digit."""
    mapped = within_sphere(NUMBERS)
    # The paper's form subtracts numbers of size 1: two roundings of 1.
    torch.testing.assert_close(mapped, 2.0 * torch.sigmoid(NUMBERS) - 1.0, rtol=0, atol=4 * EPS64)
    assert float(mapped[4]) == 0.5e-8
    naive = 2.0 * torch.sigmoid(NUMBERS.float()) - 1.0
    assert float(naive[4]) == 0.0, "the printed form loses small motions in float32"
    assert float(within_sphere(NUMBERS.float())[4]) == pytest.approx(0.5e-8, rel=1e-6)


def test_sides_of_boxes_are_the_papers_sigma_mapping() -> None:
    side = box_side(NUMBERS)
    assert ((side > 0.0) & (side <= 2.0)).all()
    assert float(box_side(torch.zeros(()))) == 1.0


def test_limits_hold_rest_between_them() -> None:
    raw = torch.stack(torch.meshgrid(NUMBERS, NUMBERS, indexing="ij"), dim=-1).reshape(-1, 2)
    lower, upper = travel(raw).unbind(-1)
    assert ((lower < 0.0) & (lower >= -1.0)).all()
    assert ((upper > 0.0) & (upper <= 1.0)).all()
    usual = travel(torch.zeros(2, dtype=torch.float64))
    # A logit and its sigmoid: a few roundings of the logit, whose size is 5.
    torch.testing.assert_close(
        usual, torch.tensor([-0.01, 0.2], dtype=torch.float64), rtol=1e-14, atol=0
    )


@pytest.mark.parametrize("mapping", [within_sphere, box_side, travel])
def test_slopes_of_mappings_are_right(mapping: object) -> None:
    numbers = NUMBERS.clone().requires_grad_()
    assert torch.autograd.gradcheck(lambda x: mapping(x.reshape(-1, 2)), numbers)  # type: ignore[operator]


@pytest.mark.parametrize("length", [1.0, 1e-2, 2.0 * LEAST_NORM, 0.5 * LEAST_NORM])
def test_slopes_of_axes_are_right_down_to_a_length_of_zero(length: float) -> None:
    """A door hung left or right: uncertain between opposite axes, the raw vector passes zero."""
    raw = torch.tensor([[0.48, -0.6, 0.64]], dtype=torch.float64) * length
    # Steps must be small beside the length; both sides of a central difference lose eps / step.
    assert torch.autograd.gradcheck(unit, raw.requires_grad_(), eps=1e-4 * length, rtol=1e-4)


def test_slopes_of_axes_are_bounded() -> None:
    """No slope exceeds 1 / `LEAST_NORM`, at zero included, also in float32."""
    for length in (0.0, 1e-30, 1e-12, 1e-6, LEAST_NORM, 1e-3):
        raw = (torch.tensor([0.48, -0.6, 0.64]) * length).requires_grad_()
        axis = unit(raw)
        assert axis.isfinite().all()
        for component in axis:
            (slope,) = torch.autograd.grad(component, raw, retain_graph=True)
            # 1.01 leaves room for float32.
            assert float(torch.linalg.vector_norm(slope)) <= 1.01 / LEAST_NORM


def head_of(config: object) -> ArticulationHead:
    torch.manual_seed(0)
    return ArticulationHead(config).double()  # type: ignore[arg-type]


def test_the_vector_has_the_papers_numbers() -> None:
    """14 numbers and the motion of each state."""
    assert sum(head_of(TINY).widths) == 14 + STATES
    assert sum(head_of(dataclasses.replace(TINY, limits=True)).widths) == 14 + STATES + 2
    assert sum(head_of(dataclasses.replace(TINY, motion="state_tokens")).widths) == 14


def test_a_states_motion_is_read_from_its_own_token() -> None:
    head = head_of(BEYOND)
    slot, by_state = (torch.randn(1, 3, *n, 16, dtype=torch.float64) for n in ((), (STATES,)))
    before = head(slot, by_state, STATES)
    changed = by_state.clone()
    changed[:, 2, 1, 0] += 1.0
    after = head(slot, changed, STATES)
    moved = (after.motion_BTP != before.motion_BTP).nonzero().tolist()
    assert moved == [[0, 1, 2]]
    assert torch.equal(after.center_BP3, before.center_BP3)


@pytest.mark.parametrize("config", [TINY, BEYOND])
def test_slopes_of_the_articulation_head_are_right(config: object) -> None:
    head = head_of(config)
    slot = torch.randn(1, 2, 16, dtype=torch.float64, requires_grad=True)
    by_state = torch.randn(1, 2, STATES, 16, dtype=torch.float64, requires_grad=True)

    def numbers(slot_BPD: Tensor, state_BPTD: Tensor) -> tuple[Tensor, ...]:
        raw = head(slot_BPD, state_BPTD if config is BEYOND else None, STATES)
        return raw.center_BP3, raw.axis_BP3, raw.motion_BTP, raw.type_BP2

    assert torch.autograd.gradcheck(numbers, (slot, by_state))


def test_no_part_hangs_on_itself_or_on_nothing() -> None:
    torch.manual_seed(1)
    valid = held((3, 4))
    logits = TreeHead(16)(torch.randn(2, SLOTS, 16), valid)
    assert (logits.diagonal(dim1=1, dim2=2) == REFUSED).all()
    assert (logits[0, :, 3] == REFUSED).all()
    assert (logits[1, :3, 3] > REFUSED).all()
    alone = TreeHead(16)(torch.randn(1, SLOTS, 16), held((1,))).softmax(dim=-1)
    assert alone.isfinite().all()


def test_slopes_of_the_tree_head_are_right() -> None:
    torch.manual_seed(2)
    head, valid = TreeHead(16).double(), held((3,))
    slot = torch.randn(1, SLOTS, 16, dtype=torch.float64, requires_grad=True)

    def allowed(slot_BPD: Tensor) -> Tensor:
        logits = head(slot_BPD, valid)
        return logits[logits > REFUSED]

    assert torch.autograd.gradcheck(allowed, slot)


def test_counts_do_not_depend_on_the_order_of_images() -> None:
    torch.manual_seed(3)
    head = CountHead(TINY).double()
    torch.nn.init.normal_(head.query_QD)
    image = torch.randn(2, 3, 4, 16, dtype=torch.float64)
    logits = head(image)
    assert logits.shape == (2, SLOTS)
    # Sums over 12 tokens in another order, four matrices deep.
    torch.testing.assert_close(head(image[:, [2, 0, 1]]), logits, rtol=0, atol=1e-12)


def test_slopes_of_the_count_head_are_right() -> None:
    torch.manual_seed(4)
    head = CountHead(TINY).double()
    torch.nn.init.normal_(head.query_QD)
    image = torch.randn(1, 2, 2, 16, dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(head, image)
