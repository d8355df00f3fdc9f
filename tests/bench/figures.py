"""`make bench`: what an asset costs and whether every tool takes it; writes docs/benchmarks.md."""

import argparse
import math
import os
import platform
import shutil
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import psutil
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from artgen.cli import run_command
from artgen.core.errors import ArtgenError
from artgen.export import read_bundle
from artgen.pipeline import AssetTask, Toolbox, make_asset
from artgen.pool import run_in_processes
from artgen.progress import progress
from artgen.rules import rule_names
from artgen.run_folder import RunFolder
from artgen.studies.table import markdown_table, write_table
from artgen.validate import validate_bundle
from tests.bench.acceptance import CHECKS, gltf_verdicts, verdicts
from tests.texels import texel_figures

SEED = 20261121
ACCEPTED = 6
"""Bundles a category that are given to other tools."""
THROUGHPUT = 1
"""Assets a category that one worker and two make against the clock."""
DOCS = Path("docs")


@dataclass(frozen=True, kw_only=True)
class Row:
    """One asset; CPU seconds count the Blender process too."""

    asset_id: str
    status: str
    make_cpu_s: float = math.nan
    validate_cpu_s: float = math.nan
    process: int = 0
    driver_mb: float = math.nan
    blender_mb: float = math.nan
    bundle_mb: float = math.nan
    files: int = 0
    triangles: int = 0
    texel_ratio: float = math.nan
    atlas_shared: float = math.nan
    message: str = ""


def cpu_seconds(process: psutil.Process) -> float:
    """User and system time of a process and of its living children."""
    return sum(sum(p.cpu_times()[:2]) for p in (process, *process.children(recursive=True)))


_tools: Toolbox | None = None
"""Of this process; set once by the pool's initializer."""


def open_tools(root: Path) -> None:
    """Tools of a process, warmed by an asset that is not counted."""
    global _tools
    _tools = Toolbox(RunFolder(root), f"bench-{os.getpid()}")
    warm = Toolbox(RunFolder(root / "warm" / str(os.getpid())), "warm")
    warm.blender = _tools.blender
    make_asset(AssetTask(category="laptop", index=999_999, seed=SEED), warm)


def measured(task: AssetTask) -> Row:
    """Make one asset in this process and weigh it; the Blender process is warm."""
    if _tools is None:
        raise RuntimeError("the pool did not open its tools")
    me = psutil.Process()
    before = cpu_seconds(me)
    try:
        outcome = make_asset(task, _tools)
    except ArtgenError as error:
        return lost(task, str(error))
    made = cpu_seconds(me) - before
    home = task.place(_tools.folder.assets if outcome.status == "made" else _tools.folder.failed)
    started = time.process_time()
    validate_bundle(home)
    validated = time.process_time() - started
    files = [path for path in home.rglob("*") if path.is_file()]
    bundle = read_bundle(home)
    texel_ratio, atlas_shared = texel_figures(home)
    return Row(
        asset_id=task.asset_id,
        status=outcome.status,
        make_cpu_s=made - validated,
        validate_cpu_s=validated,
        process=me.pid,
        driver_mb=me.memory_info().rss / 2**20,
        blender_mb=sum(child.memory_info().rss for child in me.children()) / 2**20,
        bundle_mb=sum(path.stat().st_size for path in files) / 1e6,
        files=len(files),
        triangles=sum(part.triangles for part in bundle.parts),
        texel_ratio=texel_ratio,
        atlas_shared=atlas_shared,
        message=outcome.message,
    )


def lost(task: AssetTask, cause: str) -> Row:
    """The row of an asset that was not made."""
    return Row(asset_id=task.asset_id, status="failed", message=cause)


def measure_assets(root: Path, tasks: Sequence[AssetTask], *, workers: int) -> list[Row]:
    """Every task, in the order of completion."""
    rows = []
    with progress("assets", len(tasks)) as advance:
        outcomes = run_in_processes(
            tasks, measured, workers=workers, initializer=open_tools, initargs=(root,),
            timeout_s=300.0, lost=lost,
        )  # fmt: skip
        for row in outcomes:
            rows.append(row)
            advance(f"{row.asset_id} {row.status}")
    return rows


def measure_throughput(root: Path, categories: Sequence[str]) -> tuple[float, float]:
    """Wall seconds for assets of every category by one worker and by two, processes' start
    included."""
    seconds = []
    for workers in (1, 2):
        words = [
            "--categories",
            *categories,
            "--count",
            str(THROUGHPUT * len(categories)),
            "--no-render",
        ]
        started = time.perf_counter()
        run_command(
            "generate",
            [*words, "--seed", str(SEED), "--workers", str(workers), "--out", f"{root}-{workers}"],
        )
        seconds.append(time.perf_counter() - started)
    return seconds[0], seconds[1]


def measure_renders(
    root: Path, scratch: Path, categories: Sequence[str], *, per_category: int
) -> dict[str, float]:
    """Wall seconds an asset for 4 views x 2 states at 128 px with all part images, on all cores."""
    costs = {}
    for category in categories:
        part = scratch / f"render-{category}"
        chosen = sorted((root / "assets" / category).iterdir())[:per_category]
        for folder in chosen:
            shutil.copytree(folder, part / "assets" / category / folder.name)
        started = time.perf_counter()
        run_command("render", [str(part), "--seed", str(SEED)])
        costs[category] = (time.perf_counter() - started) / len(chosen)
    return costs


