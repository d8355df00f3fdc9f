"""Slopes by differences: the normals of boxes, the gradient of any field."""

import torch

from model.config import FieldConfig
from model.field.plane_field import FieldHead, PlaneField
from model.field.rays import Growth, half_sides
from model.field.slopes import STEP, slopes, steepness
from tests.unit.model.box_scenes import box_field, cabinet

EPS32 = torch.finfo(torch.float32).eps


def test_slopes_of_a_box_are_its_normals() -> None:
    """Just outside the middles of two faces of the base; distances below 1 are rounded to half an
    eps each, so their difference over STEP is wrong by eps / STEP and a few roundings of places."""
    articulation = cabinet()
    half_S3 = half_sides(articulation.size_BP3, Growth()).flatten(0, 1)
    places = torch.tensor([[0.41, 0.1, 0.0], [0.0, 0.1, -0.46]])
    points = (places - articulation.center_BP3[0, 0]) / half_S3[0]
    found = slopes(box_field(articulation), points[None], torch.tensor([0]), half_S3)
    normals = torch.tensor([[[1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]])
    torch.testing.assert_close(found, normals, rtol=0, atol=4 * EPS32 / STEP)
    assert steepness(found) < (8 * EPS32 / STEP) ** 2
    assert steepness(2.0 * normals) == 1.0


def test_slopes_are_those_of_autograd() -> None:
    """Float64; central differences are wrong by the third derivative times STEP^2 / 24, taken here
    below 100."""
    torch.manual_seed(0)
    head = FieldHead(FieldConfig(hidden=4, octant_blend=2.0), 2).double()
    for parameter in head.parameters():
        torch.nn.init.normal_(parameter, std=0.5)
    size = torch.tensor([[[1.0, 0.6, 0.8], [0.5, 0.9, 0.7]]], dtype=torch.float64)
    field = PlaneField(torch.randn(1, 2, 6, 2, 2, 2, dtype=torch.float64), size, head)
    half_S3 = half_sides(size, Growth()).flatten(0, 1)
    points = torch.rand(2, 5, 3, dtype=torch.float64) * 1.6 - 0.8
    points.requires_grad_()
    slot = torch.arange(2)
    (local,) = torch.autograd.grad(field.distances(points, slot).sum(), points)
    found = slopes(field, points, slot, half_S3)
    torch.testing.assert_close(found, local / half_S3[:, None], rtol=0, atol=100 * STEP**2 / 24)


def test_steepness_teaches_a_network() -> None:
    articulation = cabinet(slots=4)
    head = FieldHead(FieldConfig(hidden=4), 2)
    planes = torch.randn(1, 4, 6, 2, 3, 3)
    half_S3 = half_sides(articulation.size_BP3, Growth()).flatten(0, 1)
    field = PlaneField(planes, articulation.size_BP3, head)
    points = torch.rand(4, 8, 3) * 2 - 1
    steepness(slopes(field, points, torch.arange(4), half_S3)).backward()
    last = head.distance[-1]
    assert isinstance(last, torch.nn.Linear)
    assert last.weight.grad is not None
    assert last.weight.grad.abs().max() > 0.0


def test_steepness_has_the_right_slopes() -> None:
    """With respect to planes and places; both sides of a plane blend, as differences know no jumps.

    Distances have differences over STEP in them, so steps of gradcheck's own 1e-6 are small.
    """
    torch.manual_seed(0)
    head = FieldHead(FieldConfig(hidden=3, layers=1, octant_blend=2.0), 2).double()
    for parameter in head.parameters():
        torch.nn.init.normal_(parameter, std=0.5)
        parameter.requires_grad_(False)
    size = torch.tensor([[[1.0, 0.6, 0.8]]], dtype=torch.float64)
    half_S3 = half_sides(size, Growth()).flatten(0, 1)

    def steep(planes: torch.Tensor, points: torch.Tensor) -> torch.Tensor:
        field = PlaneField(planes, size, head)
        return steepness(slopes(field, points, torch.tensor([0]), half_S3))

    planes = torch.randn(1, 1, 6, 2, 2, 2, dtype=torch.float64, requires_grad=True)
    points = (torch.rand(1, 3, 3, dtype=torch.float64) * 1.6 - 0.8).requires_grad_()
    assert torch.autograd.gradcheck(steep, (planes, points))
