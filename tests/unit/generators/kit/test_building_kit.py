"""Laws of the pieces that doors, windows and toilets are made of."""

import math

import numpy as np
import pytest

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import DraftPart, Joint, Limit
from artgen.core.transform import apply
from artgen.generators.kit.board import Stock
from artgen.generators.kit.door_hinge import DoorHinge
from artgen.generators.kit.door_leaf import pierced
from artgen.generators.kit.mirror_image import mirrored_joint, mirrored_part
from artgen.generators.kit.sliced_contact import sliced_wall
from artgen.generators.kit.swing_leaf import widest_swing
from artgen.generators.kit.toilet_pan import egg, faired, outline
from artgen.geometry.solid import prism, slab, union

WOOD = Stock(surface="wood", density=500.0)


def test_contact_around_a_hole_is_what_the_hole_leaves() -> None:
    board = WOOD.board((0.0, 0.0, 0.0), (1.0, 0.1, 2.0))
    hole = slab((0.9, 0.03, 0.8), (1.1, 0.06, 0.9))
    (cut,) = pierced((board,), hole, clear=hole)
    contact = union(cut.collision)
    left = 1.0 * 0.1 * 2.0 - 0.1 * 0.03 * 0.1
    assert cut.solid.volume == pytest.approx(left, rel=1e-12)
    assert sum(piece.volume for piece in cut.collision) == pytest.approx(left, rel=1e-12)
    assert (contact & hole).volume < 1e-15  # Faces that touch.


@pytest.mark.parametrize("power", [2.0, 2.6, 3.2])
def test_slices_lie_in_the_wall_and_fill_most_of_it(power: float) -> None:
    outer, inner = outline(0.18, -0.45, 0.1, 0.14, power), egg(0.13, -0.40, -0.085, power)
    cuts = np.linspace(-0.45, 0.1, 23).tolist()
    boxes = union(sliced_wall([outer], [inner], z=(0.0, 0.1), cuts=cuts))
    wall = prism(outer, 0.1) - prism(inner, 0.1)
    assert (boxes - wall).volume < 1e-12
    assert boxes.volume > 0.8 * wall.volume


def test_a_fair_curve_goes_through_its_rows() -> None:
    rows = np.array([(0.0, 1.0), (0.2, 0.9), (0.7, 0.4), (1.0, 0.3)])
    made = faired(rows, 4)
    assert np.allclose(made[::4], rows, atol=1e-15)
    assert (np.diff(made[:, 0]) > 0.0).all()


@pytest.mark.parametrize("axis", [(0.0, 0.0, -1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_mirrored_joint_moves_the_mirrored_part_as_the_mirror_shows(
    axis: tuple[float, float, float], kind: str
) -> None:
    joint = Joint(
        name="j", type="prismatic" if kind == "prismatic" else "revolute", parent="base",
        child="leaf", axis=axis, origin=(0.3, -0.1, 0.2), limit=Limit(lower=0.0, upper=1.0),
        friction=0.1, damping=0.1, effort=9.0,
    )  # fmt: skip
    part = DraftPart(name="leaf", label="door", bodies=(WOOD.board((0, 0, 0), (0.5, 0.1, 0.7)),))
    other = mirrored_part(part)
    flip = np.array((-1.0, 1.0, 1.0))
    points = part.bodies[0].solid.bounds
    pose = forward_kinematics("base", (joint,), {"j": 0.4})["leaf"]
    seen = forward_kinematics("base", (mirrored_joint(joint),), {"j": 0.4})["leaf"]
    assert np.allclose(apply(seen, points * flip), apply(pose, points) * flip, atol=1e-12)
    assert other.bodies[0].solid.bounds[0, 0] == -0.5


@pytest.mark.parametrize("proud", [0.012, 0.018, 0.030])
@pytest.mark.parametrize("kind", ["butt", "concealed"])
def test_a_leaf_stops_before_its_architrave(proud: float, kind: str) -> None:
    hinge = DoorHinge(
        kind="butt" if kind == "butt" else "concealed", jamb=0.0, gap=0.0036, face=0.0,
        height=0.1, radius=0.0065, finials=False,
    )  # fmt: skip
    bare = 0.008
    q = widest_swing(hinge=hinge, bare=bare, proud=proud, wanted=math.radians(175.0))
    leaf = slab((0.0036, 0.0, 0.0), (0.8, 0.04, 1.0))
    trim = slab((-0.1, -proud, 0.0), (-bare, 0.0, 1.0))
    for share in np.linspace(0.0, 1.0, 60):
        turned = leaf.turned("z", -share * q, about=(*hinge.axis, 0.0))
        assert (turned & trim).is_empty
