"""8: an assembled object's files say where its parts are: our kinematics, yourdfpy's and
pinocchio's agree, and MuJoCo compiles it. Needs no Blender: URDF, MJCF and OBJ are written here."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pinocchio
import pytest
import yourdfpy

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import sample_state
from artgen.assembly.assemble import finished
from artgen.core.stream import Stream
from artgen.core.transform import apply
from artgen.export.files import write_meshes
from artgen.export.layout import MJCF, TEXTURES, URDF, atlas_path, pivots
from artgen.export.mjcf import mjcf_text
from artgen.export.urdf import urdf_text
from artgen.textures.png import png_bytes
from tests.unit.assembly.mutations import has

STATES = 20
EXACT = 1e-9
"""m; text keeps 17 digits and chains are short: 1e-15; a wrong origin is off by more than 1e-4."""


@pytest.fixture(scope="module", params=["left", "out", "along"])
def written(request, cases, tmp_path_factory):
    """An object with a part that opens so, and no joint that follows another: readers treat those
    each in their own way, and the kinematics of formats are tested elsewhere."""
    folder = tmp_path_factory.mktemp("files")
    case = next(
        case
        for case in cases
        if has(request.param)(case) and all(joint.mimic is None for joint in case.new.joints)
    )
    obj = finished(case.new, asset_id="assembled_x", provenance={})
    write_meshes(obj, folder)
    (folder / URDF).write_text(urdf_text(obj))
    (folder / MJCF).write_text(mjcf_text(obj))
    (folder / TEXTURES).mkdir()
    image = np.full((2, 2, 3), 128, np.uint8)
    (folder / atlas_path(obj.asset_id)).write_bytes(png_bytes(image))
    return obj, folder


def states(obj):
    for k in range(STATES):
        yield sample_state(obj.joints, obj.preconditions, Stream(4, k))


def worst(obj, pose_of):
    """Largest distance between vertices under our poses and under those of a file's links."""
    off = 0.0
    for state in states(obj):
        ours = forward_kinematics(obj.base.name, obj.joints, state)
        theirs = pose_of(state)
        for part in obj.parts:
            local = part.mesh.vertices - pivots(obj)[part.name]
            there = apply(theirs[part.name], local)
            off = max(off, np.abs(apply(ours[part.name], part.mesh.vertices) - there).max())
    return off


def by_yourdfpy(obj, folder):
    robot = yourdfpy.URDF.load(
        str(folder / URDF), load_meshes=False, build_scene_graph=True, load_collision_meshes=False
    )

    def poses(state):
        robot.update_cfg(
            {name: q for name, q in state.items() if name in robot.actuated_joint_names}
        )
        return {part.name: robot.get_transform(part.name, obj.base.name) for part in obj.parts}

    return poses


def by_pinocchio(obj, folder):
    model = pinocchio.buildModelFromUrdf(str(folder / URDF))
    data = model.createData()

    def poses(state):
        q = pinocchio.neutral(model)
        for name, value in state.items():
            q[model.joints[model.getJointId(name)].idx_q] = value
        pinocchio.framesForwardKinematics(model, data, q)
        return {p.name: data.oMf[model.getFrameId(p.name)].homogeneous for p in obj.parts}

    return poses


@pytest.mark.parametrize("reader", [by_yourdfpy, by_pinocchio])
def test_8_files_put_every_vertex_where_we_do(written, reader):
    obj, folder = written
    assert worst(obj, reader(obj, folder)) < EXACT


def test_8_another_axis_is_seen(written, tmp_path):
    obj, _ = written
    joint = obj.joints[0]
    turned = replace(joint, axis=(0.0, -math.sin(1e-3), math.cos(1e-3)), type=joint.type)
    (tmp_path / URDF).write_text(urdf_text(replace(obj, joints=(turned, *obj.joints[1:]))))
    assert worst(obj, by_yourdfpy(obj, tmp_path)) > 1e-6


def test_8_mujoco_compiles_it(written):
    obj, folder = written
    model = mujoco.MjModel.from_xml_path(str(folder / MJCF))
    assert model.njnt == len(obj.joints)
    assert np.isfinite(model.body_mass).all()
