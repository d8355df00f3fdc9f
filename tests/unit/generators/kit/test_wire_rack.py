"""Laws of wire baskets."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import GeometryError
from artgen.generators.kit.wire_rack import (
    WireBasket,
    basket_collision,
    basket_wires,
    bent,
    tines,
)
from artgen.geometry.solid import union


@st.composite
def baskets(draw: st.DrawFn) -> WireBasket:
    floor = draw(st.floats(0.0, 0.3))
    low = draw(st.floats(0.08, 0.14))
    return WireBasket(
        half_width=draw(st.floats(0.15, 0.26)),
        front=0.0,
        back=draw(st.floats(0.35, 0.5)),
        floor=floor,
        crown=draw(st.sampled_from([0.0, 0.018])),
        rim_front=floor + low,
        rim_back=floor + low + draw(st.floats(0.0, 0.05)),
        radius=draw(st.floats(0.0012, 0.0020)),
        lengthwise=draw(st.integers(5, 10)),
        crosswise=draw(st.integers(5, 10)),
        belts=draw(st.integers(0, 1)),
    )


@settings(deadline=None, max_examples=30)
@given(baskets())
def test_wires_rest_on_each_other_without_sharing_volume(basket: WireBasket) -> None:
    """Then their union has the sum of their volumes; booleans keep 1e-9 of it."""
    pins = tines(basket, basket.lanes[1:3].tolist(), [0.1], height=0.06, lean=0.01)
    wires = [*basket_wires(basket), *(pins if _between_rungs(basket) else [])]
    assert union(wires).volume == pytest.approx(sum(w.volume for w in wires), rel=1e-9)


def _between_rungs(basket: WireBasket) -> bool:
    return bool(np.abs(basket.rungs - 0.1).min() > 5.0 * basket.radius)


@settings(deadline=None, max_examples=25)
@given(baskets())
def test_collision_holds_the_wires_and_leaves_the_room_open(basket: WireBasket) -> None:
    pieces = basket_collision(basket)
    boxes = np.array([piece.bounds for piece in pieces])
    wires = union(basket_wires(basket)).bounds
    # Rim and side bends stick out of the thin boxes by a third of a wire and its facets.
    assert np.abs(wires - [boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]).max() < 0.004
    volume = sum(piece.volume for piece in pieces)
    assert volume < 0.35 * np.prod(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0))


@given(st.floats(0.005, 0.03), st.floats(0.45, 2.6))
def test_bends_are_arcs_of_the_radius(radius: float, turn: float) -> None:
    """A path turning by `turn`: the arc's points lie at the radius about one center."""
    reach = 0.2
    corner = np.array([reach, 0.0, 0.0])
    end = corner + reach * np.array([math.cos(turn), math.sin(turn), 0.0])
    if radius * math.tan(turn / 2.0) > 0.9 * reach:
        return
    path = bent([(0.0, 0.0, 0.0), corner, end], radius)
    center = corner + np.array([-radius * math.tan(turn / 2.0), radius, 0.0])
    assert np.linalg.norm(path[1:-1] - center, axis=1) == pytest.approx(radius, rel=1e-9)


def test_bends_that_do_not_fit_are_refused() -> None:
    with pytest.raises(GeometryError, match="shorten the radius"):
        bent([(0, 0, 0), (0, 0, 0.01), (0.01, 0, 0.01), (0.01, 0, 0.0)], 0.008)


def test_mass_is_that_of_round_wire() -> None:
    """Along straight wire the polygon has the circle's area; bends and mitres keep the center
    line's length within 1 %."""
    basket = WireBasket(
        half_width=0.2,
        front=0.0,
        back=0.4,
        floor=0.0,
        rim_front=0.1,
        rim_back=0.1,
        radius=0.0015,
        lengthwise=5,
        crosswise=5,
        belts=0,
    )
    along = basket_wires(basket)[1]
    bends = 2.0 * basket.bend * (math.pi / 2.0 - 2.0)
    reach = 1.2 * (1.33 + 1.0) * basket.radius
    length = 0.4 + 2.0 * (0.1 - reach) + bends
    assert along.volume == pytest.approx(math.pi * 0.0015**2 * length, rel=0.01)
