"""Scenes for the rasterizer that need neither a GLB nor Blender."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.export.glb_content import Skin
from artgen.geometry.normals import corner_normals
from artgen.geometry.solid import Solid
from artgen.imaging import Singles
from artgen.render_job import AreaLight, LightRig, Shot, Sky
from renders.fast.backend import FastBackend
from renders.glb import Appearance, Look

SIZE = 48
DARK = Sky(nadir=(0.0,) * 3, horizon=(0.0,) * 3, zenith=(0.0,) * 3)
EVEN = Sky(nadir=(1.0,) * 3, horizon=(1.0,) * 3, zenith=(1.0,) * 3)
FURNACE = LightRig(name="furnace", lights=(), sky=EVEN)


def matte(name: str, gray: float) -> SurfaceSpec:
    """A surface that mirrors nothing: an index of 1 has no Fresnel reflection but at grazing."""
    return SurfaceSpec(name=name, recipe="plain", color=(gray,) * 3, roughness=1.0, ior=1.0)


def skin(solid: Solid, part: str, surface: str) -> Skin:
    """Triangles with corner normals, as a GLB stores them."""
    mesh: TriMesh = solid.trimesh()
    count = 3 * len(mesh.faces)
    return Skin(
        part=part,
        surface=surface,
        vertices=mesh.triangles.reshape(-1, 3),
        normals=corner_normals(mesh).reshape(-1, 3),
        uv=np.zeros((count, 2)),
        faces=np.arange(count, dtype=np.int32).reshape(-1, 3),
    )


def camera(points: Floats, *, azimuth: float = 0.0, elevation: float = 0.0) -> Camera:
    """A view of `points` that they fill."""
    towards = orbit_direction(math.radians(azimuth), math.radians(elevation))
    return framed(points, direction=towards, fov=0.3, size=(SIZE, SIZE), fill=0.9)


def shot(part: str | None = None, box: tuple[int, int, int, int] = (0, 0, SIZE, SIZE)) -> Shot:
    """One image of the only camera and state."""
    return Shot(file="0.exr", camera=0, state=0, part=part, box=box, samples=1)


def drawn(
    backend: FastBackend,
    skins: Sequence[Skin],
    surfaces: Sequence[SurfaceSpec],
    view: Camera,
    *,
    rig: LightRig = FURNACE,
    shots: Sequence[Shot] = (shot(),),
    looks: Mapping[str, Look] | None = None,
) -> list[Singles]:
    """The shots' images of parts at rest."""
    named = {surface.name: Look() for surface in surfaces} | dict(looks or {})
    return backend.draw(
        Appearance(skins=tuple(skins), looks=named),
        {surface.name: surface for surface in surfaces},
        rig,
        cameras=(view,),
        poses=(
            dict.fromkeys([*(s.part for s in skins), *(s.part or "" for s in shots)], np.eye(4)),
        ),
        shots=shots,
    )


def lamp(position: Sequence[float], target: Sequence[float], side: float) -> AreaLight:
    """A white square that shines towards `target`."""
    x, y, z = position
    a, b, c = target
    return AreaLight(
        position=(x, y, z), target=(a, b, c), size=(side, side), radiance=(1.0, 1.0, 1.0)
    )
