"""Laws of upsampling: which token makes which pixels of which plane."""

import dataclasses
from typing import Literal

import pytest
import torch
from torch import Tensor

from model.config import ModelConfig, PlaneConfig
from model.network.plane_head import LinearUpsample, PlaneHead
from model.network.tokens import PLANES
from tests.unit.model.tiny_art import TINY

Kind = Literal["linear", "transposed"]


def head_of(planes: PlaneConfig, width: int = 16) -> PlaneHead:
    torch.manual_seed(0)
    config: ModelConfig = dataclasses.replace(
        TINY, trunk=dataclasses.replace(TINY.trunk, width=width), planes=planes
    )
    return PlaneHead(config, planes).double()


def tokens(grid: int, width: int = 16, slots: int = 2) -> tuple[Tensor, Tensor]:
    torch.manual_seed(1)
    return (
        torch.randn(1, slots, width, dtype=torch.float64),
        torch.randn(1, slots, PLANES * grid**2, width, dtype=torch.float64),
    )


@pytest.mark.parametrize("upsampler", ["linear", "transposed"])
@pytest.mark.parametrize("place", [(0, 0, 0), (4, 1, 2), (5, 2, 2), (1, 2, 0)])
def test_a_token_makes_its_own_pixels_and_no_others(
    upsampler: Kind, place: tuple[int, int, int]
) -> None:
    """Planes slowest, then rows, then columns; token (k, i, j) covers a square of `scale` rows."""
    grid, scale = 3, 4
    head = head_of(PlaneConfig(grid=grid, scale=scale, channels=2, upsampler=upsampler))
    slot, places = tokens(grid)
    plane, row, column = place
    changed = places.clone()
    changed[0, 1, plane * grid**2 + row * grid + column] += torch.randn(16, dtype=torch.float64)
    different = (head(slot, changed) != head(slot, places)).any(dim=3)[0]
    expected = torch.zeros(2, PLANES, grid * scale, grid * scale, dtype=torch.bool)
    rows, columns = (slice(n * scale, (n + 1) * scale) for n in (row, column))
    expected[1, plane, rows, columns] = True
    assert torch.equal(different, expected)


def test_linear_upsampling_lays_a_token_out_channels_first() -> None:
    """Against loops: output (c, y, x) of a token is its number c S^2 + y S + x."""
    planes = PlaneConfig(grid=2, scale=3, channels=2)
    upsample = LinearUpsample(18, planes).double()
    with torch.no_grad():
        upsample.unfold.weight.copy_(torch.eye(18))
        upsample.unfold.bias.zero_()
    grids = torch.arange(18 * 4, dtype=torch.float64).reshape(1, 18, 2, 2)
    out = upsample(grids)[0]
    for c in range(2):
        for y in range(6):
            for x in range(6):
                number = c * 9 + (y % 3) * 3 + x % 3
                assert out[c, y, x] == grids[0, number, y // 3, x // 3]


@pytest.mark.parametrize("upsampler", ["linear", "transposed"])
def test_the_papers_24_rows_become_192(upsampler: Kind) -> None:
    planes = PlaneConfig(channels=1, upsampler=upsampler)
    head = head_of(planes, width=4)
    slot, places = tokens(24, width=4, slots=1)
    assert head(slot, places).shape == (1, 1, PLANES, 1, 192, 192)


def test_one_token_makes_all_its_planes_and_no_others() -> None:
    planes = PlaneConfig(grid=2, scale=2, channels=3, tokens="one")
    head = head_of(planes)
    slot, _ = tokens(2)
    changed = slot.clone()
    changed[0, 1] += torch.randn(16, dtype=torch.float64)
    before, after = head(slot, None), head(changed, None)
    assert before.shape == (1, 2, PLANES, 3, 4, 4)
    assert torch.equal(before[:, 0], after[:, 0])
    assert (before[:, 1] != after[:, 1]).all()


@pytest.mark.parametrize("upsampler", ["linear", "transposed"])
@pytest.mark.parametrize("kind", ["planes", "one"])
def test_slopes_are_right(upsampler: Kind, kind: Literal["planes", "one"]) -> None:
    planes = PlaneConfig(grid=1, scale=4, channels=2, upsampler=upsampler, tokens=kind)
    head = head_of(planes, width=4)
    slot, places = (x.requires_grad_() for x in tokens(1, width=4, slots=1))
    assert torch.autograd.gradcheck(lambda a, b: head(a, b), (slot, places))


def test_a_scale_of_one_keeps_the_grid() -> None:
    planes = PlaneConfig(grid=2, scale=1, channels=3, upsampler="transposed")
    slot, places = tokens(2)
    assert head_of(planes)(slot, places).shape == (1, 2, PLANES, 3, 2, 2)
