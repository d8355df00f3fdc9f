"""Slide stays: what couples them to their flap is geometry, not a fit."""

import math

import numpy as np
import pytest

from artgen.articulation.kinematics import forward_kinematics
from artgen.core.transform import apply
from artgen.generators.kit.board import Stock
from artgen.generators.kit.fall_flap import LEAN, STEP, FallFlap, fall_flap
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.handle import Handle

WOOD = Stock(surface="wood", density=700.0)
FLAP = FallFlap(
    opening=Rect(x0=-0.4, x1=0.4, z0=0.73, z1=1.13),
    front=-0.2,
    thickness=0.018,
    gap=0.003,
    arm=0.16,
    friction=2.0,
    grip=Handle(style="knob", length=0.096, radius=0.005, standoff=0.028),
    wood=WOOD,
    leather=None,
    metal=Stock(surface="metal", density=6600.0),
)


@pytest.mark.parametrize("angle", [0.0, 0.3, 0.9, math.pi / 2.0])
def test_the_stud_in_the_case_stays_on_the_line_of_the_bar(angle: float) -> None:
    """Both studs lie `arm` from the hinge, so the bar turns by half of the flap's angle; the
    rotations of two joints cost 1e-16 m each."""
    joints = fall_flap(FLAP, "flap").joints
    pose = forward_kinematics("base", joints, {"flap_hinge": angle})["flap_stay_left"]
    y, z = FLAP.hinge
    rise = math.asin(STEP / FLAP.arm)
    on_flap = np.array([y + STEP, z + FLAP.arm * math.cos(rise)])
    in_case = np.array([y + FLAP.arm * math.sin(rise + LEAN), z + FLAP.arm * math.cos(rise + LEAN)])
    seen = apply(np.linalg.inv(pose), np.array([[0.0, *in_case]]))[0, 1:]
    along = (in_case - on_flap) / np.linalg.norm(in_case - on_flap)
    offset = seen - on_flap
    assert abs(offset[0] * along[1] - offset[1] * along[0]) < 1e-15
    assert offset @ along == pytest.approx(2.0 * FLAP.arm * math.sin((LEAN + angle) / 2.0))
