"""The asset under test, whatever it was read from: parts, joints, meshes, compiled models."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import mujoco
import numpy as np

from artgen.articulation.roles import Role
from artgen.articulation.types import Joint, Mass, Precondition
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.clearance import Shape, shape_of_mesh
from artgen.validate.bounds import Bounds
from artgen.validate.origin import Origin
from artgen.validate.stated import StatedBody, StatedJoint


@dataclass(frozen=True, kw_only=True)
class Source:
    """Where an asset lies.

    Attributes:
        format: bundle, urdf, mjcf or usd.
        file: the file to read; the folder of a bundle.
        root: the folder outside of which nothing may be read.
    """

    format: str
    file: Path
    root: Path


@dataclass(frozen=True, kw_only=True, eq=False)
class SubjectPart:
    """A rigid part; `mass` is in the object frame at rest, None where the source states none."""

    name: str
    label: str
    mass: Mass | None
    densities: tuple[float, ...] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Link:
    """A body of a file: the part it belongs to, and its frame (4, 4) at rest in the object frame.

    Several links make one part where fixed joints connect them.
    """

    part: str
    object_from_link: Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Subject(ABC):
    """One asset under test; each file is read once and when first needed.

    Properties raise what reading raises; the checks of the first levels turn that into findings.
    """

    source: Source
    bounds: Bounds

    @property
    def format(self) -> str:
        """bundle, urdf, mjcf or usd."""
        return self.source.format

    @property
    @abstractmethod
    def name(self) -> str:
        """Name of the asset."""

    @abstractmethod
    def lacks(self, need: str) -> str | None:
        """Why the source cannot say what a check needs, or None where it can."""

    @abstractmethod
    def files(self) -> Iterable[Path]:
        """Every file that the verdict depends on, as far as they can be told."""

    @abstractmethod
    def problems(self) -> Iterator[tuple[str, str]]:
        """Files that cannot be read, and why."""

    @property
    @abstractmethod
    def stated_links(self) -> Mapping[str, list[str]]:
        """File to the names of its links, as they stand."""

    @property
    @abstractmethod
    def stated_joints(self) -> list[StatedJoint]:
        """Joints as the files state them."""

    @property
    @abstractmethod
    def stated_bodies(self) -> list[StatedBody]:
        """Mass properties as the files state them."""

    @property
    @abstractmethod
    def parts(self) -> tuple[SubjectPart, ...]:
        """Rigid parts, the base first."""

    @property
    def roles(self) -> Mapping[str, Role]:
        """Part name to what it is, where the source says so in words of the vocabulary."""
        return {}

    @property
    @abstractmethod
    def joints(self) -> tuple[Joint, ...]:
        """Moving joints in the object frame at rest, parents before children."""

    @property
    @abstractmethod
    def preconditions(self) -> tuple[Precondition, ...]:
        """Joints that may move only while others are open."""

    @property
    def origin(self) -> Origin:
        """What is known of a foreign source; nothing where the format cannot say."""
        return Origin()

    @property
    def passages(self) -> tuple[Precondition, ...]:
        """The preconditions that motion is judged under: those stated, or found where the format
        cannot state any."""
        return self.preconditions

    @property
    @abstractmethod
    def links(self) -> Mapping[str, Link]:
        """Body name to its part and frame, for every body of the compiled models."""

    @property
    @abstractmethod
    def mesh_files(self) -> Mapping[str, TriMesh | str]:
        """Label of each visual mesh to its triangles, or to what keeps them from being read."""

    @property
    @abstractmethod
    def meshes(self) -> Mapping[str, TriMesh]:
        """Part name to its visual mesh at rest; parts without one are not named."""

    @property
    @abstractmethod
    def collision_files(self) -> Mapping[str, tuple[TriMesh, ...] | str]:
        """Part name to its collision pieces at rest, or to what keeps them from being read."""

    @property
    @abstractmethod
    def model_files(self) -> tuple[str, ...]:
        """Files that MuJoCo compiles; dynamics uses the first."""

    @property
    def urdf_file(self) -> str:
        """The model file that is a URDF; asked for where `lacks("urdf")` is None alone."""
        return self.model_files[-1]

    @property
    def urdf_text(self) -> str:
        """The URDF of the asset, with its meshes named but not read."""
        return (self.source.root / self.urdf_file).read_text(encoding="utf-8")

    @abstractmethod
    def spec(self, file: str) -> mujoco.MjSpec:
        """What MuJoCo reads from a file; ValueError where it refuses."""

    @abstractmethod
    def model(self, file: str) -> mujoco.MjModel:
        """What MuJoCo makes of a file; ValueError where it refuses."""

    @cached_property
    def collision(self) -> Mapping[str, tuple[TriMesh, ...]]:
        """Part name to its collision pieces."""
        read = self.collision_files
        return {name: pieces for name, pieces in read.items() if isinstance(pieces, tuple)}

    @cached_property
    def boxes(self) -> Mapping[str, Floats]:
        """Part name to the (2, 3) bounds of its visual mesh at rest, m."""
        return {name: mesh.bounds for name, mesh in self.meshes.items()}

    @cached_property
    def shapes(self) -> Mapping[str, Shape]:
        """Part name to its closed bodies."""
        return {name: shape_of_mesh(mesh) for name, mesh in self.meshes.items()}

    @cached_property
    def volumes(self) -> Mapping[str, Floats]:
        """Part name to the (B,) signed volumes of its bodies, m3."""
        return {name: body_volumes(mesh) for name, mesh in self.meshes.items()}

    @property
    def simulated(self) -> mujoco.MjModel:
        """The model that motion and dynamics are judged by."""
        return self.model(self.model_files[0])


def body_volumes(mesh: TriMesh) -> Floats:
    """(B,) signed volume of each body, m3, about one of its vertices."""
    a, b, c = (mesh.triangles - mesh.vertices[0]).transpose(1, 0, 2)
    signed = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
    return np.asarray(np.bincount(np.asarray(mesh.body), weights=signed), np.float64)
