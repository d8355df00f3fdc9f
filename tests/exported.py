"""Written bundles, and their files read back by libraries that know nothing of artgen."""

import itertools
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pinocchio
import trimesh
import yourdfpy
from PIL import Image
from pxr import Usd, UsdGeom, UsdPhysics

from artgen.articulation.kinematics import forward_kinematics, resolved
from artgen.articulation.types import ArticulatedObject, State
from artgen.core.conventions import Y_UP_FROM_Z_UP
from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted, rigid
from artgen.export import layout, usd_joints
from artgen.export.files import write_model_files
from artgen.export.glb import load_kinematics as glb_kinematics
from artgen.export.layout import pivots

Poses = dict[str, Floats]
Boxes = dict[str, Floats]


def write_without_blender(obj: ArticulatedObject, folder: Path) -> Path:
    """OBJ, URDF, MJCF and USD, with a gray atlas; MuJoCo's cache is off, it goes stale."""
    mujoco.mj_setCacheCapacity(mujoco.mj_getCache(), 0)
    (folder / layout.TEXTURES).mkdir(parents=True, exist_ok=True)
    Image.new("RGB", (8, 8), (128, 128, 128)).save(folder / layout.atlas_path(obj.asset_id))
    write_model_files(obj, folder, {})
    return folder


# ------------------------------------------------------------------- poses: object_from_rest a part


def our_poses(obj: ArticulatedObject, state: State) -> Poses:
    """artgen's forward kinematics."""
    return forward_kinematics(obj.base.name, obj.joints, state)


def _from_frames(obj: ArticulatedObject, frames: Mapping[str, Floats]) -> Poses:
    """Where link frames are, as motions from rest, at which they only are translated."""
    return {name: frames[name] @ rigid(np.eye(3), -pivot) for name, pivot in pivots(obj).items()}


def mujoco_model(folder: Path, file: str) -> mujoco.MjModel:
    """What MuJoCo makes of the MJCF or URDF."""
    return mujoco.MjModel.from_xml_path(str(folder / file))


def mujoco_data(obj: ArticulatedObject, model: mujoco.MjModel, state: State) -> mujoco.MjData:
    """All positions at a state."""
    data = mujoco.MjData(model)
    for name, q in resolved(obj.joints, state).items():
        data.qpos[model.joint(name).qposadr] = q
    mujoco.mj_kinematics(model, data)
    return data


def mujoco_poses(obj: ArticulatedObject, folder: Path, file: str, state: State) -> Poses:
    """From the MJCF or URDF."""
    model = mujoco_model(folder, file)
    data = mujoco_data(obj, model, state)
    bodies = {part.name: data.body(part.name) for part in obj.parts}
    frames = {name: rigid(body.xmat.reshape(3, 3), body.xpos) for name, body in bodies.items()}
    return _from_frames(obj, frames)


def pinocchio_at(
    obj: ArticulatedObject, folder: Path, state: State
) -> tuple[pinocchio.Model, pinocchio.Data, Floats]:
    """Model, data and q from the URDF."""
    model = pinocchio.buildModelFromUrdf(str(folder / layout.URDF))
    data, q = model.createData(), pinocchio.neutral(model)
    for name, value in resolved(obj.joints, state).items():
        joint = model.joints[model.getJointId(name)]
        values = (np.cos(value), np.sin(value)) if joint.nq == 2 else (value,)
        q[joint.idx_q : joint.idx_q + joint.nq] = values
    return model, data, q


def pinocchio_poses(obj: ArticulatedObject, folder: Path, state: State) -> Poses:
    """From the URDF."""
    model, data, q = pinocchio_at(obj, folder, state)
    pinocchio.framesForwardKinematics(model, data, q)
    kind = pinocchio.FrameType.BODY
    frames = {p.name: data.oMf[model.getFrameId(p.name, kind)].homogeneous for p in obj.parts}
    return _from_frames(obj, frames)


def yourdfpy_poses(obj: ArticulatedObject, folder: Path, state: State) -> Poses:
    """From the URDF."""
    robot = yourdf(folder, load_meshes=False)
    q = resolved(obj.joints, state)
    robot.update_cfg({name: q[name] for name in robot.actuated_joint_names})
    base = robot.base_link
    return _from_frames(obj, {p.name: robot.get_transform(p.name, base) for p in obj.parts})


