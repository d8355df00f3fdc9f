"""Small outputs of other systems, written as they write them: the cabinet of `layouts`."""

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from artgen.core.rotation import axis_angle_matrix
from artgen.geometry.solid import slab
from tests.unit.model.evaluation.layouts import BASE, DOOR, DRAWER

Box = Sequence[Sequence[float]]


def write_box(path: Path, box: Box, shift: Sequence[float] = (0.0, 0.0, 0.0)) -> None:
    """A box as OBJ or ASCII PLY."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lower, upper = np.asarray(box, float) + np.asarray(shift, float)
    mesh = slab(lower, upper).trimesh()
    rows = [" ".join(repr(float(x)) for x in vertex) for vertex in mesh.vertices]
    if path.suffix == ".obj":
        lines = [f"v {row}" for row in rows]
        lines += ["f " + " ".join(str(k + 1) for k in face) for face in mesh.faces.tolist()]
    else:
        lines = ["ply", "format ascii 1.0", f"element vertex {len(rows)}"]
        lines += [f"property float {axis}" for axis in "xyz"]
        lines += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices"]
        lines += ["end_header", *rows]
        lines += ["3 " + " ".join(map(str, face)) for face in mesh.faces.tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_urdf(folder: Path) -> Path:
    """Links with frames at their joints, a turned door frame, and a knob on a fixed joint."""
    write_box(folder / "base.obj", BASE)
    write_box(folder / "drawer.obj", DRAWER, (0.0, 0.0, -0.2))
    write_box(folder / "door.obj", [(-1.0, -0.1, 0.0), (0.0, 0.0, 0.5)])
    text = f"""<robot name="cabinet">
    <link name="base"><visual><geometry><mesh filename="base.obj"/></geometry></visual></link>
    <link name="drawer"><visual><geometry><mesh filename="drawer.obj"/></geometry></visual></link>
    <link name="door"><visual><geometry><mesh filename="door.obj"/></geometry></visual></link>
    <link name="knob"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
    <joint name="slide" type="prismatic"><parent link="base"/><child link="drawer"/>
      <origin xyz="0 0 0.2"/><axis xyz="0 -1 0"/>
      <limit lower="0" upper="0.5" effort="1" velocity="1"/></joint>
    <joint name="hinge" type="revolute"><parent link="base"/><child link="door"/>
      <origin xyz="0 -0.1 0.5" rpy="0 0 {math.pi!r}"/><axis xyz="0 0 -1"/>
      <limit lower="0" upper="1.5" effort="1" velocity="1"/></joint>
    <joint name="screwed" type="fixed"><parent link="door"/><child link="knob"/>
      <origin xyz="-0.9 0.1 0.1"/></joint>
    </robot>"""
    file = folder / "mobility.urdf"
    file.write_text(text, encoding="utf-8")
    return file


def write_urdformer(folder: Path) -> Path:
    """A file in `output`, meshes beside that folder, the front along +x."""
    write_box(folder / "meshes" / "cabinet.obj", [(-1.0, 0.0, 0.0), (0.0, 2.0, 1.0)])
    write_box(folder / "meshes" / "parts" / "drawer.obj", [(-0.5, 0.0, 0.0), (0.1, 1.0, 1.0)])
    text = """<?xml version='1.0' encoding='utf-8'?>
    <robot name="my_urdf"><link name="base_link"><visual><geometry>
    <mesh filename="../meshes/cabinet.obj" scale="1 1 1" /></geometry></visual></link>
    <link name="drawer0"><visual><geometry>
    <mesh filename="../meshes/parts/drawer.obj" scale="1 1.5 0.5" /></geometry></visual></link>
    <joint name="drawer0_to_base_link" type="prismatic"><axis xyz="1 0 0" />
    <limit effort="5" lower="0" upper="0.4" velocity="2.283" />
    <origin xyz="0 0.25 0.5" rpy="0 0 0" />
    <parent link="base_link" /><child link="drawer0" /></joint></robot>"""
    file = folder / "output" / "label3.urdf"
    file.parent.mkdir(parents=True)
    file.write_text(text, encoding="utf-8")
    return file


def write_singapo(folder: Path) -> Path:
    """y up, front +z: (x, y, z) of ours is (x, z, -y) there; the base is not first."""

    def node(own: int, name: str, parent: int, box: Box, joint: Mapping[str, object]) -> object:
        lower, upper = (np.array([p[0], p[2], -p[1]]) for p in box)
        return {
            "id": own,
            "name": name,
            "parent": parent,
            "children": [],
            "aabb": {
                "center": ((lower + upper) / 2.0).tolist(),
                "size": np.abs(upper - lower).tolist(),
            },
            "joint": joint,
            "plys": [f"plys/{name}.ply"],
        }

    def moving(kind: str, axis: Sequence[float], end: float) -> dict[str, object]:
        return {"type": kind, "range": [0, end], "axis": {"direction": axis, "origin": [0, 0, 0]}}

    fixed = {
        "type": "fixed",
        "range": [0, 0],
        "axis": {"direction": [0, 0, 0], "origin": [0, 0, 0]},
    }
    tree = [
        node(0, "drawer", 2, DRAWER, moving("prismatic", (0.0, 0.0, 1.0), 0.5)),
        node(1, "door", 2, DOOR, moving("revolute", (0.0, 1.0, 0.0), -math.degrees(1.5))),
        node(2, "base", -1, BASE, fixed),
        node(3, "handle", 1, [(0.8, -0.2, 0.6), (0.9, -0.1, 0.7)], fixed),
    ]
    file = folder / "object.json"
    folder.mkdir(parents=True, exist_ok=True)
    stated = {"meta": {"obj_cat": "StorageFurniture"}, "diffuse_tree": tree}
    file.write_text(json.dumps(stated), encoding="utf-8")
    for name, box in (("drawer", DRAWER), ("door", DOOR)):
        lower, upper = box
        swapped = [(lower[0], lower[2], -upper[1]), (upper[0], upper[2], -lower[1])]
        write_box(folder / "plys" / f"{name}.ply", swapped)
    return file


def write_paris(folder: Path, kind: str) -> Path:
    """Static and moving mesh, and the motion, of which a slide's `dist` is half."""
    write_box(folder / "it20000_static_128_thre0.5.ply", BASE)
    write_box(folder / "it20000_whole_trans2start_128_thre0.5.ply", BASE)
    write_box(folder / "it20000_trans2start_128_thre0.5.ply", DOOR)
    motion: dict[str, object] = {
        "type": kind,
        "axis_d": [0.0, 0.0, -1.0],
        "axis_o": [0.0, 0.0, 0.3],
    }
    if kind == "rotate":
        motion["rot_angle"] = [math.degrees(1.5)]
    else:
        motion |= {"axis_d": [0.0, -1.0, 0.0], "dist": 0.25}
    file = folder / "it20000_test_motion.json"
    file.write_text(json.dumps(motion), encoding="utf-8")
    return folder


