"""The render job: import a GLB, pose its parts, render each shot with Cycles.

Standard library and bpy alone: this runs in Blender's own Python on render farms.
"""

import math
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bpy

from artgen.core.errors import RenderError
from artgen.render_job import RenderJob, Shot, Transport
from blender_scripts import scene as scenes
from blender_scripts.camera import add_camera, set_window
from blender_scripts.lights import add_rig
from blender_scripts.materials import apply_transport
from blender_scripts.posing import Posing


def run(job: Mapping[str, Any], threads: int) -> dict[str, Any]:
    """Render all shots; the report holds wall and CPU seconds of each stage and each shot.

    Raises:
        RenderError: the GLB is unreadable, lacks a part that the job poses, or lacks an image; or
            Blender wrote no image.
    """
    task = RenderJob.from_plain(job)
    clock = _Clock()
    scene = scenes.reset()
    posing = Posing(import_parts(task), task)
    apply_transport(task.transport, task.rig)
    ground = add_rig(scene, task.rig)
    cameras = [add_camera(f"camera_{k}", camera) for k, camera in enumerate(task.cameras)]
    _configure(scene, task, threads)
    clock.stop("import")
    seconds: dict[str, dict[str, float]] = {}
    # Once a shadow catcher was seen, Cycles denoises later images as if it were there; so parts
    # alone, which it is hidden from, come first.
    for shot in sorted(task.shots, key=lambda shot: ground is not None and shot.part is None):
        posing.show(shot)
        if ground is not None:
            ground.hide_render = shot.part is not None
        scene.camera = cameras[shot.camera]
        set_window(scene, task.cameras[shot.camera].size, shot.box)
        _render(scene, shot, Path(task.folder))
        wall, cpu = clock.stop("composite" if shot.part is None else "alone")
        seconds[shot.file] = {"wall_s": wall, "cpu_s": cpu}
    return {
        "files": [shot.file for shot in task.shots],
        "stages": clock.wall,
        "cpu": clock.cpu,
        "shots": [seconds[shot.file] for shot in task.shots],
    }


def import_parts(task: RenderJob) -> dict[str, bpy.types.Object]:
    """Mesh objects by name, freed from their parents but where they were.

    Raises:
        RenderError: as `run`.
    """
    try:
        bpy.ops.import_scene.gltf(filepath=task.glb)
    except RuntimeError as error:
        raise RenderError(
            f"{task.glb} cannot be imported ({str(error).strip().splitlines()[-1]}); write it anew"
        ) from error
    bpy.context.view_layer.update()
    parts = {node.name: node for node in bpy.data.objects if node.type == "MESH"}
    placed = {name: node.matrix_world.copy() for name, node in parts.items()}
    for name, node in parts.items():
        node.parent = None
        node.matrix_world = placed[name]
    _check_import(task, set(parts))
    return parts


def _check_import(task: RenderJob, parts: set[str]) -> None:
    stated = {name for state in task.states for name in state}
    if stated != parts:
        raise RenderError(
            f"{task.glb} holds parts {sorted(parts)}, the job poses {sorted(stated)}; write the "
            "GLB anew"
        )
    for image in bpy.data.images:
        if image.source == "FILE" and 0 in image.size:
            raise RenderError(f"{task.glb} lacks the texture {image.name}; write the GLB anew")


def _configure(scene: bpy.types.Scene, task: RenderJob, threads: int) -> None:
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.threads_mode, render.threads = "FIXED", threads
    render.use_persistent_data = True
    render.film_transparent = True
    render.use_file_extension = False
    _set_output(scene, task)
    cycles.device = "CPU"
    cycles.seed = task.seed
    cycles.use_adaptive_sampling = task.adaptive > 0.0
    cycles.adaptive_threshold = task.adaptive
    cycles.film_transparent_glass = True
    cycles.use_denoising = task.denoise
    cycles.denoiser = "OPENIMAGEDENOISE"
    cycles.denoising_quality = task.denoise_quality.upper()
    cycles.denoising_prefilter = task.prefilter.upper()
    cycles.use_light_tree = task.transport.light_tree
    scene.frame_set(0)
    render.use_motion_blur = task.transport.motion_blur
    render.motion_blur_shutter, render.motion_blur_position = 1.0, "START"
    _limit(cycles, task.transport, math.inf if task.bounces is None else task.bounces)


def _set_output(scene: bpy.types.Scene, task: RenderJob) -> None:
    """Scene-linear RGBA with Rec.709 primaries; half floats, unless passes are asked for."""
    image = scene.render.image_settings
    image.file_format = "OPEN_EXR_MULTILAYER" if task.passes else "OPEN_EXR"
    image.color_mode = "RGBA"
    image.color_depth = "32" if task.passes else "16"
    layer = scene.view_layers[0]
    layer.use_pass_z = "depth" in task.passes
    layer.use_pass_object_index = "part" in task.passes
    layer.use_pass_diffuse_color = "albedo" in task.passes


def _limit(cycles: Any, transport: Transport, most: float) -> None:
    """Bounces by kind of light transport, none more than `most`; all kinds together as many as
    they sum up to, so that no kind takes from another."""
    cycles.diffuse_bounces = min(transport.diffuse, most)
    cycles.glossy_bounces = min(transport.glossy, most)
    cycles.transmission_bounces = min(transport.transmission, most)
    cycles.transparent_max_bounces = transport.transparent
    cycles.volume_bounces = 0
    together = transport.diffuse + transport.glossy + transport.transmission
    cycles.max_bounces = min(together, most)
    cycles.caustics_reflective = transport.reflective_caustics
    cycles.caustics_refractive = transport.refractive_caustics
    cycles.sample_clamp_indirect = transport.clamp_indirect


def _render(scene: bpy.types.Scene, shot: Shot, folder: Path) -> None:
    scene.cycles.samples = shot.samples
    scene.render.filepath = str(folder / shot.file)
    bpy.ops.render.render(write_still=True)


class _Clock:
    """Seconds by stage, each counted from the end of the one before."""

    def __init__(self) -> None:
        self.wall: dict[str, float] = {}
        self.cpu: dict[str, float] = {}
        self._last = (time.perf_counter(), time.process_time())

    def stop(self, stage: str) -> tuple[float, float]:
        """Book the wall and CPU seconds since the last stop on `stage`, and return them."""
        now = (time.perf_counter(), time.process_time())
        wall, cpu = (end - start for start, end in zip(self._last, now, strict=True))
        self.wall[stage] = self.wall.get(stage, 0.0) + wall
        self.cpu[stage] = self.cpu.get(stage, 0.0) + cpu
        self._last = now
        return wall, cpu
