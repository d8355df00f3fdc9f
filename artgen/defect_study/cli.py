"""`artgen study defects`."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import UsageError
from artgen.defect_study.page import Alarms, page
from artgen.defect_study.run import (
    DEFECTS,
    FILES,
    Noticed,
    Planted,
    caught,
    false_alarms,
    noticed_by_rivals,
)
from artgen.export.layout import MANIFEST
from artgen.progress import progress
from artgen.studies.table import write_table


@dataclass(frozen=True, kw_only=True)
class Defects:
    """Plant every kind of defect into good assets and count who notices; judge good ones too."""

    run: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder of a run of `artgen generate --no-render`; its bundles are the good assets."""
    out: Path = Path("docs/studies")
    """Folder that receives defects*.csv and defects.md."""
    assets: int = 2
    """Assets of each category into which defects are planted."""


def defects(argv: Sequence[str]) -> int:
    """Planted defects: who notices them; false alarms on good assets."""
    command = tyro.cli(Defects, args=list(argv), prog="artgen study defects")
    bundles = sorted(path.parent for path in command.run.glob(f"assets/*/*/{MANIFEST}"))
    if not bundles:
        raise UsageError(f"{command.run}: holds no bundle; artgen generate --no-render makes some")
    chosen = [b for b in bundles if _rank(b, bundles) < command.assets]
    found: list[Planted] = []
    alarms = Alarms(assets=0, raised=[])
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        with progress("kinds of defect", len(DEFECTS)) as advance:
            for defect in DEFECTS:
                found += caught(defect, chosen, scratch)
                advance(defect.name)
        with progress("good assets", len(bundles) * len(FILES)) as advance:
            for asset, format_, report in false_alarms(bundles, scratch):
                alarms = alarms.joined(asset, format_, report)
                advance(asset)
        urdf = [defect for defect in DEFECTS if defect.format == "urdf"]
        table = noticed_by_rivals(urdf, chosen, scratch)
    write_table(command.out / "defects.csv", found)
    write_table(command.out / "defects_rivals.csv", _rows(table))
    path = command.out / "defects.md"
    path.write_text(page(found, alarms, table), encoding="utf-8")
    missed = sorted({row.defect for row in found if not row.check})
    print(f"page: {path}")  # noqa: T201
    print(f"missed: {', '.join(missed) or 'none'}; false alarms: {len(alarms.raised)}")  # noqa: T201
    return 1 if missed or alarms.raised else 0


def _rank(bundle: Path, bundles: Sequence[Path]) -> int:
    """Place among the bundles of its category."""
    return [other for other in bundles if other.parent == bundle.parent].index(bundle)


def _rows(table: dict[str, dict[str, bool] | None]) -> list[Noticed]:
    return [
        Noticed(checker=rival, defect=name, noticed=noticed)
        for rival, said in table.items()
        for name, noticed in (said or {}).items()
    ]
