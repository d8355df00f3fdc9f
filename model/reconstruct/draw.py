"""Quick pictures of an object without Blender: one ray a pixel, its texture, a lamp at the eye."""

import io
from collections.abc import Sequence

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from PIL import Image

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import ArticulatedObject, State
from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted

Bytes = NDArray[np.uint8]
DIM = 0.7
"""Brightness of a face seen edge on; colors of a reconstruction hold light already."""
MOST_SHADES = 128
"""Colors of a GIF's palette."""


class Painter:
    """An object whose one image lies on its atlas, ready to be drawn in any state.

    Args:
        image: (S, S, 3) uint8 sRGB on the atlas.
        dim: brightness of a face seen edge on; 1 shows the image as it is.
    """

    def __init__(self, obj: ArticulatedObject, image: Bytes, *, dim: float = DIM) -> None:
        self._dim = dim
        self._obj = obj
        self._image = image
        self._atlas = np.concatenate([np.asarray(part.mesh.atlas) for part in obj.parts])
        self._posed: tuple[State, EmbreeScene, Floats] | None = None

    def points(self, state: State) -> Floats:
        """(N, 3) corners of all triangles in a state, m."""
        return self._triangles(state).reshape(-1, 3)

    def paint(
        self, state: State, intrinsics: Floats, camera_from_object: Floats, size: tuple[int, int]
    ) -> Bytes:
        """(H, W, 4) uint8 sRGB with straight alpha, as a pinhole of `size` (width, height) px sees
        it."""
        scene, triangles = self._scene(state)
        width, height = size
        x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        pixels = np.stack([x.ravel(), y.ravel(), np.ones(width * height)], axis=1)
        local = pixels @ np.linalg.inv(intrinsics).T
        ways = local @ camera_from_object[:3, :3]
        eye = inverted(camera_from_object)[:3, 3]
        origins = np.broadcast_to(eye.astype(np.float32), ways.shape)
        hit = scene.run(np.ascontiguousarray(origins), ways.astype(np.float32))
        seen = np.flatnonzero(hit >= 0)
        picture = np.zeros((height * width, 4), np.uint8)
        picture[seen, :3] = self._colors(triangles, hit[seen], eye, ways[seen])
        picture[seen, 3] = 255
        return picture.reshape(height, width, 4)

    def _triangles(self, state: State) -> Floats:
        poses = forward_kinematics(self._obj.base.name, self._obj.joints, state)
        return np.concatenate(
            [apply(poses[part.name], part.mesh.triangles) for part in self._obj.parts]
        )

    def _scene(self, state: State) -> tuple[EmbreeScene, Floats]:
        if self._posed is None or self._posed[0] != dict(state):
            triangles = self._triangles(state)
            scene = EmbreeScene(robust=True)
            TriangleMesh(scene, triangles.astype(np.float32))
            self._posed = dict(state), scene, triangles
        return self._posed[1:]

    def _colors(
        self, triangles: Floats, hit: NDArray[np.int32], eye: Floats, ways: Floats
    ) -> Bytes:
        """(N, 3) what rays show that meet triangles."""
        a, b, c = triangles[hit].transpose(1, 0, 2)
        across = np.cross(b - a, c - a)
        slope = np.einsum("ij,ij->i", across, ways)
        depth = np.einsum("ij,ij->i", across, a - eye) / np.where(slope == 0.0, 1.0, slope)
        point = eye + depth[:, None] * ways
        area = np.einsum("ij,ij->i", across, across).clip(min=1e-300)
        v = np.einsum("ij,ij->i", across, np.cross(point - a, c - a)) / area
        w = np.einsum("ij,ij->i", across, np.cross(b - a, point - a)) / area
        weights = np.clip(np.stack([1.0 - v - w, v, w], axis=1), 0.0, 1.0)
        place = np.einsum("nc,nck->nk", weights, self._atlas[hit])
        side = len(self._image)
        column = (place[:, 0] * side).astype(np.int64).clip(0, side - 1)
        row = ((1.0 - place[:, 1]) * side).astype(np.int64).clip(0, side - 1)
        length = np.sqrt(area) * np.linalg.norm(ways, axis=1)
        shade = self._dim + (1.0 - self._dim) * np.abs(slope) / length
        return np.rint(self._image[row, column] * shade[:, None]).astype(np.uint8)


def over(rgba: Bytes, color: Sequence[int]) -> Bytes:
    """(H, W, 3) a picture on a plain ground."""
    alpha = rgba[..., 3:].astype(float) / 255.0
    return np.rint(rgba[..., :3] * alpha + np.array(color) * (1.0 - alpha)).astype(np.uint8)


def gif_bytes(frames: Sequence[Bytes], *, seconds: float) -> bytes:
    """An endless GIF of (H, W, 3) frames that takes `seconds` for a round."""
    shades = Image.fromarray(np.concatenate([frames[0], frames[len(frames) // 2]])).quantize(
        MOST_SHADES
    )
    pictures = [
        Image.fromarray(frame).quantize(palette=shades, dither=Image.Dither.NONE)
        for frame in frames
    ]
    buffer = io.BytesIO()
    pictures[0].save(
        buffer,
        "GIF",
        save_all=True,
        append_images=pictures[1:],
        duration=round(1000.0 * seconds / len(frames)),
        loop=0,
        optimize=False,
    )
    return buffer.getvalue()
