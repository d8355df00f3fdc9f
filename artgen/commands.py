"""`artgen generate`, `categories` and `inspect`: one dataclass each, which is the option list and
the help.
"""

import csv
import io
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import tyro
from rich.console import Console
from rich.table import Table

from artgen.cli import run_command
from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes
from artgen.export import Bundle, read_bundle
from artgen.pipeline import BYTES_PER_ASSET, Outcome, build_assets, plan
from artgen.rules import load_rule, parse_override, rule_names
from artgen.run_folder import RunFolder, opened
from artgen.system_libraries import check_libraries
from artgen.validate import bundle_subject
from artgen.validate.interior import open_interiors


@dataclass(frozen=True, kw_only=True)
class Generate:
    """Make assets from category rules: build, validate, render, pack shards, write a catalog.

    Interrupted runs resume: the same command again makes what is missing and ends in the same
    bytes.
    Asset i of a category depends on (seed, category, i) alone, so a larger count adds assets and
    changes none.
    """

    categories: tuple[str, ...] = ()
    """Which categories; all that `artgen categories` lists when none is named."""
    count: int | None = None
    """How many assets in all, dealt out to the categories in turn; one of each if not given."""
    seed: int = 0
    """Root of all randomness."""
    set: tuple[str, ...] = ()
    """Parameters to set, such as cabinet.rows=3, dishwasher.surfaces.front=enamel_white or
    'laptop.width={ uniform = [0.3, 0.32] }'; checked like a rule."""
    out: Path = Path("out")
    """Folder of the run; receives assets, samples, shards, catalog, contact sheet, summary and
    logs.
    """
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side; the result is the same for any number."""
    views: int = 4
    """Cameras per asset."""
    states: int = 2
    """Joint states per asset."""
    size: int = 128
    """Image width and height, px."""
    bake_ao: bool = False
    """Also bake ambient occlusion onto the atlas of every GLB; about 5 CPU s an asset."""
    render: bool = True
    """Render and pack shards after the assets are made; --no-render stops at validated bundles."""


def generate(argv: Sequence[str]) -> int:
    """Category rules to validated, rendered, sharded assets."""
    command = tyro.cli(Generate, args=argv, prog="artgen generate")
    if min(command.workers, command.views, command.states) < 1 or command.size < 16:
        raise UsageError(
            f"--workers {command.workers}, --views {command.views} and --states {command.states} "
            f"must be at least 1, --size {command.size} at least 16"
        )
    check_libraries()
    names = command.categories or tuple(rule_names())
    tasks = plan(
        names,
        len(set(names)) if command.count is None else command.count,
        command.seed,
        occlusion=command.bake_ao,
        overrides=[parse_override(word) for word in command.set],
    )
    with opened(command.out, seed=command.seed, need_bytes=len(tasks) * BYTES_PER_ASSET) as folder:
        outcomes = build_assets(folder, tasks, workers=command.workers)
        code = 0
        if command.render and any(outcome.status != "failed" for outcome in outcomes):
            code = render_and_pack(command)
        write_summary(folder)
        announce(folder, outcomes, rendered=command.render)
    return max(code, int(any(outcome.status == "failed" for outcome in outcomes)))


def render_and_pack(command: Generate) -> int:
    """The render and shard commands over the whole folder; the worse of their exit codes."""
    out = str(command.out)
    rendered = run_command(
        "render",
        [
            out,
            *("--views", str(command.views), "--states", str(command.states)),
            *("--size", str(command.size), "--seed", str(command.seed)),
            *("--workers", str(command.workers)),
        ],
    )
    return max(rendered, run_command("shard", [out]))


COLUMNS = (
    *("asset_id", "verdict", "parts", "joints", "mass_kg"),
    *("width_m", "depth_m", "height_m", "triangles", "files", "bytes"),
)


def write_summary(folder: RunFolder) -> None:
    """summary.csv: one line per asset, sorted by id."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for root, verdict in ((folder.assets, "passed"), (folder.failed, "failed")):
        for manifest in sorted(root.glob("*/*/manifest.json")):
            table.writerow(_summary_row(read_bundle(manifest.parent), verdict))
    write_bytes(folder.summary, text.getvalue().encode())


def _summary_row(bundle: Bundle, verdict: str) -> list[str | int | float]:
    width, depth, height = bundle.bounds[1] - bundle.bounds[0]
    files = [path for path in bundle.folder.rglob("*") if path.is_file()]
    return [
        bundle.asset_id,
        verdict,
        len(bundle.parts),
        len(bundle.joints),
        round(bundle.mass, 3),
        *(round(float(side), 4) for side in (width, depth, height)),
        sum(part.triangles for part in bundle.parts),
        len(files),
        sum(path.stat().st_size for path in files),
    ]


