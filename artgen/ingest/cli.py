"""`artgen ingest`: foreign objects to bundles; `artgen export`: bundles to foreign layouts."""

import dataclasses
import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro
from rich.console import Console

from artgen.core.errors import UsageError, did_you_mean
from artgen.core.licence import KNOWN
from artgen.export.thumbnails import write_thumbnails
from artgen.ingest.found import Found, found_files, found_folders
from artgen.ingest.meshes.scenes import MESHES
from artgen.ingest.options import GivenRest, Options
from artgen.ingest.report import table, write_report
from artgen.ingest.run import ingest_all
from artgen.ingest.static import Up
from artgen.ingest.task import Kind
from artgen.progress import progress
from artgen.run_folder import opened
from artgen.system_libraries import check_libraries

BYTES_PER_OBJECT = 6_000_000
USAGE = """\
usage: artgen ingest partnet DIR...   PartNet-Mobility folders that you have downloaded
       artgen ingest urdf FILE...     URDF files with OBJ, STL, GLB, DAE or PLY meshes
       artgen ingest static DIR...    GLB and other mesh files of objects that do not move

Each object becomes a bundle like those that artgen generates: closed at rest, in meters, with
collision, masses and all formats. `artgen ingest partnet --help` explains the options.
"""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """What all kinds of sources share."""

    paths: Annotated[tuple[Path, ...], tyro.conf.Positional] = ()
    """Folders or files; a folder of many is looked through."""
    out: Path = Path("out/ingested")
    """Folder of the run: assets/<category>/<object>, failed/, ingest_report.json and .txt,
    contact_sheet.png."""
    meters_per_unit: float | None = None
    """Scale of all objects; by default what the source states, or a usual size of the category."""
    max_parts: int = 40
    """Parts an object keeps; the smallest others are fixed to what carries them, and told."""
    density: float = 500.0
    """kg/m3 of everything; no source states it."""
    thickness: float = 0.004
    """m that open surfaces weigh as."""
    pieces: int = 40
    """Cuts that the collision of one part may take."""
    rest: Path | None = None
    """JSON file of closed poses that you know better: {"45940": {"3": 90.0}} puts the part that
    node 3 of the object in folder 45940 moves at 90 degrees (units, where it slides); of a URDF,
    the robot's name and the joint's. Entries that fit nothing are told."""
    licence: str | None = None
    """SPDX identifier of the objects' terms, such as CC-BY-4.0, CC-BY-NC-SA-4.0 or BSD-3-Clause.
    It lifts none: where the source binds more, as PartNet-Mobility does, that stays."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side; the result is the same for any number."""


@dataclass(frozen=True, kw_only=True)
class IngestPartnet(Settings):
    """Turn PartNet-Mobility object folders into bundles.

    The data set is gated and non-commercial: use your own copy; what is made from it is marked as
    not to be handed on. Interrupted runs resume; objects that cannot be used cost one line.
    """


@dataclass(frozen=True, kw_only=True)
class IngestUrdf(Settings):
    """Turn URDF files into bundles.

    Meshes may be OBJ (with MTL), STL, GLB, DAE or PLY, inside the folder that you name: give that
    of the package (`artgen ingest urdf my_robot`), or the file and --root. package://NAME/ is the
    nearest folder of that name. Lengths are meters, as URDF says, unless --meters-per-unit is
    given.
    """

    root: Path | None = None
    """Folder that no mesh may lie outside of; by default the folder below which the URDF was
    found, or its own where you name the file."""

    turn: float = -90.0
    """Degrees about z that bring the object's front to -y; -90 fits files whose front is +x."""


@dataclass(frozen=True, kw_only=True)
class IngestStatic(Settings):
    """Turn mesh files of objects that do not move into bundles, with their parts in order.

    Each file (GLB, OBJ, DAE, STL, PLY) is one object; its nodes are the parts: the largest first,
    the others low to high, front to back, left to right, the smallest beyond --max-parts joined to
    the largest. The manifest lists them under `fragments`.
    """

    up: Up = "y"
    """Axis that points up in the files; y as in glTF, with the front at +z, or z, front -y."""
    extensions: tuple[str, ...] = (".glb",)
    """Which files of a folder are objects."""


def ingest(argv: Sequence[str]) -> int:
    """Foreign objects (PartNet-Mobility, URDF, static meshes) to bundles."""
    kinds: Mapping[str, Callable[[Sequence[str]], int]] = {
        "partnet": partnet,
        "urdf": urdf,
        "static": static,
    }
    return dispatched("ingest", kinds, argv, USAGE)


