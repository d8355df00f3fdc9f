"""Laws of camera rays and of their way through boxes."""

import numpy as np
import pytest
import torch

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.stream import Stream
from model.field.rays import (
    LEAST_HALF,
    NO_GROWTH,
    Growth,
    box_span,
    half_sides,
    pixel_middles,
    pixel_rays,
    plucker,
    waves,
)

EPS64 = torch.finfo(torch.float64).eps


def house_camera(seed: int) -> Camera:
    rng = Stream(seed, "camera").generator()
    return framed(
        rng.uniform(-0.5, 0.5, size=(20, 3)),
        direction=orbit_direction(*rng.uniform(-1.2, 1.2, size=2)),
        fov=0.7,
        size=(7, 5),
        fill=0.9,
        principal=(3.1, 2.9),
    )


def span(origin: list[float], direction: list[float], half: list[float]) -> tuple[float, float]:
    """Entry and exit of one ray and one box about zero."""
    entry, leave = box_span(
        *(torch.tensor(row, dtype=torch.float64)[None, None, None] for row in (origin, direction)),
        torch.zeros(1, 1, 3, dtype=torch.float64),
        torch.tensor(half, dtype=torch.float64)[None, None],
    )
    return entry.item(), leave.item()


@pytest.mark.parametrize("seed", range(4))
def test_rays_are_those_of_the_house(seed: int) -> None:
    """Same origins, same directions once those of the house, one meter of depth long, are unit;
    both are a handful of roundings of numbers below 4."""
    camera = house_camera(seed)
    where, along = camera.rays()
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    origin, direction = pixel_rays(
        torch.tensor(camera.intrinsics),
        torch.tensor(camera.camera_from_world),
        pixel_middles(5, 7).double(),
    )
    np.testing.assert_allclose(direction.reshape(5, 7, 3), along, rtol=0, atol=16 * EPS64)
    expected = np.broadcast_to(where, (35, 3))
    np.testing.assert_allclose(origin, expected, rtol=0, atol=64 * EPS64)


@pytest.mark.parametrize("seed", range(3))
def test_points_on_rays_project_onto_their_pixels(seed: int) -> None:
    """With skew and unequal focal lengths; px up to 10 through a division by depth, 64 eps px."""
    rng = Stream(seed, "skew").generator()
    matrix = torch.tensor([[9.0, 0.7, 3.0], [0.0, 8.0, 2.0], [0.0, 0.0, 1.0]], dtype=torch.float64)
    pose = torch.tensor(house_camera(seed).camera_from_world)
    pixels = torch.tensor(rng.uniform(0, 6, size=(11, 2)))
    origin, direction = pixel_rays(matrix, pose, pixels)
    points = origin + torch.tensor(rng.uniform(0.5, 4.0, size=(11, 1))) * direction
    seen = (points @ pose[:3, :3].T + pose[:3, 3]) @ matrix.T
    torch.testing.assert_close(seen[:, :2] / seen[:, 2:], pixels, rtol=0, atol=640 * EPS64)
    assert (seen[:, 2] > 0).all()


def test_many_cameras_at_once_are_each_on_their_own() -> None:
    cameras = [house_camera(seed) for seed in range(3)]
    matrices = torch.tensor(np.stack([camera.intrinsics for camera in cameras]))
    poses = torch.tensor(np.stack([camera.camera_from_world for camera in cameras]))
    pixels = pixel_middles(5, 7).double()
    origin, direction = pixel_rays(matrices, poses, pixels)
    for k in range(3):
        one = pixel_rays(matrices[k], poses[k], pixels)
        torch.testing.assert_close((origin[k], direction[k]), one, rtol=0, atol=4 * EPS64)


def test_plucker_coordinates_belong_to_the_line() -> None:
    origin = torch.tensor([[0.3, -1.0, 2.0]], dtype=torch.float64)
    direction = torch.tensor([[0.6, 0.0, 0.8]], dtype=torch.float64)
    same = plucker(origin + 2.5 * direction, direction)
    torch.testing.assert_close(plucker(origin, direction), same, rtol=0, atol=8 * EPS64)


def test_each_octave_tells_twice_as_small_differences_apart() -> None:
    """A step of e turns the fastest wave by e pi 2^(octaves - 2); the values lead, unchanged."""
    values = torch.tensor([[-0.9, 0.4]], dtype=torch.float64)
    step = 1e-4
    assert torch.equal(waves(values, 0), values)
    for octaves in (1, 3, 5):
        before, after = waves(values, octaves), waves(values + step, octaves)
        assert before.shape == (1, 2 * (1 + 2 * octaves))
        assert torch.equal(before[:, :2], values)
        sine, cosine = (after - before)[0, 2:].unflatten(0, (2, 2, octaves))[:, :, -1]
        # The chord of an angle a is 2 sin(a / 2) long; 1e-11 is what 1e5 roundings of 1 leave.
        angle = step * np.pi * 2.0 ** (octaves - 2)
        chord = torch.full((2,), 2.0 * np.sin(angle / 2.0), dtype=torch.float64)
        torch.testing.assert_close(torch.hypot(sine, cosine), chord, rtol=0, atol=1e-11)


