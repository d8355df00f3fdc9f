"""Tensors to layouts: units, empty slots, and trees that are none."""

import math

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError
from model.batch import Articulation
from model.evaluation.predictions import layout_of, with_observed_limits


def articulation(**changes: torch.Tensor) -> Articulation:
    """A base, an empty slot, a door of a quarter turn, a drawer on the door."""
    values = {
        "valid_BP": torch.tensor([[True, False, True, True]]),
        "center_BP3": torch.tensor(
            [[[0.0, 0.0, 0.0], [9.0] * 3, [0.0, -0.5, 0.0], [0.1, 0.2, 0.3]]]
        ),
        "size_BP3": torch.tensor([[[1.0, 1.0, 1.0], [9.0] * 3, [1.0, 0.1, 1.0], [0.2, 0.2, 0.2]]]),
        "type_BP": torch.tensor([[0, 1, 1, 2]]),
        "axis_BP3": torch.tensor([[[0.0] * 3, [1.0] * 3, [0.0, 0.0, 2.0], [0.0, -1.0, 0.0]]]),
        "origin_BP3": torch.tensor([[[0.0] * 3, [1.0] * 3, [0.5, -0.5, 0.0], [7.0] * 3]]),
        "motion_BTP": torch.tensor([[[0.0, 0.9, 0.0, 0.0], [0.0, 0.9, 0.25, 0.1]]]),
        "limits_BP2": torch.tensor([[[0.0, 0.0], [0.0, 1.0], [0.0, 0.25], [0.0, 0.2]]]),
        "parent_BP": torch.tensor([[-1, 0, 0, 2]]),
    }
    return Articulation(**{**values, **changes})


def test_units_become_metres_and_radians() -> None:
    layout = layout_of(articulation(), 0, radius=2.0, name="x", category="oven")
    assert layout.labels == ("base", "part_2", "part_3")
    assert layout.parents.tolist() == [-1, 0, 1]
    expected = np.array([[-1.0, -1.1, -1.0], [1.0, -0.9, 1.0]])
    assert layout.boxes[1] == pytest.approx(expected, abs=1e-6)  # float32 tensors.
    assert layout.axes[1].tolist() == [0.0, 0.0, 1.0]
    assert layout.origins.tolist() == [[0.0] * 3, [1.0, -1.0, 0.0], [0.0] * 3]
    assert layout.limits[1].tolist() == pytest.approx([0.0, math.pi / 2.0], abs=1e-15)
    assert layout.limits[2].tolist() == pytest.approx([0.0, 0.8], abs=1e-7)  # float32 tensors.
    assert layout.states is not None
    assert layout.states[1].tolist() == pytest.approx([0.0, math.pi / 2.0, 0.4], abs=1e-7)


@pytest.mark.parametrize(("turns", "endless"), [(1.0, True), (0.98, True), (0.96, False)])
def test_a_full_turn_is_endless(turns: float, endless: bool) -> None:
    """A network never says exactly 1, so nearly is enough, as where objects are put together; a
    slide of two radii has ends all the same."""
    full = torch.tensor([[[0.0, 0.0], [0.0, 1.0], [0.0, turns], [0.0, turns]]])
    assert layout_of(articulation(limits_BP2=full), 0).endless.tolist() == [False, endless, False]


def test_a_circle_of_parents_hangs_on_the_base() -> None:
    circle = layout_of(articulation(parent_BP=torch.tensor([[-1, 0, 3, 2]])), 0)
    assert sorted(circle.parents.tolist()) in ([-1, 0, 0], [-1, 0, 1], [-1, 0, 2])
    assert layout_of(articulation(parent_BP=torch.tensor([[-1, 0, 1, 0]])), 0).parents.tolist() == [
        -1,
        0,
        0,
    ]


def test_a_layout_without_base_is_refused() -> None:
    with pytest.raises(ModelError, match="the base belongs there"):
        layout_of(articulation(valid_BP=torch.tensor([[False, True, True, True]])), 0, name="x")


def test_limits_of_what_was_seen_hold_rest_and_all_states() -> None:
    layout = with_observed_limits(layout_of(articulation(), 0))
    assert layout.limits[1].tolist() == pytest.approx([0.0, math.pi / 2.0], abs=1e-15)
    assert layout.limits[2].tolist() == pytest.approx([0.0, 0.2], abs=1e-7)
    assert layout.limits[0].tolist() == [0.0, 0.0]
