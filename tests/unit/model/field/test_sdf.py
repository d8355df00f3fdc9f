"""Density in its stable form: right, finite, and with finite slopes where the textbook's fails."""

import math

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from model.field.sdf import ALIKE, UNSEEN, fading, laplace_density, mean_density

EPS32 = torch.finfo(torch.float32).eps


def textbook(distance: torch.Tensor, inverse_beta: float) -> torch.Tensor:
    """S3 with its sign mended and the factor 1 / beta, branch by branch as it is written."""
    outside = 0.5 * torch.exp(-distance * inverse_beta)
    inside = 1.0 - 0.5 * torch.exp(distance * inverse_beta)
    return inverse_beta * torch.where(distance >= 0, outside, inside)


@given(st.floats(-2, 2), st.floats(1.0, 1000.0))
def test_density_is_the_laplace_distribution(distance: float, inverse_beta: float) -> None:
    """In float32, relative to 1 / beta: 0.4 eps from the product (s exp(-s) <= 1 / e), 0.5 from
    exp, 0.5 from 1 - half, 0.5 from the factor; and exp(-30) where that counts as nothing."""
    expected = 0.5 * math.exp(-abs(distance) * inverse_beta)
    expected = expected if distance >= 0 else 1.0 - expected
    found = laplace_density(torch.tensor(distance, dtype=torch.float32), inverse_beta).item()
    # The distance itself is rounded to float32: half an eps of it moves the exponent by s / 2 eps.
    bound = 3 * EPS32 + math.exp(-UNSEEN)
    assert abs(found / inverse_beta - expected) <= bound


@pytest.mark.parametrize("dtype", [torch.float32, torch.bfloat16])
@pytest.mark.parametrize("betas", [-1e4, -50.0, -1.0, -1e-3, 0.0, 1e-3, 1.0, 50.0, 1e4])
def test_slopes_are_finite_at_any_distance(dtype: torch.dtype, betas: float) -> None:
    """|s| / beta up to 1e4."""
    distance = torch.tensor([betas / 1000.0], dtype=dtype, requires_grad=True)
    sharpness = torch.tensor([1000.0], dtype=dtype, requires_grad=True)
    for density in (
        laplace_density(distance, sharpness),
        mean_density(distance, distance + 0.01, sharpness),
        mean_density(distance + 0.01, distance, sharpness),
    ):
        assert 0.0 <= density.item() <= 1000.0
        slopes = torch.autograd.grad(density.sum(), (distance, sharpness))
        assert all(torch.isfinite(slope).all() for slope in slopes)


def test_the_textbook_form_has_no_slope_far_out() -> None:
    """One branch overflows and `where` multiplies its infinite slope by zero."""
    distance = torch.tensor([10.0], requires_grad=True)
    (slope,) = torch.autograd.grad(textbook(distance, 1000.0).sum(), distance)
    assert torch.isnan(slope).all()


def test_s3_as_printed_is_no_density() -> None:
    """1 - exp(-s / beta) / 2 is below zero once s < -beta ln 2."""
    assert 1.0 - 0.5 * math.exp(1.0) < 0.0
    assert laplace_density(torch.tensor(-1.0), 1.0).item() == pytest.approx(1 - 0.5 / math.e)


@given(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(1.0, 200.0))
def test_mean_density_is_the_mean_of_the_density(a: float, b: float, inverse_beta: float) -> None:
    """Against adaptive quadrature with a break where the distance changes sign."""
    first, last = torch.tensor(a, dtype=torch.float64), torch.tensor(b, dtype=torch.float64)

    def density(share: float) -> float:
        return laplace_density(torch.lerp(first, last, share), inverse_beta).item()

    breaks = [a / (a - b)] if a * b < 0 else None
    expected, error = quad(density, 0.0, 1.0, points=breaks, limit=200)
    found = mean_density(first, last, inverse_beta).item()
    # ALIKE^2 / 48 where both ends count as one; else eps of the quotient's parts over ALIKE.
    bound = ALIKE**2 / 48 + 1e-12
    assert abs(found - expected) <= inverse_beta * bound + 10 * error


def test_mean_density_in_float32_next_to_the_limit_of_alike() -> None:
    """Deep inside, outside and on the surface: 4 eps / ALIKE relative to 1 / beta, for the parts of
    the quotient are rounded to eps of 1 and divided by ALIKE."""
    middle = torch.tensor([-10.0, -0.5, -0.02, 0.0, 0.02, 0.5, 10.0], dtype=torch.float64)
    for gap in (0.5 * ALIKE, 0.99 * ALIKE, 1.01 * ALIKE, 3 * ALIKE):
        exact = mean_density(middle - gap / 2, middle + gap / 2, 1.0)
        found = mean_density((middle - gap / 2).float(), (middle + gap / 2).float(), 1.0).double()
        assert (found - exact).abs().max() < 4 * EPS32 / ALIKE + ALIKE**2 / 48


def test_mean_density_has_no_direction() -> None:
    a, b = torch.tensor([-0.03, 0.01]), torch.tensor([0.02, 0.4])
    assert torch.equal(mean_density(a, b, 100.0), mean_density(b, a, 100.0))


def test_what_is_unseen_makes_no_denormal_numbers() -> None:
    """Such numbers slowed the backward pass on a CPU by a factor of five."""
    depth = torch.linspace(0.0, 200.0, 1001, requires_grad=True)
    values = fading(depth)
    (slopes,) = torch.autograd.grad(values.sum(), depth)
    for number in (values.detach(), slopes):
        assert ((number == 0) | (number.abs() >= 0.9 * math.exp(-UNSEEN))).all()
    shown = depth < UNSEEN
    torch.testing.assert_close(values[shown], torch.exp(-depth)[shown], rtol=4 * EPS32, atol=0)


def test_gradients() -> None:
    distance = torch.tensor([-0.3, -0.01, 0.02, 0.2], dtype=torch.float64, requires_grad=True)
    other = torch.tensor([0.1, -0.02, 0.0200001, -0.4], dtype=torch.float64, requires_grad=True)
    sharpness = torch.tensor(40.0, dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(laplace_density, (distance, sharpness))
    depth = torch.tensor([0.1, 3.0, UNSEEN + 1.0], dtype=torch.float64, requires_grad=True)
    assert torch.autograd.gradcheck(fading, (depth,))
    assert torch.autograd.gradcheck(mean_density, (distance, other, sharpness), atol=2e-4)
