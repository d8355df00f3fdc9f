"""How well a prediction agrees with the silhouettes, before anything is mended: guesses are ranked
by it, and where a part's field agrees worse than its predicted box, the box stands for it.
"""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from artgen.core.mesh import Floats
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import apply, inverted
from model.batch import Images
from model.reconstruct.guess import JointGuess, ObjectGuess, PartGuess
from model.reconstruct.shapes import boxed

BETTER = 0.01
"""By how much a part's box must agree better than its field, mean IoU of all images."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Silhouettes:
    """Foregrounds of T states by V views, with rays through the middles of their pixels.

    Attributes:
        mask: (T, V, N) whether a pixel is foreground.
        origins: (T, V, 3) m, zero at the sphere's middle.
        ways: (T, V, N, 3) directions of the rays.
    """

    mask: NDArray[np.bool_]
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


def agreement(guess: ObjectGuess, seen: Silhouettes) -> float:
    """Mean IoU of the silhouettes of a guess, moved as it says, with those that were seen."""
    found = []
    for t, v in np.ndindex(seen.mask.shape[:2]):
        if v == 0:
            scene = _scene(guess, t)
        ways = seen.ways[t, v].astype(np.float32)
        starts = np.broadcast_to(seen.origins[t, v].astype(np.float32), ways.shape)
        shown = scene.run(np.ascontiguousarray(starts), ways) >= 0
        mask = seen.mask[t, v]
        found.append(float((shown & mask).sum() / max(int((shown | mask).sum()), 1)))
    return float(np.mean(found))


def _scene(guess: ObjectGuess, state: int) -> EmbreeScene:
    poses = poses_of(guess, state)
    scene = EmbreeScene()
    triangles = [apply(poses[part.slot], part.vertices[part.faces]) for part in guess.parts]
    TriangleMesh(scene, np.concatenate(triangles).astype(np.float32))
    return scene


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


def agreeing(guess: ObjectGuess, seen: Silhouettes) -> ObjectGuess:
    """The guess with boxes for parts where boxes agree better.

    Fields as a whole and boxes as a whole are compared first; then each part, the largest first,
    may be the other of the two.
    """
    fields = {part.slot: part for part in guess.parts}
    boxes = {part.slot: boxed(part) for part in guess.parts}
    with_fields, with_boxes = agreement(guess, seen), agreement(_of(guess, boxes), seen)
    best, chosen, others = with_fields, fields, boxes
    if with_boxes > with_fields + BETTER:
        best, chosen, others = with_boxes, boxes, fields
    for slot in sorted(fields, key=lambda slot: -float(np.ptp(fields[slot].box, axis=0).prod())):
        tried = {**chosen, slot: others[slot]}
        value = agreement(_of(guess, tried), seen)
        if value > best + BETTER:
            best, chosen = value, tried
    text = (
        "a rounded box of the predicted size stands for its field; silhouettes agree to "
        f"{best:.2f} so, to {with_fields:.2f} by fields alone"
    )
    told = [(slot, text) for slot in chosen if chosen[slot].boxed and not fields[slot].boxed]
    return dataclasses.replace(_of(guess, chosen), told=(*guess.told, *told))


def _of(guess: ObjectGuess, parts: Mapping[int, PartGuess]) -> ObjectGuess:
    return dataclasses.replace(guess, parts=tuple(parts[part.slot] for part in guess.parts))
