"""A bundle under test: manifest, URDF, MJCF, and the meshes that the manifest names."""

import json
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from artgen.articulation.roles import ROLES, Role
from artgen.articulation.types import Joint, Precondition
from artgen.core.errors import ArtgenError, GeometryError
from artgen.core.mesh import TriMesh
from artgen.core.transform import rigid
from artgen.export.bundle import Bundle, read_bundle
from artgen.export.layout import MANIFEST, MJCF, REPORT, URDF
from artgen.export.manifest import SCHEMA
from artgen.validate.objfile import read_triangles
from artgen.validate.origin import Origin, origin_of
from artgen.validate.physics import compiled_spec, read_spec
from artgen.validate.second_opinion import NEED, absent
from artgen.validate.shape import misshapen
from artgen.validate.stated import (
    StatedBody,
    StatedJoint,
    manifest_bodies,
    manifest_joints,
    urdf_bodies,
    urdf_joints,
    without_frames,
)
from artgen.validate.subject import Link, Subject, SubjectPart
from artgen.validate.xmlfile import read_xml


@dataclass(frozen=True, kw_only=True, eq=False)
class BundleSubject(Subject):
    """A folder that `artgen generate` wrote, or that claims to be one."""

    @property
    def folder(self) -> Path:
        """The bundle's folder."""
        return self.source.root

    @property
    def name(self) -> str:
        """The manifest's asset_id, or the folder's name where there is none."""
        try:
            return str(self.manifest["asset_id"])
        except (OSError, ValueError, LookupError, TypeError):
            return self.folder.name

    def lacks(self, need: str) -> str | None:
        """A bundle says everything, but a tool may be missing."""
        if need == "stranger":
            return "asked of foreign files; a bundle is asked for more, in every profile"
        return absent() if need == NEED else None

    def files(self) -> Iterable[Path]:
        """Every file of the folder but the report of an earlier validation."""
        return (p for p in self.folder.rglob("*") if p.is_file() and p.name != REPORT)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Of manifest, URDF and MJCF, those that cannot be read."""
        for file in (MANIFEST, URDF, MJCF):
            if (problem := self._problem(file)) is not None:
                yield file, problem

    def _problem(self, file: str) -> str | None:
        try:
            if file == MANIFEST:
                return manifest_problem(self.manifest)
            tag = (self.urdf if file == URDF else self.mjcf).tag
            expected = "robot" if file == URDF else "mujoco"
            return None if tag == expected else f"root element <{tag}> instead of <{expected}>"
        except OSError as error:
            return f"cannot be opened: {error.strerror}"
        except (ET.ParseError, ValueError, ArtgenError, RecursionError) as error:
            return f"cannot be parsed: {error}"

    @cached_property
    def manifest(self) -> Mapping[str, Any]:
        """The manifest as it stands."""
        data: Mapping[str, Any] = json.loads((self.folder / MANIFEST).read_text(encoding="utf-8"))
        return data

    @cached_property
    def origin(self) -> Origin:
        """What the manifest says of a foreign source."""
        return origin_of(self.manifest)

    @cached_property
    def urdf(self) -> ET.Element:
        """The URDF's root element."""
        return read_xml(self.folder / URDF)

    @cached_property
    def robot(self) -> ET.Element:
        """The URDF without the frames of grips: links that hold nothing, on fixed joints, which the
        manifest names as grips. `validate.grips` judges those."""
        return without_frames(self.urdf, grip_names(self.manifest))

    @cached_property
    def mjcf(self) -> ET.Element:
        """The MJCF's root element."""
        return read_xml(self.folder / MJCF)

    @property
    def stated_links(self) -> Mapping[str, list[str]]:
        """Names of the manifest's parts and of the URDF's links."""
        return {
            MANIFEST: [str(part.get("name")) for part in self.manifest["parts"]],
            URDF: [link.get("name", "") for link in self.robot.iterfind("link")],
        }

    @cached_property
    def stated_joints(self) -> list[StatedJoint]:
        """Joints of the manifest, then of the URDF."""
        return manifest_joints(MANIFEST, self.manifest) + urdf_joints(URDF, self.robot)

    @property
    def stated_bodies(self) -> list[StatedBody]:
        """Mass properties in the manifest, then in the URDF."""
        return manifest_bodies(MANIFEST, self.manifest) + urdf_bodies(URDF, self.robot)

    @cached_property
    def bundle(self) -> Bundle:
        """The manifest as typed values."""
        return read_bundle(self.folder)

    @cached_property
    def parts(self) -> tuple[SubjectPart, ...]:
        """Parts of the manifest."""
        return tuple(
            SubjectPart(name=p.name, label=p.label, mass=p.mass, densities=p.densities)
            for p in self.bundle.parts
        )

    @cached_property
    def roles(self) -> Mapping[str, Role]:
        """By the labels of the manifest; words that are no roles are told and left out."""
        return {p.name: ROLES[p.label] for p in self.bundle.parts if p.label in ROLES}

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Joints of the manifest."""
        return self.bundle.joints

    @property
    def preconditions(self) -> tuple[Precondition, ...]:
        """Preconditions of the manifest."""
        return self.bundle.preconditions

    @cached_property
    def links(self) -> Mapping[str, Link]:
        """Every part has a body of its name, at its joint and parallel to the object frame."""
        pivots = {joint.child: np.array(joint.origin) for joint in self.joints}
        return {
            part.name: Link(
                part=part.name,
                object_from_link=rigid(np.eye(3), pivots.get(part.name, np.zeros(3))),
            )
            for part in self.parts
        }

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

    @property
    def model_files(self) -> tuple[str, ...]:
        """MJCF and URDF; springs and mimics of a URDF are not simulated everywhere."""
        return (MJCF, URDF)

    @cached_property
    def models(self) -> dict[str, mujoco.MjModel]:
        """Compiled models by file, filled as `model` is asked."""
        return {}

    def spec(self, file: str) -> mujoco.MjSpec:
        """What MuJoCo reads from the MJCF or URDF; ValueError where it refuses."""
        return read_spec(self.folder / file)

    def model(self, file: str) -> mujoco.MjModel:
        """What MuJoCo makes of the MJCF or URDF; ValueError where it refuses."""
        if file not in self.models:
            self.models[file] = compiled_spec(self.spec(file))
        return self.models[file]


def grip_names(manifest: Mapping[str, Any]) -> frozenset[str]:
    """Of a manifest as it stands, whatever it holds."""
    names: set[str] = set()
    parts = manifest.get("parts")
    for part in parts if isinstance(parts, list) else ():
        grips = part.get("grips") if isinstance(part, dict) else None
        for grip in grips if isinstance(grips, list) else ():
            names.add(str(grip.get("name")) if isinstance(grip, dict) else "")
    return frozenset(names)


def manifest_problem(manifest: object) -> str | None:
    """What keeps a manifest from being one of this version, or None."""
    if not isinstance(manifest, Mapping):
        return "is not a JSON object"
    if (schema := manifest.get("schema")) != SCHEMA:
        return f"schema {schema!r} instead of {SCHEMA!r}"
    if wrong := list(misshapen(manifest)):
        return f"{len(wrong)} keys are missing or of another kind: {', '.join(wrong[:5])}"
    return None
