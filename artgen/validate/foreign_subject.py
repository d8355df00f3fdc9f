"""A stranger's asset under test; what its format cannot say is said to be missing."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import mujoco

from artgen.articulation.types import Joint, Precondition
from artgen.core.errors import ArtgenError
from artgen.core.mesh import TriMesh
from artgen.validate.assembly import Assembly, Geometry, merged, moved
from artgen.validate.passages import found_passages
from artgen.validate.physics import compiled_spec
from artgen.validate.second_opinion import NEED, absent
from artgen.validate.subject import Link, Subject, SubjectPart

NEVER_SAID = {
    "manifest": "asked of artgen's bundles alone; a {format} file has no manifest",
    "densities": "a {format} file states no densities, so there is no integral to compare with",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class ForeignSubject(Subject):
    """An asset that a single file of links and joints describes."""

    @property
    def name(self) -> str:
        """The file's name without its suffix."""
        return self.source.file.stem

    def lacks(self, need: str) -> str | None:
        """Why the file cannot say what a check needs."""
        if need in NEVER_SAID:
            return NEVER_SAID[need].format(format=self.format)
        if need == NEED:
            only = f"asked of URDF alone; pinocchio does not read {self.format}"
            return absent() if self.format == "urdf" else only
        if need == "visual meshes" and not self.visuals:
            return f"no link of the {self.format} file has a visual shape"
        if need == "collision" and not self.contact_shapes:
            return f"no link of the {self.format} file has a collision shape"
        return None

    @property
    @abstractmethod
    def assembly(self) -> Assembly:
        """Parts and joints in the object frame at rest."""

    @property
    @abstractmethod
    def visuals(self) -> Sequence[Geometry]:
        """Visual shapes of all links."""

    @property
    @abstractmethod
    def contact_shapes(self) -> Sequence[Geometry]:
        """Collision shapes of all links."""

    @property
    def parts(self) -> tuple[SubjectPart, ...]:
        """Groups of links that fixed joints connect."""
        return self.assembly.parts

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Moving joints."""
        return self.assembly.joints

    @property
    def preconditions(self) -> tuple[Precondition, ...]:
        """None: only manifests state them."""
        return ()

    @cached_property
    def passages(self) -> tuple[Precondition, ...]:
        """Joints whose parts meet others on their way, unless those are open."""
        if self.lacks("collision"):
            return ()
        owners = {name: link.part for name, link in self.links.items()}
        return found_passages(self.simulated, self.parts[0].name, self.joints, owners)

    @property
    def links(self) -> Mapping[str, Link]:
        """Every link of the file."""
        return self.assembly.links

    @cached_property
    def visual_meshes(self) -> Mapping[Geometry, TriMesh | str]:
        """Each visual shape to its triangles in the object frame, or to why there are none."""
        return {shape: self._read(shape) for shape in self.visuals}

    @cached_property
    def contact_meshes(self) -> Mapping[Geometry, TriMesh | str]:
        """Each collision shape to its triangles in the object frame, or to why there are none."""
        return {shape: self._read(shape) for shape in self.contact_shapes}

    def _read(self, shape: Geometry) -> TriMesh | str:
        try:
            pose = self.links[shape.link].object_from_link @ shape.link_from_shape
            return moved(shape.read(), pose)
        except (ArtgenError, OSError, MemoryError) as error:
            return str(error)

    @cached_property
    def mesh_files(self) -> Mapping[str, TriMesh | str]:
        """Label of each visual shape to its triangles, or to why there are none."""
        return {shape.label: mesh for shape, mesh in self.visual_meshes.items()}

    @cached_property
    def meshes(self) -> Mapping[str, TriMesh]:
        """Part name to all its visual shapes together."""
        return {name: merged(own) for name, own in self._by_part(self.visual_meshes).items()}

    def _by_part(self, read: Mapping[Geometry, TriMesh | str]) -> dict[str, list[TriMesh]]:
        """Part name to the meshes of its links that could be read, in the order of the parts."""
        found: dict[str, list[TriMesh]] = {part.name: [] for part in self.parts}
        for shape, mesh in read.items():
            if isinstance(mesh, TriMesh):
                found[self.links[shape.link].part].append(mesh)
        return {name: own for name, own in found.items() if own}

    @cached_property
    def collision_files(self) -> Mapping[str, tuple[TriMesh, ...] | str]:
        """Part name to its pieces; label of a shape to what keeps it from being read."""
        wrong = {s.label: m for s, m in self.contact_meshes.items() if isinstance(m, str)}
        right = self._by_part(self.contact_meshes)
        return {**{name: tuple(own) for name, own in right.items()}, **wrong}

    @property
    def model_files(self) -> tuple[str, ...]:
        """The file alone."""
        return (self.source.file.name,)

    @cached_property
    def compiled(self) -> mujoco.MjModel:
        """What MuJoCo makes of the file; ValueError where it refuses."""
        return compiled_spec(self.spec(self.source.file.name))

    def model(self, file: str) -> mujoco.MjModel:
        """What MuJoCo makes of the file; ValueError where it refuses."""
        return self.compiled
