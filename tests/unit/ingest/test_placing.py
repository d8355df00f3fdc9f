"""Forward kinematics of ingested trees against yourdfpy and pinocchio on the folder's URDF."""

import re
from pathlib import Path

import numpy as np
import pinocchio
import pytest
import yourdfpy

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Joint
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.export.partnet.nodes import Leaf, Motion, Node
from artgen.export.partnet.rule import frame_of, rule_joints
from artgen.ingest.foreign import ForeignObject
from artgen.ingest.partnet.folder import OBJECT_FROM_MESH, read_partnet
from artgen.ingest.placing import Place, placed, placed_joint
from artgen.ingest.rest import Rest
from tests.unit.ingest.folders import Folder, cabinet

MESH_FROM_WORLD = np.array([[0, -1, 0], [0, 0, 1], [-1, 0, 0]], float)
"""The root's rpy takes (x, y, z) to (-z, -x, y); this undoes it."""
EXACT = 1e-9
"""The issue's bound; the worst seen is 2e-15: rpy's rounding of pi / 2 and a few products."""
KINDS = ("hinge", "slider", "hinge", "static", "slider", "hinge")


def random_folder(seed: int) -> Folder:
    """Seven nodes in a tree whose root is the last: hinges and slides with a above and below b,
    free ones, sliders that turn, fixed ones, and start poses other than as drawn."""
    rng = np.random.default_rng(seed)
    nodes = []
    for number, kind in enumerate(KINDS):
        parent = int(rng.integers(number + 1, 7))
        a, b = rng.uniform(-1.5, 1.5, 2) * (60.0 if kind == "hinge" else 0.3)
        direction = rng.normal(size=3)
        motion = Motion(
            origin=tuple(rng.uniform(-1.0, 1.0, 3)),
            direction=tuple(direction / np.linalg.norm(direction)),
            a=float(a),
            b=float(b),
            free=kind == "hinge" and bool(rng.random() < 0.3),
            rotates=kind == "slider" and bool(rng.random() < 0.3),
        )
        moves = kind != "static"
        own = (Leaf(id=number + 1, name="leaf"),)
        nodes.append(
            Node(id=number, parent=parent, kind=kind, name="n", leaves=own,
                 motion=motion if moves else None)
        )  # fmt: skip
    nodes.append(Node(id=6, parent=-1, kind="heavy", name="n", leaves=(Leaf(id=7, name="leaf"),)))
    boxes = {f"original-{k}": (rng.uniform(-1, 0, 3), rng.uniform(0.1, 1, 3)) for k in range(1, 8)}
    objs = {k: [f"original-{k}"] for k in range(1, 8)}
    return Folder(nodes=nodes, boxes=boxes, objs=objs, words={})


def urdf_values(folder: Folder, foreign: ForeignObject, rng: np.random.Generator) -> dict:
    """A random q of every joint as the data set's JSON counts, inside its limits."""
    return {
        joint.name: float(rng.uniform(joint.lower, joint.upper))
        if joint.lower is not None and joint.upper is not None
        else float(rng.uniform(-3.0, 3.0))
        for joint in foreign.joints
    }


def our_poses(
    foreign: ForeignObject, place: Place, rests: dict[str, Rest], drawn_q: dict[str, float]
) -> dict[str, Floats]:
    """Part name to its motion from rest, by our joints at the same pose."""
    joints, state = [], {}
    for joint in foreign.joints:
        at = placed_joint(joint, rests[joint.name], place)
        joints.append(
            Joint(name=joint.name, type=joint.type, parent=joint.parent, child=joint.child,
                  axis=at.axis, origin=at.origin, limit=at.limit, friction=0.0, damping=0.0,
                  effort=1.0)
        )  # fmt: skip
        size = place.scale.meters_per_unit if joint.type == "prismatic" else 1.0
        state[joint.name] = at.sign * size * (drawn_q[joint.name] - rests[joint.name].q)
    return forward_kinematics(foreign.parts[0].name, joints, state)


def in_object(place: Place, mesh_points: Floats) -> Floats:
    """Points of the mesh frame in the object frame."""
    turn = place.object_from_source
    return mesh_points @ turn[:, :3].T + turn[:, 3]


