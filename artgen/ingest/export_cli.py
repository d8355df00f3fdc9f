"""`artgen export`: bundles in layouts that others read."""

import itertools
import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro
from rich.console import Console

from artgen.assembly.finished import finished_object
from artgen.core.errors import ArtgenError, ExportError, UsageError
from artgen.core.jsonio import file_hash, fill_folder_atomically
from artgen.core.licence import licence_of
from artgen.export.glb_content import read_glb
from artgen.export.layout import GLB, MANIFEST
from artgen.export.partnet.write import NOTE, write_partnet
from artgen.export.places import bundles_below
from artgen.ingest.cli import dispatched
from artgen.progress import progress

USAGE = """\
usage: artgen export partnet BUNDLE... --out DIR   folders of PartNet-Mobility's layout

A BUNDLE is a folder that `artgen generate`, `ingest` or `assemble` wrote, or a folder of many.
"""
NAME = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,99}(?<!\.partial)")
"""Asset ids that are names of folders: no way up, no separator, nothing that is in the making."""


@dataclass(frozen=True, kw_only=True)
class ExportPartnet:
    """Write bundles as PartNet-Mobility folders: JSON, URDF, OBJ fragments, MTL and images.

    Each object is scaled to radius 1; artgen.json beside the others says by how much, under which
    licence, and what the format cannot hold. `artgen ingest partnet` reads it back.
    """

    paths: Annotated[tuple[Path, ...], tyro.conf.Positional] = ()
    """Bundles, or folders that hold some; of runs what passed, not what lies in failed/."""
    out: Path = Path("out/partnet")
    """Receives one folder an object, named by its asset id; none that is there is written over.
    Bundles of one id that differ are told apart: cabinet_000000, cabinet_000000_2."""
    doubled: bool = False
    """Write every face twice, once turned around, as most of the data set does."""


def export(argv: Sequence[str]) -> int:
    """Bundles to the layout of PartNet-Mobility."""
    kinds: Mapping[str, Callable[[Sequence[str]], int]] = {"partnet": partnet}
    return dispatched("export", kinds, argv, USAGE)


def partnet(argv: Sequence[str]) -> int:
    """Bundles to PartNet-Mobility folders: 0 all written, 1 some could not be."""
    command = tyro.cli(ExportPartnet, args=list(argv), prog="artgen export partnet")
    bundles = found_bundles(command.paths)
    failed = []
    with progress("exports", len(bundles)) as advance:
        for bundle in bundles:
            try:
                home, new = export_bundle(bundle, command.out, doubled=command.doubled)
                advance(f"{home.name} {'written' if new else 'kept'}")
            except (ArtgenError, OSError) as error:
                failed.append(f"{bundle}: {error}")
                advance(f"{bundle.name} failed")
    console = Console(highlight=False, soft_wrap=True)
    for line in failed:
        console.print(f"failed  {line}", markup=False)
    console.print(f"{len(bundles) - len(failed)} of {len(bundles)} objects in {command.out}")
    return int(bool(failed))


def found_bundles(paths: Sequence[Path]) -> list[Path]:
    """Bundles at or below paths, in order and once each.

    Raises:
        UsageError: a path holds none.
    """
    if not paths:
        raise UsageError("artgen export partnet needs a bundle, for example out/assets")
    found: dict[Path, None] = {}
    for path in paths:
        own = bundles_below(path)
        if not own:
            raise UsageError(f"{path} holds no {MANIFEST}; name a bundle or a folder of some")
        found |= dict.fromkeys(own)
    return list(found)


def export_bundle(bundle: Path, out: Path, *, doubled: bool) -> tuple[Path, bool]:
    """Write one bundle's folder below `out`, whole or not at all.

    Returns:
        The folder, and whether it is new: what was written from the same bundle is kept.

    Raises:
        ExportError: the bundle is damaged, or its asset id is no name of a folder.
    """
    obj = finished_object(bundle)
    digest = file_hash(bundle / MANIFEST)
    home, new = _home(out, obj.asset_id, digest)
    if new:
        content = read_glb(bundle / GLB)
        images = {name: own["color"] for name, own in content.images.items() if "color" in own}
        terms = licence_of(obj.provenance)
        fill_folder_atomically(
            home,
            lambda partial: write_partnet(
                obj, partial, images, doubled=doubled, licence=terms, digest=digest
            ),
        )
    return home, new


def _home(out: Path, asset_id: object, digest: str) -> tuple[Path, bool]:
    """The folder of a bundle whose manifest has this digest, and whether it is yet to be made;
    where another bundle took the name, the first number that is free."""
    if not isinstance(asset_id, str) or NAME.fullmatch(asset_id) is None:
        raise ExportError(
            f"{MANIFEST} has asset_id {asset_id!r}, which is no name of a folder; use up to 100 "
            "letters, digits, '_', '-' and '.', not first"
        )
    names = itertools.chain([asset_id], (f"{asset_id}_{number}" for number in itertools.count(2)))
    home = next(
        place
        for place in (out / name for name in names)
        if not place.exists() or _digest_of(place) == digest
    )
    return home, not home.exists()


def _digest_of(home: Path) -> str | None:
    """Of the bundle that a folder was written from; None where the folder does not say."""
    try:
        stated = json.loads((home / NOTE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    digest = stated.get("digest") if isinstance(stated, dict) else None
    return digest if isinstance(digest, str) else None
