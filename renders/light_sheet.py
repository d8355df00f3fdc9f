"""`artgen study lights`: every kind of light on the same assets, as one picture."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, get_args

import numpy as np
import tyro

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes
from artgen.dataset import read_shard
from artgen.export import read_bundle
from artgen.imaging import Bytes, png_file
from artgen.progress import progress
from renders.asset import render_asset
from renders.backends import BACKENDS, Backend
from renders.contact_sheet import on_paper
from renders.settings import LightScheme, Settings
from renders.sources import found_bundles


@dataclass(frozen=True, kw_only=True)
class Lights:
    """Render the same assets under every kind of light."""

    out: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder that holds bundles; the first of each category are taken."""
    seeds: tuple[int, ...] = (1, 2)
    """Each draws its own light."""
    size: int = 128
    """Width of an image, px."""
    accuracy: str = "standard"
    """As for `artgen render`."""
    picture: Path = Path("docs/images/lights.png")
    """Receives a row for every kind of light."""


def lights(argv: Sequence[str]) -> int:
    """Every kind of light on the same assets, as one picture."""
    command = tyro.cli(Lights, args=list(argv), prog="artgen study lights")
    categories = {found.folder.parent.name: found.folder for found in found_bundles(command.out)}
    if not categories:
        raise UsageError(f"{command.out}: holds no bundle; artgen generate makes some")
    schemes = get_args(LightScheme)
    rows = []
    total = len(schemes) * len(command.seeds) * len(categories)
    with tempfile.TemporaryDirectory() as place, progress("images", total) as advance:
        backend = BACKENDS["cycles"](Path(place) / "blender.log", 1)
        for scheme in schemes:
            row = []
            for seed in command.seeds:
                for folder in categories.values():
                    row.append(_picture(folder, scheme, seed, command, backend, Path(place)))
                    advance(f"{scheme} {folder.parent.name}")
            rows.append(np.concatenate(row, axis=1))
    write_bytes(command.picture, png_file(np.concatenate(rows)))
    print(f"picture: {command.picture}")  # noqa: T201
    return 0


def _picture(
    folder: Path, scheme: LightScheme, seed: int, command: Lights, backend: Backend, scratch: Path
) -> Bytes:
    """(size, size, 3) one asset, ajar."""
    settings = Settings(
        views=1, states=1, size=command.size, accuracy=command.accuracy, light=scheme
    )
    sample = scratch / "sample.tar"
    render_asset(
        read_bundle(folder),
        sample,
        settings=settings,
        seed=seed,
        scratch=scratch / "images",
        backend=backend,
    )
    return on_paper(next(iter(read_shard(sample))).rgba[0, 0])