def write_dta(folder: Path) -> Path:
    """Two moving parts as rigid motions; what they are is in the names of their axis meshes."""
    for k, box in enumerate((BASE, DRAWER, DOOR)):
        write_box(folder / f"init_part_{k}.obj", box)
    write_box(folder / "init_axis_0_prismatic.obj", DOOR)
    write_box(folder / "init_axis_1_revolute.obj", DOOR)
    turn = axis_angle_matrix((0.0, 0.0, -1.0), 1.5)
    origin = np.array([0.2, 0.1, 0.0])
    rows = [
        {"rotation": np.eye(3).tolist(), "translation": [0.0, -0.25, 0.0]},
        {"rotation": turn.tolist(), "translation": (origin - turn @ origin).tolist()},
    ]
    for order in ("01", "10"):
        rows = rows if order == "01" else rows[::-1]
        (folder / f"init_p{order}_motion.json").write_text(json.dumps(rows), encoding="utf-8")
    return folder


def write_artgs(folder: Path) -> Path:
    """Joints as a list of dictionaries, parts by number."""
    for k, box in enumerate((BASE, DRAWER, DOOR)):
        write_box(folder / f"part_{k}.ply", box)
    rows = [
        {
            "joint_type": "p",
            "axis_direction": [0, -1, 0],
            "axis_position": [0, 0, 0],
            "theta": 0.25,
        },
        {
            "joint_type": "r",
            "axis_direction": [0, 0, 1],
            "axis_position": [0.2, 0.1, 0],
            "theta": -math.degrees(1.5),
        },
    ]
    (folder / "joints.json").write_text(json.dumps(rows), encoding="utf-8")
    return folder


def write_two_states(folder: Path) -> Path:
    """The ground truth beside which they are laid."""
    rows = [
        {
            "type": "translate",
            "axis": {"o": [0, 0, 0], "d": [0, -1, 0]},
            "translate": {"l": 0, "r": 0.25},
        },
        {
            "type": "rotate",
            "axis": {"o": [0.2, 0.1, 0], "d": [0, 0, -1]},
            "rotate": {"l": 0, "r": math.degrees(1.5)},
        },
    ]
    for name, box in (("static", BASE), ("dynamic_0", DRAWER), ("dynamic_1", DOOR)):
        write_box(folder / "start" / f"start_{name}_rotate.ply", box)
    (folder / "trans.json").write_text(json.dumps({"trans_info": rows}), encoding="utf-8")
    return folder
