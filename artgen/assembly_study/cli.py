"""`artgen study assembly`."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import tyro

from artgen.assembly.embedded import cache_folder, embedded_library
from artgen.assembly.run import opened_market
from artgen.assembly_study.chunks import read_chunk, save_chunk
from artgen.assembly_study.page import page
from artgen.assembly_study.plots import write_histograms
from artgen.assembly_study.rows import WHAT, Chunk, ChunkTask, measured, open_market
from artgen.assembly_study.sheet import write_sheet
from artgen.core.errors import ArtgenError, UsageError
from artgen.core.jsonio import write_bytes
from artgen.pipeline import Toolbox
from artgen.pool import run_in_processes
from artgen.progress import progress
from artgen.run_folder import RunFolder
from artgen.studies.table import write_table

CHUNK = 25
"""Attempts a task; about seven seconds of work."""
TASK_TIMEOUT_S = 900.0


@dataclass(frozen=True, kw_only=True)
class Study:
    """Assemble many objects without exporting them: how many are accepted and distinct, how evenly
    donors are used, how texture lies before and after its correction; a contact sheet."""

    count: int = 1000
    """Attempts; --count 10000 takes about three quarters of an hour of one core."""
    seed: int = 0
    """Root of all randomness."""
    library: Path | None = None
    """A folder that `artgen library build` wrote; the embedded library if not given."""
    pictures: int = 48
    """Objects shown beside their templates; 0 for no contact sheet (about 3 CPU s each)."""
    out: Path = Path("docs/studies")
    """Receives assembly.md, assembly.csv, assembly_texture.png and assembly_sheet.webp."""
    kept: Path = Path("out/assembly_study")
    """Keeps finished tasks, so that an interrupted study goes on."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side."""


def study(argv: Sequence[str]) -> int:
    """What is assembled: distinct objects, acceptance, use of donors, texture before and after."""
    command = tyro.cli(Study, args=list(argv), prog="artgen study assembly")
    if command.count < 2 or command.pictures < 0:
        raise UsageError(f"--count {command.count} must be at least 2, --pictures not negative")
    place = command.library or embedded_library(
        cache_folder(os.environ), own=command.kept, workers=command.workers, show=progress
    )
    market = opened_market(place, WHAT)
    chunks = all_chunks(command, place, market.library.digest)
    rows = [row for chunk in chunks for row in chunk.rows]
    if not any(row.accepted for row in rows):
        raise ArtgenError(f"{place}: nothing can be assembled from it: {rows[0].reason}")
    write_table(command.out / "assembly.csv", rows)
    write_histograms(command.out / "assembly_texture.png", chunks)
    shown = [row.index for row in rows if row.accepted][: command.pictures]
    if shown:
        tools = Toolbox(RunFolder(command.kept), "study")
        write_sheet(
            command.out / "assembly_sheet.webp", market, shown,
            seed=command.seed, tools=tools, show=progress,
        )  # fmt: skip
    text = page(market, chunks, seed=command.seed, sheet=bool(shown))
    write_bytes(command.out / "assembly.md", text.encode())
    print(f"page: {command.out / 'assembly.md'}")  # noqa: T201
    return 0


def all_chunks(command: Study, library: Path, digest: str) -> list[Chunk]:
    """Every chunk, in order; those of an earlier run of the same library and seed are kept."""
    home = command.kept / f"{digest[:12]}-{command.seed}"
    starts = range(0, command.count, CHUNK)
    tasks = [
        ChunkTask(library=library, seed=command.seed, start=k, stop=min(k + CHUNK, command.count))
        for k in starts
    ]
    missing = [task for task in tasks if not _place(home, task).exists()]
    with progress("chunks", len(missing)) as advance:
        outcomes = run_in_processes(
            missing,
            measured,
            workers=command.workers,
            initializer=open_market,
            initargs=(library,),
            timeout_s=TASK_TIMEOUT_S,
            lost=_lost,
        )
        for chunk in outcomes if missing else ():
            rows = chunk.rows
            save_chunk(home / f"{rows[0].index}-{rows[-1].index + 1}.json", chunk)
            advance(f"{sum(row.accepted for row in rows)} of {len(rows)} accepted")
    return [read_chunk(_place(home, task)) for task in tasks]


def _place(home: Path, task: ChunkTask) -> Path:
    return home / f"{task.start}-{task.stop}.json"


def _lost(task: ChunkTask, cause: str) -> Chunk:
    raise ArtgenError(f"{task.asset_id} cannot be assembled: {cause}")