def yourdf(folder: Path, *, load_meshes: bool) -> yourdfpy.URDF:
    """The robot in yourdfpy; file names are relative to the URDF."""
    return yourdfpy.URDF.load(
        str(folder / layout.URDF),
        load_meshes=load_meshes,
        build_scene_graph=True,
        force_mesh=True,
        mesh_dir=str(folder),
    )


def grip_frames(obj: ArticulatedObject, folder: Path, state: State) -> dict[str, Poses]:
    """Reader to the frames (4, 4) of grips, as other libraries see them."""
    names = [grip.name for part in obj.parts for grip in part.grips]
    model = mujoco_model(folder, layout.MJCF)
    sites = mujoco_data(obj, model, state)
    found = {"mjcf in mujoco": {n: _placed(sites.site(n)) for n in names}}
    bodies = mujoco_data(obj, mujoco_model(folder, layout.URDF), state)
    found["urdf in mujoco"] = {n: _placed(bodies.body(n)) for n in names}
    robot = yourdf(folder, load_meshes=False)
    q = resolved(obj.joints, state)
    robot.update_cfg({name: q[name] for name in robot.actuated_joint_names})
    found["urdf in yourdfpy"] = {n: robot.get_transform(n, robot.base_link) for n in names}
    other, data, place = pinocchio_at(obj, folder, state)
    pinocchio.framesForwardKinematics(other, data, place)
    found["urdf in pinocchio"] = {n: data.oMf[other.getFrameId(n)].homogeneous for n in names}
    return found


def _placed(element: Any) -> Floats:
    """(4, 4) of a site or body of an MjData."""
    return rigid(element.xmat.reshape(3, 3), element.xpos)


# ------------------------------------------------------------------- masses: kg, m, kg m2 a part


Masses = dict[str, tuple[float, Floats, Floats]]
"""Mass, center of mass and inertia about it, in the object frame at rest."""


def mujoco_masses(obj: ArticulatedObject, folder: Path, file: str) -> Masses:
    """From the MJCF or URDF."""
    model, found = mujoco_model(folder, file), {}
    for name, pivot in pivots(obj).items():
        body = model.body(name)
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, body.iquat)
        rotation = turn.reshape(3, 3)
        tensor = (rotation * body.inertia) @ rotation.T
        found[name] = (float(body.mass[0]), pivot + body.ipos, tensor)
    return found


def pinocchio_masses(obj: ArticulatedObject, folder: Path) -> Masses:
    """From the URDF; the fixed base is part of pinocchio's universe."""
    model = pinocchio.buildModelFromUrdf(str(folder / layout.URDF))
    found = {}
    for part in obj.parts:
        frame = model.frames[model.getFrameId(part.name, pinocchio.FrameType.BODY)]
        inertia = model.inertias[frame.parent]
        found[part.name] = (inertia.mass, pivots(obj)[part.name] + inertia.lever, inertia.inertia)
    return found


def yourdfpy_masses(obj: ArticulatedObject, folder: Path) -> Masses:
    """From the URDF."""
    robot, found = yourdf(folder, load_meshes=False), {}
    for name, pivot in pivots(obj).items():
        inertial = robot.link_map[name].inertial
        found[name] = (inertial.mass, pivot + inertial.origin[:3, 3], inertial.inertia)
    return found


def usd_masses(obj: ArticulatedObject, folder: Path) -> Masses:
    """From the USD, by usd-core."""
    stage, found = Usd.Stage.Open(str(folder / layout.USD)), {}
    cache = UsdGeom.XformCache()
    for part in obj.parts:
        prim = stage.GetPrimAtPath(f"/{obj.asset_id}/{part.name}")
        place = cache.GetLocalToWorldTransform(prim)
        api = UsdPhysics.MassAPI(prim)
        axes = api.GetPrincipalAxesAttr().Get()
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, np.array([axes.GetReal(), *axes.GetImaginary()], float))
        rotation = turn.reshape(3, 3)
        tensor = (rotation * np.array(api.GetDiagonalInertiaAttr().Get(), float)) @ rotation.T
        center = np.array(place.Transform(api.GetCenterOfMassAttr().Get()))
        found[part.name] = (api.GetMassAttr().Get(), center, tensor)
    return found


# ------------------------------------------------------------------- boxes: (2, 3) a part, world


