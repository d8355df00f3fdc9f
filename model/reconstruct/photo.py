"""Colors of a reconstruction taken from its photographs: what cameras see, by how squarely they
look.

A field's colors are as coarse as its planes; the photographs are not. Where no camera sees a point,
the field's color stands.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import ArticulatedObject, State
from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted

Bytes = NDArray[np.uint8]
SQUARE = 3.0
"""Power of the cosine between view and normal by which photographs count."""
FLATTEST = 0.15
"""Cosine below which a photograph says nothing."""
DOUBT = 1e-3
"""Weight of the field's color beside the photographs'."""
LIFT = 2e-3
"""Share of the distance to the camera by which a point may lie behind what is seen first."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Photo:
    """One photograph of the object in one state.

    Attributes:
        rgba: (H, W, 4) uint8, straight alpha.
        camera_from_object: (4, 4) rigid, m, the frame of the finished object.
    """

    rgba: Bytes
    intrinsics: Floats
    camera_from_object: Floats
    state: State


class PhotoColors:
    """The photographs of an object, each with what of the object it sees first."""

    def __init__(self, obj: ArticulatedObject, photos: list[Photo]) -> None:
        self._photos = photos
        self._poses = [
            forward_kinematics(obj.base.name, obj.joints, photo.state) for photo in photos
        ]
        self._scenes = [_scene(obj, poses) for poses in self._poses]

    def __call__(self, part: str, points: Floats, normals: Floats, rgb: Floats) -> Floats:
        """(N, 3) sRGB in [0, 1] of points of a part at rest, with unit normals; `rgb` is what they
        have where no photograph shows them."""
        total = DOUBT * rgb
        weight = np.full((len(points), 1), DOUBT)
        for photo, poses, scene in zip(self._photos, self._poses, self._scenes, strict=True):
            share, color = _seen(photo, poses[part], scene, points, normals)
            total = total + share[:, None] * color
            weight = weight + share[:, None]
        return np.asarray(total / weight)


def _scene(obj: ArticulatedObject, poses: Mapping[str, Floats]) -> EmbreeScene:
    triangles = [apply(poses[part.name], part.mesh.triangles) for part in obj.parts]
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, np.concatenate(triangles).astype(np.float32))
    return scene


def _seen(
    photo: Photo, object_from_rest: Floats, scene: EmbreeScene, points: Floats, normals: Floats
) -> tuple[Floats, Floats]:
    """(N,) weight of a photograph for points, 0 where they are hidden, and (N, 3) its colors."""
    placed = apply(object_from_rest, points)
    eye = inverted(photo.camera_from_object)[:3, 3]
    ways = placed - eye
    distance = np.linalg.norm(ways, axis=1)
    ways = ways / distance[:, None]
    facing = -np.einsum("ij,ij->i", ways, normals @ object_from_rest[:3, :3].T)
    local = apply(photo.camera_from_object, placed)
    depth = np.where(local[:, 2] > 1e-6, local[:, 2], 1.0)
    pixel = (local[:, :2] / depth[:, None]) @ photo.intrinsics[:2, :2].T + photo.intrinsics[:2, 2]
    column, row = np.floor(pixel).astype(np.int64).T
    height, width = photo.rgba.shape[:2]
    good = (local[:, 2] > 1e-6) & (facing > FLATTEST)
    good &= (column >= 0) & (column < width) & (row >= 0) & (row < height)
    good[good] &= photo.rgba[row[good], column[good], 3] > 200
    near = np.flatnonzero(good)
    origins = np.broadcast_to(eye.astype(np.float32), (len(near), 3))
    rays = ways[near].astype(np.float32)
    reach = scene.run(np.ascontiguousarray(origins), rays, query="DISTANCE")
    good[near] = reach >= distance[near] * (1.0 - LIFT)
    weight = np.where(good, np.maximum(facing, 0.0) ** SQUARE, 0.0)
    color = np.zeros((len(points), 3))
    color[good] = photo.rgba[row[good], column[good], :3] / 255.0
    return weight, color
