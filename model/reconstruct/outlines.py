"""Which rays of the photographs meet which part, while parts are moved.

An acceleration structure costs more than the rays that are shot at it. So a part has one, at rest;
where the part is moved, rays are taken back to it instead, and answers are kept.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import inverted
from model.batch import Images
from model.reconstruct.guess import JointGuess, ObjectGuess, PartGuess

Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True, eq=False)
class Silhouettes:
    """Foregrounds of T states by V views, with rays through the middles of their pixels.

    Attributes:
        mask: (T, V, N) whether a pixel is foreground.
        origins: (T, V, 3) m, zero at the sphere's middle.
        ways: (T, V, N, 3) directions of the rays.
    """

    mask: Mask
    origins: Floats
    ways: Floats


def silhouettes(images: Images, radius: float) -> Silhouettes:
    """Those of one object's images, whose cameras are in radii of `radius` m."""
    alpha = images.alpha_BTVHW[0].double().numpy()
    states, views, height, width = alpha.shape
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    pixels = np.stack([x.ravel(), y.ravel(), np.ones(height * width)], axis=1)
    matrices = images.intrinsics_BTV33[0].double().numpy()
    poses = images.camera_from_world_BTV44[0].double().numpy()
    origins, ways = np.zeros((states, views, 3)), np.zeros((states, views, height * width, 3))
    for t, v in np.ndindex(states, views):
        local = pixels @ np.linalg.inv(matrices[t, v]).T
        ways[t, v] = local @ poses[t, v, :3, :3]
        origins[t, v] = radius * inverted(poses[t, v])[:3, 3]
    return Silhouettes(mask=alpha.reshape(states, views, -1) > 0.5, origins=origins, ways=ways)


class Outlines:
    """The parts of a guess as the cameras of `seen` see each of them alone."""

    def __init__(self, guess: ObjectGuess, seen: Silhouettes) -> None:
        self._seen = seen
        self._scenes = {part.slot: _scene(part) for part in guess.parts}
        self._kept: dict[tuple[int, int, bytes], Mask] = {}

    def of(self, guess: ObjectGuess) -> list[Mask]:
        """(T, V, N) rays that meet a part, of every part; a guess of the same parts."""
        states = range(len(self._seen.mask))
        poses = [poses_of(guess, t) for t in states]
        return [
            np.stack([self._met(part.slot, t, poses[t][part.slot]) for t in states])
            for part in guess.parts
        ]

    def agreement(self, guess: ObjectGuess) -> float:
        """Mean IoU of the silhouettes of a guess, moved as it says, with those that were seen."""
        return overlap(self.of(guess), self._seen)

    def _met(self, slot: int, state: int, pose: Floats) -> Mask:
        key = slot, state, pose.tobytes()
        if key not in self._kept:
            self._kept[key] = self._cast(slot, state, inverted(pose))
        return self._kept[key]

    def _cast(self, slot: int, state: int, rest_from_object: Floats) -> Mask:
        turn, shift = rest_from_object[:3, :3], rest_from_object[:3, 3]
        ways = (self._seen.ways[state] @ turn.T).astype(np.float32)
        starts = (self._seen.origins[state] @ turn.T + shift).astype(np.float32)
        starts = np.broadcast_to(starts[:, None], ways.shape).reshape(-1, 3)
        hit = self._scenes[slot].run(np.ascontiguousarray(starts), ways.reshape(-1, 3))
        return np.asarray((hit >= 0).reshape(ways.shape[:2]))


def poses_of(guess: ObjectGuess, state: int) -> dict[int, Floats]:
    """Slot to (4, 4) where a part at rest is in a state of the images; parents that run in a circle
    count as the base."""
    joints = {joint.slot: joint for joint in guess.joints}
    found = {}
    for part in guess.parts:
        pose, slot, passed = np.eye(4), part.slot, set[int]()
        while slot in joints and slot not in passed:
            pose = _motion(joints[slot], float(joints[slot].observed[state])) @ pose
            passed.add(slot)
            slot = joints[slot].parent
        found[part.slot] = pose
    return found


def _motion(joint: JointGuess, q: float) -> Floats:
    """(4, 4) what a joint does at q."""
    pose = np.eye(4)
    length = math.hypot(*joint.axis.tolist())
    if length < 1e-6:
        return pose
    axis = joint.axis / length
    if joint.type == "prismatic":
        pose[:3, 3] = q * axis
        return pose
    pose[:3, :3] = axis_angle_matrix(axis.tolist(), q)
    pose[:3, 3] = joint.origin - pose[:3, :3] @ joint.origin
    return pose


def overlap(masks: Iterable[Mask], seen: Silhouettes) -> float:
    """Mean IoU, over all images, of what parts cover together with what is foreground."""
    shown = np.logical_or.reduce(list(masks))
    both, either = (shown & seen.mask).sum(axis=-1), (shown | seen.mask).sum(axis=-1)
    return float((both / np.maximum(either, 1)).mean())


def _scene(part: PartGuess) -> EmbreeScene:
    scene = EmbreeScene()
    TriangleMesh(scene, part.vertices[part.faces].astype(np.float32))
    return scene
