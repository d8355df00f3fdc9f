"""`artgen repair`: a mended copy of a stranger's URDF, what was changed, and its verdict."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated

import tyro
from rich.console import Console

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_json
from artgen.validate import validate_asset
from artgen.validate.bounds import load_bounds
from artgen.validate.find import found_sources
from artgen.validate.levels import Selection
from artgen.validate.repair import PIECES, beyond_mending, repaired
from artgen.validate.subject import Source
from artgen.validate.urdf_subject import UrdfSubject


@dataclass(frozen=True, kw_only=True)
class Repair:
    """Write a mended copy of a URDF asset: inertia, limits, meshes, convex collision."""

    path: Annotated[Path, tyro.conf.Positional]
    """A URDF; it is read, never changed."""
    out: Path
    """Receives the copy, its meshes, repair.json (every change) and report.json (its verdict)."""
    root: Path | None = None
    """The folder inside which the file may name others; its own by default."""
    pieces: int = PIECES
    """Convex pieces that CoACD may make of one body."""
    bounds: Path | None = None
    """A TOML file with bounds of your own, each with its reason."""


def repair(argv: Sequence[str]) -> int:
    """Write a mended copy of a foreign URDF and judge it: 0 valid now, 1 findings are left."""
    command = tyro.cli(Repair, args=list(argv), prog="artgen repair")
    (source,) = found_sources([command.path], command.root)
    if source.format != "urdf":
        raise UsageError(f"{command.path} is a {source.format}; artgen repair mends URDF files")
    if command.out.resolve() == source.file.parent.resolve():
        raise UsageError(f"--out {command.out} is the asset's own folder; the original stays as is")
    subject = UrdfSubject(source=source, bounds=load_bounds(command.bounds))
    if (problem := beyond_mending(subject)) is not None:
        raise UsageError(f"{command.path} cannot be mended: {problem}")
    changes = repaired(subject, command.out, pieces=command.pieces)
    write_json(command.out / "repair.json", [asdict(change) for change in changes])
    copy = Source(format="urdf", file=command.out / f"{subject.name}.urdf", root=command.out)
    report = validate_asset(copy, Selection(), subject.bounds)
    write_json(command.out / "report.json", report.as_json())
    console = Console(highlight=False, soft_wrap=True)
    for change in changes:
        console.print(f"changed  {change}", markup=False)
    for finding in report.findings:
        console.print(f"left     {finding}", markup=False)
    console.print(f"{copy.file}: {len(changes)} changes, {len(report.findings)} findings left")
    return 0 if report.ok else 1
