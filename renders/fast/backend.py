"""The fast backend: the images of a plan without Blender."""

import time
from pathlib import Path

from artgen.transport import CLEAR
from renders.fast.context import open_context
from renders.fast.filtered import Blur
from renders.fast.light import shine
from renders.fast.rasterizer import Canvases, Programs, Rasterizer
from renders.fast.scenes import occlusions, scene_of
from renders.glb import read_appearance
from renders.pictures import Pictures
from renders.plan import RenderPlan

SHADING = "fast/1"
"""The number rises with every change of the shading model that pixels show."""


class FastBackend:
    """Draws by software OpenGL; one context serves asset after asset."""

    shading = SHADING

    def __init__(self, *, threads: int = 1) -> None:
        self._context = open_context(threads=threads)
        self._programs = Programs(self._context)
        self._canvases = Canvases(self._context)
        self._blur = Blur()

    def pictures(self, plan: RenderPlan, folder: Path) -> Pictures:
        """All images of the plan, drawn one after the other; no file is written.

        Raises:
            RenderError: the GLB cannot be read, or the rig has too many lights.
        """
        started = time.process_time()
        appearance = read_appearance(Path(plan.job.glb))
        surfaces = {surface.name: surface for surface in plan.bundle.surfaces}
        light = shine(plan.job.rig, self._blur)
        opaque = [s for s in appearance.skins if surfaces[s.surface].transmission <= CLEAR]
        hidden = occlusions(
            opaque, plan.passes.shots, plan.poses, light, size=max(plan.cameras[0].size)
        )
        prepared = time.process_time()
        rasterizer = Rasterizer(
            self._context,
            self._programs,
            self._canvases,
            appearance=appearance,
            surfaces=surfaces,
            light=light,
        )
        try:
            shades = {scene: rasterizer.shade(found) for scene, found in hidden.items()}
            images = [
                rasterizer.draw(
                    plan.cameras[shot.camera],
                    shot.box,
                    plan.poses[shot.state],
                    part=shot.part,
                    shade=shades.get(scene_of(shot, plan.poses)),
                )
                for shot in plan.passes.shots
            ]
        finally:
            rasterizer.close()
        cpu = {"shade": prepared - started, "draw": time.process_time() - prepared}
        return Pictures(images=images, cpu=cpu)
