"""Which scenes a plan's shots show, and what is in the way of light in each."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from artgen.core.mesh import Floats
from artgen.render_job import Shot
from renders.fast.light import Shine
from renders.fast.occlusion import Cloud, Occlusion, occlusion, strewn
from renders.glb import Skin

PX_PER_CELL = 4
"""Grids are as fine as images: this many pixels a cell, along a cube's side, within bounds."""
WHOLE_CELLS = (24, 48)
"""Along a cube's side, around all parts: 15 to 30 mm each for furniture at 256 px."""
PART_CELLS = (12, 20)
"""Around one part, which also fills fewer pixels."""
FINENESS = 48.0
"""Points across the longest side of a part."""
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
    clouds = _part_clouds(skins)
    scenes = {scene_of(shot, poses): shot for shot in shots}
    found: dict[Scene, Occlusion] = {}
    for alone, (least, most) in ((False, WHOLE_CELLS), (True, PART_CELLS)):
        side = min(max(size // PX_PER_CELL, least), most)
        wanted = {
            scene: cloud
            for scene, shot in scenes.items()
            if (shot.part is not None) == alone
            and (cloud := _posed(clouds, poses[shot.state], shot.part)) is not None
        }
        for some in _batches(list(wanted)):
            grids = occlusion([wanted[scene] for scene in some], light, cells=side**3)
            found.update(zip(some, grids, strict=True))
    return found


def _part_clouds(skins: Sequence[Skin]) -> dict[str, Cloud]:
    """Points on every part at rest."""
    triangles: dict[str, list[Floats]] = {}
    for skin in skins:
        triangles.setdefault(skin.part, []).append(skin.vertices[skin.faces])
    clouds = {}
    for part, lists in triangles.items():
        corners = np.concatenate(lists)
        longest = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
        clouds[part] = strewn(corners, max(longest, 1e-9) / FINENESS)
    return clouds


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
