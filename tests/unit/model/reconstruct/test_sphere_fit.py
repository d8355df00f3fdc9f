"""A sphere is led to where agreement is best, as far as the hull lets it, and no further."""

import numpy as np
import pytest

from model.reconstruct.sight import Sphere
from model.reconstruct.sphere_fit import (
    FARTHEST,
    ROUNDS,
    SIZES,
    changes,
    fitted,
    near,
    resized,
    told_sphere,
)


def ball(
    center: tuple[float, float, float] = (0.0, 0.0, 0.0),
    radius: float = 1.0,
    *,
    center_stated: bool = False,
    radius_stated: bool = False,
) -> Sphere:
    return Sphere(
        center=np.array(center),
        radius=radius,
        meters=0.5,
        center_stated=center_stated,
        radius_stated=radius_stated,
    )


class Nearness:
    """An agreement that is best at the true sphere, and counts how often it was asked."""

    def __init__(self, true: Sphere) -> None:
        self.true, self.asked = true, 0

    def __call__(self, sphere: Sphere) -> float:
        self.asked += 1
        off = np.abs(sphere.center - self.true.center).sum()
        return -float(off + abs(np.log(sphere.radius / self.true.radius)))


@pytest.mark.parametrize("true", [ball((0.1, -0.2, 0.15), 1.1), ball((0.0, 0.24, -0.1), 0.8)])
def test_the_best_sphere_is_found(true: Sphere) -> None:
    """Each of four numbers is at most a step and a half away, and seven rounds take the largest
    error first: what is left of each is less than half a step, 0.08, of a radius up to 1.16."""
    value = Nearness(true)
    found = fitted(ball(), value)
    assert np.abs(found.center - true.center).max() <= 0.08 * 1.16
    assert abs(found.radius / true.radius - 1.0) <= 0.08
    assert value.asked <= 1 + 8 * ROUNDS


def test_what_is_stated_is_not_moved() -> None:
    true = ball((0.1, -0.2, 0.15), 1.1)
    center_known = fitted(ball(center_stated=True), Nearness(true))
    assert center_known.center.tolist() == [0.0, 0.0, 0.0]
    assert center_known.radius > 1.0
    radius_known = fitted(ball(radius_stated=True), Nearness(true))
    assert radius_known.radius == 1.0
    assert radius_known.center[1] < -0.1
    assert changes(ball(center_stated=True, radius_stated=True)) == []


def test_a_sphere_stays_near_the_hull() -> None:
    """Whatever agrees out there: objects do not leave their hull."""
    found = fitted(ball(), Nearness(ball((0.0, 5.0, 0.0), 9.0)))
    assert near(found, ball())
    assert float(np.linalg.norm(found.center)) <= FARTHEST
    assert found.radius <= SIZES[1]


def test_growing_and_shrinking_by_the_same_step_leads_back() -> None:
    """Two roundings."""
    assert resized(resized(ball(), 0.12), -0.12).radius == pytest.approx(1.0, rel=1e-15)


def test_equal_agreement_moves_nothing() -> None:
    first = ball()
    assert fitted(first, lambda sphere: 0.5) is first


def test_the_found_sphere_is_told() -> None:
    told = told_sphere(ball((0.0, 0.3, 0.4), 1.5), ball(radius=2.0))
    assert "states no center and no radius" in told
    assert "moved by 0.25 of its radius and made 0.75 times as large" in told
    assert "center 0, 0.3, 0.4, radius 1.5" in told
    assert "states no radius:" in told_sphere(ball(), ball(center_stated=True))
