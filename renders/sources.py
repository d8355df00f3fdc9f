"""Where bundles come from, and the folder that receives their rendering."""

import json
import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_json
from artgen.dataset.listing import BUNDLES, sample_path
from artgen.export.layout import MANIFEST
from artgen.export.places import bundles_below, is_run
from artgen.run_folder import RunFolder, locked, opened

SAFE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*")
"""Asset ids and categories become names of files and keys of WebDataset, which end at a dot."""


@dataclass(frozen=True, kw_only=True)
class Found:
    """A bundle's folder and what its manifest calls it."""

    folder: Path
    asset_id: str
    category: str

    @property
    def sample(self) -> Path:
        """Where its sample lies among samples: <category>/<rest of the id>.tar."""
        return sample_path(self.asset_id, self.category)


def found_bundles(folder: Path) -> list[Found]:
    """Every bundle in `folder`: those under assets/ of runs, any others at any depth; sorted.

    Raises:
        UsageError: there is no folder, or no bundle in it.
    """
    if not folder.is_dir():
        raise UsageError(
            f"{folder}: no such folder; name a run of `artgen generate`, a folder of bundles or a "
            "bundle"
        )
    places = bundles_below(folder)
    if not places:
        raise UsageError(
            f"{folder}: holds no bundle, that is no folder with a {MANIFEST}; make some with "
            f"`artgen generate --out {folder}`"
        )
    return [_identified(place) for place in places]


def _identified(folder: Path) -> Found:
    """As the manifest says; as the folders are named where it cannot be read, which rendering then
    tells."""
    try:
        stated = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
        asset_id, category = stated["asset_id"], stated["category"]
    except (OSError, ValueError, KeyError, TypeError):
        category = folder.resolve().parent.name
        asset_id = f"{category}_{folder.resolve().name}"
    return Found(folder=folder, asset_id=str(asset_id), category=str(category))


def rendering_folder(source: Path, *, out: Path | None, name: str | None) -> Path:
    """Where a rendering of the bundles in `source` goes.

    Into the run itself, into `<source>-renders` beside any other folder, or to `out`; a named
    rendering into `renders/<name>/` of that.

    Raises:
        UsageError: the name is no name for a folder, or the place lies inside a bundle.
    """
    beside = source.resolve().with_name(f"{source.resolve().name}-renders")
    root = out or (source if is_run(source) else beside)
    if name is not None:
        if not SAFE.fullmatch(name):
            raise UsageError(f"--name {name}: expected letters, digits, - and _")
        root = root / "renders" / name
    for place in (root.resolve(), *root.resolve().parents):
        if (place / MANIFEST).is_file():
            raise UsageError(f"{root}: lies inside the bundle {place}; choose another --out")
    return root


@contextmanager
def opened_rendering(root: Path, source: Path, *, seed: int) -> Iterator[RunFolder]:
    """The folder of the rendering, locked: a run as it is, any other one created or recognized."""
    if root.resolve() == source.resolve():
        with locked(root):
            yield RunFolder(root)
    else:
        with opened(root, seed=seed) as folder:
            yield folder


def write_sources(folder: RunFolder, source: Path, found: Sequence[Found]) -> None:
    """bundles.json of a rendering that lies apart from its bundles; `artgen shard` reads it."""
    if folder.root.resolve() == source.resolve():
        return
    root = folder.root.resolve()
    known = {
        bundle.asset_id: {
            "bundle": Path(os.path.relpath(bundle.folder.resolve(), root)).as_posix(),
            "category": bundle.category,
            "sample": (Path("samples") / bundle.sample).as_posix(),
        }
        for bundle in found
    }
    write_json(folder.root / BUNDLES, known)
