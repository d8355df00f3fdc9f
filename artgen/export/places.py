"""Which bundles lie at or below a folder: of a run those that passed, elsewhere all."""

import os
from pathlib import Path

from artgen.export.layout import MANIFEST

RUN = "run.json"
"""Of the folder of a run, which also holds what failed and what is in the making."""


def is_run(folder: Path) -> bool:
    """True for a folder that `artgen generate`, `ingest` or `assemble` fills."""
    return (folder / RUN).is_file() or any((folder / "assets").glob(f"*/*/{MANIFEST}"))


def bundles_below(folder: Path) -> list[Path]:
    """Folders of bundles at or below a folder, sorted: of runs those under assets/, as what lies in
    failed/ is of no use to anyone who does not name it; any others at any depth."""
    places = []
    for place, folders, files in os.walk(folder):
        here = Path(place)
        if MANIFEST in files:
            places.append(here)
            folders.clear()
        elif RUN in files or (here == folder and is_run(folder)):
            folders[:] = [name for name in folders if name == "assets"]
        folders[:] = [n for n in folders if not (n.startswith(".") or n.endswith(".partial"))]
    return sorted(places)
