"""What finishing asks of Blender, as plain data: jobs, and the arrays beside them.

A job is a frozen dataclass whose `plain` form is one line of JSON; arrays travel in an npz file
that the job names. Every job carries its `kind`, which the worker dispatches on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from artgen.core.mesh import Floats, Ints
from artgen.core.surface import SurfaceSpec


@dataclass(frozen=True, kw_only=True)
class RoundJob:
    """Round the sharp convex edges of closed bodies.

    Attributes:
        input: npz written by `write_bodies`, with `radius` (n,) m.
        output: npz in the same layout, without `radius`; bodies in the same order.

    The report lists in `kept_sharp` the bodies that no bevel could leave closed, and that come back
    as they went in.
    """

    input: str
    output: str
    kind: str = "round"


def write_bodies(
    path: Path, bodies: Sequence[tuple[Floats, Ints]], *, radius: Sequence[float] = ()
) -> None:
    """Bodies one after another: `vertices` (sum V, 3) m, `faces` (sum F, 3), `vertex_counts` (n,),
    `face_counts` (n,), `radius` (n,) m or (0,); the indices of each body start at 0."""
    np.savez(
        path,
        vertices=np.concatenate([np.zeros((0, 3)), *(v for v, _ in bodies)]),
        faces=np.concatenate([np.zeros((0, 3), np.int32), *(f for _, f in bodies)]),
        vertex_counts=np.array([len(v) for v, _ in bodies], np.int64),
        face_counts=np.array([len(f) for _, f in bodies], np.int64),
        radius=np.array(radius, np.float64),
    )


def read_bodies(path: Path) -> tuple[list[tuple[Floats, Ints]], Floats]:
    """Bodies and radii that `write_bodies` wrote."""
    with np.load(path) as stored:
        vertices = np.split(stored["vertices"], np.cumsum(stored["vertex_counts"])[:-1])
        faces = np.split(stored["faces"], np.cumsum(stored["face_counts"])[:-1])
        count, radius = len(stored["vertex_counts"]), stored["radius"]
    return list(zip(vertices, faces, strict=True))[:count], radius


@dataclass(frozen=True, kw_only=True)
class GltfImages:
    """Absolute paths of PNG files that go into the GLB byte for byte; None where a factor suffices.

    Attributes:
        color: sRGB; replaces the surface's color.
        orm: R = 1, G = roughness, B = metallic; replaces both factors.
        normal: tangent space, y up (OpenGL).
        emission: sRGB; multiplied by the surface's `emission`.
    """

    color: str | None = None
    orm: str | None = None
    normal: str | None = None
    emission: str | None = None


@dataclass(frozen=True, kw_only=True)
class GltfSurface:
    """One glTF material; the numbers mean what they mean in `SurfaceSpec`."""

    name: str
    color: tuple[float, float, float]
    roughness: float
    metallic: float
    transmission: float
    ior: float
    emission: float
    images: GltfImages = field(default_factory=GltfImages)

    @classmethod
    def of(cls, spec: SurfaceSpec, images: GltfImages) -> Self:
        """The material of a surface and the image files of its recipe."""
        return cls(
            name=spec.name,
            color=spec.color,
            roughness=spec.roughness,
            metallic=spec.metallic,
            transmission=spec.transmission,
            ior=spec.ior,
            emission=spec.emission,
            images=images,
        )


@dataclass(frozen=True, kw_only=True)
class GltfPart:
    """One glTF node.

    Attributes:
        name: name of the node and of its mesh.
        parent: name of another part, listed before this one; None for the base.
        origin: of the node, m, object frame at rest: its joint's origin, or zero for the base.
        extras: JSON for the node's `extras`.
    """

    name: str
    parent: str | None
    origin: tuple[float, float, float]
    extras: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class OcclusionBake:
    """Ambient occlusion of every part by itself, on the atlas, by Cycles.

    Parts are baked apart from each other, so that the image is right in every pose. Costs 0.3 CPU s
    a sample at 512 px, whatever the object.

    Attributes:
        output: the PNG that is written, and embedded in the GLB.
        size: texels along a side.
        samples: rays a texel.
        reach: m; what is farther away does not darken.
    """

    output: str
    size: int = 512
    samples: int = 16
    reach: float = 0.25


@dataclass(frozen=True, kw_only=True)
class GltfJob:
    """Write one GLB; the arrays of every part lie in `arrays` as `write_gltf_arrays` puts them.

    Attributes:
        parts: base first, parents before children.
        surfaces: what `slot` indexes; those that no triangle uses are left out of the file.
        extras: JSON for the scene's `extras`.
        arrays: npz file.
        output: the .glb; its folder exists.
        occlusion: None bakes nothing.
    """

    parts: tuple[GltfPart, ...]
    surfaces: tuple[GltfSurface, ...]
    extras: Mapping[str, Any]
    arrays: str
    output: str
    occlusion: OcclusionBake | None = None
    kind: str = "gltf"

    @classmethod
    def from_plain(cls, job: Mapping[str, Any]) -> Self:
        """The job that `plain` turned into JSON."""
        surfaces = (
            GltfSurface(
                **{**row, "color": tuple(row["color"]), "images": GltfImages(**row["images"])}
            )
            for row in job["surfaces"]
        )
        parts = (GltfPart(**{**row, "origin": tuple(row["origin"])}) for row in job["parts"])
        bake = job["occlusion"] and OcclusionBake(**job["occlusion"])
        typed = {"surfaces": tuple(surfaces), "parts": tuple(parts), "occlusion": bake}
        return cls(**{**job, **typed})


@dataclass(frozen=True, kw_only=True, eq=False)
class GltfArrays:
    """Triangles of one part.

    Attributes:
        vertices: (V, 3) m, object frame at rest.
        faces: (F, 3).
        normals: (F, 3, 3) unit, a corner.
        uv: (F, 3, 2) in repeats of the image: meters divided by the surface's tile; v up.
        atlas: (F, 3, 2) in the unit square; v up.
        slot: (F,) index into `GltfJob.surfaces`.
    """

    vertices: Floats
    faces: Ints
    normals: Floats
    uv: Floats
    atlas: Floats
    slot: NDArray[np.int16]


def write_gltf_arrays(path: Path, parts: Mapping[str, GltfArrays]) -> None:
    """One npz for all parts: `<part>/<array>`."""
    named = {f"{part}/{name}": getattr(parts[part], name) for part in parts for name in _ARRAYS}
    np.savez(path, **named)


def read_gltf_arrays(path: Path) -> dict[str, GltfArrays]:
    """Part name to what `write_gltf_arrays` wrote."""
    with np.load(path) as stored:
        parts = dict.fromkeys(key.rpartition("/")[0] for key in stored.files)
        return {
            part: GltfArrays(**{name: stored[f"{part}/{name}"] for name in _ARRAYS})
            for part in parts
        }


_ARRAYS = tuple(f.name for f in fields(GltfArrays))
