"""Which images a sample consists of: the composite, and every part alone in its window."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.core.camera import Camera
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.render_job import Shot

Box = tuple[int, int, int, int]
APRON = 2
"""px around a part's projection that its soft edge may color; the pixel filter reaches 0.75 px."""


@dataclass(frozen=True, kw_only=True)
class Passes:
    """Shots, and which of them show what.

    Attributes:
        shots: every image that is rendered, once.
        composite: [state][view] -> shot.
        alone: [state][view][part] -> shot, or None where the part projects outside the image.
        boxes: [state][view][part] -> window px of the part alone.
    """

    shots: tuple[Shot, ...]
    composite: tuple[tuple[int, ...], ...]
    alone: tuple[tuple[tuple[int | None, ...], ...], ...]
    boxes: tuple[tuple[tuple[Box, ...], ...], ...]


def planned_passes(
    names: Sequence[str],
    vertices: Sequence[Floats],
    poses: Sequence[Mapping[str, Floats]],
    cameras: Sequence[Camera],
    *,
    samples: int,
    part_samples: int,
) -> Passes:
    """All images of T states x V cameras; a part that stands still between two states is rendered
    once a camera.

    Args:
        vertices: (N, 3) of each part at rest, m.
        poses: part name to `object_from_rest`, for each state.
    """
    shots: list[Shot] = []
    rendered: dict[tuple[str, int, bytes], int] = {}
    composite, alone, boxes = [], [], []
    for t, pose in enumerate(poses):
        windows = [
            [window(camera, apply(pose[n], v)) for n, v in zip(names, vertices, strict=True)]
            for camera in cameras
        ]
        own: list[list[int | None]] = [[None] * len(names) for _ in cameras]
        composite.append(tuple(range(len(shots), len(shots) + len(cameras))))
        for v, camera in enumerate(cameras):
            shots.append(_shot(len(shots), v, t, None, (0, 0, *camera.size), samples))
        for p, name in enumerate(names):
            for v in range(len(cameras)):
                if not _area(windows[v][p]):
                    continue
                key = (name, v, np.asarray(pose[name]).tobytes())
                if key not in rendered:
                    rendered[key] = len(shots)
                    shots.append(_shot(len(shots), v, t, name, windows[v][p], part_samples))
                own[v][p] = rendered[key]
        alone.append(tuple(tuple(row) for row in own))
        boxes.append(tuple(tuple(row) for row in windows))
    return Passes(
        shots=tuple(shots), composite=tuple(composite), alone=tuple(alone), boxes=tuple(boxes)
    )


def window(camera: Camera, points: Floats) -> Box:
    """The smallest whole-pixel window that holds the projection of (N, 3) points and its soft edge,
    cut to the image; all points lie in front of the camera."""
    pixels = camera.project(points)[:, :2]
    low = np.floor(pixels.min(axis=0)).astype(int) - APRON
    high = np.ceil(pixels.max(axis=0)).astype(int) + APRON
    left, top = (int(v) for v in np.maximum(low, 0))
    right, bottom = (int(v) for v in np.minimum(high, camera.size))
    return (left, top, right, bottom) if right > left and bottom > top else (0, 0, 0, 0)


def _area(box: Box) -> int:
    left, top, right, bottom = box
    return (right - left) * (bottom - top)


def _shot(number: int, camera: int, state: int, part: str | None, box: Box, samples: int) -> Shot:
    return Shot(
        file=f"{number:04d}.exr", camera=camera, state=state, part=part, box=box, samples=samples
    )
