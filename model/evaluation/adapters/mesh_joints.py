"""Meshes of parts beside a file of joints: PARIS, Digital Twin Art, ArtGS, and their ground truth.

All of them reconstruct an object in two states; rest is the first. Every moving part hangs on the
static one. A joint's range runs from 0 to the second state, as none of them states limits.

| layout | joints | meshes at the first state |
| --- | --- | --- |
| PARIS | `*_motion.json`: type, axis_o, axis_d, rot_angle (deg) or dist (half) | `*_static_*.ply`,
  `*_trans2start_*.ply` |
| DTA | `init_motion.json`, or `init_p<order>_motion.json` of several: rotation, translation |
  `init_part_<k>.obj`, part 0 static |
| ArtGS | `pred_joint_list.json` or `joints.json`: axis_position, axis_direction, theta (deg),
  joint_type r or p; or `trans_pred.json` as the ground truth | `part_<k>.ply`, part 0 static |
| ground truth | `trans.json`: trans_info with axis o, d, type, rotate or translate l, r |
  `start/start_static_rotate.ply`, `start/start_dynamic[_<k>]_rotate.ply` |
"""

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from artgen.core.errors import ArtgenError, ModelError
from artgen.core.mesh import Floats, TriMesh
from artgen.validate.meshfile import read_mesh
from model.evaluation.adapters.stated_row import Row, kind_of
from model.evaluation.layout import Layout, unit_axes

STILL_DEG = 5.0
"""Relative turns below count as slides where nothing says what a joint is."""
MESHES = (".obj", ".ply", ".stl", ".glb")


@dataclass(frozen=True, eq=False)
class Claim:
    """A joint as such a file states it: kind, axis (3,), point (3,), travel in rad or lengths."""

    kind: int
    axis: Floats
    origin: Floats
    travel: float


def layout_of_paris(folder: Path) -> Layout:
    """The layout of a PARIS export; its learned motion is half of the way, `dist` too."""
    file = _last(folder, "*_motion.json")
    row = Row(file, "motion", _json(file))
    kind = row.kind("type")
    travel = math.radians(row.number("rot_angle")) if kind == REVOLUTE else 2.0 * row.number("dist")
    origin = row.vector("axis_o") if "axis_o" in row else np.zeros(3)
    parts = [_last(folder, "*_static_*.ply"), _last(folder, "*_trans2start_*.ply")]
    return _layout(folder.name, parts, [Claim(kind, row.vector("axis_d"), origin, travel)])


def layout_of_dta(folder: Path) -> Layout:
    """The layout of a result folder of Digital Twin Art, in the state that it calls `init`."""
    file = _first(folder, ("init_motion.json", "init_p*_motion.json"))
    claims = [_rigid_claim(folder, k, row) for k, row in enumerate(_rows(file, _json(file)))]
    parts = [_with_suffix(folder, f"init_part_{k}") for k in range(len(claims) + 1)]
    return _layout(folder.name, parts, claims)


def layout_of_artgs(folder: Path) -> Layout:
    """The layout of joints and meshes that were taken out of ArtGS."""
    file = _first(folder, ("pred_joint_list.json", "joints.json", "trans_pred.json"))
    stated = _json(file)
    listed = stated.get("trans_info", stated) if isinstance(stated, Mapping) else stated
    claims = [_any_claim(row) for row in _rows(file, listed)]
    parts = [_with_suffix(folder, f"part_{k}") for k in range(len(claims) + 1)]
    return _layout(folder.name, parts, claims)


def layout_of_two_states(folder: Path) -> Layout:
    """The layout of the ground truth that PARIS, DTA and ArtGS are compared with."""
    file = folder / "trans.json"
    listed = Row(file, "the file", _json(file)).value("trans_info")
    claims = [_any_claim(row) for row in _rows(file, listed)]
    start = folder / "start"
    names = [f"start_dynamic_{k}_rotate" for k in range(len(claims))]
    names = ["start_dynamic_rotate"] if len(claims) == 1 else names
    parts = [_with_suffix(start, name) for name in ("start_static_rotate", *names)]
    return _layout(folder.name, parts, claims)


def _any_claim(row: Row) -> Claim:
    """A row with `axis` (ground truth) or with `axis_direction` (ArtGS)."""
    if "axis" in row:
        kind, ends, axis = row.kind("type"), row.below(row.value("type")), row.below("axis")
        travel = ends.number("r") - ends.number("l")
        direction, point = axis.vector("d"), axis.vector("o")
    else:
        kind = row.kind("joint_type" if "joint_type" in row else "type")
        travel = row.number("theta")
        direction, point = row.vector("axis_direction"), row.vector("axis_position")
    return Claim(kind, direction, point, math.radians(travel) if kind == REVOLUTE else travel)


