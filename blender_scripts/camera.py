"""Our cameras and crop windows in Blender's terms."""

from collections.abc import Sequence

import bpy
from mathutils import Matrix

from artgen.core.stated_camera import Row, StatedCamera

SENSOR = 36.0
"""mm; any value does, as the focal length follows from it."""


def add_camera(name: str, camera: StatedCamera) -> bpy.types.Object:
    """A Blender camera that sees what ours sees."""
    data = bpy.data.cameras.new(name)
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = SENSOR
    width, height = camera.size
    data.lens = SENSOR * camera.focal / width
    # Blender shifts the film, in widths of the image, so the principal point moves against it.
    data.shift_x = 0.5 - camera.principal[0] / width
    data.shift_y = (camera.principal[1] - height / 2.0) / width
    data.clip_start, data.clip_end = 1e-5, 1e6  # m; rays cost nothing more for either
    node = bpy.data.objects.new(name, data)
    node.matrix_world = Matrix(world_from_blender_camera(camera.camera_from_world))
    bpy.context.scene.collection.objects.link(node)
    return node


def world_from_blender_camera(camera_from_world: Sequence[Row]) -> list[list[float]]:
    """(4, 4) pose of a camera with Blender's axes: x right, y up, z backward.

    The inverse of a rigid matrix by transposition, then y and z turned around; in float64, as
    Blender's own matrices round to float32.
    """
    shift = [row[3] for row in camera_from_world[:3]]
    rows = []
    for k in range(3):
        right, down, forward = (row[k] for row in camera_from_world[:3])
        eye = -(right * shift[0] + down * shift[1] + forward * shift[2])
        rows.append([right, -down, -forward, eye])
    return [*rows, [0.0, 0.0, 0.0, 1.0]]


def set_window(scene: bpy.types.Scene, size: tuple[int, int], box: tuple[int, ...]) -> None:
    """Render only the window (left, top, right, bottom) px of an image of `size`.

    Blender floors border * size; half a pixel of head room keeps float32 from flooring one too low.
    """
    width, height = size
    left, top, right, bottom = box
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x = _edges(left, right, width)
    render.border_min_y, render.border_max_y = _edges(height - bottom, height - top, height)


def _edges(low: int, high: int, size: int) -> tuple[float, float]:
    return (low + 0.25) / size if low else 0.0, (high + 0.25) / size if high < size else 1.0