@pytest.mark.parametrize("seed", range(3))
def test_spans_hold_exactly_the_points_inside(seed: int) -> None:
    """Against a thousand points along each of 200 rays; steps of 5e-3 locate an end to one step."""
    rng = Stream(seed, "spans").generator()
    origin = torch.tensor(rng.uniform(-2, 2, size=(1, 1, 200, 3)))
    center = torch.tensor(rng.uniform(-0.3, 0.3, size=(1, 1, 3)))
    direction = center + torch.tensor(rng.normal(size=(1, 1, 200, 3))) - origin
    direction /= direction.norm(dim=-1, keepdim=True)
    half = torch.tensor(rng.uniform(0.1, 0.9, size=(1, 1, 3)))
    entry, leave = box_span(origin, direction, center, half)
    at = torch.arange(0.0, 5.0, 5e-3, dtype=torch.float64)
    points = origin[..., None, :] + at[:, None] * direction[..., None, :]
    inside = ((points - center[0, 0]).abs() <= half[0, 0]).all(dim=-1)
    assert torch.equal(inside, (at >= entry[..., None]) & (at <= leave[..., None]))
    assert inside.any(dim=-1).sum() > 20


def test_rays_parallel_to_faces() -> None:
    box = [0.5, 0.5, 0.5]
    assert span([-2, 0.2, 0], [1, 0, 0], box) == (1.5, 2.5)
    assert span([-2, 0.5, 0], [1, 0, 0], box) == (1.5, 2.5)
    entry, leave = span([-2, 0.5000001, 0], [1, 0, 0], box)
    assert leave < entry
    entry, leave = span([-2, 0.2, 0.9], [1, 0, 0], box)
    assert leave < entry


def test_rays_that_start_inside_or_beyond() -> None:
    box = [0.5, 0.5, 0.5]
    assert span([0, 0, 0], [0, 0, 1], box) == (0.0, 0.5)
    entry, leave = span([2, 0, 0], [1, 0, 0], box)
    assert leave < entry == 0.0


def test_boxes_without_thickness() -> None:
    """Crossed in no length, run along within."""
    flat = [0.5, 0.0, 0.5]
    entry, leave = span([0, -1, 0], [0, 1, 0], flat)
    assert entry == leave == 1.0
    assert span([-1, 0, 0], [1, 0, 0], flat) == (0.5, 1.5)


def test_growth_adds_a_share_but_at_least_a_margin() -> None:
    size = torch.tensor([[[2.0, 0.1, 0.0]]])
    assert half_sides(size, Growth(share=0.1, margin=0.02)).tolist() == [
        [[pytest.approx(1.1), pytest.approx(0.07), pytest.approx(0.02)]]
    ]
    assert half_sides(size, NO_GROWTH)[0, 0, 2].item() == pytest.approx(LEAST_HALF)


def test_gradients_of_spans_and_rays() -> None:
    rng = Stream(0, "slopes").generator()
    origin = torch.tensor([[[[-2.0, 0.1, 0.05], [0.3, -2.0, 0.2], [0.1, 0.2, 2.0]]]]).double()
    direction = torch.tensor(rng.normal(size=(1, 1, 3, 3)) * 0.05) - origin / 2.0
    center = torch.tensor([[[0.02, -0.03, 0.01]]], dtype=torch.float64)
    half = torch.tensor([[[0.5, 0.4, 0.6]]], dtype=torch.float64)
    inputs = [value.requires_grad_() for value in (origin, direction, center, half)]
    assert torch.autograd.gradcheck(box_span, inputs)
    lines = [value.requires_grad_() for value in (origin.detach(), direction.detach())]
    assert torch.autograd.gradcheck(plucker, lines)
    assert torch.autograd.gradcheck(lambda values: waves(values, 3), lines[:1])
    # One side takes the share, one the margin, and one, of no length, the margin from zero.
    size = torch.tensor([[[2.0, 0.1, 0.0]]], dtype=torch.float64)
    assert torch.autograd.gradcheck(
        lambda values: half_sides(values, Growth(share=0.1, margin=0.02)), [size.requires_grad_()]
    )
    camera = house_camera(0)
    matrices = (torch.tensor(camera.intrinsics), torch.tensor(camera.camera_from_world))
    pixels = pixel_middles(1, 2).double()
    assert torch.autograd.gradcheck(
        pixel_rays, (*(matrix.requires_grad_() for matrix in matrices), pixels.requires_grad_())
    )
