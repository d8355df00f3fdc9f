"""Small outputs of other systems, each spoiled in one way: what people's folders really hold."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from tests.made import finished
from tests.unit.model.evaluation.adapters.outputs import (
    write_artgs,
    write_dta,
    write_paris,
    write_singapo,
    write_two_states,
    write_urdf,
    write_urdformer,
)
from tests.unit.validate.cabinet import write_quick_bundle

Spoil = Callable[[Path], None]
"""Damages the output in a folder."""


def write_bundle(folder: Path) -> Path:
    """A laptop of ours."""
    write_quick_bundle(finished("laptop", 0), folder)
    return folder


def write_turning_paris(folder: Path) -> Path:
    """PARIS's, of a joint that turns."""
    return write_paris(folder, "rotate")


def write_sliding_paris(folder: Path) -> Path:
    """PARIS's, of a joint that slides."""
    return write_paris(folder, "translate")


WRITERS: Mapping[str, Callable[[Path], Path]] = {
    "bundle": write_bundle,
    "singapo": write_singapo,
    "dta": write_dta,
    "paris": write_turning_paris,
    "artgs": write_artgs,
    "two_states": write_two_states,
    "urdf": write_urdf,
    "urdformer": write_urdformer,
}
STATED = {
    "bundle": "manifest.json",
    "singapo": "object.json",
    "dta": "init_p01_motion.json",
    "paris": "it20000_test_motion.json",
    "artgs": "joints.json",
    "two_states": "trans.json",
    "urdf": "mobility.urdf",
    "urdformer": "output/label3.urdf",
}
"""The file of each format that states joints."""
NOT_JSON = {
    "empty": b"",
    "cut": b'{"type": "rot',
    "binary": bytes(range(256)),
    "deep": b"[" * 100_000,
    "null": b"null",
    "number": b"3",
    "word": b'"joint"',
    "list of nothing": b"[null]",
    "list of words": b'["a", "b"]',
    "object": b"{}",
    "other": b'{"diffuse_tree": 5, "trans_info": 5, "type": 5, "schema": 5}',
}


def replaced(file: str, data: bytes) -> Spoil:
    """A file with other contents."""

    def spoil(folder: Path) -> None:
        (folder / file).write_bytes(data)

    return spoil


def removed(pattern: str) -> Spoil:
    """The files of that pattern, of which there must be one, are gone."""

    def spoil(folder: Path) -> None:
        found = list(folder.glob(pattern))
        assert found
        for path in found:
            path.unlink()

    return spoil


def renamed(file: str, name: str) -> Spoil:
    """A file under another name."""

    def spoil(folder: Path) -> None:
        (folder / file).rename(folder / name)

    return spoil


def made_a_folder(file: str) -> Spoil:
    """A folder where a file is expected."""

    def spoil(folder: Path) -> None:
        (folder / file).unlink()
        (folder / file).mkdir()

    return spoil


def text_changed(file: str, old: str, new: str) -> Spoil:
    """A file where `old`, which must be there, is `new`."""

    def spoil(folder: Path) -> None:
        text = (folder / file).read_text(encoding="utf-8")
        assert old in text, text
        (folder / file).write_text(text.replace(old, new), encoding="utf-8")

    return spoil


def stated_changed(file: str, change: Callable[[Any], Any]) -> Spoil:
    """A JSON file whose contents `change` alters in place, or returns anew."""

    def spoil(folder: Path) -> None:
        stated = json.loads((folder / file).read_text(encoding="utf-8"))
        again = change(stated)
        text = json.dumps(stated if again is None else again)
        (folder / file).write_text(text, encoding="utf-8")

    return spoil


def put(*path: Any, value: Any) -> Callable[[Any], None]:
    """Sets what lies at a path of keys and indices."""

    def change(stated: Any) -> None:
        for key in path[:-1]:
            stated = stated[key]
        stated[path[-1]] = value

    return change


def dropped(*path: Any) -> Callable[[Any], None]:
    """Takes out what lies at a path of keys and indices."""

    def change(stated: Any) -> None:
        for key in path[:-1]:
            stated = stated[key]
        del stated[path[-1]]

    return change


NAN, INF = float("nan"), float("inf")
TREE = "diffuse_tree"