def _rigid_claim(folder: Path, number: int, row: Row) -> Claim:
    """A joint from the rigid motion (R, t) between the states, as DTA reads it.

    A turn leaves the points of its axis in place: (I - R) o = t, solved with the least norm, so
    that a part of t along the axis is left aside.
    """
    turn, shift = row.rotation("rotation"), row.vector("translation")
    half = min(float(np.linalg.norm(turn - np.eye(3))) / math.sqrt(8.0), 1.0)
    angle = 2.0 * math.asin(half)
    if _dta_kind(folder, number, row, angle) == PRISMATIC:
        return Claim(PRISMATIC, shift, np.zeros(3), float(np.linalg.norm(shift)))
    values, vectors = np.linalg.eig(turn)
    axis = np.real(vectors[:, np.argmin(np.abs(values - 1.0))])
    skew = turn - turn.T
    if axis @ (skew[2, 1], skew[0, 2], skew[1, 0]) < 0.0:
        axis = -axis
    origin = np.linalg.lstsq(np.eye(3) - turn, shift, rcond=1e-6)[0]
    return Claim(REVOLUTE, axis, origin, angle)


def _dta_kind(folder: Path, number: int, row: Row, angle: float) -> int:
    """What the row says, or the name of the axis mesh, or how far the part turned."""
    for key in ("joint_type", "type"):
        if key in row:
            return row.kind(key)
    for path in sorted(folder.glob(f"init_axis_{number}_*")):
        return kind_of(path, path.stem.rpartition("_")[2])
    return REVOLUTE if math.degrees(angle) >= STILL_DEG else PRISMATIC


def _layout(name: str, parts: Sequence[Path], claims: Sequence[Claim]) -> Layout:
    meshes = tuple(_mesh(path) for path in parts)
    signs = np.array([1.0, *(-1.0 if claim.travel < 0.0 else 1.0 for claim in claims)])
    types = np.array([FIXED, *(claim.kind for claim in claims)], np.int8)
    travels = np.array([0.0, *(abs(claim.travel) for claim in claims)])
    axes = np.array([np.zeros(3), *(claim.axis for claim in claims)])
    origins = np.array([np.zeros(3), *(claim.origin for claim in claims)])
    return Layout(
        name=name,
        labels=("static", *(f"dynamic_{k}" for k in range(len(claims)))),
        boxes=np.stack([mesh.bounds for mesh in meshes]),
        types=types,
        axes=unit_axes(axes, types) * signs[:, None],
        origins=np.where((types == REVOLUTE)[:, None], origins, 0.0),
        limits=np.stack([np.zeros(len(types)), travels], axis=1),
        parents=np.array([-1, *(0 for _ in claims)], np.int64),
        states=np.stack([np.zeros(len(types)), travels]),
        meshes=meshes,
    )


def _mesh(path: Path) -> TriMesh:
    try:
        return read_mesh(path, np.ones(3))
    except (ArtgenError, OSError) as error:
        raise ModelError(f"{path}: the mesh of a part cannot be read: {error}") from error


def _json(file: Path) -> Any:
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise ModelError(f"{file}: the joints cannot be read: {error}") from error


def _rows(file: Path, listed: Any) -> list[Row]:
    """The joints of a list, or the only one."""
    if isinstance(listed, Mapping):
        listed = [listed]
    if not isinstance(listed, list):
        raise ModelError(f"{file}: its joints are {listed!r:.80}, expected a list, a row a joint")
    return [Row(file, f"joint {k}", stated) for k, stated in enumerate(listed)]


def _last(folder: Path, pattern: str) -> Path:
    """The file of that pattern; of several, which begin with `it` and a number of updates, that
    which has run the longest."""
    found = [path for path in sorted(folder.glob(pattern)) if "whole" not in path.name]
    if not found:
        raise ModelError(f"{folder}: no {pattern}; expected the files of one reconstruction")
    return max(found, key=lambda path: (_updates(path), path.name))


def _updates(path: Path) -> int:
    found = re.match(r"it(\d+)", path.name)
    return int(found[1]) if found else -1


def _first(folder: Path, patterns: Sequence[str]) -> Path:
    for pattern in patterns:
        for path in sorted(folder.glob(pattern)):
            return path
    raise ModelError(f"{folder}: none of {', '.join(patterns)}")


def _with_suffix(folder: Path, stem: str) -> Path:
    for suffix in MESHES:
        if (folder / f"{stem}{suffix}").is_file():
            return folder / f"{stem}{suffix}"
    raise ModelError(f"{folder}: no {stem} with one of {', '.join(MESHES)}; each part needs one")
