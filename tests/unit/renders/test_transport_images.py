"""What a scene does not call for changes no pixel; what stands in for the real thing is near it."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from artgen.core.jsonio import plain
from artgen.core.stream import Stream
from artgen.export import Bundle
from artgen.imaging import Singles, display, read_exr
from artgen.render_job import RenderJob, Shot, Transport
from artgen.worker import BlenderWorker
from renders.plan import plan_render
from renders.settings import Settings

pytestmark = pytest.mark.blender

EVERYTHING = Transport(
    diffuse=12, glossy=12, transmission=12, transparent=32, clamp_indirect=10.0, panes=()
)


@pytest.fixture(scope="module")
def job(bundle: Bundle, tmp_path_factory: pytest.TempPathFactory) -> RenderJob:
    folder = tmp_path_factory.mktemp("transport")
    settings = Settings(views=1, states=2, size=48, accuracy="1spp")
    plan = plan_render(bundle, Stream(2), settings=settings, folder=folder)
    return dataclasses.replace(plan.job, denoise=False)


def view(
    blender: BlenderWorker, job: RenderJob, transport: Transport, part: str | None, samples: int
) -> Singles:
    shot = Shot(file="t.exr", camera=0, state=1, part=part, box=(0, 0, 48, 48), samples=samples)
    asked = dataclasses.replace(job, transport=transport, shots=(shot,))
    blender.run(plain(asked), timeout_s=120)
    return read_exr(Path(job.folder) / "t.exr")


def test_transmission_and_transparency_are_free_where_nothing_transmits(
    job: RenderJob, blender: BlenderWorker
) -> None:
    least = dataclasses.replace(job.transport, panes=(), transparent=1)
    most = dataclasses.replace(least, transparent=32, transmission=3)
    one = view(blender, job, least, "drawer", 16)
    assert np.array_equal(one, view(blender, job, most, "drawer", 16))


def test_the_needed_bounces_are_near_to_all_of_them(job: RenderJob, blender: BlenderWorker) -> None:
    """The chest alone, open to the front: light that bounces more than three times between walls of
    albedo 0.4 carries under 2 % of the light; noise of 128 paths is 1.5 % a pixel."""
    needed = display(view(blender, job, job.transport, "base", 128)).astype(float)
    everything = display(view(blender, job, EVERYTHING, "base", 128)).astype(float)
    difference = np.abs(needed - everything)[..., :3]
    assert difference[everything[..., 3] > 0].mean() < 4.0


def test_thin_glass_lets_through_what_fresnel_leaves(
    job: RenderJob, blender: BlenderWorker
) -> None:
    """Two faces, each mirroring at least 4 % (index 1.5, head on) and more at an angle; the pane is
    clear, so alpha lies above 1 - 0.96^2 = 0.078, and every pixel inside has no noise."""
    few = view(blender, job, job.transport, "lid", 4)[..., 3]
    many = view(blender, job, job.transport, "lid", 32)[..., 3]
    inside = (few > 0.05) & (few < 0.95)
    core = inside & np.roll(inside, 3, 0) & np.roll(inside, -3, 0)
    core &= np.roll(inside, 3, 1) & np.roll(inside, -3, 1)
    assert core.sum() > 20
    # The tint of the spec, 0.8, crosses two faces: a clear fraction of 0.64 at most.
    assert (few[core] > 1 - (0.96 * 0.8) ** 2 - 1e-3).all()
    np.testing.assert_allclose(few[core], many[core], atol=0.02)