@pytest.mark.parametrize("seed", range(12))
def test_kinematics_agree_with_yourdfpy_and_pinocchio(seed: int, tmp_path: Path) -> None:
    """Every link's points, by both libraries from the URDF and by us from the JSON, at five states
    with random closed poses."""
    folder = random_folder(seed)
    root = folder.write(tmp_path / "1234")
    foreign = read_partnet(root)
    rng = np.random.default_rng(seed + 100)
    rests = {
        joint.name: Rest(q=0.0 if joint.lower is None else float(rng.choice([joint.lower,
                         joint.upper])), reason="", confidence="given")
        for joint in foreign.joints
    }  # fmt: skip
    points = {part.name: rng.uniform(-1.0, 1.0, (5, 3)) for part in foreign.parts}
    place = placed(foreign, rests, points, meters_per_unit=0.7)
    nodes = {f"link_{node.id}": node for node in folder.nodes}
    signs = {j.name: nodes[j.child].motion.sign for j in foreign.joints}
    for _ in range(5):
        drawn_q = urdf_values(folder, foreign, rng)
        poses = our_poses(foreign, place, rests, drawn_q)
        stated = slide_names(folder, {n: signs[n] * q for n, q in drawn_q.items()}, foreign)
        for link_poses in (by_yourdfpy(root, stated), by_pinocchio(root, stated)):
            for part in foreign.parts:
                ours = apply(poses[part.name], place.points(part.name, points[part.name]))
                moved = points[part.name] - np.array(frame_of(nodes[part.name]))
                world = apply(link_poses[part.name], moved)
                theirs = in_object(place, world @ MESH_FROM_WORLD.T)
                assert np.abs(ours - theirs).max() <= EXACT


def slide_names(
    folder: Folder, values: dict[str, float], foreign: ForeignObject
) -> dict[str, float]:
    """Values by the URDF's joint names: what slides and turns slides by the helper's joint."""
    helper = {j.child.removesuffix("_helper"): j.name for j in rule_joints(folder.nodes)
              if j.child.endswith("_helper")}  # fmt: skip
    found = dict.fromkeys((f"joint_{k}" for k in range(len(folder.nodes) - 1)), 0.0)
    for joint in foreign.joints:
        found[helper.get(joint.child, joint.name)] = values[joint.name]
    return found


def by_yourdfpy(root: Path, state: dict[str, float]) -> dict[str, Floats]:
    robot = yourdfpy.URDF.load(str(root / "mobility.urdf"), load_meshes=False)
    robot.update_cfg({name: state.get(name, 0.0) for name in robot.actuated_joint_names})
    return {name: robot.get_transform(name) for name in robot.link_map}


def by_pinocchio(root: Path, state: dict[str, float]) -> dict[str, Floats]:
    """With the effort and velocity that urdfdom asks for, and without shapes."""
    text = (root / "mobility.urdf").read_text()
    text = re.sub(r"<(visual|collision).*?</\1>", "", text, flags=re.S)
    text = text.replace("<limit ", '<limit effort="100" velocity="10" ')
    model = pinocchio.buildModelFromXML(text)
    data = model.createData()
    q = pinocchio.neutral(model)
    for number in range(1, model.njoints):
        value, at = state.get(model.names[number], 0.0), model.joints[number].idx_q
        if model.joints[number].nq == 2:
            q[at : at + 2] = np.cos(value), np.sin(value)
        else:
            q[at] = value
    pinocchio.framesForwardKinematics(model, data, q)
    return {frame.name: np.array(data.oMf[k]) for k, frame in enumerate(model.frames)}


def test_a_joint_that_rests_at_its_end_opens_the_other_way(tmp_path: Path) -> None:
    """b used as rest: the limits become [0, b - a] about the axis turned around."""
    foreign = read_partnet(cabinet().write(tmp_path / "1"))
    joint = next(joint for joint in foreign.joints if joint.type == "revolute")
    rests = {j.name: Rest(q=0.0, reason="", confidence="given") for j in foreign.joints}
    rests[joint.name] = Rest(q=joint.upper, reason="", confidence="given")
    points = {part.name: np.eye(3) for part in foreign.parts}
    place = placed(foreign, rests, points, meters_per_unit=1.0)
    at = placed_joint(joint, rests[joint.name], place)
    assert at.sign == -1.0
    assert at.limit.lower == 0.0
    assert at.limit.upper == pytest.approx(joint.upper - joint.lower, abs=1e-15)


def test_object_stands_on_the_ground_in_the_middle_facing_minus_y(tmp_path: Path) -> None:
    """The mesh frame's y is up and its +z the front. Sums of two numbers of size 1 round by 2e-16
    each; 1e-14 is allowed."""
    foreign = read_partnet(random_folder(5).write(tmp_path / "1"))
    rests = {j.name: Rest(q=0.0, reason="", confidence="given") for j in foreign.joints}
    rng = np.random.default_rng(0)
    points = {part.name: rng.uniform(-1.0, 1.0, (20, 3)) for part in foreign.parts}
    place = placed(foreign, rests, points, meters_per_unit=2.0)
    moved = np.concatenate([place.points(name, own) for name, own in points.items()])
    lower, upper = moved.min(axis=0), moved.max(axis=0)
    assert np.abs([lower[0] + upper[0], lower[1] + upper[1], lower[2]]).max() <= 1e-14
    assert (np.array([0.0, 0.0, 1.0]) @ OBJECT_FROM_MESH.T == [0.0, -1.0, 0.0]).all()
