"""Where rays through pixel centers meet a part.

Rays are moved into the part's rest frame, so that one static search tree a part serves all states
and cameras. Embree finds the triangle in float32; where on it the ray ends is then computed in
float64.
"""

from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.core.camera import Camera
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply, inverted
from artgen.geometry.normals import corner_normals, unit

Box = tuple[int, int, int, int]


@dataclass(frozen=True, kw_only=True, eq=False)
class Hits:
    """The N pixels of a camera whose rays meet one part.

    Attributes:
        pixel: (N,) row * width + column, ascending.
        triangle: (N,) of the part's mesh.
        point: (N, 3) m, object frame at rest.
        depth: (N,) m along the camera's z.
        normal: (N, 3) unit, world, smooth over creases as shading is.
    """

    pixel: NDArray[np.intp]
    triangle: NDArray[np.intp]
    point: Floats
    depth: Floats
    normal: Floats

    def of(self, chosen: NDArray[np.bool_]) -> "Hits":
        """Some of the hits; `chosen` is (N,)."""
        return Hits(
            pixel=self.pixel[chosen],
            triangle=self.triangle[chosen],
            point=self.point[chosen],
            depth=self.depth[chosen],
            normal=self.normal[chosen],
        )


class View:
    """A camera and its rays, computed once for all parts."""

    def __init__(self, camera: Camera) -> None:
        self.camera = camera
        self.eye, self.directions = camera.rays()


class PartCaster:
    """One part at rest, ready to be hit by rays."""

    def __init__(self, mesh: TriMesh) -> None:
        self._triangles = mesh.triangles
        self._normals = corner_normals(mesh)
        # Robust traversal: a ray through an edge shared by two triangles meets one of them.
        self._scene = EmbreeScene(robust=True)
        TriangleMesh(self._scene, np.asarray(mesh.vertices, np.float32), np.array(mesh.faces))

    def cast(self, view: View, object_from_rest: Floats, box: Box) -> Hits:
        """Where this part alone is met; rays outside `box` (left, top, right, bottom) px are known
        to miss."""
        left, top, right, bottom = box
        rest_from_object = inverted(object_from_rest)
        origin = apply(rest_from_object, view.eye)
        window = view.directions[top:bottom, left:right].reshape(-1, 3)
        rays = window @ rest_from_object[:3, :3].T
        triangle = self._first(origin, rays)
        (met,) = np.nonzero(triangle >= 0)
        met, depth = self._depth(origin, rays, triangle, met)
        triangle, rays = triangle[met].astype(np.intp), rays[met]
        point = origin + depth[:, None] * rays
        wide = max(right - left, 1)
        pixel = (top + met // wide) * view.camera.size[0] + left + met % wide
        normal = self._normal(point, triangle) @ object_from_rest[:3, :3].T
        return Hits(pixel=pixel, triangle=triangle, point=point, depth=depth, normal=normal)

    def _first(self, origin: Floats, rays: Floats) -> NDArray[np.int32]:
        """(N,) the triangle each ray meets first, -1 where it meets none."""
        if not len(rays):
            return np.zeros(0, np.int32)
        origins = np.broadcast_to(origin.astype(np.float32), rays.shape)
        return self._scene.run(np.ascontiguousarray(origins), rays.astype(np.float32))

    def _depth(
        self, origin: Floats, rays: Floats, triangle: NDArray[np.int32], met: NDArray[np.intp]
    ) -> tuple[NDArray[np.intp], Floats]:
        """The rays that meet a triangle with an area, and where they meet its plane."""
        a, b, c = self._triangles[triangle[met]].transpose(1, 0, 2)
        across = np.cross(b - a, c - a)
        slope = _dot(across, rays[met])
        depth = _dot(across, a - origin) / np.where(slope == 0.0, np.nan, slope)
        real = depth > 0.0
        return met[real], depth[real]

    def _normal(self, point: Floats, triangle: NDArray[np.intp]) -> Floats:
        """(N, 3) smooth unit normals at rest."""
        weights = barycentric(point, self._triangles[triangle])
        smooth = unit(np.einsum("ni,nij->nj", weights, self._normals[triangle]))
        (lost,) = np.nonzero(_dot(smooth, smooth) < 0.25)
        if len(lost):
            a, b, c = self._triangles[triangle[lost]].transpose(1, 0, 2)
            smooth[lost] = unit(np.cross(b - a, c - a))
        return smooth


def barycentric(point: Floats, corners: Floats) -> Floats:
    """(N, 3) weights, each in [0, 1], of the corners (N, 3, 3) at (N, 3) points of their planes."""
    a, b, c = corners.transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    area = _dot(across, across)
    area = np.where(area == 0.0, np.inf, area)
    v = _dot(across, np.cross(point - a, c - a)) / area
    w = _dot(across, np.cross(b - a, point - a)) / area
    return np.clip(np.stack([1.0 - v - w, v, w], axis=1), 0.0, 1.0)


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", a, b))
