"""Colors of a reconstruction taken from its photographs: what cameras see, by how squarely they
look.

A field's colors are as coarse as its planes; the photographs are not. Where no camera sees a point,
it takes the color of what is seen beside it on the same part and looks the same way, such as around
an edge. Farther away the field's color stands, shifted by what it is wrong by where the part is
seen: a field may be too dark all over, and one that was given up for a box often is.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from scipy.ndimage import minimum_filter
from scipy.spatial import cKDTree

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import ArticulatedObject, State
from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted

Bytes = NDArray[np.uint8]
SQUARE = 3.0
"""Power of the cosine between view and normal by which photographs count."""
OPAQUE = 200
"""Alpha of what is foreground, of 255."""
FLATTEST = 0.15
"""Cosine below which a photograph says nothing."""
DOUBT = 1e-3
"""Weight of the field's color beside the photographs'."""
RIM = 0.01
"""What a pixel counts that touches the background, which it may have mixed into its color."""
SEEN = 0.02
"""Weight of all photographs above which a point counts as seen."""
BESIDE = 0.1
"""Diagonals of a part over which color spreads to what is not seen."""
TURNED = 1.2
"""The same for normals that differ by one: over 49 degrees nothing spreads."""
SPREAD_FROM = 6
"""Points that are seen, whose colors an unseen one takes, the nearer the more."""
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
        self._inner = [minimum_filter(photo.rgba[..., 3], 3) > OPAQUE for photo in photos]
        self._poses = [
            forward_kinematics(obj.base.name, obj.joints, photo.state) for photo in photos
        ]
        self._scenes = [_scene(obj, poses) for poses in self._poses]

    def __call__(self, part: str, points: Floats, normals: Floats, rgb: Floats) -> Floats:
        """(N, 3) sRGB in [0, 1] of points of a part at rest, with unit normals; `rgb` is what the
        field says of them."""
        total = DOUBT * rgb
        weight = np.full((len(points), 1), DOUBT)
        every = zip(self._photos, self._inner, self._poses, self._scenes, strict=True)
        for photo, inner, poses, scene in every:
            share, color = _seen(photo, inner, poses[part], scene, points, normals)
            total = total + share[:, None] * color
            weight = weight + share[:, None]
        seen = weight[:, 0] - DOUBT > SEEN
        return spread(points, normals, shifted(rgb, np.asarray(total / weight), seen), seen)


def shifted(rgb: Floats, shown: Floats, seen: NDArray[np.bool_]) -> Floats:
    """(N, 3) the photographs' colors of points that are seen; of the others their own, by as much
    brighter or darker, channel by channel, as the photographs are on average."""
    if not seen.any():
        return shown
    shift = (shown[seen] - rgb[seen]).mean(axis=0)
    return np.asarray(np.where(seen[:, None], shown, (rgb + shift).clip(0.0, 1.0)))


def spread(points: Floats, normals: Floats, rgb: Floats, seen: NDArray[np.bool_]) -> Floats:
    """(N, 3) colors of the points of a part; those that are not seen fade, with distance and with
    the turn of their normals, from what is seen nearby to their own."""
    if not seen.any() or seen.all():
        return rgb
    reach = BESIDE * float(np.linalg.norm(np.ptp(points, axis=0)))
    places = np.concatenate([points / max(reach, 1e-9), TURNED * normals], axis=1)
    count = min(SPREAD_FROM, int(seen.sum()))
    off, index = cKDTree(places[seen]).query(places[~seen], k=count, distance_upper_bound=1.0)
    off, index = off.reshape(-1, count), index.reshape(-1, count)
    near = np.isfinite(off)
    shares = np.where(near, 1.0 / np.maximum(off, 1e-3), 0.0)
    beside = np.einsum("nk,nkc->nc", shares, rgb[seen][np.where(near, index, 0)])
    beside /= np.maximum(shares.sum(axis=1, keepdims=True), 1e-9)
    own = np.minimum(off[:, :1], 1.0) ** 2
    found = rgb.copy()
    found[~seen] = own * rgb[~seen] + (1.0 - own) * beside
    return found


def _scene(obj: ArticulatedObject, poses: Mapping[str, Floats]) -> EmbreeScene:
    triangles = [apply(poses[part.name], part.mesh.triangles) for part in obj.parts]
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, np.concatenate(triangles).astype(np.float32))
    return scene


def _seen(
    photo: Photo,
    inner: NDArray[np.bool_],
    object_from_rest: Floats,
    scene: EmbreeScene,
    points: Floats,
    normals: Floats,
) -> tuple[Floats, Floats]:
    """(N,) weight of a photograph for points, 0 where they are hidden, and (N, 3) its colors.

    Args:
        inner: (H, W) whether no background touches a pixel.
    """
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
    good[good] &= photo.rgba[row[good], column[good], 3] > OPAQUE
    near = np.flatnonzero(good)
    origins = np.broadcast_to(eye.astype(np.float32), (len(near), 3))
    rays = ways[near].astype(np.float32)
    reach = scene.run(np.ascontiguousarray(origins), rays, query="DISTANCE")
    good[near] = reach >= distance[near] * (1.0 - LIFT)
    weight = np.where(good, np.maximum(facing, 0.0) ** SQUARE, 0.0)
    weight[good] *= np.where(inner[row[good], column[good]], 1.0, RIM)
    color = np.zeros((len(points), 3))
    color[good] = photo.rgba[row[good], column[good], :3] / 255.0
    return weight, color
