"""14: how evenly donors are used is told by entropy."""

import numpy as np
import pytest

from artgen.assembly_study.rows import entropy_share


def test_even_use_has_all_the_entropy_there_is():
    assert entropy_share([7] * 20, 20) == pytest.approx(1.0)


def test_half_of_the_donors_used_evenly():
    assert entropy_share([3] * 10 + [0] * 10, 20) == pytest.approx(np.log(10) / np.log(20))


def test_a_favorite_is_seen():
    """The control: one donor of twenty fills four slots of five."""
    assert entropy_share([400] + [5] * 19, 20) < 0.8
    assert entropy_share([400] + [0] * 19, 20) == pytest.approx(0.0)
