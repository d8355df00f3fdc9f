"""The render job: import a GLB, pose its parts, render each shot with Cycles."""

import math
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bpy
from mathutils import Matrix

from artgen.render_job import RenderJob, Shot, Transport
from blender_scripts import scene as scenes
from blender_scripts.camera import add_camera, set_window
from blender_scripts.lights import add_rig
from blender_scripts.materials import make_thin_glass


def run(job: Mapping[str, Any], threads: int) -> dict[str, Any]:
    """Render all shots; the report holds the seconds of each stage."""
    task = RenderJob.from_plain(job)
    started = time.perf_counter()
    scene = scenes.reset()
    parts = _import_parts(task.glb)
    rest = {name: node.matrix_world.copy() for name, node in parts.items()}
    for pane in task.transport.panes:
        make_thin_glass(pane, task.rig.sky)
    add_rig(scene, task.rig)
    cameras = [add_camera(f"camera_{k}", camera) for k, camera in enumerate(task.cameras)]
    _configure(scene, task, threads)
    built = time.perf_counter()
    for shot in task.shots:
        for name, node in parts.items():
            node.matrix_world = Matrix(task.states[shot.state][name]) @ rest[name]
            node.hide_render = shot.part not in (None, name)
        scene.camera = cameras[shot.camera]
        set_window(scene, task.cameras[shot.camera].size, shot.box)
        _render(scene, shot, Path(task.folder))
    rendered = time.perf_counter()
    return {
        "files": [shot.file for shot in task.shots],
        "stages": {"import": built - started, "render": rendered - built},
    }


def _import_parts(glb: str) -> dict[str, bpy.types.Object]:
    """Mesh objects by name, freed from their parents but where they were."""
    bpy.ops.import_scene.gltf(filepath=glb)
    bpy.context.view_layer.update()
    parts = {node.name: node for node in bpy.data.objects if node.type == "MESH"}
    placed = {name: node.matrix_world.copy() for name, node in parts.items()}
    for name, node in parts.items():
        node.parent = None
        node.matrix_world = placed[name]
    return parts


def _configure(scene: bpy.types.Scene, task: RenderJob, threads: int) -> None:
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.threads_mode, render.threads = "FIXED", threads
    render.use_persistent_data = True
    render.film_transparent = True
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGBA"
    render.image_settings.color_depth = "16"
    render.use_file_extension = False
    cycles.device = "CPU"
    cycles.seed = task.seed
    cycles.use_adaptive_sampling = task.adaptive > 0.0
    cycles.adaptive_threshold = task.adaptive
    cycles.film_transparent_glass = True
    cycles.use_denoising = task.denoise
    cycles.denoiser = "OPENIMAGEDENOISE"
    cycles.denoising_quality = task.denoise_quality.upper()
    cycles.denoising_prefilter = task.prefilter.upper()
    _limit(cycles, task.transport, math.inf if task.bounces is None else task.bounces)


def _limit(cycles: Any, transport: Transport, most: float) -> None:
    """Bounces by kind of light transport, none more than `most`."""
    cycles.diffuse_bounces = min(transport.diffuse, most)
    cycles.glossy_bounces = min(transport.glossy, most)
    cycles.transmission_bounces = min(transport.transmission, most)
    cycles.transparent_max_bounces = transport.transparent
    cycles.volume_bounces = 0
    cycles.max_bounces = min(max(transport.diffuse, transport.glossy, transport.transmission), most)
    cycles.caustics_reflective = False
    cycles.caustics_refractive = transport.transmission > 0
    cycles.sample_clamp_indirect = transport.clamp_indirect


def _render(scene: bpy.types.Scene, shot: Shot, folder: Path) -> None:
    scene.cycles.samples = shot.samples
    scene.render.filepath = str(folder / shot.file)
    bpy.ops.render.render(write_still=True)
