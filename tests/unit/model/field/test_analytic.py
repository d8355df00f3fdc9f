"""Distances of boxes against the nearest of many points on their surface."""

import torch

from model.field.analytic import BoxField, box_distance
from model.field.rays import half_sides
from tests.unit.model.box_scenes import box_field, cabinet


def test_distance_is_to_the_nearest_point_of_the_surface() -> None:
    """Points of a 41 x 41 grid on each face are at most half a step's diagonal apart."""
    half = torch.tensor([0.4, 0.1, 0.25], dtype=torch.float64)
    line = torch.linspace(-1, 1, 41, dtype=torch.float64)
    u, v = (grid.flatten() for grid in torch.meshgrid(line, line, indexing="ij"))
    faces = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            face = torch.stack([u, v], dim=-1)
            face = torch.cat([face[:, :axis], torch.full((len(u), 1), side), face[:, axis:]], dim=1)
            faces.append(face * half)
    surface = torch.cat(faces)
    generator = torch.Generator().manual_seed(0)
    points = torch.rand(200, 3, generator=generator, dtype=torch.float64) - 0.5
    nearest = torch.cdist(points, surface).amin(dim=1)
    found = box_distance(points, half)
    inside = (points.abs() < half).all(dim=1)
    assert torch.equal(found < 0, inside)
    assert inside.any()
    step = 2 * 0.4 / 40
    assert ((nearest - found.abs()) >= -1e-12).all()
    assert ((nearest - found.abs()) <= step).all()


def test_a_union_has_the_nearer_box_and_its_color() -> None:
    """One box red and one blue, and a third that is absent."""
    articulation = cabinet(slots=4)
    center = torch.zeros(1, 4, 3, 3)
    center[0, 0, :, 0] = torch.tensor([-0.2, 0.2, 0.0])
    field = BoxField(
        articulation=articulation,
        center_BPM3=center,
        half_BPM3=torch.full((1, 4, 3, 3), 0.05),
        rgb_BPM3=torch.eye(3).expand(1, 4, 3, 3),
        present_BPM=torch.tensor([True, True, False]).expand(1, 4, 3),
    )
    half = half_sides(articulation.size_BP3, field.growth)[0, 0]
    places = torch.tensor([[-0.2, 0.0, 0.0], [0.2, 0.3, 0.0], [0.0, 0.0, 0.0]])
    points = ((places - articulation.center_BP3[0, 0]) / half)[None]
    distance, rgb = field.seen(points, torch.tensor([0]))
    expected = torch.tensor([[-0.05, 0.25, 0.15]])
    torch.testing.assert_close(distance, expected, rtol=0, atol=1e-6)
    assert rgb[0, 0].tolist() == [1, 0, 0]
    assert rgb[0, 1].tolist() == [0, 1, 0]


def test_all_parts_at_once_are_each_on_its_own() -> None:
    articulation = cabinet(slots=4, batch=2)
    field = box_field(articulation)
    points = torch.rand(2, 4, 5, 3, generator=torch.Generator().manual_seed(0)) * 2 - 1
    distance, rgb = field(points)
    for k in range(8):
        alone = field.seen(points.flatten(0, 1)[k, None], torch.tensor([k]))
        assert torch.equal(distance.flatten(0, 1)[k], alone[0][0])
        assert torch.equal(rgb.flatten(0, 1)[k], alone[1][0])
    assert torch.equal(
        field.distances(points.flatten(0, 1), torch.arange(8)), distance.flatten(0, 1)
    )


def test_slopes_are_right() -> None:
    """Outside beside a face, an edge and a corner, and inside."""
    offset = torch.tensor(
        [[0.7, 0.02, 0.05], [0.6, 0.3, 0.1], [-0.5, 0.2, -0.6], [0.1, 0.02, -0.03]],
        dtype=torch.float64,
        requires_grad=True,
    )
    half = torch.tensor([0.4, 0.1, 0.25], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(box_distance, (offset, half))
