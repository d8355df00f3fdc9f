"""Which scenes a plan's shots show, and what is in the way of light in each."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from artgen.core.mesh import Floats
from artgen.export.glb_content import Skin
from artgen.render_job import Shot
from renders.fast.light import Shine
from renders.fast.occlusion import Cloud, Occlusion, fitted, occlusion, strewn

PX_PER_CELL = 5
"""Grids are as fine as images: this many pixels a cell, along a cube's side, within bounds."""
WHOLE_CELLS = (24, 48)
"""Along a cube's side, around all parts: 15 to 30 mm each for furniture at 256 px."""
PART_CELLS = (10, 14)
"""Around one part, which also fills fewer pixels."""
SPACING = 0.5
"""Cells between points on a surface."""
TOGETHER = 16
"""Grids computed at once, which bounds memory."""

Scene = tuple[str | None, bytes]
"""The only part shown, or None for all, and the poses."""


def scene_of(shot: Shot, poses: Sequence[Mapping[str, Floats]]) -> Scene:
    """What the shot shows; equal scenes look the same from every side."""
    shown = poses[shot.state] if shot.part is None else {shot.part: poses[shot.state][shot.part]}
    return shot.part, b"".join(np.asarray(pose).tobytes() for pose in shown.values())


def occlusions(
    skins: Sequence[Skin],
    shots: Sequence[Shot],
    poses: Sequence[Mapping[str, Floats]],
    light: Shine,
    *,
    size: int,
) -> dict[Scene, Occlusion]:
    """By scene; scenes without an opaque surface are left out.

    Args:
        skins: the opaque ones.
        size: of the images, px.
    """
    whole, single = (
        min(max(size // PX_PER_CELL, least), most) ** 3 for least, most in (WHOLE_CELLS, PART_CELLS)
    )
    clouds = _part_clouds(skins, whole, single)
    scenes = {scene_of(shot, poses): shot for shot in shots}
    found: dict[Scene, Occlusion] = {}
    for alone, cells in ((False, whole), (True, single)):
        wanted = {
            scene: cloud
            for scene, shot in scenes.items()
            if (shot.part is not None) == alone
            and (cloud := _posed(clouds, poses[shot.state], shot.part)) is not None
        }
        for some in _batches(list(wanted)):
            grids = occlusion([wanted[scene] for scene in some], light, cells=cells)
            found.update(zip(some, grids, strict=True))
    return found


def _part_clouds(skins: Sequence[Skin], whole: int, single: int) -> dict[str, Cloud]:
    """Points on every part at rest, dense enough that no cell of either grid misses a surface."""
    triangles: dict[str, list[Floats]] = {}
    for skin in skins:
        triangles.setdefault(skin.part, []).append(skin.vertices[skin.faces])
    corners = {part: np.concatenate(lists) for part, lists in triangles.items()}
    if not corners:
        return {}
    coarse = _cell(np.concatenate(list(corners.values())), whole)
    return {
        part: strewn(own, SPACING * min(coarse, _cell(own, single)))
        for part, own in corners.items()
    }


def _cell(corners: Floats, cells: int) -> float:
    """Cell size (m) of a grid around triangles (F, 3, 3)."""
    sizes, _ = fitted(np.ptp(corners.reshape(-1, 3), axis=0)[None], cells)
    return float(sizes[0])


def _posed(
    clouds: Mapping[str, Cloud], poses: Mapping[str, Floats], part: str | None
) -> Cloud | None:
    shown = [name for name in clouds if part in (None, name)]
    if not shown:
        return None
    return Cloud(
        points=np.concatenate([_moved(clouds[name].points, poses[name]) for name in shown], axis=1),
        areas=np.concatenate([clouds[name].areas for name in shown]),
    )


def _moved(points: Floats, pose: Floats) -> Floats:
    """(3, N) points after a rigid motion."""
    return np.asarray(pose[:3, :3] @ points + pose[:3, 3:])


def _batches(scenes: Sequence[Scene]) -> Iterator[Sequence[Scene]]:
    for start in range(0, len(scenes), TOGETHER):
        yield scenes[start : start + TOGETHER]
