"""Ears and notches of doors that fall open."""

import math

import numpy as np
import pytest

from artgen.generators.kit.drop_door import (
    DropDoor,
    detergent_dispenser,
    hinge_ears,
    inner_body,
    notches,
    pins,
    wrapped_panel,
)
from artgen.geometry.solid import slab, union

DOOR = DropDoor(
    half_width=0.29,
    inner=-0.004,
    outer=-0.060,
    skin=0.012,
    bottom=0.112,
    skin_bottom=0.095,
    top=0.81,
    pivot=(-0.016, 0.120),
)


@pytest.mark.parametrize("degrees", np.linspace(0.0, 90.0, 7))
def test_the_door_turns_around_its_ears(degrees: float) -> None:
    body = inner_body(DOOR, top=DOOR.top, dish=(0.23, 0.2, 0.75), depth=0.011, narrowed=0.002)
    panel = wrapped_panel(DOOR, top=DOOR.top, returns=DOOR.top, sheet=0.002, edge=0.012)
    whole = union([body, panel, *pins(DOOR)])
    opened = whole.turned("x", math.radians(degrees), about=(0.0, *DOOR.pivot))
    ears = union(hinge_ears(DOOR, back=0.0))
    assert (opened & ears).is_empty
    assert opened.manifold.min_gap(ears.manifold, 0.002) > 0.0005  # 1 mm less the bore's facets.


def test_pins_bridge_their_notches() -> None:
    """A pin ends where the notch ends: it touches the door on both sides and fills nothing."""
    for pin, x in zip(pins(DOOR), DOOR.ears, strict=True):
        assert pin.bounds[:, 0] == pytest.approx([x - 0.0045, x + 0.0045])
        assert (pin - notches(DOOR)).volume < 1e-15


def test_the_dish_leaves_a_flat_border() -> None:
    body = inner_body(DOOR, top=DOOR.top, dish=(0.23, 0.2, 0.75), depth=0.011, narrowed=0.0)
    assert body.bounds[1, 1] == pytest.approx(DOOR.inner)
    border = slab((0.235, DOOR.inner - 0.01, 0.2), (0.28, DOOR.inner, 0.75))
    middle = slab((-0.2, DOOR.inner - 0.01, 0.25), (0.2, DOOR.inner, 0.7))
    assert (body & border).volume == pytest.approx(border.volume)
    assert (body & middle).is_empty


def test_the_dispenser_stays_below_the_liner() -> None:
    """The lower rack rolls over it."""
    parts = detergent_dispenser(y=DOOR.inner - 0.011, x=0.0, z=0.5, depth=0.011)
    assert max(part.bounds[1, 1] for part in parts) < DOOR.inner
    assert union(parts).volume == pytest.approx(sum(part.volume for part in parts))
