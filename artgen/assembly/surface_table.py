"""The surfaces of an object under assembly: each once, under a name of its own."""

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np

from artgen.assembly.piece import Piece
from artgen.core.surface import SurfaceSpec

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
        for old in piece.slots:
            place[old] = self.slot(change(surfaces[old]))
        slots = place[np.asarray(piece.mesh.slot)]
        return dataclasses.replace(piece, mesh=dataclasses.replace(piece.mesh, slot=slots))
