"""`artgen train-data`."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import tyro

from artgen.core.errors import UsageError
from artgen.export.layout import MANIFEST
from artgen.progress import progress
from artgen.rules import rule_names
from model.data.library import Library, read_library
from model.data.make import Request, dealt, make_library
from model.data.soup import TOLERANCE


@dataclass(frozen=True, kw_only=True)
class TrainData:
    """Build objects from seeds, and read bundles, into one file of colored triangles, some kB each.

    `artgen train` ray-casts its images from such a library, on a GPU or a CPU, so that neither
    Blender nor rendered images are needed where a model is trained. An interrupted run resumes with
    the same command; the file is the same for any number of workers.

    For example:

    artgen train-data --count 6000

    artgen train-data --categories laptop cabinet --count 500 --seed 7 --out small.npz

    artgen train-data --count 0 --bundles out/assembled out/ingested --out mine.npz
    """

    categories: tuple[str, ...] = ()
    """Which categories; all that `artgen categories` lists when none is named."""
    count: int = 1000
    """How many objects in all, dealt out to the categories in turn; 0 for bundles alone."""
    bundles: tuple[Path, ...] = ()
    """Folders with bundles at any depth, such as those of `artgen assemble` or `artgen ingest`."""
    seed: int = 0
    """Root of all randomness; object i of a category is the one that `artgen generate` makes."""
    tolerance: float = TOLERANCE
    """How far triangles may leave the exact shape, in radii of the object; 0 keeps it exact."""
    out: Path = Path("out/train-data/library.npz")
    """The file; one that holds another library is not overwritten."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side."""


def train_data(argv: Sequence[str]) -> int:
    """Objects from seeds as a small file that `artgen train` casts its images from."""
    command = tyro.cli(TrainData, args=list(argv), prog="artgen train-data")
    names = command.categories or tuple(rule_names())
    bundles = found_bundles(command.bundles)
    enough = command.count >= len(names) or (command.count == 0 and bundles)
    if not enough or command.workers < 1 or command.tolerance < 0.0:
        raise UsageError(
            f"--count {command.count} must be at least the {len(names)} categories, or 0 with "
            f"--bundles; --workers {command.workers} at least 1, --tolerance {command.tolerance} "
            "at least 0"
        )
    request = Request(
        counts=dealt(names, command.count) if command.count else {},
        seed=command.seed,
        tolerance=command.tolerance,
        bundles=bundles,
    )
    failed = make_library(command.out, request, workers=command.workers, show=progress)
    for asset_id, reason in sorted(failed.items()):
        print(f"{asset_id}: {reason}")  # noqa: T201
    print(f"{command.out}: {described(read_library(command.out), command.out)}")  # noqa: T201
    return int(bool(failed))


def found_bundles(folders: Sequence[Path]) -> tuple[Path, ...]:
    """Every bundle in the folders, sorted; those in `failed/` of a run did not pass and stay out.

    Raises:
        UsageError: a folder holds none.
    """
    found: list[Path] = []
    for folder in folders:
        places = [path.parent for path in sorted(folder.rglob(MANIFEST))]
        passed = [place for place in places if "failed" not in place.relative_to(folder).parts]
        if not passed:
            raise UsageError(f"{folder}: holds no bundle; make some with `artgen assemble`")
        found += passed
    return tuple(found)


def described(library: Library, path: Path) -> str:
    """What a library holds, in a line."""
    size, count = path.stat().st_size, len(library)
    triangles = len(library.columns["corner"]) / count
    parts = np.bincount(library.part_counts)
    several = ", ".join(f"{n} of {p} parts" for p, n in enumerate(parts) if n)
    kinds = len(set(library.categories))
    return (
        f"{count} objects of {kinds} categories, {size / count / 1e3:.1f} kB and {triangles:.0f} "
        f"triangles each; {several}"
    )
