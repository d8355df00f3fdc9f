"""Reading: the meshes of a foreign object, and what could not be read."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from artgen.core.errors import ArtgenError, IngestError
from artgen.core.mesh import Floats
from artgen.ingest.foreign import ForeignObject, ForeignPart, ForeignShape
from artgen.ingest.meshes.soup import Soup

MOST_TRIANGLES = 2_000_000
"""Of one object; what has more is no part of furniture."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ReadMeshes:
    """Meshes by shape, and a line for each that is left out."""

    soups: Mapping[ForeignShape, Soup]
    dropped: tuple[str, ...]

    def points(self, part: ForeignPart) -> Floats:
        """(N, 3) corners of all triangles of a part, as drawn."""
        return self.corners(part).reshape(-1, 3)

    def corners(self, part: ForeignPart) -> Floats:
        """(F, 3, 3) of all triangles of a part, as drawn."""
        own = [self.soups[shape] for shape in part.shapes if shape in self.soups]
        return np.concatenate([soup.vertices[soup.faces] for soup in own])


def read_meshes(obj: ForeignObject) -> ReadMeshes:
    """Every mesh of an object; what is missing or damaged is left out and told.

    Raises:
        IngestError: a part has no mesh left, or there are too many triangles.
    """
    soups: dict[ForeignShape, Soup] = {}
    dropped: list[str] = []
    for part in obj.parts:
        for shape in part.shapes:
            try:
                soups[shape] = shape.read()
            except (ArtgenError, OSError, MemoryError) as error:
                dropped.append(f"{part.name}, {shape.label}: {error}")
            except (ArithmeticError, LookupError, TypeError, ValueError) as error:
                dropped.append(f"{part.name}, {shape.label}: it cannot be understood: {error!r}")
    count = sum(len(soup.faces) for soup in soups.values())
    if count > MOST_TRIANGLES:
        raise IngestError(f"it has {count} triangles, at most {MOST_TRIANGLES}; decimate it")
    if bare := [part for part in obj.parts if not any(s in soups for s in part.shapes)]:
        raise IngestError(_bare(bare, dropped))
    return ReadMeshes(soups=soups, dropped=tuple(dropped))


def _bare(parts: Iterable[ForeignPart], dropped: list[str]) -> str:
    names = ", ".join(f"{part.name} ({part.word})" for part in parts)
    why = f": {dropped[0]}" if dropped else "; none is stated"
    return f"{names}: no mesh that can be used{why}"