def _paris() -> Mapping[str, Spoil]:
    file = STATED["paris"]
    values = {
        "without rot_angle": dropped("rot_angle"),
        "without type": dropped("type"),
        "without axis": dropped("axis_d"),
        "type is a list": put("type", value=["rotate"]),
        "type is not known": put("type", value="helical"),
        "angle of nothing": put("rot_angle", value=[]),
        "angle is null": put("rot_angle", value=None),
        "angle is not a number": put("rot_angle", value=NAN),
        "angle is infinite": put("rot_angle", value=[INF]),
        "axis of two": put("axis_d", value=[0.0, 1.0]),
        "axis of words": put("axis_d", value=["x", "y", "z"]),
        "axis is a number": put("axis_d", value=1.0),
        "axis is not finite": put("axis_d", value=[0.0, INF, 0.0]),
        "origin is null": put("axis_o", value=None),
        "origin is not finite": put("axis_o", value=[NAN, 0.0, 0.0]),
        "origin is far beyond": put("axis_o", value=[1e300, 0.0, 0.0]),
    }
    return {name: stated_changed(file, change) for name, change in values.items()} | {
        "no mesh": removed("*_static_*.ply"),
        "mesh of noise": replaced("it20000_static_128_thre0.5.ply", bytes(range(256)) * 3),
        "mesh of points": replaced(
            "it20000_trans2start_128_thre0.5.ply",
            b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            b"property float z\nend_header\n0 0 0\n",
        ),
        "file is a folder": made_a_folder(file),
    }


def _dta() -> Mapping[str, Spoil]:
    file = STATED["dta"]
    values: dict[str, Callable[[Any], Any]] = {
        "short rotation": put(0, "rotation", value=[[1.0, 0.0], [0.0, 1.0]]),
        "rotation is null": put(0, "rotation", value=None),
        "without rotation": dropped(1, "rotation"),
        "without translation": dropped(1, "translation"),
        "rotation is not finite": put(0, "rotation", value=[[NAN] * 3] * 3),
        "rotation of zeros": put(1, "rotation", value=[[0.0] * 3] * 3),
        "rotation mirrors": put(1, "rotation", value=[[1, 0, 0], [0, 1, 0], [0, 0, -1]]),
        "short translation": put(0, "translation", value=[1.0]),
        "type is a number": put(0, "joint_type", value=3),
        "a row is null": put(0, value=None),
        "more joints than parts": lambda stated: stated.append(stated[0]),
    }
    return {name: stated_changed(file, change) for name, change in values.items()} | {
        "axis mesh of an unknown kind": renamed(
            "init_axis_0_prismatic.obj", "init_axis_0_helical.obj"
        ),
        "mesh of no triangle": replaced("init_part_1.obj", b"v 0 0 0\n"),
        "mesh names missing vertices": replaced("init_part_1.obj", b"v 0 0 0\nf 1 2 3\n"),
    }


def _artgs() -> Mapping[str, Spoil]:
    file = STATED["artgs"]
    values = {
        "without theta": dropped(0, "theta"),
        "theta is a word": put(0, "theta", value="wide"),
        "theta of nothing": put(0, "theta", value=[]),
        "without direction": dropped(1, "axis_direction"),
        "position is null": put(1, "axis_position", value=None),
        "without type": dropped(1, "joint_type"),
        "type is null": put(1, "joint_type", value=None),
        "axis is null": put(1, "axis", value=None),
        "a row is a word": put(0, value="p"),
    }
    return {name: stated_changed(file, change) for name, change in values.items()} | {
        "mesh is missing": removed("part_1.ply"),
    }


def _two_states() -> Mapping[str, Spoil]:
    file = STATED["two_states"]
    values = {
        "rows are null": put("trans_info", value=None),
        "without ends": dropped("trans_info", 0, "translate"),
        "ends are a number": put("trans_info", 1, "rotate", value=90.0),
        "an end is null": put("trans_info", 1, "rotate", "r", value=None),
        "axis without a point": dropped("trans_info", 0, "axis", "o"),
        "axis is a list": put("trans_info", 0, "axis", value=[0, 0, 1]),
        "type is null": put("trans_info", 0, "type", value=None),
    }
    return {name: stated_changed(file, change) for name, change in values.items()} | {
        "no meshes": removed("start/*.ply"),
    }


