"""The fast backend: the images of a plan without Blender."""

import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from artgen.core.camera import Camera
from artgen.core.mesh import Floats
from artgen.core.surface import SurfaceSpec
from artgen.imaging import Singles
from artgen.render_job import LightRig, Shot
from renders.fast.context import open_context
from renders.fast.filtered import Blur
from renders.fast.light import shine
from renders.fast.rasterizer import Canvas, Programs, Rasterizer, is_pane
from renders.fast.scenes import occlusions, scene_of
from renders.glb import Appearance, read_appearance, surfaces_by_name
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
        self._canvas = Canvas(self._context)
        self._blur = Blur()

    def pictures(self, plan: RenderPlan, folder: Path) -> Pictures:
        """All images of the plan, drawn one after the other; no file is written.

        Raises:
            RenderError: the GLB or the rig's environment cannot be read, or the rig has too many
                lights.
        """
        started = time.process_time()
        appearance = read_appearance(Path(plan.job.glb))
        images = self.draw(
            appearance,
            surfaces_by_name(plan.bundle.surfaces, appearance),
            plan.job.rig,
            cameras=plan.cameras,
            poses=plan.poses,
            shots=plan.passes.shots,
        )
        return Pictures(images=images, cpu={"draw": time.process_time() - started})

    def draw(
        self,
        appearance: Appearance,
        surfaces: Mapping[str, SurfaceSpec],
        rig: LightRig,
        *,
        cameras: Sequence[Camera],
        poses: Sequence[Mapping[str, Floats]],
        shots: Sequence[Shot],
    ) -> list[Singles]:
        """For each shot (h, w, 4) float32 of its window, linear RGB premultiplied by alpha.

        Args:
            surfaces: by name.
            poses: part name to `object_from_rest`, for each state.
        """
        light = shine(rig, self._blur)
        opaque = [skin for skin in appearance.skins if not is_pane(surfaces[skin.surface])]
        hidden = occlusions(opaque, shots, poses, light, size=max(cameras[0].size))
        rasterizer = Rasterizer(
            self._context,
            self._programs,
            self._canvas,
            appearance=appearance,
            surfaces=surfaces,
            light=light,
        )
        try:
            shades = {scene: rasterizer.shade(found) for scene, found in hidden.items()}
            return [
                rasterizer.draw(
                    cameras[shot.camera],
                    shot.box,
                    poses[shot.state],
                    part=shot.part,
                    shade=shades.get(scene_of(shot, poses)),
                )
                for shot in shots
            ]
        finally:
            rasterizer.close()
