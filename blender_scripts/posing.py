"""Parts where a shot wants them, alone or together, still or moving while the shutter is open."""

from collections.abc import Mapping, Sequence
from typing import Any

import bpy
from mathutils import Matrix

from artgen.core.errors import RenderError
from artgen.render_job import RenderJob, Shot

STEPS = 2
"""Cycles takes 2^STEPS + 1 poses while the shutter is open and runs straight between them."""


class Posing:
    """The parts of a job; only what differs from the shot before is touched, as whatever is touched
    is synchronized anew."""

    def __init__(self, parts: Mapping[str, bpy.types.Object], task: RenderJob) -> None:
        self._parts = dict(parts)
        self._task = task
        self._rest = {name: node.matrix_world.copy() for name, node in parts.items()}
        self._state: int | None = None
        self._shown: dict[str, list[Any]] = {}
        for number, name in enumerate(sorted(parts)):
            parts[name].pass_index = number + 1

    def show(self, shot: Shot) -> None:
        """Pose all parts, hide those that the shot does without.

        Raises:
            RenderError: the shot shows a part that is not there.
        """
        if shot.part is not None and shot.part not in self._parts:
            raise RenderError(
                f"shot {shot.file} shows {shot.part!r}; {self._task.glb} has "
                f"{', '.join(sorted(self._parts))}"
            )
        if shot.state != self._state:
            self._pose(shot.state)
            self._state = shot.state
        for name, node in self._parts.items():
            hidden = shot.part not in (None, name)
            if node.hide_render != hidden:
                node.hide_render = hidden

    def _pose(self, state: int) -> None:
        poses = self._task.states[state]
        moments = self._task.exposures[state] if self._task.exposures else ()
        for name, node in self._parts.items():
            shown = [poses[name], *(moment[name] for moment in moments)]
            if shown == self._shown.get(name):
                continue
            self._shown[name] = shown
            node.animation_data_clear()
            node.matrix_world = Matrix(poses[name]) @ self._rest[name]
            if any(pose != shown[0] for pose in shown):
                _move(node, shown[1:], self._rest[name])


def _move(node: bpy.types.Object, poses: Sequence[Any], rest: Matrix) -> None:
    """Keyframes from frame 0 to 1, straight in between."""
    node.rotation_mode = "QUATERNION"
    node.cycles.motion_steps = STEPS
    turn = None
    for k, pose in enumerate(poses):
        place, rotation, _ = (Matrix(pose) @ rest).decompose()
        if turn is not None:
            rotation.make_compatible(turn)
        turn = rotation
        node.location, node.rotation_quaternion = place, rotation
        for path in ("location", "rotation_quaternion"):
            node.keyframe_insert(path, frame=k / (len(poses) - 1))
    for curve in node.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
