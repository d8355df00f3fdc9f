"""Labels by ray casting: depth and normal of every part alone, and which part a pixel shows.

Rays go through pixel centres and are moved into each part's rest frame, so that one static search
tree a part serves all states and cameras. Embree finds the triangle in float32; where on it the ray
ends is then computed in float64.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.core.camera import Camera
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply, inverted
from artgen.dataset.sample import BACKGROUND
from artgen.geometry.normals import corner_normals, unit

Box = tuple[int, int, int, int]


@dataclass(frozen=True, kw_only=True, eq=False)
class Labels:
    """What one camera sees in one state, for P parts.

    Attributes:
        part_id: (H, W) uint8 index of the nearest part, 255 where there is none.
        depth: (H, W) float32 m along the camera's z; 0 is background.
        normal: (H, W, 3) float32 unit, world, smooth over creases as shading is; 0 is background.
        part_depth: (P, H, W) float32, each part alone.
        part_normal: (P, H, W, 3) float32, each part alone.
    """

    part_id: NDArray[np.uint8]
    depth: NDArray[np.float32]
    normal: NDArray[np.float32]
    part_depth: NDArray[np.float32]
    part_normal: NDArray[np.float32]


class PartCaster:
    """One part at rest, ready to be hit by rays."""

    def __init__(self, mesh: TriMesh) -> None:
        self.mesh = mesh
        self._triangles = mesh.triangles
        self._normals = corner_normals(mesh)
        # Robust traversal: a ray through an edge shared by two triangles meets one of them.
        self._scene = EmbreeScene(robust=True)
        TriangleMesh(self._scene, np.asarray(mesh.vertices, np.float32), np.array(mesh.faces))

    def cast(
        self, camera: Camera, object_from_rest: Floats, box: Box
    ) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Depth (H, W) and world normal (H, W, 3) of this part alone; rays outside `box` (left,
        top, right, bottom) px are known to miss."""
        width, height = camera.size
        depth = np.zeros((height, width), np.float32)
        normal = np.zeros((height, width, 3), np.float32)
        left, top, right, bottom = box
        if right <= left or bottom <= top:
            return depth, normal
        eye, directions = camera.rays()
        rest_from_object = inverted(object_from_rest)
        origin = apply(rest_from_object, eye)
        rays = directions[top:bottom, left:right].reshape(-1, 3) @ rest_from_object[:3, :3].T
        origins = np.broadcast_to(origin.astype(np.float32), rays.shape)
        hit = self._scene.run(np.ascontiguousarray(origins), rays.astype(np.float32), output=1)
        (met,) = np.nonzero(hit["primID"] >= 0)
        distance, bent = self._exact(origin, rays[met], hit["primID"][met])
        window = np.zeros((bottom - top, right - left), np.float32)
        window.ravel()[met] = distance
        depth[top:bottom, left:right] = window
        facing = np.zeros((window.size, 3), np.float32)
        facing[met] = bent @ object_from_rest[:3, :3].T
        normal[top:bottom, left:right] = facing.reshape(*window.shape, 3)
        return depth, normal

    def _exact(
        self, origin: Floats, rays: Floats, triangle: NDArray[np.int32]
    ) -> tuple[Floats, Floats]:
        """Depth (N,) where the rays meet their triangles' planes, and smooth normals there."""
        a, b, c = self._triangles[triangle].transpose(1, 0, 2)
        across = np.cross(b - a, c - a)
        depth = _dot(across, a - origin) / _dot(across, rays)
        point = origin + depth[:, None] * rays
        area = _dot(across, across)
        v = _dot(across, np.cross(point - a, c - a)) / area
        w = _dot(across, np.cross(b - a, point - a)) / area
        weights = np.clip(np.stack([1.0 - v - w, v, w], axis=1), 0.0, 1.0)
        smooth = unit(np.einsum("ni,nij->nj", weights, self._normals[triangle]))
        flat = unit(across)
        lost = np.linalg.norm(smooth, axis=1, keepdims=True) < 0.5
        return depth, np.where(lost, flat, smooth)


def cast_labels(
    casters: Sequence[PartCaster],
    names: Sequence[str],
    poses: Mapping[str, Floats],
    camera: Camera,
    boxes: Sequence[Box],
) -> Labels:
    """Labels of all parts; the composite is the nearest over the parts, so both always agree."""
    images = [
        caster.cast(camera, poses[name], box)
        for caster, name, box in zip(casters, names, boxes, strict=True)
    ]
    part_depth = np.stack([depth for depth, _ in images])
    part_normal = np.stack([normal for _, normal in images])
    far = np.where(part_depth > 0.0, part_depth, np.inf)
    nearest = np.argmin(far, axis=0)
    seen = np.isfinite(far.min(axis=0))
    pick = nearest[None]
    depth = np.take_along_axis(part_depth, pick, axis=0)[0]
    normal = np.take_along_axis(part_normal, pick[..., None], axis=0)[0]
    return Labels(
        part_id=np.where(seen, nearest, BACKGROUND).astype(np.uint8),
        depth=np.where(seen, depth, np.float32(0)),
        normal=np.where(seen[..., None], normal, np.float32(0)),
        part_depth=part_depth,
        part_normal=part_normal,
    )


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", a, np.broadcast_to(b, a.shape)))
