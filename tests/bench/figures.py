"""`make bench`: what an asset costs and whether every tool takes it; writes docs/benchmarks.md."""

import argparse
import csv
import json
import platform
import re
import resource
import shutil
import tempfile
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median

import psutil

from artgen.cli import run_command
from artgen.pipeline import AssetTask, Toolbox, make_asset
from artgen.rules import rule_names
from artgen.run_folder import RunFolder
from artgen.validate import validate_bundle
from tests.bench.acceptance import CHECKS, gltf_verdicts, verdicts

SEED = 20261121
DOCS = Path("docs")


@dataclass(frozen=True, kw_only=True)
class Row:
    """One asset; CPU seconds count the Blender process too."""

    asset_id: str
    status: str
    make_cpu_s: float
    validate_cpu_s: float
    worker_mb: float
    bundle_mb: float
    files: int
    triangles: int


def cpu_seconds(process: psutil.Process) -> float:
    """User and system time of a process and of its living children."""
    return sum(sum(p.cpu_times()[:2]) for p in (process, *process.children(recursive=True)))


def peak_mb(pid: int) -> float:
    """Largest resident size that a process had, from Linux' accounts."""
    status = Path(f"/proc/{pid}/status").read_text()
    return float(re.search(r"VmHWM:\s+(\d+) kB", status)[1]) / 1024.0


def measured(task: AssetTask, tools: Toolbox) -> Row:
    """Make one asset in this process and weigh it; the Blender process is warm."""
    me = psutil.Process()
    before = cpu_seconds(me)
    outcome = make_asset(task, tools)
    made = cpu_seconds(me) - before
    home = task.place(tools.folder.assets if outcome.status == "made" else tools.folder.failed)
    started = time.process_time()
    validate_bundle(home)
    validated = time.process_time() - started
    files = [path for path in home.rglob("*") if path.is_file()]
    stated = json.loads((home / "manifest.json").read_text())
    return Row(
        asset_id=task.asset_id,
        status=outcome.status,
        make_cpu_s=made - validated,
        validate_cpu_s=validated,
        worker_mb=max(peak_mb(child.pid) for child in me.children()),
        bundle_mb=sum(path.stat().st_size for path in files) / 1e6,
        files=len(files),
        triangles=sum(part["triangles"] for part in stated["parts"]),
    )


def measure_assets(root: Path, per_category: int) -> list[Row]:
    """`per_category` unseen assets of every category, one after another."""
    tools = Toolbox(RunFolder(root), "bench")
    rows = []
    with tools.blender:
        make_asset(AssetTask(category=rule_names()[0], index=999_999, seed=SEED), tools)  # warm up
        shutil.rmtree(root / "assets", ignore_errors=True)
        for category in rule_names():
            for index in range(per_category):
                rows.append(measured(AssetTask(category=category, index=index, seed=SEED), tools))
    return rows


def measure_renders(root: Path, categories: Sequence[str]) -> dict[str, float]:
    """Wall seconds an asset for 4 views x 2 states at 128 px with all part images, on all cores."""
    costs = {}
    for category in categories:
        part = root / f"render-{category}"
        shutil.copytree(root / "assets" / category, part / "assets" / category)
        count = len(list((part / "assets" / category).iterdir()))
        started = time.perf_counter()
        run_command("render", [str(part), "--seed", str(SEED)])
        costs[category] = (time.perf_counter() - started) / count
    return costs


def measure_acceptance(root: Path) -> list[tuple[str, int, int]]:
    """(tool, passed, asked) over every bundle below `root`/assets."""
    folders = sorted(path.parent for path in (root / "assets").glob("*/*/manifest.json"))
    found = [verdicts(folder) for folder in folders]
    table = [(tool, sum(not f[tool] for f in found), len(found)) for tool in CHECKS]
    gltf = gltf_verdicts(folders)
    if gltf is not None:
        table.append(
            ("Khronos glTF validator", sum(v["errors"] == 0 for v in gltf.values()), len(folders))
        )
    return table


def report(rows: list[Row], renders: dict[str, float], accepted: list[tuple[str, int, int]]) -> str:
    """The page."""
    lines = [
        "# Benchmarks",
        "",
        "Made by `make bench`; `benchmarks.csv` beside this page has a line per asset.",
        "",
        f"Machine: {psutil.cpu_count()} cores, {platform.machine()}, "
        f"{psutil.virtual_memory().total / 1e9:.0f} GB, {platform.system()}. "
        "CPU seconds are user + system and include the Blender process.",
        "",
        "| category | assets | passed | build + finish + export, CPU s (median, max) "
        "| validate, CPU s (median, max) | bundle, MB (median, max) | files (max) "
        "| Blender worker, MB (max) | render 4 x 2 at 128 px, wall s |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for category in rule_names():
        mine = [row for row in rows if row.asset_id.startswith(category)]
        lines.append(
            f"| {category} | {len(mine)} | {sum(r.status == 'made' for r in mine)} "
            f"| {middle_and_top([r.make_cpu_s for r in mine], 2)} "
            f"| {middle_and_top([r.validate_cpu_s for r in mine], 3)} "
            f"| {middle_and_top([r.bundle_mb for r in mine], 2)} "
            f"| {max(r.files for r in mine)} | {max(r.worker_mb for r in mine):.0f} "
            f"| {renders.get(category, float('nan')):.1f} |"
        )
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    lines += [
        "",
        f"The process that drives the worker peaked at {own:.0f} MB.",
        "",
        "| tool | bundles accepted without error |",
        "|---|---|",
        *(f"| {tool} | {passed} of {asked} |" for tool, passed, asked in accepted),
        "",
    ]
    return "\n".join(lines)


def middle_and_top(values: Sequence[float], digits: int) -> str:
    """`median, max`."""
    return f"{median(values):.{digits}f}, {max(values):.{digits}f}"


def main() -> None:
    """Measure and rewrite the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--per-category", type=int, default=20)
    parser.add_argument("--render", type=int, default=4, help="assets a category that are rendered")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch)
        rows = measure_assets(root, options.per_category)
        accepted = measure_acceptance(root)
        for category in rule_names():
            for extra in sorted((root / "assets" / category).iterdir())[options.render :]:
                shutil.rmtree(extra)
        renders = measure_renders(root, rule_names())
    with (DOCS / "benchmarks.csv").open("w", newline="") as stream:
        table = csv.DictWriter(stream, fieldnames=list(asdict(rows[0])))
        table.writeheader()
        table.writerows(asdict(row) for row in rows)
    page = report(rows, renders, accepted)
    (DOCS / "benchmarks.md").write_text(page)
    print(page)  # noqa: T201


if __name__ == "__main__":
    main()
