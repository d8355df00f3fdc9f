"""The part of `make bench` that renders: seconds by stage, against a plain script, memory."""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import mean

import psutil

from artgen.core.jsonio import plain
from artgen.core.stream import Stream
from artgen.export import Bundle
from artgen.imaging import read_exr
from artgen.run_folder import RunFolder
from artgen.studies.table import markdown_table, write_table
from artgen.worker import BlenderWorker
from renders.accuracy import quality
from renders.asset import render_asset
from renders.backends import BACKENDS, Backend, CyclesBackend
from renders.collect import cast
from renders.plan import RenderPlan, plan_render
from renders.run import RenderTask, run_tasks
from renders.settings import Settings
from renders.study.measures import pooled_error
from renders.study.scenes import made_bundles
from tests.bench.figures import DOCS, SEED, cpu_seconds
from tests.bench.memory import measure_memory

PARALLEL = 1.85
"""CPU seconds over wall seconds of path tracing with two threads on two idle cores."""
STANDARD = Settings(views=4, states=2, size=128, accuracy="standard")
TRUTH_PATHS = 256


@dataclass(frozen=True, kw_only=True)
class Figure:
    """One line of the section: what was measured, and the bound that it is held against."""

    what: str
    measured: float
    unit: str
    bound: str
    note: str


def planned(bundle: Bundle, folder: Path, settings: Settings) -> RenderPlan:
    """The plan of the bench's seed."""
    stream = Stream(SEED, "bench", bundle.asset_id)
    return plan_render(bundle, stream, settings=settings, folder=folder)


def label_figures(bundle: Bundle, folder: Path) -> list[Figure]:
    """Labels of 4 views x 2 states at 256 px."""
    plan = planned(bundle, folder, replace(STANDARD, size=256))
    cast(plan)  # warm
    wall, cpu = timed(lambda: cast(plan))
    parts = len(bundle.parts)
    return [figure("labels, V 4, T 2, 256 px", cpu, "CPU s", "0.4", f"{parts} parts; {wall:.2f} s")]


def image_figures(bundle: Bundle, folder: Path, worker: BlenderWorker) -> list[Figure]:
    """Composites and parts alone of `standard`, and what an image costs beyond its paths."""
    found = []
    for size, bound in ((128, "0.6"), (256, "2.5")):
        plan = planned(bundle, folder, replace(STANDARD, size=size))
        spent = seconds_of_shots(plan, worker)
        shots = list(zip(plan.passes.shots, spent, strict=True))[1:]  # the first one warms up
        whole = mean(s for shot, s in shots if shot.part is None)
        alone = mean(s for shot, s in shots if shot.part is not None)
        promise = quality("standard", size).promise
        told = f"{whole:.2f} CPU s; {promise.psnr_db:.1f} dB" if promise else ""
        found.append(figure(f"standard composite, {size} px", whole / PARALLEL, "s", bound, told))
        if size == 256:
            note = f"{alone:.2f} CPU s, cropped"
            found.append(figure("part alone, 256 px", alone / PARALLEL, "s", "0.2", note))
    tiny = planned(bundle, folder, replace(STANDARD, size=16, accuracy="1spp"))
    overhead = mean(seconds_of_shots(tiny, worker)[1:])
    note = "16 px, one path, denoised"
    return [*found, figure("an image beyond its paths", 1000 * overhead, "CPU ms", "40", note)]


def seconds_of_shots(plan: RenderPlan, worker: BlenderWorker) -> list[float]:
    """CPU seconds of every shot of a plan."""
    Path(plan.job.folder).mkdir(parents=True, exist_ok=True)
    report = worker.run(plain(plan.job), timeout_s=3600.0)
    return [shot["cpu_s"] for shot in report["shots"]]


def object_figure(bundle: Bundle, folder: Path, worker: BlenderWorker) -> Figure:
    """From bundle to staged sample, warm, at 128 px."""

    def whole() -> None:
        render_asset(
            bundle,
            folder / "sample.tar",
            settings=STANDARD,
            seed=SEED,
            scratch=folder / "scratch",
            backend=CyclesBackend(worker),
        )

    wall, cpu = timed(whole)
    note = f"{len(bundle.parts)} parts, 4 x 2, labels, packed; {cpu:.1f} CPU s"
    return figure("whole object, 128 px", wall, "s", "9", note)


