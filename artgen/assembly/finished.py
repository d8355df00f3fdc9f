"""A bundle read back as a finished object: vertices of its OBJ files, looks of its GLB."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from artgen.articulation.types import ArticulatedObject, Part
from artgen.core.conventions import UV_DECIMALS
from artgen.core.errors import ExportError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.export import read_bundle
from artgen.export.glb_content import Skin, read_glb
from artgen.export.layout import GLB

APART = 4e-6
"""m; float32 keeps 3e-7 m of 5 m in a position, its node and their sum, in each of 9 numbers."""
FACING = 1e-3
"""m; weight of a normal beside positions: tells the two triangles apart where bodies touch."""


def finished_object(folder: Path) -> ArticulatedObject:
    """The object of a bundle, as it was before export: OBJ files hold its vertices and bodies bit
    for bit, the GLB holds UV (to float32, which is 1e-7 of a tile) and surfaces.

    Raises:
        ExportError: the bundle is damaged, or its GLB shows other triangles than its OBJ files.
    """
    bundle = read_bundle(folder)
    skins = read_glb(folder / GLB).skins
    parts = []
    for part in bundle.parts:
        own = [skin for skin in skins if skin.part == part.name]
        mesh = bundle.load_mesh(part.name)
        parts.append(
            Part(
                name=part.name,
                label=part.label,
                mesh=_with_looks(mesh, own, bundle.surfaces, where=f"{folder}: {part.name}"),
                collision=bundle.load_collision(part.name),
                mass=part.mass,
                densities=part.densities,
                grips=part.grips,
            )
        )
    return ArticulatedObject(
        category=bundle.category,
        asset_id=bundle.asset_id,
        parts=tuple(parts),
        joints=bundle.joints,
        surfaces=bundle.surfaces,
        preconditions=bundle.preconditions,
        provenance=bundle.manifest,
    )


def _with_looks(
    mesh: TriMesh, skins: Sequence[Skin], surfaces: Sequence[SurfaceSpec], *, where: str
) -> TriMesh:
    """The mesh with UV in m and slots, taken from the triangles at the same place."""
    if sum(len(skin.faces) for skin in skins) != len(mesh.faces):
        raise ExportError(f"{where}: GLB and OBJ have other triangles; export the asset anew")
    slots = {surface.name: k for k, surface in enumerate(surfaces)}
    numbers = np.repeat(
        [slots[skin.surface] for skin in skins], [len(skin.faces) for skin in skins]
    )
    tiles = np.array([surface.tile for surface in surfaces])
    corners = np.concatenate([skin.vertices[skin.faces] for skin in skins])
    upward = [(skin.uv * (1.0, -1.0) + (0.0, 1.0))[skin.faces] for skin in skins]
    uv = np.concatenate(upward) * tiles[numbers][:, None, :]
    nearest = _matched(mesh.triangles, corners, where)
    turn = _turns(mesh.triangles, corners[nearest])
    index = (np.arange(3) + turn[:, None]) % 3
    taken = np.take_along_axis(uv[nearest], index[:, :, None], axis=1)
    return dataclasses.replace(
        mesh, uv=np.round(taken, UV_DECIMALS) + 0.0, slot=numbers[nearest].astype(np.int16)
    )


def _matched(ours: Floats, theirs: Floats, where: str) -> NDArray[np.intp]:
    """(F,) for each of our triangles the one of theirs at the same place, facing the same way."""
    distance, nearest = cKDTree(_features(theirs)).query(_features(ours))
    if distance.max() > APART + FACING * 0.2 or len(np.unique(nearest)) != len(nearest):
        raise ExportError(
            f"{where}: triangles of GLB and OBJ lie up to {distance.max():.2g} m apart; export the "
            "asset anew"
        )
    return np.asarray(nearest, np.intp)


def _features(triangles: Floats) -> Floats:
    """(F, 9) what tells triangles apart whichever corner comes first: middle, reach from it along
    each axis, and the way they face."""
    middle = triangles.mean(axis=1)
    spread = np.abs(triangles - middle[:, None]).max(axis=1)
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(cross, axis=1, keepdims=True)
    normal = cross / np.where(length > 0.0, length, 1.0)
    return np.concatenate([middle, spread, FACING * normal], axis=1)


def _turns(ours: Floats, theirs: Floats) -> NDArray[np.int64]:
    """(F,) by how many corners their triangles have to be turned to lie corner on corner."""
    off = [np.abs(ours - np.roll(theirs, -shift, axis=1)).max(axis=(1, 2)) for shift in range(3)]
    return np.argmin(np.stack(off, axis=1), axis=1)
