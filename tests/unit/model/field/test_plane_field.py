"""Plane fields: the ball they begin as, one answer however asked, and slopes everywhere."""

import pytest
import torch

from model.config import FieldConfig
from model.field.plane_field import (
    Dense,
    Field,
    FieldHead,
    PackedField,
    PlaneField,
    ball_distance,
    packed,
)
from model.field.rays import NO_GROWTH, Growth, half_sides
from tests.unit.model.box_scenes import box_field, cabinet

GROWTH = Growth(share=0.1, margin=0.02)


def plane_field(
    *, batch: int = 2, parts: int = 3, dtype: torch.dtype = torch.float32, config: FieldConfig
) -> PlaneField:
    """Random planes and networks; the distance network's last layer is no longer zero."""
    torch.manual_seed(0)
    head = FieldHead(config, 4).to(dtype)
    for parameter in head.parameters():
        torch.nn.init.normal_(parameter, std=0.3)
    planes = torch.randn(batch, parts, 6, 4, 5, 5, dtype=dtype)
    size = torch.rand(batch, parts, 3, dtype=dtype) + 0.1
    return PlaneField(planes, size, head, GROWTH)


def some_points(count: int, dtype: torch.dtype = torch.float32) -> torch.Tensor:
    generator = torch.Generator().manual_seed(1)
    return torch.rand(2, 3, count, 3, generator=generator, dtype=dtype) * 2 - 1


@pytest.mark.parametrize("bias", ["paper", "normalized", "smallest_side"])
def test_a_new_field_is_a_ball_whatever_its_planes(bias: str) -> None:
    """The distance network begins at zero."""
    config = FieldConfig(bias=bias)
    size = torch.tensor([[[1.0, 0.4, 0.2]]])
    field = PlaneField(torch.randn(1, 1, 6, 4, 5, 5), size, FieldHead(config, 4), NO_GROWTH)
    points = some_points(9)[:1, :1]
    half = torch.tensor([0.5, 0.2, 0.1])
    expected = {
        "paper": (points * half).norm(dim=-1) - 0.1,
        "normalized": points.norm(dim=-1) - 0.5,
        "smallest_side": (points.norm(dim=-1) - 0.5) * 0.1,
    }[bias]
    torch.testing.assert_close(field(points)[0], expected, rtol=0, atol=1e-6)


def test_lengths_are_those_of_the_grown_box() -> None:
    """One radius from the middle of the box is one radius, however the box was grown."""
    size = torch.tensor([[[1.0, 0.4, 0.0]]])
    half = half_sides(size, GROWTH)[0]
    point = torch.tensor([[[0.3, 0.0, 0.0]]]) / half
    found = ball_distance(point, half, "paper")
    assert found.item() == pytest.approx(0.2, abs=1e-7)


def test_the_ball_has_a_slope_at_its_middle() -> None:
    points = torch.zeros(1, 1, 3, requires_grad=True)
    ball_distance(points, torch.ones(1, 3), "paper").sum().backward()
    assert torch.isfinite(points.grad).all()


def test_asked_part_by_part_or_all_at_once() -> None:
    """Matrix products of other shapes may sum in another order: a few eps of values below 3."""
    field = plane_field(config=FieldConfig(hidden=8))
    points = some_points(7)
    distance, rgb = field(points)
    slots = torch.tensor([1, 1, 4])
    some = points.flatten(0, 1)[slots]
    far, color = field.seen(some, slots)
    torch.testing.assert_close(far, distance.flatten(0, 1)[slots], rtol=0, atol=1e-5)
    torch.testing.assert_close(color, rgb.flatten(0, 1)[slots], rtol=0, atol=1e-5)
    assert torch.equal(field.distances(some, slots), far)
    assert ((rgb >= 0) & (rgb <= 1)).all()


def test_parts_do_not_see_each_other() -> None:
    field = plane_field(config=FieldConfig(hidden=8))
    points = some_points(7)
    before = field(points)
    torch.manual_seed(0)
    head = field.head
    planes = torch.randn(2, 3, 6, 4, 5, 5, generator=torch.Generator().manual_seed(5))
    other = planes.clone()
    other[1, 2] += 1.0
    size = torch.full((2, 3, 3), 0.5)
    a, b = (PlaneField(given, size, head, GROWTH)(points) for given in (planes, other))
    same = torch.ones(2, 3, dtype=torch.bool)
    same[1, 2] = False
    assert torch.equal(a[0][same], b[0][same])
    assert not torch.allclose(a[0][1, 2], b[0][1, 2])
    assert before[0].shape == (2, 3, 7)


def test_a_field_that_only_answers_for_all_is_asked_by_table() -> None:
    """The same answers through `Dense` as from the field itself."""
    articulation = cabinet(slots=4, batch=2)
    whole = box_field(articulation)

    class OnlyDense:
        def __call__(self, points_BPN3: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
            return whole(points_BPN3)

    shy: Field = OnlyDense()
    asked = packed(shy, 2, 4)
    assert isinstance(asked, Dense)
    slots = torch.tensor([0, 0, 3, 5])
    points = some_points(9)[0, :1].expand(4, -1, -1)
    assert torch.equal(asked.distances(points, slots), whole.distances(points, slots))
    for a, b in zip(asked.seen(points, slots), whole.seen(points, slots), strict=True):
        assert torch.equal(a, b)
    assert packed(whole, 2, 4) is whole
    assert isinstance(whole, PackedField)


def test_half_precision_in_the_networks_leaves_the_ball_exact() -> None:
    """bfloat16 rounds the learned part to 2^-8 of itself; the ball stays float32."""
    torch.manual_seed(0)
    head = FieldHead(FieldConfig(), 4)
    field = PlaneField(torch.randn(2, 3, 6, 4, 5, 5), torch.ones(2, 3, 3), head, GROWTH)
    points = some_points(7)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        distance, rgb = field(points)
    assert distance.dtype == rgb.dtype == torch.float32
    assert torch.equal(distance, field(points)[0])


@pytest.mark.parametrize("bias", ["paper", "normalized", "smallest_side"])
def test_gradients(bias: str) -> None:
    """With respect to planes and points."""
    config = FieldConfig(hidden=3, layers=1, bias=bias)
    template = plane_field(batch=1, parts=2, dtype=torch.float64, config=config)
    size = torch.tensor([[[0.5, 0.3, 0.4], [0.2, 0.1, 0.6]]], dtype=torch.float64)

    def answer(planes: torch.Tensor, points: torch.Tensor) -> tuple[torch.Tensor, ...]:
        return PlaneField(planes, size, template.head, GROWTH)(points)

    planes = torch.randn(1, 2, 6, 4, 3, 3, dtype=torch.float64, requires_grad=True)
    points = some_points(2, torch.float64)[:1, :2].clone().requires_grad_()
    assert torch.autograd.gradcheck(answer, (planes, points))
