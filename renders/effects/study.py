"""`artgen study effects`: every effect of light transport on and off, in seconds, codes and
pictures."""

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro

from artgen.core.jsonio import plain, write_bytes
from artgen.core.mesh import Floats
from artgen.imaging import Bytes, Singles, display, png_file, read_exr
from artgen.render_job import RenderJob, Transport
from artgen.studies.table import write_table
from artgen.worker import BlenderWorker
from renders.contact_sheet import on_paper
from renders.effects.scenes import EFFECTS, PLAIN, Effect, scene_job, write_scene

TIMEOUT_S = 600.0
BLOCK = 4
"""px; differences are taken of means over blocks of this width, which noise does not move much."""
CONVERGED = 16
"""Factor on the paths of an image that others are held against."""
AMPLIFIED = 4.0
"""Factor on differences in the pictures."""


@dataclass(frozen=True, kw_only=True)
class Effects:
    """Render scenes that call for one effect each, with it and without it."""

    size: int = 128
    """Width of the images, px."""
    samples: int = 256
    """Paths a pixel."""
    table: Annotated[Path, tyro.conf.arg(aliases=["-t"])] = Path("docs/studies/effects.csv")
    """Receives a row per effect."""
    pictures: Path = Path("docs/images/effects")
    """Receives a picture per effect: on, off, four times the difference."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One effect.

    Attributes:
        on_cpu_s, off_cpu_s: of the image that needs it.
        error: of the image without it, root mean square over the image in 8-bit codes, of means
            over 4 x 4 px.
        noise: the same between two images with it and other seeds. A light tree changes nothing
            but noise, so its row has the errors of single pixels against CONVERGED times the paths.
        idle_share: CPU seconds of a scene that does not need it with it on, over those with it off.
        idle_identical: whether these two images agree bit for bit.
    """

    effect: str
    on_cpu_s: float
    off_cpu_s: float
    error: float
    noise: float
    idle_share: float
    idle_identical: bool


def effects(argv: Sequence[str]) -> int:
    """What each effect of light transport shows and costs, on and off."""
    asked = tyro.cli(Effects, args=list(argv), prog="artgen study effects")
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        with BlenderWorker(folder / "blender.log", threads=os.cpu_count() or 1) as worker:
            calm = write_scene(PLAIN, folder / "plain", worker)
            rows = []
            for name, effect in EFFECTS.items():
                row, picture = measured(name, effect, asked, folder / name, calm, worker)
                rows.append(row)
                write_bytes(asked.pictures / f"{name}.png", png_file(picture))
                print(f"{name}: {row}")  # noqa: T201
    write_table(asked.table, rows)
    return 0


def measured(
    name: str, effect: Effect, asked: Effects, folder: Path, calm: Path, worker: BlenderWorker
) -> tuple[Row, Bytes]:
    """The row of an effect, and its picture.

    Raises:
        WorkerError: Blender failed.
    """
    glb = write_scene(effect.scene, folder, worker)
    job = scene_job(effect.scene, glb, folder, size=asked.size, samples=asked.samples)
    rendered(worker, replace(job, shots=(replace(job.shots[0], samples=1),)))  # Caches warm up.
    on, on_s = rendered(worker, job)
    again = replace(job, seed=1)
    off, off_s = rendered(worker, replace(job, transport=effect.without))
    without, with_it = idle_jobs(effect, calm, folder, size=asked.size, samples=asked.samples)
    still, still_s = rendered(worker, without)
    idle, idle_s = rendered(worker, with_it)
    if name == "light_tree":
        shot = replace(job.shots[0], samples=CONVERGED * asked.samples)
        truth, _ = rendered(worker, replace(again, shots=(shot,)))
        error, noise = difference(truth, off, 1), difference(truth, on, 1)
    else:
        error, noise = difference(on, off), difference(on, rendered(worker, again)[0])
    row = Row(
        effect=name,
        on_cpu_s=on_s,
        off_cpu_s=off_s,
        error=error,
        noise=noise,
        idle_share=idle_s / still_s,
        idle_identical=bool(np.array_equal(still, idle)),
    )
    return row, _picture(on, off)


def idle_jobs(
    effect: Effect, glb: Path, folder: Path, *, size: int, samples: int
) -> tuple[RenderJob, RenderJob]:
    """`PLAIN` as it calls for, and with an effect that it does not call for."""
    job = scene_job(PLAIN, glb, folder, size=size, samples=samples)
    if effect.alone:
        job = replace(job, shots=(replace(job.shots[0], part="subject"),))
    moments = (job.states[0],) * 5
    switched: Transport = replace(job.transport, **effect.idle)  # type: ignore[arg-type]
    exposures = (moments,) if switched.motion_blur else ()
    return job, replace(job, transport=switched, exposures=exposures)


def rendered(worker: BlenderWorker, job: RenderJob) -> tuple[Singles, float]:
    """The job's only image, and CPU seconds."""
    report = worker.run(plain(job), timeout_s=TIMEOUT_S)
    return read_exr(Path(job.folder) / job.shots[0].file), sum(report["cpu"].values())


def difference(one: Singles, two: Singles, block: int = BLOCK) -> float:
    """Root mean square over an image on paper, in 8-bit codes, of means over blocks."""
    return float(np.sqrt(((_means(one, block) - _means(two, block)) ** 2).mean()))


def _means(image: Singles, block: int) -> Floats:
    shown = on_paper(display(image)).astype(float)
    height, width = (length // block for length in shown.shape[:2])
    cut = shown[: height * block, : width * block]
    return cut.reshape(height, block, width, block, 3).mean(axis=(1, 3))


def _picture(on: Singles, off: Singles) -> Bytes:
    """On, off and their difference, side by side."""
    shown = [on_paper(display(image)) for image in (on, off)]
    apart = AMPLIFIED * np.abs(shown[0].astype(float) - shown[1])
    return np.concatenate([*shown, np.minimum(apart, 255.0).astype(np.uint8)], axis=1)