def announce(folder: RunFolder, outcomes: Sequence[Outcome], *, rendered: bool) -> None:
    """A table of the run and where everything lies."""
    console = Console()
    table = Table("category", "passed", "failed", title=f"{folder.root}")
    names = sorted({outcome.asset_id.rsplit("_", 1)[0] for outcome in outcomes})
    for name in names:
        mine = [o for o in outcomes if o.asset_id.rsplit("_", 1)[0] == name]
        failed = sum(o.status == "failed" for o in mine)
        table.add_row(name, str(len(mine) - failed), str(failed))
    console.print(table)
    for outcome in outcomes:
        if outcome.status == "failed":
            console.print(f"failed {outcome.asset_id}: {outcome.message}", highlight=False)
    places = [
        ("assets", folder.assets),
        ("summary", folder.summary),
        ("log", folder.logs / "run.log"),
    ]
    if rendered:
        places += [
            ("shards", folder.root / "shards"),
            ("catalog", folder.root / "catalog"),
            ("contact sheet", folder.contact_sheet),
        ]
    for what, place in places:
        console.print(f"{what:<14} {place}", highlight=False)


@dataclass(frozen=True, kw_only=True)
class Categories:
    """List the categories that have a rule, with what varies in each."""

    verbose: bool = False
    """Also list every parameter and what it is drawn from."""


def categories(argv: Sequence[str]) -> int:
    """List the categories and what varies in each."""
    command = tyro.cli(Categories, args=argv, prog="artgen categories")
    console = Console()
    table = Table(
        "category", "version", "parameters", "size w x d x h, m", "mass, kg", "what it is"
    )
    for name in rule_names():
        rule = load_rule(name)
        sides = " x ".join(
            f"{rule.bands[k].lower:g}-{rule.bands[k].upper:g}" for k in ("width", "depth", "height")
        )
        mass = f"{rule.bands['mass'].lower:g}-{rule.bands['mass'].upper:g}"
        table.add_row(name, str(rule.version), str(len(rule.draws)), sides, mass, rule.summary)
    console.print(table)
    if command.verbose:
        for name in rule_names():
            console.print(f"[bold]{name}[/]")
            for key, draw in load_rule(name).draws.items():
                console.print(f"  {key:<24} {draw.distribution}", highlight=False)
    return 0


@dataclass(frozen=True, kw_only=True)
class Inspect:
    """Print what is in a bundle: parts, joints, masses, files."""

    bundle: tyro.conf.Positional[Path]
    """Folder of one asset."""


def inspect(argv: Sequence[str]) -> int:
    """Print the parts, joints, masses and files of a bundle."""
    command = tyro.cli(Inspect, args=argv, prog="artgen inspect")
    bundle = read_bundle(command.bundle)
    console = Console()
    size = " x ".join(f"{side:.3f}" for side in bundle.bounds[1] - bundle.bounds[0])
    console.print(f"{bundle.asset_id}: {size} m, {bundle.mass:.2f} kg", highlight=False)
    parts = Table("part", "label", "mass, kg", "triangles", "collision pieces", "surfaces")
    for part in bundle.parts:
        parts.add_row(
            part.name,
            part.label,
            f"{part.mass.mass:.3f}",
            str(part.triangles),
            str(len(part.collision)),
            ", ".join(part.surfaces),
        )
    console.print(parts)
    joints = Table("joint", "type", "parent", "child", "axis", "limits", "friction", "needs")
    for joint in bundle.joints:
        needs = [
            f"{r.requires} >= {r.at_least:.3f}"
            for r in bundle.preconditions
            if r.joint == joint.name
        ]
        limits = (
            "none" if joint.limit is None else f"{joint.limit.lower:.3f} .. {joint.limit.upper:.3f}"
        )
        axis = " ".join(f"{a:g}" for a in joint.axis)
        joints.add_row(
            joint.name,
            joint.type,
            joint.parent,
            joint.child,
            axis,
            limits,
            f"{joint.friction:g}",
            ", ".join(needs),
        )
    console.print(joints)
    for interior in open_interiors(bundle_subject(command.bundle)):
        console.print(str(interior), highlight=False)
    for path in sorted(command.bundle.rglob("*")):
        if path.is_file():
            console.print(
                f"{path.stat().st_size:>9} {path.relative_to(command.bundle)}", highlight=False
            )
    return 0