def _singapo() -> Mapping[str, Spoil]:
    file = STATED["singapo"]
    values = {
        "empty tree": put(TREE, value=[]),
        "tree is an object": put(TREE, value={}),
        "a node is null": put(TREE, 1, value=None),
        "range of one": put(TREE, 0, "joint", "range", value=[0.5]),
        "range is null": put(TREE, 0, "joint", "range", value=None),
        "range of words": put(TREE, 0, "joint", "range", value=["a", "b"]),
        "range is infinite": put(TREE, 0, "joint", "range", value=[0, INF]),
        "axis is null": put(TREE, 1, "joint", "axis", value=None),
        "direction of two": put(TREE, 1, "joint", "axis", "direction", value=[0, 1]),
        "direction is not finite": put(TREE, 1, "joint", "axis", "direction", value=[0, INF, 0]),
        "origin is null": put(TREE, 1, "joint", "axis", "origin", value=None),
        "origin is not finite": put(TREE, 1, "joint", "axis", "origin", value=[0, NAN, 0]),
        "joint is null": put(TREE, 0, "joint", value=None),
        "type is not known": put(TREE, 0, "joint", "type", value="helical"),
        "type is a list": put(TREE, 0, "joint", "type", value=[]),
        "box without center": dropped(TREE, 0, "aabb", "center"),
        "box is negative": put(TREE, 0, "aabb", "size", value=[-1, -1, -1]),
        "box is not finite": put(TREE, 0, "aabb", "size", value=[1, 1, NAN]),
        "box is far beyond": put(TREE, 0, "aabb", "size", value=[1, 1, 1e300]),
        "two of one id": put(TREE, 3, "id", value=1),
        "id is a list": put(TREE, 0, "id", value=[0]),
        "parent is missing": put(TREE, 3, "parent", value=17),
        "parents go round": put(TREE, 1, "parent", value=3),
        "no base": put(TREE, 2, "parent", value=0),
        "two bases": put(TREE, 0, "parent", value=-1),
    }
    return {name: stated_changed(file, change) for name, change in values.items()}


def _urdf(format_: str) -> Mapping[str, Spoil]:
    file = STATED[format_]
    child = "door" if format_ == "urdf" else "drawer0"
    base = "base" if format_ == "urdf" else "base_link"
    values = {
        "joint hangs on nothing": (f'<child link="{child}"', '<child link="ghost"'),
        "joint without a child": (f'<child link="{child}"', "<nothing"),
        "parts go round": (f'<parent link="{base}"', f'<parent link="{child}"'),
        "limits are words": ('lower="0"', 'lower="low"'),
        "limits are not numbers": ('lower="0"', 'lower="nan"'),
        "limits are infinite": ('lower="0"', 'lower="-inf"'),
        "axis of two": ('<axis xyz="', '<axis xyz="0 0" also="'),
        "axis is not finite": ('<axis xyz="', '<axis xyz="inf 0 0" also="'),
        "origin of words": ('<origin xyz="', '<origin xyz="a b c" also="'),
        "type is not known": ('type="prismatic"', 'type="helical"'),
        "without a type": ('type="prismatic"', ""),
        "two of one name": (f'<link name="{child}"', f'<link name="{base}"'),
    }
    return {name: text_changed(file, old, new) for name, (old, new) in values.items()} | {
        "another document": replaced(file, b"<html/>"),
        "no shape": replaced(file, b'<robot name="x"><link name="a"/></robot>'),
        "a bomb": replaced(
            file,
            b'<!DOCTYPE a [<!ENTITY b "bbbbbbbb"><!ENTITY c "&b;&b;&b;&b;">]>'
            b'<robot name="&c;"><link name="a"/></robot>',
        ),
    }


def _bundle() -> Mapping[str, Spoil]:
    file = STATED["bundle"]
    values = {
        "without parts": dropped("parts"),
        "parts of nothing": put("parts", value=[]),
        "a part is null": put("parts", 0, value=None),
        "another schema": put("schema", value="artgen-asset/0"),
        "joints are null": put("joints", value=None),
        "a joint without a type": dropped("joints", 0, "type"),
        "a limit of words": put("joints", 0, "lower", value="wide"),
        "an axis of nothing": put("joints", 0, "axis", value=[]),
        "a box of one": put("parts", 0, "bounds", value=[0.0]),
        "a box is not finite": put("parts", 0, "bounds", value=[[0, 0, 0], [1, 1, INF]]),
        "a mesh that is not there": put("parts", 0, "mesh", value="none.glb"),
        "a mesh without a name": put("parts", 0, "mesh", value=None),
        "a mesh elsewhere": put("parts", 0, "mesh", value="../../../etc/passwd"),
    }
    return {name: stated_changed(file, change) for name, change in values.items()}


SPOILED: Mapping[str, Mapping[str, Spoil]] = {
    "bundle": _bundle(),
    "singapo": _singapo(),
    "dta": _dta(),
    "paris": _paris(),
    "artgs": _artgs(),
    "two_states": _two_states(),
    "urdf": _urdf("urdf"),
    "urdformer": _urdf("urdformer"),
}
