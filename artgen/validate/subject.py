"""What the checks look at: a bundle's files, each read once and when first needed."""

import json
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from artgen.core.errors import ArtgenError, GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.export.bundle import Bundle, read_bundle
from artgen.export.layout import MANIFEST, MJCF, URDF
from artgen.geometry.clearance import Shape, shape_of_mesh
from artgen.validate.objfile import read_triangles
from artgen.validate.physics import compiled


@dataclass(frozen=True, kw_only=True, eq=False)
class Subject:
    """One bundle under test; properties raise what reading raises, checks of the first levels turn
    that into findings."""

    folder: Path

    @cached_property
    def manifest(self) -> Mapping[str, Any]:
        """The manifest as it stands."""
        data: Mapping[str, Any] = json.loads((self.folder / MANIFEST).read_text(encoding="utf-8"))
        return data

    @cached_property
    def urdf(self) -> ET.Element:
        """The URDF's root element."""
        return ET.parse(self.folder / URDF).getroot()

    @cached_property
    def mjcf(self) -> ET.Element:
        """The MJCF's root element."""
        return ET.parse(self.folder / MJCF).getroot()

    @cached_property
    def bundle(self) -> Bundle:
        """The manifest as typed values."""
        return read_bundle(self.folder)

    @cached_property
    def mesh_files(self) -> Mapping[str, TriMesh | str]:
        """Path to the visual mesh there, or to what keeps it from being read."""
        return {part.mesh: self._read(part.mesh) for part in self.bundle.parts}

    def _read(self, path: str) -> TriMesh | str:
        try:
            return read_triangles(self.folder / path)
        except (GeometryError, OSError) as error:
            return str(error)

    @cached_property
    def meshes(self) -> Mapping[str, TriMesh]:
        """Part name to its visual mesh, in the order of the manifest."""
        read = {part.name: self.mesh_files[part.mesh] for part in self.bundle.parts}
        return {name: mesh for name, mesh in read.items() if isinstance(mesh, TriMesh)}

    @cached_property
    def collision_files(self) -> Mapping[str, tuple[TriMesh, ...] | str]:
        """Part name to its collision pieces, or to what keeps them from being read."""
        return {part.name: self._read_collision(part.name) for part in self.bundle.parts}

    def _read_collision(self, part: str) -> tuple[TriMesh, ...] | str:
        try:
            return self.bundle.load_collision(part)
        except (ArtgenError, OSError, ValueError, IndexError) as error:
            return str(error)

    @cached_property
    def collision(self) -> Mapping[str, tuple[TriMesh, ...]]:
        """Part name to its collision pieces."""
        read = self.collision_files
        return {name: pieces for name, pieces in read.items() if isinstance(pieces, tuple)}

    @cached_property
    def shapes(self) -> Mapping[str, Shape]:
        """Part name to its closed bodies."""
        return {name: shape_of_mesh(mesh) for name, mesh in self.meshes.items()}

    @cached_property
    def volumes(self) -> Mapping[str, Floats]:
        """Part name to the (B,) signed volumes of its bodies, m3."""
        return {name: body_volumes(mesh) for name, mesh in self.meshes.items()}

    @cached_property
    def models(self) -> dict[str, mujoco.MjModel]:
        """Compiled models by file, filled as `model` is asked."""
        return {}

    def model(self, file: str) -> mujoco.MjModel:
        """What MuJoCo makes of the MJCF or URDF; ValueError where it refuses."""
        if file not in self.models:
            self.models[file] = compiled(self.folder / file)
        return self.models[file]


def body_volumes(mesh: TriMesh) -> Floats:
    """(B,) signed volume of each body, m3, about the middle of the mesh."""
    a, b, c = (mesh.triangles - mesh.bounds.mean(axis=0)).transpose(1, 0, 2)
    signed = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
    return np.asarray(np.bincount(np.asarray(mesh.body), weights=signed), np.float64)
