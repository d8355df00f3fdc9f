"""Two solids that are sunk into each other end on the sides of a plane, losing little."""

import pytest

from artgen.geometry.solid import slab
from model.reconstruct.planes import partings

GAP = 0.002
ONE = slab((0.0, 0.0, 0.0), (0.4, 0.3, 0.2))


@pytest.mark.parametrize("shift", [(0.3, 0.0, 0.0), (0.0, -0.2, 0.0), (0.05, 0.02, 0.15)])
def test_the_gap_lies_between_them(shift: tuple[float, float, float]) -> None:
    """Cuts of boxes are exact to roundings of 1e-16."""
    found = partings(ONE, ONE.at(*shift), GAP)[0]
    (low, high), (first, last) = found.one.bounds[:, found.axis], found.other.bounds[:, found.axis]
    assert abs(max(first - high, low - last) - GAP) <= 1e-12


def test_the_plane_takes_least_from_whom_it_takes_most() -> None:
    """Overlapping by a quarter of their length: the middle takes an eighth and half a gap."""
    found = partings(ONE, ONE.at(0.3), GAP)[0]
    assert found.axis == 0
    assert abs(found.lost - (0.05 + GAP / 2.0) / 0.4) <= 1e-9


def test_a_part_within_another_keeps_its_volume_or_half_of_it() -> None:
    """A small block in the middle of a large one: a plane at its side takes half of the large one
    at most and none of the small one, but for half a gap."""
    small = slab((0.18, 0.13, 0.08), (0.22, 0.17, 0.12))
    found = partings(ONE, small, GAP)[0]
    assert found.lost <= 0.6


def test_what_is_the_same_is_halved() -> None:
    found = partings(ONE, ONE, GAP)[0]
    assert abs(found.lost - (0.5 + GAP / 2.0 / 0.4)) <= 1e-9
