"""Laws of samples on segments: cells fill them, planes cost nothing, walls are found."""

import pytest
import torch

from artgen.core.stream import Stream
from model.field.sampling import Cells, optical_depth, placed
from model.field.sdf import mean_density

EPS64 = torch.finfo(torch.float64).eps


def segments(count: int = 7) -> tuple[torch.Tensor, torch.Tensor]:
    rng = Stream(0, "segments").generator()
    return torch.tensor(rng.uniform(0.5, 2, size=count)), torch.tensor(
        rng.uniform(0, 1, size=count)
    )


def wall(at: torch.Tensor, place: float = 1.3, half: float = 0.004) -> torch.Tensor:
    """Distance from a thin wall across the ray."""
    return (at - place).abs() - half


def check_cells(cells: Cells, entry: torch.Tensor, length: torch.Tensor) -> None:
    """Edges rise from entry to exit; every sample lies in its cell."""
    assert (cells.edges_KM.diff(dim=1) >= 0).all()
    torch.testing.assert_close(cells.edges_KM[:, 0], entry, rtol=0, atol=0)
    torch.testing.assert_close(cells.edges_KM[:, -1], entry + length, rtol=0, atol=4 * EPS64)
    assert (cells.at_KN >= cells.edges_KM[:, :-1]).all()
    assert (cells.at_KN <= cells.edges_KM[:, 1:]).all()


@pytest.mark.parametrize("coarse", [0, 16])
@pytest.mark.parametrize("drawn", [False, True])
def test_cells_fill_segments(coarse: int, *, drawn: bool) -> None:
    entry, length = segments()
    generator = torch.Generator().manual_seed(1) if drawn else None
    cells = placed(
        *(entry, length, 9),
        generator=generator,
        coarse=coarse,
        inverse_beta=200.0,
        distances=wall,
    )
    check_cells(cells, entry, length)


def test_the_coarse_pass_gathers_samples_at_a_wall_thinner_than_its_steps() -> None:
    """16 even samples are 62 mm apart, the wall is 8 mm thick; a fifth of all samples stay even."""
    entry, length = torch.tensor([1.0]), torch.tensor([1.0])
    cells = placed(entry, length, 20, coarse=16, inverse_beta=400.0, distances=wall)
    near = (wall(cells.at_KN) < 0.1).sum().item()
    assert 14 <= near < 20
    depth = optical_depth(wall(cells.at_KN), cells, 400.0, "linear")
    # The wall's own depth is about 2 x 0.004 x 400; an even choice of 20 meets it by luck alone.
    assert 2.0 < depth.sum().item() < 4.5


@pytest.mark.parametrize("samples", [1, 2, 3, 17])
def test_linear_quadrature_is_exact_on_planes(samples: int) -> None:
    """Between the first and the last sample; the ends, where nothing is known, are constant.

    The sum of some 17 cells, each right to eps / ALIKE of 1 / beta times its length.
    """
    cells = placed(torch.tensor([0.5]).double(), torch.tensor([1.0]).double(), samples)
    distance = 0.8 * (0.9 - cells.at_KN)
    first, last = distance[:, 0], distance[:, -1]
    inner = mean_density(first, last, 30.0) * (cells.at_KN[:, -1] - cells.at_KN[:, 0])
    ends = mean_density(first, first, 30.0) + mean_density(last, last, 30.0)
    expected = inner + ends / (2.0 * samples)
    found = optical_depth(distance, cells, 30.0, "linear").sum(dim=1)
    torch.testing.assert_close(found, expected, rtol=0, atol=30.0 * 1e-5)


def test_quadrature_at_points_needs_many() -> None:
    """A sharp plane: 12 points miss its depth by more than linear cells do by a hundred times."""
    errors = {}
    truth_cells = placed(torch.tensor([0.5]).double(), torch.tensor([1.0]).double(), 20000)
    truth = optical_depth(0.9 - truth_cells.at_KN, truth_cells, 300.0, "point").sum()
    cells = placed(torch.tensor([0.5]).double(), torch.tensor([1.0]).double(), 12)
    for quadrature in ("point", "linear"):
        found = optical_depth(0.9 - cells.at_KN, cells, 300.0, quadrature).sum()
        errors[quadrature] = abs(found - truth).item()
    assert errors["linear"] < errors["point"] / 100


def test_coincident_samples_have_no_depth_and_finite_slopes() -> None:
    """A segment without length, and one whose samples all fell on one place."""
    at = torch.tensor([[1.0, 1.0, 1.0]])
    edges = torch.tensor([[1.0, 1.0, 1.0, 1.0]])
    distance = torch.tensor([[0.1, -0.1, 0.1]], requires_grad=True)
    for quadrature in ("point", "linear"):
        depth = optical_depth(distance, Cells(at_KN=at, edges_KM=edges), 1e4, quadrature)
        assert not depth.any()
        (slope,) = torch.autograd.grad(depth.sum(), distance)
        assert torch.isfinite(slope).all()
    none = placed(torch.ones(1), torch.zeros(1), 4, coarse=4, inverse_beta=1e4, distances=wall)
    assert torch.equal(none.edges_KM, torch.ones(1, 5))


def test_gradients() -> None:
    rng = Stream(0, "slopes").generator()
    cells = placed(*segments(3), 5, generator=torch.Generator().manual_seed(0))
    distance = torch.tensor(rng.uniform(-0.3, 0.3, size=(3, 5)), requires_grad=True)
    at, edges = (value.clone().requires_grad_() for value in (cells.at_KN, cells.edges_KM))
    sharpness = torch.tensor(20.0, dtype=torch.float64, requires_grad=True)

    def depth(d: torch.Tensor, a: torch.Tensor, e: torch.Tensor, b: torch.Tensor) -> torch.Tensor:
        return torch.cat(
            [optical_depth(d, Cells(at_KN=a, edges_KM=e), b, kind) for kind in ("point", "linear")]
        )

    assert torch.autograd.gradcheck(depth, (distance, at, edges, sharpness), atol=1e-4)
