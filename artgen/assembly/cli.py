"""`artgen library` and `artgen assemble`: one dataclass each, which is the option list and the
help.
"""

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import tyro
from rich.console import Console
from rich.table import Table

from artgen.assembly.build import Taken, build_library
from artgen.assembly.embedded import cache_folder, embedded_library
from artgen.assembly.harvest import bundle_folders, embedded
from artgen.assembly.library import Library
from artgen.assembly.run import (
    TEMPLATES,
    AssembleTask,
    check_kept,
    opened_market,
    run_tasks,
    set_twins_aside,
)
from artgen.core.errors import UsageError, did_you_mean
from artgen.export.thumbnails import write_thumbnails
from artgen.pipeline import Outcome
from artgen.progress import progress
from artgen.run_folder import RunFolder, opened, run_log
from artgen.system_libraries import check_libraries

BYTES_PER_OBJECT = 4_000_000
TOLD = 20
"""Bundles left out of a library that are named."""


@dataclass(frozen=True, kw_only=True)
class LibraryBuild:
    """Collect donors and templates from bundles and from artgen's own generators.

    The folder receives index.parquet (one row a part: role, box, hinge side, handle, materials,
    licence, hash of its shape), a JSON file a source, and meshes named by their content. Bundles
    may come from generate or from ingest; each keeps its licence. An interrupted build goes on.
    """

    bundles: tyro.conf.Positional[tuple[Path, ...]] = ()
    """Bundles, or folders that hold some at any depth; of runs what passed, not what lies in
    failed/. Assembled ones are left out: take in what they are made from."""
    embedded: bool = True
    """Also take in the embedded library, made by artgen's own generators."""
    sharp: bool = False
    """Leave the edges of what is generated sharp; needs no Blender."""
    out: Path = Path("out/library")
    """Folder of the library."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side; the result is the same for any number."""


def library(argv: Sequence[str]) -> int:
    """Collect doors, drawers, handles and bodies into a library of donors: 0 all taken in, 1 some
    left out."""
    words = list(argv)
    if words[:1] != ["build"]:
        helped = words[:1] in (["-h"], ["--help"])
        if not helped:
            raise UsageError("artgen library knows one action: build; see artgen library build -h")
        words = ["build", "--help"]
    command = tyro.cli(LibraryBuild, args=words[1:], prog="artgen library build")
    if not command.sharp and command.embedded:
        check_libraries()
    bundles = bundle_folders(command.bundles)
    made = embedded() if command.embedded else []
    if not made and not bundles:
        raise UsageError("nothing to take in: name bundles, or leave out --no-embedded")
    digest, faults = build_library(
        command.out,
        made=made,
        bundles=bundles,
        workers=command.workers,
        show=progress,
        sharp=command.sharp,
    )
    tell_library(Library(command.out), Console())
    tell_left_out(faults, Console(soft_wrap=True))
    Console().print(f"library {command.out}, digest {digest[:12]}", highlight=False)
    return int(bool(faults))


def tell_left_out(faults: Sequence[Taken], console: Console) -> None:
    """A line for each source that is not in the library, up to a number."""
    for fault in faults[:TOLD]:
        console.print(f"left out {fault.task}: {fault.fault}", highlight=False, markup=False)
    if (more := len(faults) - TOLD) > 0:
        console.print(f"left out {more} more", highlight=False)


def tell_library(found: Library, console: Console) -> None:
    """A table of what a library holds."""
    table = Table("part", "opens", "kind", "number", "shapes", "handles", "licences")
    kinds = sorted({(e.label, e.side, e.kind) for e in found.entries})
    for label, side, kind in kinds:
        own = [e for e in found.entries if (e.label, e.side, e.kind) == (label, side, kind)]
        table.add_row(
            label,
            side,
            kind,
            str(len(own)),
            str(len({e.shape for e in own})),
            str(len({e.handle_shape for e in own if e.handle})),
            ", ".join(sorted({e.licence for e in own})),
        )
    console.print(table)


