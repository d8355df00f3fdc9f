"""Our cameras and crop windows in Blender's terms."""

import bpy
from mathutils import Matrix

from artgen.core.camera import Camera
from artgen.core.transform import BLENDER_CAMERA_FROM_CAMERA, inverted

SENSOR = 36.0
"""mm; any value does, as the focal length follows from it."""


def add_camera(name: str, camera: Camera) -> bpy.types.Object:
    """A Blender camera that sees what ours sees."""
    data = bpy.data.cameras.new(name)
    data.sensor_fit = "HORIZONTAL"
    data.sensor_width = SENSOR
    data.lens = SENSOR * camera.focal / camera.size[0]
    data.clip_start, data.clip_end = 1e-3, 1e4
    node = bpy.data.objects.new(name, data)
    # The diagonal matrix is its own inverse.
    pose = inverted(camera.camera_from_world) @ BLENDER_CAMERA_FROM_CAMERA
    node.matrix_world = Matrix(pose.tolist())
    bpy.context.scene.collection.objects.link(node)
    return node


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
