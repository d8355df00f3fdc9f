"""Images of one object with their cameras: T states by V views, foreground in alpha, all alike."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from model.reconstruct.cameras import Rig, Shot
from model.reconstruct.masks import Bytes, Segmenter, foreground, mask_beside, read_rgba

FAR_OUTSIDE = 1.0
"""Image widths by which a principal point may lie outside; beyond, the intrinsics are of another
size."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Capture:
    """What was photographed. View k of all states was taken from about the same place.

    Attributes:
        files: T lists of V image paths.
        rgba: (T, V, H, W, 4) uint8, sRGB, straight alpha; alpha is the foreground.
        intrinsics: (T, V, 3, 3) px.
        camera_from_world: (T, V, 4, 4) rigid, OpenCV axes.
        states: numbers of the states in the camera file, ascending.
    """

    files: tuple[tuple[Path, ...], ...]
    rgba: Bytes
    intrinsics: Floats
    camera_from_world: Floats
    states: tuple[int, ...]

    def only(self, views: Sequence[int]) -> "Capture":
        """Some views of each state."""
        chosen = list(views)
        return Capture(
            files=tuple(tuple(row[k] for k in chosen) for row in self.files),
            rgba=self.rgba[:, chosen],
            intrinsics=self.intrinsics[:, chosen],
            camera_from_world=self.camera_from_world[:, chosen],
            states=self.states,
        )

    def in_states(self, places: Sequence[int]) -> "Capture":
        """Some states, by their places."""
        chosen = list(places)
        return Capture(
            files=tuple(self.files[k] for k in chosen),
            rgba=self.rgba[chosen],
            intrinsics=self.intrinsics[chosen],
            camera_from_world=self.camera_from_world[chosen],
            states=tuple(self.states[k] for k in chosen),
        )


def read_capture(
    images: Path, rig: Rig, *, masks: Path | None = None, segmenter: Segmenter | None = None
) -> Capture:
    """The images of a rig, grouped by state; the first in the order of the camera file, each later
    one in the order that brings its cameras nearest to those of the first.

    Raises:
        ModelError: an image is missing or of another size, has no foreground, or states have
            unequal numbers of views.
    """
    by_state: dict[int, list[Shot]] = {}
    for shot in rig.shots:
        by_state.setdefault(shot.state, []).append(shot)
    states = sorted(by_state)
    counts = {state: len(by_state[state]) for state in states}
    if len(set(counts.values())) != 1:
        told = ", ".join(f"state {state}: {count}" for state, count in counts.items())
        raise ModelError(
            f"{rig.file}: states have unequal numbers of views ({told}); give each as many, and "
            "check the state of every image"
        )
    grid = [paired(by_state[states[0]], by_state[state]) for state in states]
    files = tuple(tuple(images / shot.image for shot in row) for row in grid)
    pictures = [
        [_picture(images, shot, masks=masks, segmenter=segmenter) for shot in row] for row in grid
    ]
    _check_sizes(files, pictures)
    return Capture(
        files=files,
        rgba=np.array(pictures),
        intrinsics=np.array([[shot.intrinsics for shot in row] for row in grid]),
        camera_from_world=np.array([[shot.camera_from_world for shot in row] for row in grid]),
        states=tuple(states),
    )


def paired(first: Sequence[Shot], others: Sequence[Shot]) -> list[Shot]:
    """The other shots in the order of the first ones: the cameras of a pair are as near to each
    other as all pairs together allow."""
    _, order = linear_sum_assignment(cdist(_eyes(first), _eyes(others)))
    return [others[k] for k in order]


def _eyes(shots: Sequence[Shot]) -> Floats:
    """(V, 3) where the cameras stand."""
    return np.array([inverted(shot.camera_from_world)[:3, 3] for shot in shots])


def _picture(images: Path, shot: Shot, *, masks: Path | None, segmenter: Segmenter | None) -> Bytes:
    path = images / shot.image
    rgba = read_rgba(path)
    height, width = rgba.shape[:2]
    x, y = shot.intrinsics[0, 2] / width - 0.5, shot.intrinsics[1, 2] / height - 0.5
    if max(abs(x), abs(y)) > 0.5 + FAR_OUTSIDE:
        raise ModelError(
            f"{path}: its principal point {shot.intrinsics[:2, 2].tolist()} lies far outside of "
            f"{width} x {height} px; scale the intrinsics with the image"
        )
    mask = None
    if masks is not None:
        mask = mask_beside(masks, shot.image)
    elif shot.mask is not None:
        mask = images / shot.mask
    return foreground(rgba, path, mask=mask, segmenter=segmenter)


def _check_sizes(files: tuple[tuple[Path, ...], ...], pictures: list[list[Bytes]]) -> None:
    first = pictures[0][0].shape[:2]
    for paths, row in zip(files, pictures, strict=True):
        for path, picture in zip(paths, row, strict=True):
            if picture.shape[:2] != first:
                raise ModelError(
                    f"{path} is {picture.shape[1]} x {picture.shape[0]} px, {files[0][0]} is "
                    f"{first[1]} x {first[0]}; make all images of one size and scale their "
                    "intrinsics"
                )
