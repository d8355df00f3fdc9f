"""Laws of the pieces that gadgets share: buttons, dials, round contact, aims, insets, turns."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from artgen.generators.kit.aiming import aim_matrix
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.dial import Dial
from artgen.generators.kit.push_button import PushButton
from artgen.generators.kit.quarter_turn import turned_joint, turned_part
from artgen.generators.kit.round_contact import round_boxes
from artgen.generators.kit.stapler_design import convex_outline, inset_convex
from artgen.geometry.profile import circle
from artgen.geometry.solid import slab

FACE = PanelPlane(
    origin=(0.0, -0.2, 0.1), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=(0.1, 0.1)
)
"""Looks to -y."""
BUTTON = PushButton(
    name="stop", center=(0.05, 0.05), size=(0.012, 0.012), proud=0.004, travel=0.002
)


def test_a_pressed_button_neither_meets_its_face_nor_its_well() -> None:
    part, joint = BUTTON.part(FACE, "key", density=1000.0), BUTTON.joint(FACE, parent="base")
    wall = slab((-1.0, -0.2, -1.0), (1.0, 0.0, 1.0))
    for q in (0.0, BUTTON.travel):
        step = [q * a for a in joint.axis]
        body = part.bodies[0]
        assert ((wall - FACE.placed(BUTTON.well())) & body.solid.at(*step)).is_empty
        assert all((wall & piece.at(*step)).is_empty for piece in body.collision)


def test_a_dial_clears_its_face_and_its_hole() -> None:
    dial = Dial(name="dial", center=(0.05, 0.05), radius=0.015, height=0.016, lift=0.001)
    wall = slab((-1.0, -0.2, -1.0), (1.0, 0.0, 1.0)) - FACE.placed(dial.hole())
    part = dial.part(FACE, "knob", "mark", density=1000.0)
    assert all((wall & body.solid).is_empty for body in part.bodies)
    assert_allclose(dial.joint(FACE, parent="base").axis, (0.0, 1.0, 0.0), atol=0.0)


def test_boxes_for_a_round_bar_stay_within_its_circle() -> None:
    """The corners lie on the circle to the third digit of the shares."""
    for box in round_boxes(0.02, 0.1, 0.3, axis="x", at=(0.5, 0.7)):
        low, high = box.bounds
        assert (low[0], high[0]) == pytest.approx((0.1, 0.3), abs=1e-12)
        corner = math.hypot(high[1] - 0.5, high[2] - 0.7)
        assert 0.97 * 0.02 < corner <= 0.02


def test_an_aim_is_a_rotation_that_takes_z_to_its_direction() -> None:
    for direction in ((0.0, -0.3, -0.9), (1.0, 0.0, 0.0), (0.2, 0.5, 0.1)):
        matrix = aim_matrix((1.0, 2.0, 3.0), direction)
        turn = matrix[:3, :3]
        assert_allclose(turn @ turn.T, np.eye(3), atol=1e-15)
        assert np.linalg.det(turn) == pytest.approx(1.0, abs=1e-15)
        assert_allclose(turn[:, 2], np.array(direction) / np.linalg.norm(direction), atol=1e-15)


def test_an_inset_circle_is_a_smaller_one() -> None:
    """All sides of a regular polygon move in alike, so its corners stay on one circle."""
    outline = convex_outline(circle(0.01, segments=24))
    inner = np.linalg.norm(inset_convex(outline, 0.002), axis=1)
    assert_allclose(inner, 0.01 - 0.002 / math.cos(math.pi / 24.0), atol=1e-12)


def test_a_quarter_turn_takes_what_faced_left_of_the_front_there_and_keeps_volumes() -> None:
    part, joint = BUTTON.part(FACE, "key", density=1000.0), BUTTON.joint(FACE, parent="base")
    turned = turned_part(part)
    assert turned.bodies[0].solid.volume == pytest.approx(part.bodies[0].solid.volume, rel=1e-12)
    assert_allclose(turned.grips[0].outward, (-1.0, 0.0, 0.0), atol=0.0)
    assert_allclose(turned_joint(joint).axis, (1.0, 0.0, 0.0), atol=0.0)
