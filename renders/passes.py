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
    corners: Sequence[Floats],
    shown: Sequence[Sequence[Mapping[str, Floats]]],
    cameras: Sequence[Camera],
    *,
    samples: int,
    part_samples: int,
) -> Passes:
    """All images of T states x V cameras; a part that is posed alike in two states is rendered once
    a camera.

    Args:
        corners: (N, 3) of each part's hull at rest, m.
        shown: part name to `object_from_rest`, for every pose that an image of state t shows: the
            state, and those while the shutter is open.
    """
    shots: list[Shot] = []
    rendered: dict[bytes, list[int | None]] = {}
    composite, alone, boxes = [], [], []
    for t, poses in enumerate(shown):
        composite.append(tuple(range(len(shots), len(shots) + len(cameras))))
        for v, camera in enumerate(cameras):
            shots.append(_shot(len(shots), v, t, None, (0, 0, *camera.size), samples))
        columns, windows_of = [], []
        for name, points in zip(names, corners, strict=True):
            matrices = np.array([pose[name] for pose in poses])
            seen = windows(cameras, np.concatenate([apply(m, points) for m in matrices]))
            key = name.encode() + matrices.tobytes()
            if key not in rendered:
                rendered[key] = _add(shots, seen, state=t, part=name, samples=part_samples)
            columns.append(rendered[key])
            windows_of.append(seen)
        alone.append(tuple(zip(*columns, strict=True)))
        boxes.append(tuple(zip(*windows_of, strict=True)))
    return Passes(
        shots=tuple(shots), composite=tuple(composite), alone=tuple(alone), boxes=tuple(boxes)
    )


def _add(
    shots: list[Shot], seen: Sequence[Box], *, state: int, part: str, samples: int
) -> list[int | None]:
    """Append a shot of the part for every camera that sees it; their numbers."""
    numbers: list[int | None] = []
    for camera, box in enumerate(seen):
        numbers.append(len(shots) if _area(box) else None)
        if _area(box):
            shots.append(_shot(len(shots), camera, state, part, box, samples))
    return numbers


def windows(cameras: Sequence[Camera], points: Floats) -> list[Box]:
    """For each camera the smallest whole-pixel window that holds the projection of (N, 3) points
    and its soft edge, cut to the image; all points lie in front of the cameras."""
    size = np.array([camera.size for camera in cameras])
    pixels = np.stack([camera.project(points)[:, :2] for camera in cameras])
    low = np.maximum(np.floor(pixels.min(axis=1)).astype(int) - APRON, 0)
    high = np.minimum(np.ceil(pixels.max(axis=1)).astype(int) + APRON, size)
    return [
        (left, top, right, bottom) if right > left and bottom > top else (0, 0, 0, 0)
        for (left, top), (right, bottom) in zip(low.tolist(), high.tolist(), strict=True)
    ]


def _area(box: Box) -> int:
    left, top, right, bottom = box
    return (right - left) * (bottom - top)


def _shot(number: int, camera: int, state: int, part: str | None, box: Box, samples: int) -> Shot:
    return Shot(
        file=f"{number:06d}.exr", camera=camera, state=state, part=part, box=box, samples=samples
    )
