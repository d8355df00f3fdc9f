"""What people write first: a script that renders one object with Cycles, part by part.

A fresh process for each object, everything that Blender does by default left as it is (no
persistent data, denoiser at high quality with an accurate prefilter, 12 bounces, caustics on),
whole images, parts alone by hiding the others. It takes the same GLB, lights, cameras and states as
a `RenderJob`, so that the two can be compared.

usage: python -m tests.bench.plain_cycles JOB.json OUT PATHS PART_PATHS THREADS [raw]
"""

import json
import sys
from collections.abc import Sequence
from pathlib import Path

import bpy
from mathutils import Matrix

from artgen.render_job import RenderJob
from blender_scripts.camera import add_camera
from blender_scripts.lights import add_rig


def main(argv: Sequence[str]) -> int:
    """Write `<state>_<view>_<part>.exr` for every state and view of all and of each part."""
    file, out, paths, part_paths, threads, *raw = argv
    job = RenderJob.from_plain(json.loads(Path(file).read_text(encoding="utf-8")))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job.glb)
    bpy.context.view_layer.update()
    parts = {node.name: node for node in bpy.data.objects if node.type == "MESH"}
    rest = {name: node.matrix_world.copy() for name, node in parts.items()}
    for node in parts.values():
        node.parent = None
    scene = bpy.context.scene
    add_rig(scene, job.rig)
    cameras = [add_camera(f"camera_{k}", camera) for k, camera in enumerate(job.cameras)]
    configure(scene, job, threads=int(threads), denoise=not raw)
    for t, poses in enumerate(job.states):
        for name, node in parts.items():
            node.matrix_world = Matrix(poses[name]) @ rest[name]
        for v, camera in enumerate(cameras):
            scene.camera = camera
            for shown in (None, *parts) if int(part_paths) else (None,):
                for name, node in parts.items():
                    node.hide_render = shown not in (None, name)
                scene.cycles.samples = int(paths if shown is None else part_paths)
                scene.render.filepath = f"{out}/{t}_{v}_{shown or 'all'}.exr"
                bpy.ops.render.render(write_still=True)
    return 0


def configure(scene: bpy.types.Scene, job: RenderJob, *, threads: int, denoise: bool) -> None:
    """Resolution, film and file; Cycles as it comes."""
    scene.render.engine = "CYCLES"
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = job.cameras[0].size
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.cycles.device = "CPU"
    scene.cycles.seed = job.seed + 1
    scene.cycles.use_denoising = denoise


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
