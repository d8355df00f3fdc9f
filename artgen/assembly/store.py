"""A library on disk: an index as Parquet, a file of JSON a source, and meshes by content.

<folder>/library.json          what it was built from; its digest
<folder>/index.parquet         one row a base, moving part and handle
<folder>/sources/<id>.json     joints, names, surfaces; pieces by the hash of their meshes
<folder>/meshes/<hash>.npz     arrays of a piece; equal pieces are one file
"""

import hashlib
import io
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.types import Precondition
from artgen.assembly.piece import Piece
from artgen.assembly.source import Member, Source
from artgen.core.errors import UsageError
from artgen.core.jsonio import plain, write_bytes, write_json
from artgen.core.licence import stated_licence
from artgen.core.mesh import TriMesh
from artgen.export.bundle import read_grip, read_joint, read_surface
from artgen.export.kinematics import as_file_joint

DIGITS = 24


def write_piece(folder: Path, piece: Piece) -> dict[str, Any]:
    """What a source's JSON says about a piece; its arrays go to meshes/ unless they are there."""
    arrays = _arrays(piece)
    digest = hashlib.sha256()
    for name in sorted(arrays):
        digest.update(f"{name}:{arrays[name].shape}:{arrays[name].dtype};".encode())
        digest.update(np.ascontiguousarray(arrays[name]).tobytes())
    name = digest.hexdigest()[:DIGITS]
    path = folder / "meshes" / f"{name}.npz"
    if not path.exists():
        buffer = io.BytesIO()
        np.savez_compressed(buffer, **arrays)
        mine = path.with_suffix(f".{os.getpid()}")  # Another process may have an equal piece.
        write_bytes(mine, buffer.getvalue())
        mine.replace(path)
    stated = {"mesh": name, "densities": piece.densities, "grips": piece.grips}
    return {**stated, "shells": piece.shells} if piece.shells else stated


def _arrays(piece: Piece) -> dict[str, np.ndarray[Any, Any]]:
    mesh, pieces = piece.mesh, piece.collision
    return {
        "vertices": mesh.vertices,
        "faces": mesh.faces,
        "uv": np.asarray(mesh.uv),
        "slot": np.asarray(mesh.slot),
        "body": np.asarray(mesh.body),
        "hull_vertices": np.concatenate([np.zeros((0, 3)), *(p.vertices for p in pieces)]),
        "hull_faces": np.concatenate([np.zeros((0, 3), np.int32), *(p.faces for p in pieces)]),
        "hull_counts": np.array([(len(p.vertices), len(p.faces)) for p in pieces]).reshape(-1, 2),
    }


def read_piece(folder: Path, entry: Mapping[str, Any]) -> Piece:
    """The piece that a source's JSON names.

    Raises:
        UsageError: its file is missing or damaged.
    """
    path = folder / "meshes" / f"{entry['mesh']}.npz"
    try:
        with np.load(path) as data:
            arrays = dict(data)
    except (OSError, ValueError, EOFError) as error:
        raise UsageError(f"{path}: cannot be read ({error}); build the library anew") from error
    mesh = TriMesh(**{key: arrays[key] for key in ("vertices", "faces", "uv", "slot", "body")})
    vertices, faces = np.zeros(2, int), []
    for counts in arrays["hull_counts"].astype(int):
        after = vertices + counts
        faces.append(
            TriMesh(
                vertices=arrays["hull_vertices"][vertices[0] : after[0]],
                faces=arrays["hull_faces"][vertices[1] : after[1]],
            )
        )
        vertices = after
    return Piece(
        mesh=mesh,
        densities=tuple(entry["densities"]),
        collision=tuple(faces),
        grips=tuple(read_grip(grip) for grip in entry["grips"]),
        shells={int(k): float(t) for k, t in entry.get("shells", {}).items()},
    )


def write_source(folder: Path, source: Source) -> None:
    """sources/<id>.json and the meshes that it names."""

    def piece(one: Piece | None) -> dict[str, Any] | None:
        return None if one is None else write_piece(folder, one)

    members = [
        {
            "name": member.name,
            "label": member.label,
            "joint": as_file_joint(member.joint),
            "kind": member.kind,
            "side": member.side,
            "body": piece(member.body),
            "handle": piece(member.handle),
            "works": piece(member.works),
        }
        for member in source.members
    ]
    stated = {
        "id": source.id,
        "category": source.category,
        "dataset": source.dataset,
        "family": source.family,
        "licence": source.licence,
        "base": piece(source.base),
        "base_name": source.base_name,
        "members": members,
        "surfaces": source.surfaces,
        "preconditions": source.preconditions,
    }
    write_json(folder / "sources" / f"{source.id}.json", plain(stated))


def read_source(folder: Path, id: str) -> Source:
    """A source of a library.

    Raises:
        UsageError: the library does not hold it, or its file is damaged.
    """
    path = folder / "sources" / f"{id}.json"
    try:
        stated = json.loads(path.read_text(encoding="utf-8"))
        return Source(
            id=stated["id"],
            category=stated["category"],
            dataset=stated["dataset"],
            family=stated["family"],
            licence=stated_licence(stated["licence"]),
            base=read_piece(folder, stated["base"]),
            base_name=stated["base_name"],
            members=tuple(_member(folder, entry) for entry in stated["members"]),
            surfaces=tuple(read_surface(entry) for entry in stated["surfaces"]),
            preconditions=tuple(Precondition(**entry) for entry in stated["preconditions"]),
        )
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise UsageError(f"{path}: cannot be read ({error!r}); build the library anew") from error


def _member(folder: Path, entry: Mapping[str, Any]) -> Member:
    def piece(key: str) -> Piece | None:
        return None if entry[key] is None else read_piece(folder, entry[key])

    return Member(
        name=entry["name"],
        label=entry["label"],
        joint=read_joint(entry["joint"]),
        kind=entry["kind"],
        side=entry["side"],
        body=read_piece(folder, entry["body"]),
        handle=piece("handle"),
        works=piece("works"),
    )