def measure_acceptance(root: Path) -> list[tuple[str, int, int]]:
    """(tool, passed, asked) over the first bundles of every category."""
    folders = [
        path.parent
        for category in sorted((root / "assets").iterdir())
        for path in sorted(category.glob("*/manifest.json"))[:ACCEPTED]
    ]
    found = [verdicts(folder) for folder in folders]
    table = [(tool, sum(not f[tool] for f in found), len(found)) for tool in CHECKS]
    gltf = gltf_verdicts(folders)
    if gltf is not None:
        table.append(
            ("Khronos glTF validator", sum(v["errors"] == 0 for v in gltf.values()), len(folders))
        )
    return table


HEADER = (
    *("category", "assets", "passed", "build + finish + export, CPU s", "validate, CPU s"),
    *("triangles", "bundle, MB", "files", "texels a meter, greatest over least"),
    *("atlas that two places share", "render 4 x 2 at 128 px, wall s"),
)


def report(
    rows: Sequence[Row],
    renders: dict[str, float],
    accepted: list[tuple[str, int, int]],
    throughput: tuple[float, float],
) -> str:
    """The page."""
    table = [category_line(category, rows, renders) for category in rule_names()]
    tools = [[tool, f"{passed} of {asked}"] for tool, passed, asked in accepted]
    all_cpu = [row.make_cpu_s + row.validate_cpu_s for row in rows if row.status == "made"]
    return PAGE.format(
        cores=psutil.cpu_count(),
        machine=platform.machine(),
        memory=psutil.virtual_memory().total / 1e9,
        system=platform.system(),
        table=markdown_table(HEADER, table),
        passed=sum(row.status == "made" for row in rows),
        count=len(rows),
        cpu=middle_and_top(all_cpu, 2),
        throughput=THROUGHPUT,
        one=throughput[0],
        two=throughput[1],
        ratio=throughput[0] / throughput[1],
        tools=markdown_table(("tool", "bundles accepted without error"), tools),
    )


def category_line(category: str, rows: Sequence[Row], renders: dict[str, float]) -> list[str]:
    """One line of the table; numbers are median and greatest."""
    mine = [row for row in rows if row.asset_id.rsplit("_", 1)[0] == category]
    made = [row for row in mine if row.status == "made"]
    return [
        category,
        str(len(mine)),
        str(len(made)),
        middle_and_top([row.make_cpu_s for row in made], 2),
        middle_and_top([row.validate_cpu_s for row in made], 3),
        middle_and_top([float(row.triangles) for row in made], 0),
        middle_and_top([row.bundle_mb for row in made], 2),
        middle_and_top([float(row.files) for row in made], 0),
        middle_and_top([row.texel_ratio for row in made], 2),
        f"{max(row.atlas_shared for row in made):.1e}",
        f"{renders.get(category, math.nan):.1f}",
    ]


PAGE = """\
# Benchmarks

Made by `make bench`; `benchmarks.csv` beside this page has a line per asset.

Machine: {cores} cores, {machine}, {memory:.0f} GB, {system}. CPU seconds are user + system and
include the Blender process; numbers in a cell are median and greatest. Areas of the atlas that two
places share are roundings of UV to 1e-6 in triangles that touch.

{table}

{passed} of {count} assets passed; {cpu} CPU s an asset over all categories.

{throughput} of every category by `artgen generate`: {one:.0f} s with one worker, {two:.0f} s
with two, {ratio:.2f} times as fast, the start of processes included.

{tools}

Resident memory of every process that makes assets, and of its Blender:

![memory](studies/memory_generate.png)

"""


def middle_and_top(values: Sequence[float], digits: int) -> str:
    """`median, max`."""
    return f"{median(values):.{digits}f}, {max(values):.{digits}f}"


def plot_memory(path: Path, rows: Sequence[Row]) -> None:
    """Resident size of every process and its Blender over the assets it made."""
    figure = Figure(figsize=(7.2, 3.6), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    for number, process in enumerate(dict.fromkeys(row.process for row in rows if row.process)):
        mine = [row for row in rows if row.process == process]
        axes.plot([row.driver_mb for row in mine], label=f"worker {number + 1}")
        axes.plot([row.blender_mb for row in mine], label=f"its Blender {number + 1}")
    axes.set(xlabel="assets made by the worker", ylabel="resident MB", ylim=(0, None))
    axes.grid(visible=True, alpha=0.25)
    axes.legend(fontsize=7)
    figure.savefig(path, metadata={"Software": None})


def main() -> None:
    """Measure and rewrite the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--per-category", type=int, default=50)
    parser.add_argument("--render", type=int, default=1, help="assets a category that are rendered")
    parser.add_argument("--keep", type=Path, help="new folder that receives the assets and stays")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    names = rule_names()
    tasks = [
        AssetTask(category=category, index=index, seed=SEED)
        for index in range(options.per_category)
        for category in names
    ]
    with tempfile.TemporaryDirectory() as scratch:
        root = options.keep or Path(scratch) / "run"
        rows = measure_assets(root, tasks, workers=options.workers)
        accepted = measure_acceptance(root)
        renders = measure_renders(root, Path(scratch), names, per_category=options.render)
        throughput = measure_throughput(Path(scratch) / "throughput", names)
    plot_memory(DOCS / "studies" / "memory_generate.png", rows)
    rows = sorted(rows, key=lambda row: row.asset_id)
    write_table(DOCS / "benchmarks.csv", rows)
    page = report(rows, renders, accepted, throughput)
    (DOCS / "benchmarks.md").write_text(page)
    print(page)  # noqa: T201


if __name__ == "__main__":
    main()