@dataclass(frozen=True, kw_only=True)
class Assemble:
    """Make new objects: the tree of a template, its fronts and handles from donors.

    Donors are fitted to the slots (a scale for each axis, mirrored for the other hinge side, frames
    kept at their width), texture coordinates corrected, woods, paints and metals drawn anew. Each
    object is validated like every asset. One that does not fit after other donors were tried is
    given up with its reason. Interrupted runs resume: object i depends on (library, seed, i) alone.

    For example:

    artgen assemble storage_furniture --count 20

    artgen library build out/ingested --out out/library

    artgen assemble storage_furniture --count 1000 --library out/library --out out/thousand
    """

    what: tyro.conf.Positional[str]
    """What to make: storage_furniture."""
    count: int = 10
    """How many objects to try; about one in a hundred is given up."""
    seed: int = 0
    """Root of all randomness."""
    library: Path | None = None
    """A folder that `artgen library build` wrote; the embedded library if not given, which is built
    once a machine, in artgen/ under $XDG_CACHE_HOME or ~/.cache, or in $ARTGEN_CACHE."""
    out: Path = Path("out/assembled")
    """Folder of the run; receives assets/assembled, failed/assembled, contact_sheet.png, logs."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side; the result is the same for any number."""


def assemble(argv: Sequence[str]) -> int:
    """Templates and donors to new validated objects."""
    command = tyro.cli(Assemble, args=argv, prog="artgen assemble")
    if command.what not in TEMPLATES:
        hint = did_you_mean(command.what, list(TEMPLATES))
        raise UsageError(f"{command.what!r} is not assembled{hint}; known: {', '.join(TEMPLATES)}")
    if min(command.count, command.workers) < 1:
        raise UsageError(
            f"--count {command.count} and --workers {command.workers} must be at least 1"
        )
    check_libraries()
    need = command.count * BYTES_PER_OBJECT
    with opened(command.out, seed=command.seed, need_bytes=need) as folder:
        place = command.library or embedded_library(
            cache_folder(os.environ), own=folder.work, workers=command.workers, show=progress
        )
        tell_terms(opened_market(place, command.what).library, Console(soft_wrap=True))
        tasks = [
            AssembleTask(what=command.what, index=k, seed=command.seed, library=place)
            for k in range(command.count)
        ]
        outcomes = make_objects(folder, tasks, workers=command.workers)
        homes = [(task.asset_id, task.place(folder.assets)) for task in tasks]
        write_thumbnails(folder.contact_sheet, homes)
        tell_outcomes(folder, outcomes)
    return 0 if any(outcome.status != "failed" for outcome in outcomes) else 1


def make_objects(
    folder: RunFolder, tasks: Sequence[AssembleTask], *, workers: int
) -> list[Outcome]:
    """Make what is missing; one line per object and stage goes to logs/run.log."""
    kept = check_kept(folder, tasks, Library(tasks[0].library).digest)
    outcomes = {
        task.asset_id: Outcome(asset_id=task.asset_id, status="kept")
        for task in tasks
        if task.asset_id in kept
    }
    missing = [task for task in tasks if task.asset_id not in kept]
    record = run_log(folder)
    with progress("objects", len(missing)) as advance:
        for outcome in run_tasks(folder, missing, workers=workers) if missing else ():
            for stage, seconds in outcome.seconds.items():
                record.info("%s %s %.2f s", outcome.asset_id, stage, seconds)
            record.info("%s %s %s", outcome.asset_id, outcome.status, outcome.message)
            outcomes[outcome.asset_id] = outcome
            advance(f"{outcome.asset_id} {outcome.status}")
    for twin in set_twins_aside(folder, tasks):
        outcomes[twin.asset_id] = twin
    return [outcomes[task.asset_id] for task in tasks]


def tell_terms(library: Library, console: Console) -> None:
    """Which of a library's sources may not be handed on, with what is made from them."""
    bound = {e.source: e.licence for e in library.entries if not e.distributable}
    if bound:
        licences = ", ".join(sorted(set(bound.values())))
        console.print(
            f"{len(bound)} sources of the library may not be handed on ({licences}), nor may what "
            "is made from them; their manifests say so, and artgen shard --public refuses them",
            highlight=False,
        )


def tell_outcomes(folder: RunFolder, outcomes: Sequence[Outcome]) -> None:
    """How many came out, why others did not, and where everything lies."""
    console = Console()
    failed = [outcome for outcome in outcomes if outcome.status == "failed"]
    passed = len(outcomes) - len(failed)
    console.print(
        f"{passed} of {len(outcomes)} objects ({100.0 * passed / len(outcomes):.0f} %) in "
        f"{folder.assets}",
        highlight=False,
    )
    for message, count in Counter(outcome.message for outcome in failed).most_common(20):
        console.print(f"given up {count} x {message}", highlight=False, markup=False)
    if folder.contact_sheet.exists():
        console.print(f"pictures {folder.contact_sheet}", highlight=False)
    console.print(f"log {folder.logs / 'run.log'}", highlight=False)
