"""The surfaces of an object under assembly: each once, under a name of its own."""

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from artgen.assembly.piece import Piece
from artgen.assembly.texels import density
from artgen.assembly.uv_fix import areas
from artgen.core.mesh import Floats, TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.geometry.unwrap import metric_uv

METRIC = (0.85, 1.15)
"""Mean density of texture laid out in meters: box projections lose some on oblique faces."""
Change = Callable[[SurfaceSpec], SurfaceSpec]


class SurfaceTable:
    """Grows as pieces are taken in; equal surfaces share a slot whatever their names were."""

    def __init__(self) -> None:
        self.surfaces: list[SurfaceSpec] = []

    def slot(self, surface: SurfaceSpec) -> int:
        """The slot of a surface, added under a free name if it is new."""
        plain = dataclasses.replace(surface, name="")
        for place, known in enumerate(self.surfaces):
            if dataclasses.replace(known, name="") == plain:
                return place
        names = {known.name for known in self.surfaces}
        name, count = surface.name, 1
        while name in names:
            count += 1
            name = f"{surface.name}_{count}"
        self.surfaces.append(dataclasses.replace(surface, name=name))
        return len(self.surfaces) - 1

    def take(self, piece: Piece, surfaces: Sequence[SurfaceSpec], change: Change) -> Piece:
        """The piece with slots of this table, its surfaces changed on the way."""
        place = np.zeros(len(surfaces), np.int16)
        redrawn = []
        for old in piece.slots:
            new = change(surfaces[old])
            place[old] = self.slot(new)
            if new != surfaces[old]:
                redrawn += [old] * (not _metric(piece.mesh, old))
        own = np.asarray(piece.mesh.slot)
        uv = laid_anew(piece.mesh, np.isin(own, redrawn))
        return dataclasses.replace(
            piece, mesh=dataclasses.replace(piece.mesh, slot=place[own], uv=uv)
        )


def _metric(mesh: TriMesh, slot: int) -> bool:
    """Whether the texture of a surface lies in meters."""
    own = np.asarray(mesh.slot) == slot
    mean = np.average(density(mesh)[own], weights=areas(mesh.triangles)[own])
    return bool(METRIC[0] <= mean <= METRIC[1])


def laid_anew(mesh: TriMesh, faces: NDArray[np.bool_]) -> Floats:
    """(F, 3, 2) UV with some faces laid out in meters, body by body: a foreign texture is as dense
    as its maker liked, which does not suit another material."""
    uv, bodies = np.array(mesh.uv), np.asarray(mesh.body)
    for body in np.unique(bodies[faces]).tolist():
        own = faces & (bodies == body)
        used, index = np.unique(mesh.faces[own], return_inverse=True)
        corners = index.reshape(-1, 3).astype(np.int32)
        uv[own] = metric_uv(mesh.vertices[used], corners, grain=None, place=body)
    return uv
