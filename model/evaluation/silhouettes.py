"""What a camera sees of each part alone and of all together, by rays against its surface or box."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.geometry.solid import slab
from model.evaluation.boxes import corners
from model.evaluation.images import Mask, mask_iou
from model.evaluation.layout import Layout
from model.evaluation.matching import Matching

VIEWS = tuple(
    orbit_direction(math.radians(azimuth), math.radians(elevation))
    for azimuth, elevation in ((-35.0, 25.0), (35.0, 10.0), (0.0, 60.0), (145.0, 25.0))
)
"""From the object to the eye: front left, front right, from above, from behind."""
SHARES = (0.0, 0.5, 1.0)
"""Of the way of every joint from rest to its far end."""
FIELD_OF_VIEW = math.radians(40.0)
THINNEST = 1e-4
"""Share of the radius to which boxes without thickness are thickened, to be seen at all."""


@dataclass(frozen=True, kw_only=True)
class MaskScores:
    """Means of mask IoU over views and states.

    Attributes:
        base: of the base alone, with nothing in front of it.
        moving: of true moving parts alone; 0 for those that no predicted part stands for.
        composite: of the whole object.
    """

    base: float | None
    moving: float | None
    composite: float | None


def mask_scores(
    predicted: Layout, true: Layout, matchings: Mapping[str, Matching], *, pixels: int
) -> dict[str, MaskScores]:
    """Amodal masks of matched parts and of everything, at `VIEWS` and `SHARES`, by matching.

    Each layout opens its joints by the same share of its own ranges; cameras follow the true one.
    """
    tallies = {name: _Tally() for name in matchings}
    for share in SHARES:
        mine, theirs = (placed_triangles(own, share) for own in (predicted, true))
        for camera in cameras(true, pixels):
            seen, wanted = masks(mine, camera), masks(theirs, camera)
            for name, matching in matchings.items():
                tallies[name].add(seen, wanted, matching, true)
    return {name: tally.scores() for name, tally in tallies.items()}


class _Tally:
    """IoU of masks as they come."""

    def __init__(self) -> None:
        self._base: list[float | None] = []
        self._moving: list[float | None] = []
        self._composite: list[float | None] = []

    def add(self, seen: Mask, wanted: Mask, matching: Matching, true: Layout) -> None:
        """One view of one state."""
        self._composite.append(mask_iou(seen.any(axis=0), wanted.any(axis=0)))
        for p, t in matching.pairs:
            own = mask_iou(seen[p], wanted[t])
            if t == 0:
                self._base.append(own)
            elif true.movable[t]:
                self._moving.append(own)
        self._moving += [0.0 for t in matching.loose_true if true.movable[t]]

    def scores(self) -> MaskScores:
        """Their means."""
        return MaskScores(
            base=_mean(self._base), moving=_mean(self._moving), composite=_mean(self._composite)
        )


def placed_triangles(layout: Layout, share: float) -> list[Floats]:
    """(F, 3, 3) triangles of each part at a share of the way, or of its box."""
    poses = layout.poses(layout.opened(share))
    return [apply(pose, part_triangles(layout, part)) for part, pose in enumerate(poses)]


def part_triangles(layout: Layout, part: int) -> Floats:
    """(F, 3, 3) triangles of a part at rest, or of its box."""
    mesh = layout.meshes[part] if layout.meshes else None
    if mesh is not None:
        return mesh.triangles
    box, thin = layout.boxes[part], THINNEST * max(layout.radius, 1e-12)
    middle, half = box.mean(axis=0), np.maximum((box[1] - box[0]) / 2.0, thin)
    return slab(middle - half, middle + half).trimesh().triangles


def cameras(true: Layout, pixels: int) -> list[Camera]:
    """One for each of `VIEWS`; all of them hold the object at every share of its way."""
    points = []
    for share in SHARES:
        poses = true.poses(true.opened(share))
        points += [apply(pose, corners(box)) for pose, box in zip(poses, true.boxes, strict=True)]
    cloud = np.concatenate(points)
    size = (pixels, pixels)
    return [framed(cloud, direction=view, fov=FIELD_OF_VIEW, size=size, fill=0.9) for view in VIEWS]


def masks(parts: list[Floats], camera: Camera) -> Mask:
    """(P, H, W) what is seen of each part alone."""
    return np.stack([hit_triangles(triangles, camera) >= 0 for triangles in parts])


def hit_triangles(triangles: Floats, camera: Camera) -> Floats:
    """(H, W) index of the triangle that each pixel's center sees, -1 for none."""
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, np.ascontiguousarray(triangles, np.float32))
    origin, directions = camera.rays()
    rays = np.ascontiguousarray(directions.reshape(-1, 3), np.float32)
    origins = np.broadcast_to(origin, rays.shape).astype(np.float32)
    width, height = camera.size
    return np.asarray(scene.run(origins, rays)).reshape(height, width)


def _mean(values: list[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.mean(known)) if known else None
