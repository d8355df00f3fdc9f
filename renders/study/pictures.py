"""Rendering for the study: every picture once, kept in files: an interrupted run resumes."""

import io
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from artgen.core.jsonio import content_hash, file_hash, plain, write_bytes
from artgen.core.stream import Stream
from artgen.export import Bundle
from artgen.imaging import Singles, read_exr
from artgen.render_job import RenderJob, Shot
from artgen.worker import BlenderWorker
from renders.backends import patience
from renders.plan import RenderPlan, plan_render
from renders.settings import Settings
from renders.study.settings import Setting

SEED = 7
"""Of cameras, states, lights and of the path tracer in measured pictures."""
REFERENCE_SEED = 1_000_000
"""Of the first picture of a reference; the next ones count on."""
CHUNK = 256
"""Paths a pixel of one picture of a reference; their mean is the reference."""
PLAIN = Setting(samples=CHUNK, denoise=False)
VIEWS = ((1, 0), (0, 0))
"""(state, view) of the composites: ajar and shut, from the front."""


@dataclass(frozen=True, kw_only=True)
class Target:
    """A scene at a size, and which of its images are looked at.

    Attributes:
        shots: composites first, then parts alone.
        composites: how many.
    """

    scene: str
    size: int
    job: RenderJob
    shots: tuple[Shot, ...]
    composites: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Pictures:
    """Linear images of a target's shots with the seconds that each took, warm.

    Attributes:
        images: (h, w, 4) float16 of each shot's window, linear RGB premultiplied.
        cpu_s, wall_s: of each shot: sync, path tracing, denoising, writing the EXR.
    """

    images: tuple[Singles, ...]
    cpu_s: tuple[float, ...]
    wall_s: tuple[float, ...]


def target(scene: str, bundle: Bundle, *, size: int, folder: Path) -> Target:
    """Two composites, the base alone, and the largest moving part alone."""
    settings = Settings(views=1, states=2, size=size)
    plan = plan_render(bundle, Stream(SEED, "study", scene), settings=settings, folder=folder)
    composites = [plan.passes.composite[t][v] for t, v in VIEWS]
    shots = [plan.passes.shots[k] for k in (*composites, *_alone(plan))]
    return Target(
        scene=scene, size=size, job=plan.job, shots=tuple(shots), composites=len(composites)
    )


def _alone(plan: RenderPlan) -> list[int]:
    """Shots of the base and of the part with the largest window, in the first composite."""
    t, v = VIEWS[0]
    base, *others = [shot for shot in plan.passes.alone[t][v] if shot is not None]

    def area(shot: int) -> int:
        left, top, right, bottom = plan.passes.shots[shot].box
        return (right - left) * (bottom - top)

    return [base, max(others, key=area)]


def rendered(
    seen: Target, setting: Setting, *, seed: int, worker: BlenderWorker, kept: Path
) -> Pictures:
    """The pictures of a target, from `kept` where they are there.

    Raises:
        WorkerError: Blender failed.
    """
    job = asked(seen, setting, seed=seed)
    identity = content_hash([replace(job, glb="", folder=""), file_hash(Path(job.glb))])[:16]
    file = kept / f"{seen.scene}_{seen.size}_{identity}.npz"
    if not file.exists():
        write_bytes(file, _packed(_render(job, worker)))
    return _unpacked(file, len(seen.shots))


def reference(seen: Target, *, samples: int, worker: BlenderWorker, kept: Path) -> list[Pictures]:
    """Pictures without denoiser from other seeds than the measured ones; an even number of them."""
    return [
        rendered(seen, PLAIN, seed=REFERENCE_SEED + k, worker=worker, kept=kept)
        for k in range(2 * max(1, round(samples / (2 * CHUNK))))
    ]


def asked(seen: Target, setting: Setting, *, seed: int) -> RenderJob:
    """The job of a setting; its first shot warms up and is dropped."""
    first = replace(seen.shots[0], file="warm.exr", samples=1)
    shots = tuple(replace(shot, samples=setting.samples) for shot in seen.shots)
    return replace(
        seen.job,
        shots=(first, *shots),
        seed=seed,
        denoise=setting.denoise,
        prefilter=setting.prefilter,
        denoise_quality=setting.denoise_quality,
        adaptive=setting.adaptive,
        bounces=setting.bounces,
    )


def _render(job: RenderJob, worker: BlenderWorker) -> Pictures:
    with tempfile.TemporaryDirectory() as scratch:
        report = worker.run(plain(replace(job, folder=scratch)), timeout_s=patience(job.shots))
        images = tuple(read_exr(Path(scratch) / shot.file) for shot in job.shots[1:])
    spent = report["shots"][1:]
    return Pictures(
        images=images,
        cpu_s=tuple(shot["cpu_s"] for shot in spent),
        wall_s=tuple(shot["wall_s"] for shot in spent),
    )


def _packed(pictures: Pictures) -> bytes:
    buffer = io.BytesIO()
    images = {f"image_{k}": image.astype(np.float16) for k, image in enumerate(pictures.images)}
    np.savez(buffer, cpu_s=pictures.cpu_s, wall_s=pictures.wall_s, **images)
    return buffer.getvalue()


def _unpacked(file: Path, count: int) -> Pictures:
    with np.load(file) as stored:
        return Pictures(
            images=tuple(stored[f"image_{k}"].astype(np.float32) for k in range(count)),
            cpu_s=tuple(stored["cpu_s"].tolist()),
            wall_s=tuple(stored["wall_s"].tolist()),
        )


def mean_image(pictures: Sequence[Pictures], shot: int) -> Singles:
    """(h, w, 4) mean of one shot over pictures of different seeds."""
    return np.mean([each.images[shot].astype(np.float64) for each in pictures], axis=0)
