"""A bundle read back: the manifest as typed values, meshes on demand."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.types import (
    Grip,
    Joint,
    Latch,
    Limit,
    Mass,
    Mimic,
    Precondition,
    Spring,
    Vector,
    check_tree,
)
from artgen.core.errors import ArtgenError, ExportError
from artgen.core.jsonio import read_object
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.export.kinematics import vector
from artgen.export.layout import MANIFEST
from artgen.export.manifest import SCHEMA
from artgen.export.obj import read_obj
from artgen.geometry.solid import slab


@dataclass(frozen=True, kw_only=True)
class BundleBox:
    """A collision cuboid along the axes, m, object frame at rest."""

    center: Vector
    size: Vector


@dataclass(frozen=True, kw_only=True)
class BundleHull:
    """A convex collision mesh in a file of the bundle."""

    file: str


@dataclass(frozen=True, kw_only=True, eq=False)
class BundlePart:
    """A part as the manifest states it; object frame at rest.

    Attributes:
        mesh: path of its OBJ, relative to the bundle.
        bounds: (2, 3) m.
        volume: of all bodies, m3.
        bodies: how many closed bodies the mesh has.
        densities: kg/m3 a body, or None.
        surfaces: names of the surfaces on it.
    """

    name: str
    label: str
    mesh: str
    bounds: Floats
    mass: Mass
    volume: float
    triangles: int
    bodies: int
    densities: tuple[float, ...] | None
    surfaces: tuple[str, ...]
    collision: tuple[BundleBox | BundleHull, ...]
    grips: tuple[Grip, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class Bundle:
    """One asset's folder; parts in canonical order, joints parents before children.

    Attributes:
        bounds: (2, 3) rest box of the object, m.
        center: (3,) of the sphere that holds the object in all states, m.
        radius: of that sphere, m.
        mass: kg, all parts.
        manifest: the manifest as JSON, for fields that have no type here (seed, rule, params ...).
    """

    folder: Path
    asset_id: str
    category: str
    parts: tuple[BundlePart, ...]
    joints: tuple[Joint, ...]
    preconditions: tuple[Precondition, ...]
    surfaces: tuple[SurfaceSpec, ...]
    bounds: Floats
    center: Floats
    radius: float
    mass: float
    manifest: Mapping[str, Any]

    def part(self, name: str) -> BundlePart:
        """The part of that name.

        Raises:
            ExportError: there is none.
        """
        for part in self.parts:
            if part.name == name:
                return part
        known = ", ".join(part.name for part in self.parts)
        raise ExportError(f"{self.folder}: no part {name!r}; it has {known}")

    def load_mesh(self, part_name: str) -> TriMesh:
        """The part's triangles with atlas and bodies, object frame at rest."""
        return read_obj((self.folder / self.part(part_name).mesh).read_text(encoding="utf-8"))

    def load_collision(self, part_name: str) -> tuple[TriMesh, ...]:
        """The part's convex pieces as meshes, object frame at rest."""
        return tuple(self._piece_mesh(piece) for piece in self.part(part_name).collision)

    def _piece_mesh(self, piece: BundleBox | BundleHull) -> TriMesh:
        if isinstance(piece, BundleHull):
            return read_obj((self.folder / piece.file).read_text(encoding="utf-8"))
        center, half = np.array(piece.center), np.array(piece.size) / 2.0
        return slab(center - half, center + half).trimesh()


def read_bundle(folder: Path) -> Bundle:
    """The bundle in `folder`.

    Raises:
        ExportError: there is no manifest, it is of another schema, or it is damaged.
    """
    path = folder / MANIFEST
    stated = read_object(path, remedy=f"is {folder} an asset?")
    schema = stated.get("schema")
    if schema != SCHEMA:
        raise ExportError(
            f"{path} has schema {schema!r}, this artgen reads {SCHEMA!r}; generate the asset anew"
        )
    try:
        return _bundle(folder, stated)
    except (KeyError, TypeError, ValueError, ArtgenError) as error:
        raise ExportError(f"{path} is damaged ({error!r}); generate the asset anew") from error


def _bundle(folder: Path, stated: dict[str, Any]) -> Bundle:
    parts = tuple(_part(entry) for entry in stated["parts"])
    joints = tuple(read_joint(entry) for entry in stated["joints"])
    preconditions = tuple(Precondition(**entry) for entry in stated["preconditions"])
    check_tree([part.name for part in parts], joints, preconditions)
    return Bundle(
        folder=folder,
        asset_id=stated["asset_id"],
        category=stated["category"],
        parts=parts,
        joints=joints,
        preconditions=preconditions,
        surfaces=tuple(read_surface(entry) for entry in stated["surfaces"]),
        bounds=np.array(stated["bounds"], float).reshape(2, 3),
        center=np.array(stated["center"], float).reshape(3),
        radius=float(stated["radius"]),
        mass=float(stated["mass"]),
        manifest=stated,
    )


def _part(entry: dict[str, Any]) -> BundlePart:
    densities = entry["densities"]
    return BundlePart(
        name=entry["name"],
        label=entry["label"],
        mesh=entry["mesh"],
        bounds=np.array(entry["bounds"], float).reshape(2, 3),
        mass=Mass(
            mass=entry["mass"],
            center=np.array(entry["com"], float).reshape(3),
            inertia=np.array(entry["inertia"], float).reshape(3, 3),
        ),
        volume=float(entry["volume"]),
        triangles=int(entry["triangles"]),
        bodies=int(entry["bodies"]),
        densities=None if densities is None else tuple(densities),
        surfaces=tuple(entry["surfaces"]),
        collision=tuple(_piece(piece) for piece in entry["collision"]),
        grips=tuple(read_grip(grip) for grip in entry["grips"]),
    )


def _piece(entry: dict[str, Any]) -> BundleBox | BundleHull:
    if entry["type"] == "hull":
        return BundleHull(file=entry["file"])
    return BundleBox(center=vector(np.array(entry["center"])), size=vector(np.array(entry["size"])))


def read_grip(entry: Mapping[str, Any]) -> Grip:
    """A grip as JSON states it."""
    vectors = {key: vector(np.array(entry[key])) for key in ("position", "outward", "pull")}
    return Grip(name=entry["name"], kind=entry["kind"], **vectors)


def read_joint(entry: Mapping[str, Any]) -> Joint:
    """A joint as a manifest states it, its limit as `lower` and `upper`."""
    plain = {key: value for key, value in entry.items() if key not in ("lower", "upper")}
    lower, upper = entry["lower"], entry["upper"]
    typed = {
        "axis": tuple(entry["axis"]),
        "origin": tuple(entry["origin"]),
        "limit": None if lower is None else Limit(lower=lower, upper=upper),
        "spring": entry["spring"] and Spring(**entry["spring"]),
        "latch": entry["latch"] and Latch(**entry["latch"]),
        "mimic": entry["mimic"] and Mimic(**entry["mimic"]),
    }
    return Joint(**{**plain, **typed})


def read_surface(entry: Mapping[str, Any]) -> SurfaceSpec:
    """A surface as JSON states it."""
    color, tile = tuple(entry["color"]), tuple(entry["tile"])
    return SurfaceSpec(**{**entry, "color": color, "tile": tile})