def _box(points: Floats) -> Floats:
    return np.stack([points.min(axis=0), points.max(axis=0)])


def our_boxes(obj: ArticulatedObject, state: State) -> Boxes:
    """Of the object itself."""
    poses = our_poses(obj, state)
    return {part.name: _box(apply(poses[part.name], part.mesh.vertices)) for part in obj.parts}


def mujoco_boxes(obj: ArticulatedObject, folder: Path, file: str, state: State) -> Boxes:
    """Of the visual meshes MuJoCo loaded."""
    model = mujoco_model(folder, file)
    data = mujoco_data(obj, model, state)
    return {part.name: geom_box(model, data, f"{part.name}_visual") for part in obj.parts}


def geom_box(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> Floats:
    """Of one box or mesh geom."""
    geom, placed = model.geom(name), data.geom(name)
    if geom.type[0] == mujoco.mjtGeom.mjGEOM_BOX:
        points = geom.size * np.array(list(itertools.product((-1, 1), repeat=3)))
    else:
        mesh = int(geom.dataid[0])
        start, first = model.mesh_vertadr[mesh], model.mesh_faceadr[mesh]
        faces = model.mesh_face[first : first + model.mesh_facenum[mesh]]
        points = model.mesh_vert[start + np.unique(faces)].astype(float)  # Only what is shown.
    return _box(apply(rigid(placed.xmat.reshape(3, 3), placed.xpos), points))


def yourdfpy_boxes(obj: ArticulatedObject, folder: Path, state: State) -> Boxes:
    """Of the visual meshes that yourdfpy loaded from the URDF."""
    robot = yourdf(folder, load_meshes=True)
    q = resolved(obj.joints, state)
    robot.update_cfg({name: q[name] for name in robot.actuated_joint_names})
    boxes = {}
    for part in obj.parts:
        visual = robot.link_map[part.name].visuals[0]
        place = robot.get_transform(part.name, robot.base_link) @ visual.origin
        mesh = trimesh.load(folder / visual.geometry.mesh.filename, force="mesh", process=False)
        boxes[part.name] = _box(apply(place, mesh.vertices))
    return boxes


def usd_boxes(obj: ArticulatedObject, folder: Path, state: State) -> Boxes:
    """Of the meshes in the USD, moved as its own joints say."""
    stated = usd_joints.load_kinematics(folder)
    poses = forward_kinematics(stated.base, stated.joints, state)  # type: ignore[arg-type]
    stage, cache, boxes = Usd.Stage.Open(str(folder / layout.USD)), UsdGeom.XformCache(), {}
    for part in obj.parts:
        mesh = UsdGeom.Mesh(stage.GetPrimAtPath(f"/{obj.asset_id}/{part.name}/visual"))
        place = np.array(cache.GetLocalToWorldTransform(mesh.GetPrim())).T
        points = np.array(mesh.GetPointsAttr().Get(), float)
        boxes[part.name] = _box(apply(poses[part.name] @ place, points))
    return boxes


def glb_boxes(obj: ArticulatedObject, folder: Path, state: State) -> Boxes:
    """Of the meshes that trimesh loads from the GLB, moved as its own joints say."""
    stated = glb_kinematics(folder)
    poses = forward_kinematics(stated.base, stated.joints, state)  # type: ignore[arg-type]
    scene = trimesh.load(folder / layout.GLB, process=False)
    back, points = inverted(Y_UP_FROM_Z_UP), {part.name: [] for part in obj.parts}
    for node in scene.graph.nodes_geometry:
        place, geometry = scene.graph[node]
        name = _owner(scene, node, points)
        points[name].append(apply(back @ place, scene.geometry[geometry].vertices))
    return {name: _box(apply(poses[name], np.concatenate(p))) for name, p in points.items()}


def _owner(scene: trimesh.Scene, node: str, parts: Mapping[str, object]) -> str:
    """The part's node: trimesh hangs each material's piece of a mesh below it."""
    while node not in parts:
        node = scene.graph.transforms.parents[node]
    return node


def xml_paths(folder: Path) -> list[str]:
    """Every file name that the URDF and MJCF state."""
    names = []
    for file in (layout.URDF, layout.MJCF):
        for element in ET.parse(folder / file).iter():
            names += [v for k, v in element.attrib.items() if k in ("file", "filename")]
    return names
