"""TriMesh: triangle arrays and their invariants."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from artgen.core.errors import GeometryError

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]


def frozen(values: ArrayLike, dtype: type[np.generic]) -> NDArray[np.generic]:
    """A read-only contiguous copy."""
    array = np.array(values, dtype=dtype, order="C")
    array.setflags(write=False)
    return array


@dataclass(frozen=True, kw_only=True, eq=False)
class TriMesh:
    """Triangles with counter-clockwise outward winding.

    Attributes:
        vertices: (V, 3) float64, m.
        faces: (F, 3) int32, indices into `vertices`.
        uv: (F, 3, 2) float64 in meters on the surface, or None; v points up.
        atlas: (F, 3, 2) float64 inside the unit square without overlap, or None.
        slot: (F,) int16, index into the owner's `surfaces`; zeros when not given.
        body: (F,) int16, which closed body of the part the triangle belongs to; zeros when not
            given."""

    vertices: Floats
    faces: Ints
    uv: Floats | None = None
    atlas: Floats | None = None
    slot: NDArray[np.int16] | None = None
    body: NDArray[np.int16] | None = None

    def __post_init__(self) -> None:
        put = object.__setattr__
        put(self, "vertices", frozen(self.vertices, np.float64).reshape(-1, 3))
        put(self, "faces", frozen(self.faces, np.int32).reshape(-1, 3))
        count = len(self.faces)
        for name in ("slot", "body"):
            given = getattr(self, name)
            put(self, name, frozen(np.zeros(count) if given is None else given, np.int16))
        for name in ("uv", "atlas"):
            if (given := getattr(self, name)) is not None:
                put(self, name, frozen(given, np.float64).reshape(count, 3, 2))
        self._check(count)

    def _check(self, count: int) -> None:
        if not np.isfinite(self.vertices).all():
            raise GeometryError(
                "a mesh has a vertex that is not finite; check the solid it came from"
            )
        if count == 0:
            raise GeometryError("a mesh has no triangle; the solid it came from is empty")
        if self.faces.min() < 0 or self.faces.max() >= len(self.vertices):
            raise GeometryError(
                f"a face names vertex {int(self.faces.max())} of {len(self.vertices)}; "
                "indices start at 0"
            )
        a, b, c = self.faces.T
        if ((a == b) | (b == c) | (c == a)).any():
            raise GeometryError(
                "a triangle names one vertex twice; weld the mesh before building a TriMesh"
            )

    @property
    def bounds(self) -> Floats:
        """(2, 3) lower then upper corner, m."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    @property
    def triangles(self) -> Floats:
        """(F, 3, 3) corner positions, m."""
        corners: Floats = self.vertices[self.faces]
        return corners