def plain_figures(bundle: Bundle, folder: Path, threads: int) -> list[Figure]:
    """Ours and the plain script on one object, both with their process's start; errors against the
    plain script's own image of many paths."""
    plan = planned(bundle, folder / "ours", STANDARD)
    (folder / "ours").mkdir()
    own = quality("standard", STANDARD.size)

    def ours() -> None:
        with BlenderWorker(folder / "ours.log", threads=threads) as worker:
            list(CyclesBackend(worker).pictures(plan, folder / "ours").images)

    wall, cpu = timed(ours)
    job = folder / "job.json"
    job.write_text(json.dumps(plain(plan.job)))
    truth = plain_run(job, folder / "truth", (TRUTH_PATHS, 0), threads, raw=True)
    flip = flip_of(plan, folder / "ours", folder / "truth")
    rivals = []
    for paths in sorted({max(1, own.samples // 2), own.samples}):
        share = max(1, own.part_samples * paths // own.samples)
        spent = plain_run(job, folder / f"plain_{paths}", (paths, share), threads, raw=False)
        rivals.append((flip_of(plan, folder / f"plain_{paths}", folder / "truth"), *spent))
    fair = next((rival for rival in rivals if rival[0] <= flip), rivals[-1])
    told = ", ".join(f"{f:.3f} in {c:.0f} CPU s" for f, _, c in rivals)
    return [
        figure(
            "plain script over ours, CPU", fair[2] / cpu, "times", ">= 4",
            f"FLIP {flip:.3f} in {cpu:.1f} CPU s ({wall:.1f} s); plain {told}; "
            f"truth of {TRUTH_PATHS} paths {truth[1]:.0f} CPU s",
        ),
        figure("plain script over ours, wall", fair[1] / wall, "times", ">= 4", "the same run"),
    ]  # fmt: skip


def plain_run(
    job: Path, out: Path, paths: tuple[int, int], threads: int, *, raw: bool
) -> tuple[float, float]:
    """Wall and CPU seconds of the plain script in a fresh process."""
    words = [str(job), str(out), *map(str, paths), str(threads), *(["raw"] if raw else [])]
    command = [sys.executable, "-m", "tests.bench.plain_cycles", *words]
    environment = {**os.environ, "OIDN_NUM_THREADS": str(threads), "OIDN_SET_AFFINITY": "0"}
    return timed(lambda: subprocess.run(command, check=True, capture_output=True, env=environment))


def flip_of(plan: RenderPlan, images: Path, truth: Path) -> float:
    """Mean FLIP of the composites in a folder, ours by number or plain ones by name."""
    shots, made, true = [], [], []
    for t, row in enumerate(plan.passes.composite):
        for v, k in enumerate(row):
            shot, name = plan.passes.shots[k], f"{t}_{v}_all.exr"
            numbered = images / shot.file
            shots.append(shot)
            made.append(read_exr(numbered if numbered.exists() else images / name))
            true.append(read_exr(truth / name))
    return pooled_error(made, true, shots, plan.settings.size).flip


def worker_figure(bundles: Sequence[Bundle], folder: Path) -> Figure:
    """Wall seconds of four objects by one worker over those by two."""
    walls = []
    for workers in (1, 2):
        place = folder / f"workers_{workers}"
        tasks = [
            RenderTask(
                asset_id=f"{bundle.asset_id}_{copy}",
                bundle=bundle.folder,
                sample=place / f"{bundle.asset_id}_{copy}.tar",
                settings=STANDARD,
                seed=SEED + copy,
            )
            for copy in range(2)
            for bundle in bundles
        ]
        started = time.perf_counter()
        list(run_tasks(RunFolder(place), tasks, workers=workers, backend=BACKENDS["cycles"]))
        walls.append(time.perf_counter() - started)
    note = f"{walls[0]:.1f} s and {walls[1]:.1f} s for {len(tasks)} objects"
    return figure("two workers over one", walls[0] / walls[1], "times", ">= 1.9", note)


def fast_figures(bundle: Bundle, folder: Path, worker: BlenderWorker) -> list[Figure]:
    """CPU seconds of all images of an object by Cycles over those by the fast backend."""
    place = folder / "both"
    place.mkdir()
    settings = replace(STANDARD, size=256)
    fast = seconds_of_backend(BACKENDS["fast"](folder / "fast.log", 1), bundle, place, settings)
    found = []
    for accuracy in ("standard", "high"):
        asked = replace(settings, accuracy=accuracy)
        cycles = seconds_of_backend(CyclesBackend(worker), bundle, place, asked)
        note = f"{cycles:.1f} and {fast:.2f} CPU s, all images of 4 x 2 at 256 px"
        what = f"Cycles at `{accuracy}` over fast"
        found.append(figure(what, cycles / fast, "times", ">= 25", note))
    return found


def seconds_of_backend(backend: Backend, bundle: Bundle, folder: Path, settings: Settings) -> float:
    """CPU seconds of all images of an object, warm."""
    warm = planned(bundle, folder, replace(settings, size=16))
    plan = planned(bundle, folder, settings)
    list(backend.pictures(warm, folder).images)
    before = cpu_seconds(psutil.Process())
    list(backend.pictures(plan, folder).images)
    return cpu_seconds(psutil.Process()) - before


def timed(work: Callable[[], object]) -> tuple[float, float]:
    """Wall seconds, and CPU seconds of this process and of its children, dead ones too."""
    me = psutil.Process()

    def spent() -> float:
        dead = me.cpu_times()
        return cpu_seconds(me) + dead.children_user + dead.children_system

    before, started = spent(), time.perf_counter()
    work()
    return time.perf_counter() - started, spent() - before


def figure(what: str, measured: float, unit: str, bound: str, note: str) -> Figure:
    """A line, rounded to three digits."""
    return Figure(what=what, measured=float(f"{measured:.3g}"), unit=unit, bound=bound, note=note)


HEADING = "\n## Rendering\n"
WORDS = """
Made by `make bench`, in one run; `benchmarks_rendering.csv` beside this page. The object is the oak
cabinet of `artgen study render`. CPU seconds do not depend on what else the machine does; where a
bound is in wall seconds, they are divided by {parallel}, which two idle cores make of two threads.
The plain script is `tests/bench/plain_cycles.py`: a fresh process, no persistent data, the default
denoiser, whole images of every part; errors of both are against its own image of many paths.

{table}

Resident memory of the Blender process and of its driver over {objects} objects:
![memory](studies/memory.png)
"""


def measured_figures(bundles: Sequence[Bundle], folder: Path) -> list[Figure]:
    """All of them; the first bundle is the object."""
    bundle = bundles[0]
    found = label_figures(bundle, folder)
    with BlenderWorker(folder / "blender.log", threads=2) as worker:
        found += image_figures(bundle, folder / "images", worker)
        found.append(object_figure(bundle, folder, worker))
        found += fast_figures(bundle, folder, worker)
    return [*found, *plain_figures(bundle, folder, 2), worker_figure(bundles, folder)]


def main() -> None:
    """Measure and rewrite the section."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--objects", type=int, default=300, help="rendered for the memory plot")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        bundles = list(made_bundles(folder / "scenes").values())
        found = measured_figures(bundles, folder)
        measure_memory(bundles, folder / "memory", DOCS / "studies", objects=options.objects)
    write_table(DOCS / "benchmarks_rendering.csv", found)
    lines = [(f.what, f"{f.measured:g} {f.unit}", f.bound, f.note) for f in found]
    table = markdown_table(("figure", "measured", "bound", "note"), lines)
    words = WORDS.format(table=table, parallel=PARALLEL, objects=options.objects)
    page = DOCS / "benchmarks.md"
    above = page.read_text(encoding="utf-8").split(HEADING)[0]
    page.write_text(f"{above.rstrip()}\n{HEADING}{words}", encoding="utf-8")


if __name__ == "__main__":
    main()
