"""The manifest: what an asset is, in numbers and words, and the hash of every other file."""

from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.targets import swept_sphere
from artgen.articulation.types import ArticulatedObject, Part
from artgen.core.jsonio import file_hash, plain
from artgen.core.licence import OURS, licence_of
from artgen.core.mesh import TriMesh
from artgen.export.kinematics import as_file_joint
from artgen.export.layout import MANIFEST, REPORT, BoxPiece, collision_pieces, mesh_path
from artgen.geometry.measure import total_volume

SCHEMA = "artgen-bundle/2"
LICENSE = "The asset is its maker's: artgen claims no right in what it generates."
CONVENTIONS = {
    "units": "m, kg, s, rad; forces N, torques N m",
    "frame": "right-handed, z up, front faces -y, stands on z = 0, centered in x and y",
    "rest": "all joints at 0: everything closed; positive values open",
    "glb": "y up, front +z: (x, y, z) here is (x, z, -y) there",
}
PACKAGES = {
    "artgen": "artgen",
    "bpy": "bpy",
    "manifold3d": "manifold3d",
    "mujoco": "mujoco-core",
    "usd": "usd-core",
    "xatlas": "xatlas",
}


def manifest(obj: ArticulatedObject, folder: Path) -> dict[str, Any]:
    """The manifest of a bundle whose other files lie in `folder` already."""
    boxes = [part.mesh.bounds for part in obj.parts]
    bounds = np.stack([np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]])
    center, radius = swept_sphere([part.name for part in obj.parts], boxes, obj.joints)
    facts = {
        "schema": SCHEMA,
        "asset_id": obj.asset_id,
        "category": obj.category,
        "license": license_text(obj.provenance),
        "conventions": CONVENTIONS,
        "versions": versions(),
        "bounds": bounds,
        "center": center,
        "radius": radius,
        "mass": sum(part.mass.mass for part in obj.parts),
        "parts": [part_entry(obj, part) for part in obj.parts],
        "joints": [as_file_joint(joint) for joint in obj.joints],
        "preconditions": obj.preconditions,
        "surfaces": obj.surfaces,
        "files": file_entries(folder),
    }
    entry: dict[str, Any] = plain({**obj.provenance, **facts})
    return entry


def open_bodies(provenance: Mapping[str, object], part: str) -> list[int]:
    """Numbers of a part's bodies that are open surfaces; a stranger's part may have some."""
    shells = provenance.get("shells")
    bodies = shells.get("bodies") if isinstance(shells, Mapping) else None
    return list(bodies.get(part, ())) if isinstance(bodies, Mapping) else []


def closed_volume(mesh: TriMesh, open_numbers: Sequence[int]) -> float:
    """m3 of the bodies that are closed; 0 where none is."""
    kept = ~np.isin(np.asarray(mesh.body), open_numbers)
    if not kept.any():
        return 0.0
    return total_volume(TriMesh(vertices=mesh.vertices, faces=mesh.faces[kept]))


def license_text(provenance: Mapping[str, object]) -> str:
    """The terms of what an object was made from, or those of our own generators."""
    licence = licence_of(provenance)
    return LICENSE if licence == OURS else licence.text


def part_entry(obj: ArticulatedObject, part: Part) -> dict[str, Any]:
    """One part: names, measures, exact mass, collision as formats state it."""
    used = np.unique(np.asarray(part.mesh.slot))
    return {
        "name": part.name,
        "label": part.label,
        "mesh": mesh_path(obj.asset_id, part.name),
        "bounds": part.mesh.bounds,
        "mass": part.mass.mass,
        "com": part.mass.center,
        "inertia": part.mass.inertia,
        "volume": closed_volume(part.mesh, open_bodies(obj.provenance, part.name)),
        "triangles": len(part.mesh.faces),
        "bodies": int(np.asarray(part.mesh.body).max()) + 1,
        "densities": part.densities,
        "surfaces": [obj.surfaces[slot].name for slot in used],
        "collision": [
            {"type": "box", "center": piece.center, "size": piece.size}
            if isinstance(piece, BoxPiece)
            else {"type": "hull", "file": piece.file}
            for piece in collision_pieces(obj.asset_id, part)
        ],
        "grips": part.grips,
    }


def file_entries(folder: Path) -> dict[str, Mapping[str, Any]]:
    """Relative path to hash and size, for every file but the manifest and the report."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    named = {path.relative_to(folder).as_posix(): path for path in paths}
    return {
        name: {"sha256": file_hash(path), "bytes": path.stat().st_size}
        for name, path in named.items()
        if name not in (MANIFEST, REPORT)
    }


def versions() -> dict[str, str | None]:
    """Of artgen and of the libraries that shape an asset; None where one is not installed."""
    return {name: _version(package) for name, package in PACKAGES.items()}


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None
