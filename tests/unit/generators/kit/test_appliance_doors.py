"""Doors on pins stay clear of what they close, at every angle that they open to."""

import math

import numpy as np
import pytest

from artgen.articulation.kinematics import forward_kinematics
from artgen.core.transform import apply
from artgen.generators.kit.heel_door import HeelDoor, Hinge
from artgen.generators.kit.lined_cavity import LinedCavity
from artgen.generators.kit.oven_rack import PLAY, OvenRack, RackLadders
from artgen.generators.kit.porthole_door import PortholeDoor
from artgen.generators.kit.wash_drum import TUB, WashDrum


def heel_door(hinge: Hinge) -> HeelDoor:
    return HeelDoor(
        hinge=hinge,
        corner=(-0.2 if hinge != "right" else 0.2, 0.0, 0.03),
        width=0.33,
        length=0.26,
        thickness=0.04,
        gap=0.0015,
        heel=0.0125,
        ears=(0.03, 0.23),
    )


@pytest.mark.parametrize("hinge", ["left", "right", "bottom"])
def test_a_heel_door_turns_clear_of_its_cabinet(hinge: Hinge) -> None:
    """No point of the leaf that lies before the cabinet comes behind half of its gap; the heel is
    drawn with chords, which lie inside its circle."""
    door = heel_door(hinge)
    leaf = door.placed(door.layer(door.front, door.back)).trimesh().vertices
    joint = door.joint(upper=math.radians(92.5), friction=1.0)
    edge = np.array(door.corner)
    for q in np.linspace(0.0, joint.limit.upper if joint.limit else 0.0, 40):
        moved = apply(forward_kinematics("base", (joint,), {joint.name: float(q)})["door"], leaf)
        ahead = {
            "left": moved[:, 0] > edge[0],
            "right": moved[:, 0] < edge[0],
            "bottom": moved[:, 2] > edge[2],
        }[hinge]
        assert moved[ahead, 1].max() < -0.5 * door.gap


@pytest.mark.parametrize("hinge", ["left", "right", "bottom"])
def test_positive_q_brings_the_free_edge_to_the_user(hinge: Hinge) -> None:
    door = heel_door(hinge)
    joint = door.joint(upper=1.5, friction=1.0)
    free = np.array([door.point(door.width, door.front, door.length / 2.0)])
    pose = forward_kinematics("base", (joint,), {joint.name: 0.1})["door"]
    assert apply(pose, free)[0, 1] < free[0, 1] - 0.02


def test_a_bowl_swings_out_of_its_seal() -> None:
    """Points of the bowl cross the seal's plane within its lip."""
    door = PortholeDoor(
        center=0.4, rim=0.22, mouth=0.14, lip=0.148, thickness=0.04, gap=0.003, bowl=0.13,
        covered=False, grip="scoop",
    )  # fmt: skip
    x, y = door.pin
    for radius, depth in door.bowl_outline:
        reach = math.hypot(radius - x, depth - y)
        across = math.sqrt(reach**2 - y**2) + x
        assert across < door.lip - 0.004


def test_the_drum_contact_stays_in_its_tub_at_every_angle() -> None:
    drum = WashDrum(
        center=0.4, radius=0.24, mouth=0.16, front=0.1, back=0.45, paddles=3, paddle_height=0.05
    )
    (body, *_) = drum.part(shell="a", rear="b", paddle="c").bodies
    for piece in body.collision:
        corners = piece.trimesh().vertices - (0.0, 0.0, drum.center)
        assert np.hypot(corners[:, 0], corners[:, 2]).max() < drum.radius + 0.4 * TUB


def test_racks_rest_above_their_rails_and_between_the_posts() -> None:
    cavity = LinedCavity(low=(-0.23, 0.0, 0.1), high=(0.23, 0.42, 0.45), corner=0.02, lining=0.003)
    ladders = RackLadders(cavity=cavity, levels=(0.16, 0.24, 0.32), front=0.05, back=0.36)
    rack = OvenRack(
        name="rack", ladders=ladders, level=1, front=0.03, back=0.38, bars=12, bar=0.002
    )
    (body,) = rack.rack_part("wire").bodies
    rails = ladders.solid()
    for out in np.linspace(0.0, 0.3, 7):
        assert (body.solid.at(y=-float(out), z=-0.8 * PLAY) & rails).is_empty
    assert not (body.solid.at(z=-3.0 * PLAY) & rails).is_empty
