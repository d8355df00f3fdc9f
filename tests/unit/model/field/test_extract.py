"""Meshes of analytic fields: closed, outward, of the right volume, place and color."""

import numpy as np
import pytest
import torch
import trimesh

from model.field.analytic import BoxField
from model.field.extract import LEAST_CELLS, ColoredMesh, colors_at, part_meshes
from model.field.rays import Growth, half_sides
from tests.unit.model.box_scenes import COLORS, PARTS, SIZES, box_field, cabinet, changed

RESOLUTION = 24


class Ball:
    """A ball of some radius about the middle of every box; its color is the place in the box."""

    def __init__(self, half_BP3: torch.Tensor, radius: float) -> None:
        self.half_BP3, self.radius = half_BP3, radius

    def __call__(self, points_BPN3: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        places = points_BPN3 * self.half_BP3[:, :, None]
        return places.norm(dim=-1) - self.radius, (points_BPN3 + 1.0) / 2.0


def solid(mesh: ColoredMesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)


def check_closed(mesh: ColoredMesh) -> trimesh.Trimesh:
    """Every edge has two triangles that run along it in opposite directions; volume is positive."""
    shape = solid(mesh)
    assert shape.is_watertight
    assert shape.is_winding_consistent
    assert shape.volume > 0.0
    assert mesh.rgb.shape == mesh.vertices.shape
    return shape


def cube(side: float = 1.0) -> object:
    """One part in a cube."""
    articulation = cabinet(slots=4)
    size = torch.full_like(articulation.size_BP3, side)
    valid = torch.tensor([[True, False, False, False]])
    return changed(articulation, size_BP3=size, valid_BP=valid)


@pytest.mark.parametrize("resolution", [16, 32])
def test_a_ball_is_round_and_as_large_as_it_is(resolution: int) -> None:
    """Along an edge of length h the distance bends by h^2 / (8 R) at most, so vertices lie that
    far off the sphere; facets of cells h sag by (sqrt(3) h)^2 / (8 R) below it. Together the volume
    is wrong by the sphere's area times h^2 / (2 R)."""
    articulation = cube()
    growth = Growth(share=0.0, margin=0.05)
    half = half_sides(articulation.size_BP3, growth)
    ball, radius = Ball(half, 0.4), 0.4
    (mesh,) = part_meshes(ball, articulation, resolution=resolution, growth=growth)
    step = 2 * 0.55 / resolution
    shape = check_closed(mesh)
    middle = articulation.center_BP3[0, 0].numpy()
    off = np.linalg.norm(mesh.vertices - middle, axis=1) - radius
    assert np.abs(off).max() < step**2 / (8 * radius) + 1e-6
    area, volume = 4 * np.pi * radius**2, 4 / 3 * np.pi * radius**3
    assert abs(shape.volume - volume) < area * step**2 / (2 * radius)
    assert not mesh.from_box


def test_boxes_lose_only_their_edges() -> None:
    """Faces are exact, for distances are linear there; only cells at the box's edges are cut off:
    less than one cell's cross-section along each of the twelve edges."""
    articulation = cabinet()
    meshes = part_meshes(box_field(articulation), articulation, resolution=RESOLUTION)
    assert [mesh.slot for mesh in meshes] == list(range(PARTS))
    half = half_sides(articulation.size_BP3, Growth())[0]
    for mesh, size, color in zip(meshes, SIZES, COLORS, strict=True):
        shape = check_closed(mesh)
        assert not mesh.from_box
        grown = 2.0 * half[mesh.slot].numpy()
        step = grown / np.maximum(np.ceil(RESOLUTION * grown / grown.max()), LEAST_CELLS)
        edges = 4 * sum(size[k] * step[(k + 1) % 3] * step[(k + 2) % 3] for k in range(3))
        lost = np.prod(size) - shape.volume
        assert -1e-6 < lost < edges
        # Nudged samples move the surface by a thousandth of a cell.
        np.testing.assert_allclose(shape.extents, size, rtol=0, atol=2e-3 * step.max())
        middle = shape.bounds.mean(axis=0)
        expected = articulation.center_BP3[0, mesh.slot]
        np.testing.assert_allclose(middle, expected, rtol=0, atol=2e-3 * step.max())
        np.testing.assert_allclose(mesh.rgb, np.tile(color, (len(mesh.rgb), 1)), atol=1e-6)


def test_lengths_are_in_metres() -> None:
    articulation = cabinet()
    small = part_meshes(box_field(articulation), articulation, resolution=12)
    large = part_meshes(box_field(articulation), articulation, resolution=12, radius=2.5)
    for a, b in zip(small, large, strict=True):
        np.testing.assert_allclose(b.vertices, 2.5 * a.vertices, rtol=1e-12)
        assert np.array_equal(a.faces, b.faces)


def test_what_fills_its_box_is_closed_within_it() -> None:
    """A field that is inside everywhere: the mesh ends in the outermost cells."""
    articulation = cube()
    half = half_sides(articulation.size_BP3, Growth())
    (mesh,) = part_meshes(Ball(half, 5.0), articulation, resolution=10)
    shape = check_closed(mesh)
    low, high = (shape.bounds - articulation.center_BP3[0, 0].numpy()) / half[0, 0].numpy()
    assert (np.abs(low) < 1.0).all() and (high < 1.0).all()  # noqa: PT018
    assert (np.abs(low) > 0.8).all() and (high > 0.8).all()  # noqa: PT018


def test_where_there_is_no_surface_the_box_stands_in() -> None:
    articulation = cube(0.6)
    half = half_sides(articulation.size_BP3, Growth())
    (mesh,) = part_meshes(Ball(half, -1.0), articulation, resolution=10)
    shape = check_closed(mesh)
    assert mesh.from_box
    assert shape.volume == pytest.approx(0.6**3, rel=1e-6)


def test_crumbs_are_left_out_and_hollows_kept() -> None:
    """A hollow box of six walls, and a crumb of a thousandth of its size in a corner."""
    articulation = cube(1.0)
    middle = articulation.center_BP3[:, :1, None]
    walls, halves = [], []
    for axis in range(3):
        for side in (-0.35, 0.35):
            center, half = torch.zeros(3), torch.full((3,), 0.4)
            center[axis], half[axis] = side, 0.05
            walls.append(center)
            halves.append(half)
    walls.append(torch.full((3,), 0.46))
    halves.append(torch.full((3,), 0.03))
    count = len(walls)
    field = BoxField(
        articulation=articulation,
        center_BPM3=(middle + torch.stack(walls)).expand(1, 4, count, 3),
        half_BPM3=torch.stack(halves).expand(1, 4, count, 3),
        rgb_BPM3=torch.ones(1, 4, count, 3),
    )
    (mesh,) = part_meshes(field, articulation, resolution=42)
    shape = check_closed(mesh)
    # 0.8^3 - 0.6^3, less the cut edges of both boxes: 12 * 1.4 * (1.05 / 42)^2.
    assert 0.296 - 0.0105 < shape.volume < 0.296 + 0.0105
    (whole,) = part_meshes(field, articulation, resolution=42, least_share=0.0)
    assert solid(whole).body_count == 3
    assert shape.body_count == 2


def test_colors_at_places_are_those_of_the_field() -> None:
    articulation = cube()
    half = half_sides(articulation.size_BP3, Growth())
    points = articulation.center_BP3[0, 0] + torch.tensor([[0.0, 0.0, 0.0], [0.525, 0.0, -0.525]])
    found = colors_at(Ball(half, 0.3), articulation, 0, points)
    expected = torch.tensor([[0.5, 0.5, 0.5], [1.0, 0.5, 0.0]])
    torch.testing.assert_close(found, expected, rtol=0, atol=1e-6)
    (mesh,) = part_meshes(Ball(half, 0.3), articulation, resolution=12)
    own = colors_at(Ball(half, 0.3), articulation, 0, torch.tensor(mesh.vertices).float())
    np.testing.assert_allclose(mesh.rgb, own, rtol=0, atol=1e-5)


def test_one_object_of_a_batch() -> None:
    both = cabinet(batch=2)
    moved = changed(both, center_BP3=both.center_BP3 + torch.tensor([[[0.0]], [[0.1]]]))
    meshes = part_meshes(box_field(moved), moved, resolution=12, index=1)
    alone = part_meshes(box_field(cabinet()), cabinet(), resolution=12)
    for a, b in zip(meshes, alone, strict=True):
        np.testing.assert_allclose(a.vertices, b.vertices + 0.1, rtol=0, atol=1e-5)
