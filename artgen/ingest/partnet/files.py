"""The files of a PartNet-Mobility folder, one function each; nothing outside of it is read."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from artgen.articulation.types import Vector
from artgen.core.errors import ArtgenError, IngestError
from artgen.export.partnet.nodes import KINDS, MOVING, Leaf, Motion, Node
from artgen.validate.places import inside, read_capped

MAX_JSON = 32 * 2**20
MOST_NODES = 2000
"""Links of one object; the largest of the data set has 116."""


def read_json(root: Path, name: str) -> Any:
    """What a JSON file of the folder holds; numbers that are not finite are refused.

    Raises:
        IngestError: it does not exist, leaves the folder, is too large, or is no JSON.
    """
    try:
        data = read_capped(inside(root, root, name), MAX_JSON)
        return json.loads(data, parse_constant=_refused)
    except ArtgenError as error:
        raise IngestError(str(error)) from error
    except (OSError, ValueError, RecursionError) as error:
        raise IngestError(f"{name} cannot be read: {error}") from error


def _refused(word: str) -> NoReturn:
    raise ValueError(f"it holds {word}")


@dataclass(frozen=True, kw_only=True)
class Meta:
    """`meta.json`: ids are words here."""

    model_id: str
    anno_id: str
    category: str


def read_meta(root: Path) -> Meta:
    """Ids and `model_cat`, which is the category that counts; "" where it is not stated."""
    stated = read_json(root, "meta.json")
    if not isinstance(stated, dict):
        raise IngestError("meta.json holds no object")
    words = {key: str(stated.get(key) or "") for key in ("model_id", "anno_id", "model_cat")}
    return Meta(model_id=words["model_id"], anno_id=words["anno_id"], category=words["model_cat"])


def read_leaves(root: Path) -> tuple[str, Mapping[int, tuple[str, ...]]]:
    """Name of the root of `result.json`, and leaf id to the stems of its OBJ files.

    Only this file's ids are those of `mobility_v2.json`; the merged tree is renumbered.
    """
    stated = read_json(root, "result.json")
    if not (isinstance(stated, list) and stated and isinstance(stated[0], dict)):
        raise IngestError("result.json holds no tree")
    found: dict[int, tuple[str, ...]] = {}
    waiting = [node for node in stated if isinstance(node, dict)]
    while waiting:
        node = waiting.pop()
        waiting += [child for child in node.get("children") or () if isinstance(child, dict)]
        objs = node.get("objs")
        if isinstance(objs, list) and isinstance(node.get("id"), int):
            found[node["id"]] = tuple(str(stem) for stem in objs)
    return str(stated[0].get("name", "")), found


def read_nodes(root: Path) -> tuple[Node, ...]:
    """`mobility_v2.json`.

    Raises:
        IngestError: it is no list of motion nodes, ids repeat, or a number of a hinge or slider
            is missing or not finite.
    """
    stated = read_json(root, "mobility_v2.json")
    if not isinstance(stated, list) or not stated:
        raise IngestError("mobility_v2.json holds no list of motion nodes")
    if len(stated) > MOST_NODES:
        raise IngestError(
            f"mobility_v2.json holds {len(stated)} motion nodes, at most {MOST_NODES}"
        )
    nodes = tuple(_node(entry) for entry in stated)
    ids = [node.id for node in nodes]
    if len(set(ids)) != len(ids):
        raise IngestError(f"mobility_v2.json: node ids repeat: {sorted(ids)}")
    return nodes


def _node(entry: object) -> Node:
    if not isinstance(entry, dict) or not isinstance(entry.get("id"), int):
        raise IngestError("mobility_v2.json: a motion node has no id")
    where = f"mobility_v2.json, node {entry['id']}"
    kind, parent = entry.get("joint"), entry.get("parent")
    if kind not in KINDS:
        raise IngestError(f"{where}: joint {kind!r} is none of {', '.join(KINDS)}")
    if not isinstance(parent, int):
        raise IngestError(f"{where}: parent {parent!r} is no number of a node")
    return Node(
        id=entry["id"],
        parent=parent,
        kind=kind,
        name=str(entry.get("name", "")),
        leaves=tuple(_leaf(part, where) for part in entry.get("parts") or ()),
        motion=_motion(entry.get("jointData"), kind, where) if kind in MOVING else None,
    )


def _leaf(part: object, where: str) -> Leaf:
    if not isinstance(part, dict) or not isinstance(part.get("id"), int):
        raise IngestError(f"{where}: a part has no id")
    return Leaf(id=part["id"], name=str(part.get("name", "")))


def _motion(data: object, kind: str, where: str) -> Motion:
    axis = data.get("axis") if isinstance(data, dict) else None
    limit = data.get("limit") if isinstance(data, dict) else None
    if not isinstance(axis, dict) or not isinstance(limit, dict):
        raise IngestError(f"{where}: a {kind} without axis and limit")
    free = limit.get("noLimit") is True
    rotates = kind == "slider" and limit.get("rotates") is True
    direction = _triple(axis.get("direction"), f"{where}: direction")
    if not math.hypot(*direction) > 0.0:
        raise IngestError(f"{where}: its direction is {direction}")
    turn = limit.get("rotationLimit")
    bounded = rotates and limit.get("noRotationLimit") is not True and turn is not None
    return Motion(
        origin=_triple(axis.get("origin"), f"{where}: origin"),
        direction=direction,
        a=0.0 if free else _number(limit.get("a"), f"{where}: limit a"),
        b=0.0 if free else _number(limit.get("b"), f"{where}: limit b"),
        free=free,
        rotates=rotates,
        turn=_number(turn, f"{where}: rotationLimit") if bounded else None,
    )


def _triple(values: object, what: str) -> Vector:
    if not isinstance(values, list) or len(values) != 3:
        raise IngestError(f"{what} is {values!r}, expected three numbers")
    x, y, z = (_number(value, what) for value in values)
    return x, y, z


def _number(value: object, what: str) -> float:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not math.isfinite(float(value)):  # type: ignore[arg-type]
        raise IngestError(f"{what} is {value!r}, expected a finite number")
    return float(value)  # type: ignore[arg-type]


def read_semantics(root: Path) -> Mapping[str, tuple[str, str]]:
    """Link to (kind, label); nothing where the file is not there."""
    try:
        text = read_capped(inside(root, root, "semantics.txt"), MAX_JSON).decode("utf-8", "replace")
    except (ArtgenError, OSError):
        return {}
    rows = (line.split(maxsplit=2) for line in text.splitlines())
    return {row[0]: (row[1], row[2].strip()) for row in rows if len(row) == 3}
