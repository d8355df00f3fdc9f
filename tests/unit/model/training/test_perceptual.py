"""Laws of the feature distance: a distance between images, with finite slopes."""

import pytest
import torch

from model.network.encoders.efflite import EfficientNetLite0
from model.training.perceptual import FeatureDistance, packaged_distance


def distance() -> FeatureDistance:
    torch.manual_seed(0)
    return FeatureDistance(EfficientNetLite0())


def images(seed: int, count: int = 2) -> torch.Tensor:
    return torch.rand(count, 3, 32, 32, generator=torch.Generator().manual_seed(seed))


def test_an_image_is_at_no_distance_from_itself_and_at_some_from_another() -> None:
    measure, ours, theirs = distance(), images(1), images(2)
    assert (measure(ours, ours.clone()) == 0.0).all()
    apart = measure(ours, theirs)
    assert apart.shape == (2,)
    assert (apart > 0.0).all()
    # The same numbers squared with the other sign, in batches of another order.
    torch.testing.assert_close(measure(theirs, ours), apart, rtol=1e-4, atol=0)


def test_the_distance_grows_with_the_change() -> None:
    measure, ours = distance(), images(3)
    noise = images(4) - 0.5
    near, far = (measure(ours + share * noise, ours) for share in (0.01, 0.3))
    assert (near < far).all()


def test_slopes_are_finite_on_flat_black_too() -> None:
    """The bug this prevents: features of length zero have no direction."""
    measure = distance()
    for ours in (images(5), torch.zeros(2, 3, 32, 32)):
        ours.requires_grad_()
        measure(ours, images(6)).sum().backward()
        assert ours.grad is not None
        assert ours.grad.isfinite().all()


def test_slopes_are_right() -> None:
    """Along random directions, in float64; kinks of ReLU6 have measure zero."""
    measure = distance().double()
    ours, theirs = (images(seed, 1)[..., :8, :8].double() for seed in (7, 8))
    assert torch.autograd.gradcheck(measure, (ours.requires_grad_(), theirs), fast_mode=True)


def test_its_network_neither_learns_nor_changes() -> None:
    measure = distance()
    measure.train()
    assert not any(module.training for module in measure.modules())
    assert not any(weights.requires_grad for weights in measure.parameters())


def test_without_the_package_there_is_no_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("model.training.perceptual.EFFLITE_PACKAGE", "no_such_package_anywhere")
    assert packaged_distance() is None
