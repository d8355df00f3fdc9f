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
class Picture:
    """(h, w, 4) linear premultiplied RGBA of a shot's window, and the seconds that it took, warm:
    sync, path tracing, denoising, writing the EXR."""

    image: Singles
    cpu_s: float
    wall_s: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Pictures:
    """All pictures of a target in one setting; attributes as of `Picture`, a shot each."""

    images: tuple[Singles, ...]
    cpu_s: tuple[float, ...]
    wall_s: tuple[float, ...]


def target(scene: str, bundle: Bundle, *, size: int, folder: Path) -> Target:
    """Two composites, the base alone, and the largest moving part alone."""
    settings = Settings(views=1, states=2, size=size, accuracy="1spp")
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
    seen: Target, series: Sequence[Setting], *, seed: int, worker: BlenderWorker, kept: Path
) -> dict[Setting, Pictures]:
    """The pictures of settings that differ in nothing but `samples`, from `kept` where they are.

    Raises:
        WorkerError: Blender failed.
    """
    content = file_hash(Path(seen.job.glb))
    files = {}
    for setting in series:
        job = asked(seen, [setting], seed=seed)
        identity = content_hash([replace(job, glb="", folder=""), content])[:16]
        files[setting] = kept / f"{seen.scene}_{seen.size}_{identity}.npz"
    missing = [setting for setting in series if not files[setting].exists()]
    if missing:
        made = _render(asked(seen, missing, seed=seed), worker)
        count = len(seen.shots)
        for k, setting in enumerate(missing):
            write_bytes(files[setting], _packed(made[k * count : (k + 1) * count]))
    return {setting: _unpacked(files[setting], len(seen.shots)) for setting in series}


def reference(seen: Target, *, samples: int, worker: BlenderWorker, kept: Path) -> list[Pictures]:
    """Pictures without denoiser from other seeds than the measured ones; an even number of them."""
    count = 2 * max(1, round(samples / (2 * CHUNK)))
    return [
        rendered(seen, [PLAIN], seed=REFERENCE_SEED + k, worker=worker, kept=kept)[PLAIN]
        for k in range(count)
    ]


def asked(seen: Target, series: Sequence[Setting], *, seed: int) -> RenderJob:
    """The job of all settings of a series; its first shot warms up and is dropped."""
    first = replace(seen.shots[0], file="warm.exr", samples=1)
    shots = tuple(
        replace(shot, samples=setting.samples, file=f"{setting.samples}_{shot.file}")
        for setting in series
        for shot in seen.shots
    )
    shared = series[0]
    return replace(
        seen.job,
        shots=(first, *shots),
        seed=seed,
        denoise=shared.denoise,
        prefilter=shared.prefilter,
        denoise_quality=shared.denoise_quality,
        adaptive=shared.adaptive,
        bounces=shared.bounces,
    )


def _render(job: RenderJob, worker: BlenderWorker) -> list[Picture]:
    """Of every shot but the first."""
    with tempfile.TemporaryDirectory() as scratch:
        report = worker.run(plain(replace(job, folder=scratch)), timeout_s=patience(job.shots))
        return [
            Picture(image=read_exr(Path(scratch) / shot.file), **spent)
            for shot, spent in zip(job.shots[1:], report["shots"][1:], strict=True)
        ]


def _packed(pictures: Sequence[Picture]) -> bytes:
    buffer = io.BytesIO()
    images = {f"image_{k}": each.image.astype(np.float16) for k, each in enumerate(pictures)}
    cpu_s, wall_s = ([getattr(each, name) for each in pictures] for name in ("cpu_s", "wall_s"))
    np.savez(buffer, cpu_s=cpu_s, wall_s=wall_s, **images)
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