def dispatched(
    command: str, kinds: Mapping[str, Callable[[Sequence[str]], int]], argv: Sequence[str], use: str
) -> int:
    """Run the sub-command that the first word names; print how to use it where none is named."""
    console = Console(highlight=False, soft_wrap=True)
    if not argv or argv[0] in ("-h", "--help", "help"):
        console.print(use, markup=False)
        return 0 if argv else 2
    if argv[0] not in kinds:
        near = did_you_mean(argv[0], list(kinds))
        raise UsageError(
            f"artgen {command} {argv[0]}: no such kind{near}; known: {', '.join(kinds)}"
        )
    return kinds[argv[0]](list(argv[1:]))


def partnet(argv: Sequence[str]) -> int:
    """PartNet-Mobility folders to bundles: 0 all usable, 1 some refused."""
    command = tyro.cli(IngestPartnet, args=list(argv), prog="artgen ingest partnet")
    return run(command, "partnet", found_folders(command.paths), checked_options(command))


def urdf(argv: Sequence[str]) -> int:
    """URDF files to bundles: 0 all usable, 1 some refused."""
    command = tyro.cli(IngestUrdf, args=list(argv), prog="artgen ingest urdf")
    if not math.isfinite(command.turn):
        raise UsageError(f"--turn {command.turn} must be a number of degrees")
    found = found_files(command.paths, (".urdf",), command.root)
    options = dataclasses.replace(checked_options(command), turn_deg=command.turn)
    return run(command, "urdf", found, options)


def static(argv: Sequence[str]) -> int:
    """Mesh files to bundles without joints: 0 all usable, 1 some refused."""
    command = tyro.cli(IngestStatic, args=list(argv), prog="artgen ingest static")
    extensions = tuple(word.lower() for word in command.extensions)
    if unknown := [word for word in extensions if word not in MESHES]:
        raise UsageError(f"--extensions {unknown[0]} is not read; known: {', '.join(MESHES)}")
    found = found_files(command.paths, extensions)
    options = dataclasses.replace(checked_options(command), up=command.up)
    return run(command, "static", found, options)


def run(command: Settings, kind: Kind, found: Sequence[Found], options: Options) -> int:
    """Ingest what was found, write and print the report."""
    check_libraries()
    need = len(found) * BYTES_PER_OBJECT
    with opened(command.out, seed=0, need_bytes=need) as folder:
        outcomes = ingest_all(folder, kind, found, options, workers=command.workers, show=progress)
        write_report(folder, outcomes, options.rests)
        homes = [(o.asset_id, folder.assets / o.category / o.asset_id) for o in outcomes]
        pictured = write_thumbnails(folder.contact_sheet, homes)
    console = Console(highlight=False, soft_wrap=True)
    console.print(table(outcomes, options.rests), markup=False, end="")
    console.print(f"report: {command.out / 'ingest_report.json'}", markup=False)
    if pictured:
        console.print(f"pictures: {folder.contact_sheet}", markup=False)
    return int(any(outcome.status == "refused" for outcome in outcomes))


def checked_options(command: Settings) -> Options:
    """Options of a run.

    Raises:
        UsageError: a number is out of range, or the file of rests cannot be read.
    """
    for name, value in (
        ("--meters-per-unit", command.meters_per_unit),
        ("--density", command.density),
        ("--thickness", command.thickness),
        ("--max-parts", command.max_parts),
        ("--workers", command.workers),
    ):
        if value is not None and not 0 < value < math.inf:
            raise UsageError(f"{name} {value} must be a number above 0")
    if command.pieces < 0:
        raise UsageError(f"--pieces {command.pieces} must be 0 or more")
    if command.licence is not None and command.licence not in KNOWN:
        near = did_you_mean(command.licence, list(KNOWN))
        raise UsageError(f"--licence {command.licence}{near}; known: {', '.join(KNOWN)}")
    return Options(
        meters_per_unit=command.meters_per_unit,
        max_parts=command.max_parts,
        density=command.density,
        thickness=command.thickness,
        pieces=command.pieces,
        rests=() if command.rest is None else read_rests(command.rest),
        licence=command.licence,
    )


def read_rests(path: Path) -> tuple[GivenRest, ...]:
    """Closed poses from the user's table.

    Raises:
        UsageError: it is no JSON object of objects of finite numbers.
    """
    try:
        stated = json.loads(path.read_text(encoding="utf-8"))
        return tuple(
            GivenRest(id=str(name), number=str(number), q=_finite(q))
            for name, own in sorted(stated.items())
            for number, q in sorted(own.items())
        )
    except (OSError, ValueError, AttributeError, TypeError) as error:
        raise UsageError(
            f'--rest {path} cannot be read ({error}); write {{"45940": {{"3": 90.0}}}}'
        ) from error


def _finite(q: object) -> float:
    if isinstance(q, bool) or not isinstance(q, int | float) or not math.isfinite(q):
        raise ValueError(f"{q!r} is no finite number")
    return float(q)
