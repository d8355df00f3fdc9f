"""A clean Blender scene for each job."""

import bpy


def reset() -> bpy.types.Scene:
    """Factory settings, nothing in the scene; no data of an earlier job survives."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene
