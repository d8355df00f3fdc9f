"""The visual hull: points of space that every camera of a state sees in its foreground.

It tells whether cameras and images belong together, and where the object is.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import apply, inverted
from model.reconstruct.cameras import OPENCV_FROM_OPENGL
from model.reconstruct.capture import Capture

GRID = 40
"""Points along each side of the space that is searched."""
ROUNDS = 3
"""How often the space is narrowed to the hull."""
GOOD = 0.85
"""Share of the foreground that the hull covers, if cameras and images belong together: right ones
cover 0.99, other conventions of a chunky object up to 0.62, views in another order up to 0.78."""
WIDEST = 3.0
"""Half side of the first search space, as a multiple of the largest foreground at its distance."""

Bools = NDArray[np.bool_]
READINGS: Mapping[str, Callable[[Floats], Floats]] = {
    "OpenGL axes (x right, y up, z back)": lambda pose: OPENCV_FROM_OPENGL @ pose,
    "the inverse, world_from_camera": inverted,
    "world_from_camera with OpenGL axes": lambda pose: OPENCV_FROM_OPENGL @ inverted(pose),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class VisualHull:
    """Where the object may be.

    Attributes:
        points: T arrays (N, 3) inside the hull of each state, world.
        step: distance of neighboring points.
        covered: share of all foreground pixels that the hulls cover, the least of all views.
    """

    points: tuple[Floats, ...]
    step: float
    covered: float


def check_cameras(capture: Capture) -> VisualHull:
    """The hull of a capture whose cameras agree with its images.

    Raises:
        ModelError: they do not; the message names the convention that would agree, if one does.
    """
    hull = visual_hull(capture, capture.camera_from_world)
    if hull.covered >= GOOD:
        return hull
    for words, change in READINGS.items():
        poses = np.array([[change(pose) for pose in row] for row in capture.camera_from_world])
        other = visual_hull(capture, poses)
        if other.covered >= GOOD:
            raise ModelError(
                f"{capture.files[0][0].parent}: seen through these cameras the masks share a hull "
                f"that covers {hull.covered:.0%} of them, but {other.covered:.0%} if the poses are "
                f"{words}; state camera_from_world with OpenCV axes (x right, y down, z forward), "
                "or mark the views as opengl"
            )
    raise ModelError(
        f"{capture.files[0][0].parent}: seen through these cameras the masks share a hull that "
        f"covers {hull.covered:.0%} of them, expected {GOOD:.0%}; check that poses, intrinsics, "
        "states and masks belong to these images"
    )


def visual_hull(capture: Capture, poses: Floats) -> VisualHull:
    """The hull of every state, found by narrowing a grid around where the views meet."""
    masks = capture.rgba[..., 3] > 127
    rays = _mask_rays(masks, capture.intrinsics, poses)
    middle = _meeting_point(*rays)
    depth = np.linalg.norm(rays[0] - middle, axis=1)
    half = WIDEST * float((depth * _widths(masks, capture.intrinsics)).max()) / 2.0
    found: list[Floats] = []
    for _ in range(ROUNDS):
        axis = np.linspace(-half, half, GRID)
        grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        grid = grid + middle
        found = [
            grid[_inside(grid, masks[t], capture.intrinsics[t], poses[t])]
            for t in range(len(masks))
        ]
        every = np.concatenate(found)
        if not len(every):
            return VisualHull(points=tuple(found), step=0.0, covered=0.0)
        low, high = every.min(axis=0), every.max(axis=0)
        step = float(axis[1] - axis[0])
        middle, half = (low + high) / 2.0, float((high - low).max()) / 2.0 + 2.0 * step
    return VisualHull(
        points=tuple(found),
        step=step,
        covered=min(
            _covered(found[t], step, masks[t], capture.intrinsics[t], poses[t])
            for t in range(len(masks))
        ),
    )


def _mask_rays(masks: Bools, intrinsics: Floats, poses: Floats) -> tuple[Floats, Floats]:
    """Camera centers (N, 3) and unit directions through the middles of the masks, world."""
    origins, ways = [], []
    for mask, matrix, pose in zip(
        masks.reshape(-1, *masks.shape[2:]),
        intrinsics.reshape(-1, 3, 3),
        poses.reshape(-1, 4, 4),
        strict=True,
    ):
        rows, columns = np.nonzero(mask)
        middle = np.array([columns.mean() + 0.5, rows.mean() + 0.5, 1.0])
        way = pose[:3, :3].T @ np.linalg.solve(matrix, middle)
        origins.append(inverted(pose)[:3, 3])
        ways.append(way / np.linalg.norm(way))
    return np.array(origins), np.array(ways)


def _meeting_point(origins: Floats, ways: Floats) -> Floats:
    """The point nearest to all rays; far rays alike pull it to a finite place."""
    across = np.eye(3) - ways[:, :, None] * ways[:, None, :]
    system = across.sum(axis=0) + 1e-6 * np.eye(3)
    return np.linalg.solve(system, np.einsum("nij,nj->i", across, origins))


def _widths(masks: Bools, intrinsics: Floats) -> Floats:
    """(N,) longer side of each mask, as a slope."""
    found = []
    for mask, matrix in zip(
        masks.reshape(-1, *masks.shape[2:]), intrinsics.reshape(-1, 3, 3), strict=True
    ):
        rows, columns = np.nonzero(mask)
        spans = np.ptp(rows) + 1.0, np.ptp(columns) + 1.0
        found.append(max(spans[0] / matrix[1, 1], spans[1] / matrix[0, 0]))
    return np.array(found)


def _projected(points: Floats, matrix: Floats, pose: Floats) -> tuple[Floats, Bools]:
    """(N, 2) px of points, and which lie in front of the camera."""
    local = apply(pose, points)
    ahead = local[:, 2] > 1e-6
    depth = np.where(ahead, local[:, 2], 1.0)
    return (local[:, :2] / depth[:, None]) @ matrix[:2, :2].T + matrix[:2, 2], ahead


def _inside(grid: Floats, masks: Bools, intrinsics: Floats, poses: Floats) -> Bools:
    """(N,) which points all views of a state show as foreground."""
    kept = np.ones(len(grid), bool)
    height, width = masks.shape[1:]
    for mask, matrix, pose in zip(masks, intrinsics, poses, strict=True):
        pixel, ahead = _projected(grid, matrix, pose)
        column, row = np.floor(pixel).astype(np.int64).T
        within = ahead & (column >= 0) & (column < width) & (row >= 0) & (row < height)
        kept &= within
        kept[within] &= mask[row[within], column[within]]
    return kept


def _covered(points: Floats, step: float, masks: Bools, intrinsics: Floats, poses: Floats) -> float:
    """The least share of a view's foreground that lies within a step of a projected point."""
    if not len(points):
        return 0.0
    least = 1.0
    for mask, matrix, pose in zip(masks, intrinsics, poses, strict=True):
        pixel, _ = _projected(points, matrix, pose)
        depth = float(np.median(apply(pose, points)[:, 2]))
        reach = max(1, int(np.ceil(0.75 * step * matrix[0, 0] / max(depth, 1e-6))))
        shape = tuple(side // reach + 2 for side in mask.shape)
        seen = np.zeros(shape, bool)
        column, row = np.floor(pixel / reach).astype(np.int64).T
        inside = (column >= 0) & (row >= 0) & (column < shape[1]) & (row < shape[0])
        seen[row[inside], column[inside]] = True
        rows, columns = np.nonzero(mask)
        least = min(least, float(_thick(seen)[rows // reach, columns // reach].mean()))
    return least


def _thick(seen: Bools) -> Bools:
    """Each cell and its eight neighbors."""
    padded = np.pad(seen, 1)
    height, width = seen.shape
    return np.any(
        [padded[i : i + height, j : j + width] for i in range(3) for j in range(3)], axis=0
    )
