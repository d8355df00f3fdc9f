"""Labels of a sample: depth and normal of every part alone, and what the nearest part shows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.camera import Camera
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.dataset.sample import BACKGROUND
from renders.paint import Paint
from renders.raycast import Box, Hits, PartCaster, View

Singles = NDArray[np.float32]
Bytes = NDArray[np.uint8]


@dataclass(frozen=True, kw_only=True, eq=False)
class Labels:
    """What V cameras see in T states, for P parts.

    Attributes:
        part_id: (T, V, H, W) index of the nearest part, 255 where there is none.
        depth: (T, V, H, W) m along the camera's z; 0 is background.
        normal: (T, V, H, W, 3) unit, world, smooth over creases as shading is; 0 is background.
        part_depth: (T, V, P, H, W), each part alone.
        part_normal: (T, V, P, H, W, 3), each part alone.
        albedo: (T, V, H, W, 3) sRGB base color, or None; 0 is background.
        roughness: (T, V, H, W) 255 is 1, or None; 0 is background.
        flow: (T, V, H, W, 2) px to where the surface point is in the next state, or None; 0 is
            background, and all of the last state.
    """

    part_id: Bytes
    depth: Singles
    normal: Singles
    part_depth: Singles
    part_normal: Singles
    albedo: Bytes | None = None
    roughness: Bytes | None = None
    flow: Singles | None = None


def cast_labels(
    casters: Sequence[PartCaster],
    poses: Sequence[Sequence[Floats]],
    cameras: Sequence[Camera],
    boxes: Sequence[Sequence[Sequence[Box]]],
    *,
    paint: Sequence[Paint] | None = None,
    moving: bool = False,
) -> Labels:
    """Labels of all parts; the composite is the nearest over the parts, so both always agree.

    A part that stands still between two states is cast once a camera.

    Args:
        poses: [state][part] -> `object_from_rest`.
        boxes: [state][view][part] -> window px outside which no ray meets the part alone.
        paint: of each part; asks for albedo and roughness.
        moving: asks for flow.
    """
    canvas = _Canvas(len(poses), len(casters), cameras, painted=paint is not None, moving=moving)
    for v, camera in enumerate(cameras):
        view, known = View(camera), dict[tuple[int, bytes], Hits]()
        for t, pose in enumerate(poses):
            met = []
            for p, caster in enumerate(casters):
                key = (p, pose[p].tobytes())
                if key not in known:
                    known[key] = caster.cast(view, pose[p], boxes[t][v][p])
                met.append(known[key])
            for p, shown in enumerate(canvas.put_geometry(t, v, met)):
                if paint is not None:
                    canvas.put_paint(t, v, shown, paint[p])
                if moving and t + 1 < len(poses):
                    canvas.put_flow(t, v, shown, camera, (pose[p], poses[t + 1][p]))
    return canvas.labels


class _Canvas:
    """Images filled hit by hit; what no ray meets is never touched, and costs no memory."""

    def __init__(
        self, states: int, parts: int, cameras: Sequence[Camera], *, painted: bool, moving: bool
    ) -> None:
        width, height = cameras[0].size
        whole, alone = (states, len(cameras)), (states, len(cameras), parts)
        image = (height, width)
        self.labels = Labels(
            part_id=np.full((*whole, *image), BACKGROUND, np.uint8),
            depth=np.zeros((*whole, *image), np.float32),
            normal=np.zeros((*whole, *image, 3), np.float32),
            part_depth=np.zeros((*alone, *image), np.float32),
            part_normal=np.zeros((*alone, *image, 3), np.float32),
            albedo=np.zeros((*whole, *image, 3), np.uint8) if painted else None,
            roughness=np.zeros((*whole, *image), np.uint8) if painted else None,
            flow=np.zeros((*whole, *image, 2), np.float32) if moving else None,
        )
        self._pixels = width * height

    def put_geometry(self, t: int, v: int, met: Sequence[Hits]) -> list[Hits]:
        """Write depths, normals and ids of one view; of each part, the hits that are nearest."""
        nearest = np.full(self._pixels, np.inf)
        owner = self.labels.part_id[t, v].reshape(-1)
        for p, hits in enumerate(met):
            self.labels.part_depth[t, v, p].reshape(-1)[hits.pixel] = hits.depth
            self.labels.part_normal[t, v, p].reshape(-1, 3)[hits.pixel] = hits.normal
            before = hits.depth < nearest[hits.pixel]
            nearest[hits.pixel[before]] = hits.depth[before]
            owner[hits.pixel[before]] = p
        seen = [hits.of(owner[hits.pixel] == p) for p, hits in enumerate(met)]
        for hits in seen:
            self.labels.depth[t, v].reshape(-1)[hits.pixel] = hits.depth
            self.labels.normal[t, v].reshape(-1, 3)[hits.pixel] = hits.normal
        return seen

    def put_paint(self, t: int, v: int, hits: Hits, paint: Paint) -> None:
        """Write albedo and roughness."""
        if self.labels.albedo is not None and self.labels.roughness is not None:
            albedo, roughness = paint.at(hits)
            self.labels.albedo[t, v].reshape(-1, 3)[hits.pixel] = albedo
            self.labels.roughness[t, v].reshape(-1)[hits.pixel] = roughness

    def put_flow(
        self, t: int, v: int, hits: Hits, camera: Camera, poses: tuple[Floats, Floats]
    ) -> None:
        """Write where the points go from the first pose to the second; still parts stay at 0."""
        if self.labels.flow is not None and not np.array_equal(*poses):
            now, then = (camera.project(apply(pose, hits.point))[:, :2] for pose in poses)
            self.labels.flow[t, v].reshape(-1, 2)[hits.pixel] = then - now


def poses_by_part(
    names: Sequence[str], poses: Sequence[Mapping[str, Floats]]
) -> list[list[Floats]]:
    """[state][part] of poses by name."""
    return [[np.asarray(pose[name]) for name in names] for pose in poses]
