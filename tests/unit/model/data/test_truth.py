"""Targets in radii and slots, by the law that supplements S4 and S5 of the paper state."""

import numpy as np
import pytest
import torch

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import sample_states, travel
from artgen.articulation.targets import Targets, targets
from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from model.batch import FIXED, REVOLUTE
from model.data.scene import centered
from model.data.truth import Truth, articulation, truth
from model.field.kinematics import world_from_rest
from tests.unit.model.data.small import soup


def _truth(category: str, slots: int = 8) -> tuple[Truth, Targets, list[dict[str, float]]]:
    made = soup(category)
    states = sample_states(made.joints, made.preconditions, Stream(1), 2)
    boxes = list(made.bounds)
    aims = targets(made.parts, boxes, made.joints, states, center=made.center, radius=made.radius)
    return truth(aims, radius=made.radius, slots=slots), aims, states


@pytest.mark.parametrize("category", ["cabinet", "laptop", "dishwasher", "toolbox"])
def test_the_network_s_motions_put_parts_where_forward_kinematics_does(category):
    made = soup(category)
    found, _, states = _truth(category)
    block = articulation([found], torch.device("cpu"))
    poses = world_from_rest(block.mapped(lambda x: x.double() if x.is_floating_point() else x))
    for t, state in enumerate(states):
        expected = forward_kinematics(made.parts[0], made.joints, state)
        for p, name in enumerate(made.parts):
            moved = centered(expected[name], made.center, made.radius)
            # Axes, origins and motions pass through float32 (6e-8), angles times 2 pi.
            np.testing.assert_allclose(poses[0, t, p].numpy(), moved, atol=2e-6)


def test_units_are_radii_and_the_unit_of_motion():
    made = soup("cabinet")
    found, aims, _ = _truth("cabinet")
    arrays = found.arrays
    for k, joint in enumerate(made.joints):
        p = made.parts.index(joint.child)
        unit = 2 * np.pi if arrays["type_P"][p] == REVOLUTE else 2 * made.radius
        np.testing.assert_allclose(arrays["limits_P2"][p] * unit, travel(joint), err_msg=str(k))
    half = arrays["size_P3"] / 2
    low = (arrays["center_P3"] - half) * made.radius + made.center
    np.testing.assert_allclose(low[: len(made.parts)], made.bounds[:, 0], atol=1e-12)
    np.testing.assert_array_equal(arrays["motion_TP"][:, : len(made.parts)], aims.motion)


def test_empty_slots_are_empty():
    found, aims, _ = _truth("laptop", slots=5)
    assert found.arrays["valid_P"].tolist() == [True, True, False, False, False]
    assert found.arrays["parent_P"].tolist() == [-1, 0, -1, -1, -1]
    assert (found.arrays["type_P"][2:] == FIXED).all()
    for name in ("center_P3", "size_P3", "axis_P3", "origin_P3", "limits_P2"):
        assert not found.arrays[name][2:].any(), name
    assert len(aims.type) == 2


def test_too_many_parts_are_refused():
    with pytest.raises(ModelError, match="do not fit into 2 slots"):
        _truth("cardboard_box", slots=2)
