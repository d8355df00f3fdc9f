"""What points read from hexa-planes, against S1 written out point by point."""

import numpy as np
import pytest
import torch

from artgen.core.stream import Stream
from model.field.hexaplane import INSET, read, stacked


def planes_and_points(
    *, batch: int = 1, parts: int = 3, count: int = 5, side: tuple[int, int] = (4, 6)
) -> tuple[torch.Tensor, torch.Tensor]:
    rng = Stream(0, "planes").generator()
    planes = torch.tensor(rng.normal(size=(batch, parts, 6, 2, *side)))
    points = torch.tensor(rng.uniform(-1, 1, size=(batch * parts, count, 3)))
    return planes, points


def bilinear(plane: np.ndarray, x: float, y: float) -> np.ndarray:
    """(C,) of a (C, H, W) plane whose outer texel middles lie at -1 and 1."""
    _, height, width = plane.shape
    column = min((x + 1) / 2 * (width - 1), width - 1 - INSET)
    row = min((y + 1) / 2 * (height - 1), height - 1 - INSET)
    i, j = int(row), int(column)
    down, right = row - i, column - j
    above = (1 - right) * plane[:, i, j] + right * plane[:, i, j + 1]
    below = (1 - right) * plane[:, i + 1, j] + right * plane[:, i + 1, j + 1]
    return (1 - down) * above + down * below


def written_out(planes: np.ndarray, point: np.ndarray) -> np.ndarray:
    """S1 for one part's six planes (6, C, H, W) at one point."""
    x, y, z = point
    return np.concatenate(
        [
            bilinear(planes[0] if z >= 0 else planes[1], x, y),
            bilinear(planes[2] if x >= 0 else planes[3], y, z),
            bilinear(planes[4] if y >= 0 else planes[5], x, z),
        ]
    )


@pytest.mark.parametrize("batch", [1, 2])
def test_reading_is_s1(batch: int) -> None:
    """grid_sample's coordinates round at 1e-16 of 12 texels, times slopes of a few: 1e-13."""
    planes, points = planes_and_points(batch=batch)
    slots = torch.arange(batch * 3)
    found = read(stacked(planes), points, slots, parts=3)
    for k in range(batch * 3):
        for n in range(points.shape[1]):
            expected = written_out(planes.flatten(0, 1)[k].numpy(), points[k, n].numpy())
            np.testing.assert_allclose(found[k, n], expected, rtol=0, atol=1e-13)


def test_segments_may_be_any_in_any_number() -> None:
    """Objects with no segment, with one, with many."""
    planes, _ = planes_and_points(batch=3)
    points = planes_and_points(batch=2)[1]
    slots = torch.tensor([0, 0, 2, 1, 2, 7])
    found = read(stacked(planes), points, slots, parts=3)
    for k, slot in enumerate(slots.tolist()):
        own = stacked(planes[slot // 3, None])
        alone = read(own, points[k, None], torch.tensor([slot % 3]), parts=3)
        torch.testing.assert_close(found[k], alone[0], rtol=0, atol=1e-13)


@pytest.mark.parametrize(("side", "parts"), [(24, 5), (24, 7), (64, 8), (192, 5), (192, 8)])
def test_no_reading_reaches_the_planes_of_others(side: int, parts: int) -> None:
    """Not even at the border of the box, in float32, if others hold a million times more: the other
    parts, and of the part itself the planes of the sides where the points are not.

    Coordinates are exact where parts times side is a power of two, and round elsewhere.
    """
    planes, _ = planes_and_points(side=(side, side), parts=parts)
    planes = planes.float()
    corners = torch.tensor([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)])
    points = corners.float()[None]
    upper = points[0][:, (2, 0, 1)].repeat_interleave(2, dim=-1) >= 0
    for part in range(parts):
        slot = torch.tensor([part])
        quiet = read(stacked(planes), points, slot, parts=parts)[0]
        loud = planes * 1e6
        loud[:, part] = planes[:, part]
        assert torch.equal(read(stacked(loud), points, slot, parts=parts)[0], quiet)
        for first, shown in ((0, ~upper), (1, upper)):
            loud = planes.clone()
            loud[:, :, first::2] *= 1e6
            found = read(stacked(loud), points, slot, parts=parts)[0]
            assert torch.equal(found[shown], quiet[shown])


def test_planes_of_one_texel_are_constant() -> None:
    planes, points = planes_and_points(side=(1, 1))
    found = read(stacked(planes), points, torch.arange(3), parts=3)
    above = points[..., 2] >= 0
    upper, lower = planes[0, :, None, 0, :, 0, 0], planes[0, :, None, 1, :, 0, 0]
    expected = torch.where(above[..., None], upper, lower)
    # Weights of 1 that were rounded once.
    torch.testing.assert_close(found[..., :2], expected, rtol=1e-15, atol=0)


def test_blending_joins_the_octants() -> None:
    """Across z = 0 the switch jumps; the blend does not, and is the switch away from 0."""
    planes, _ = planes_and_points(parts=1)
    line = torch.tensor([[0.3, 0.4, z] for z in (-0.5, -1e-9, 1e-9, 0.5)], dtype=torch.float64)[
        None
    ]
    slot = torch.tensor([0])
    switched = read(stacked(planes), line, slot, parts=1)[0]
    blended = read(stacked(planes), line, slot, parts=1, blend=0.1)[0]
    assert (switched[1] - switched[2]).abs().max() > 0.1
    # Slopes are differences of features of a few over 0.2, times 2e-9.
    assert (blended[1] - blended[2]).abs().max() < 1e-6
    assert torch.equal(blended[[0, 3]], switched[[0, 3]])


@pytest.mark.parametrize("blend", [0.0, 0.2])
def test_gradients(blend: float) -> None:
    """With respect to planes and to points."""
    planes, points = planes_and_points(batch=2, parts=2, count=2, side=(3, 3))
    slots = torch.tensor([0, 1, 1, 3])

    def reading(some_planes: torch.Tensor, some_points: torch.Tensor) -> torch.Tensor:
        return read(stacked(some_planes), some_points, slots, parts=2, blend=blend)

    inputs = (planes.requires_grad_(), points.requires_grad_())
    assert torch.autograd.gradcheck(reading, inputs)
