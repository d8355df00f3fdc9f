"""`artgen study simulate`."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import UsageError
from artgen.export.layout import MANIFEST
from artgen.progress import progress
from artgen.simulation_study.closed_forms import integrator_rows
from artgen.simulation_study.collision import fidelity_rows
from artgen.simulation_study.dropping import dropping
from artgen.simulation_study.inertia import inertia_rows
from artgen.simulation_study.measured import Measured
from artgen.simulation_study.page import page, picture_name
from artgen.simulation_study.solver import solver_rows
from artgen.simulation_study.sweeping import sweep_rows
from artgen.studies.plot import Point, plot_front
from artgen.studies.table import write_table

STUDIES: Mapping[str, Callable[[], Iterator[Measured]]] = {
    "integrators": integrator_rows,
    "solvers": solver_rows,
    "collision": fidelity_rows,
    "inertia": inertia_rows,
    "sweeps": sweep_rows,
}
FLOOR = 1e-17
"""Errors of nothing are drawn here; a logarithmic axis has no zero."""


@dataclass(frozen=True, kw_only=True)
class Simulate:
    """Integrators, solvers, collision pieces, inertia modes and sweeps: error against CPU time."""

    out: Annotated[Path, tyro.conf.Positional] = Path("docs/studies")
    """Folder that receives simulate_*.csv, simulate_*.png and simulate.md."""
    run: Path = Path("out")
    """Run of `artgen generate` on whose assets effects are left off and dropped."""


def simulate(argv: Sequence[str]) -> int:
    """Time step, solver, collision pieces, inertia and sweeps: error against CPU time."""
    command = tyro.cli(Simulate, args=list(argv), prog="artgen study simulate")
    bundles = sorted(path.parent for path in command.run.glob(f"assets/*/*/{MANIFEST}"))
    if not bundles:
        raise UsageError(f"{command.run}: holds no bundle; artgen generate --no-render makes some")
    measured: dict[str, list[Measured]] = {}
    with progress("studies", len(STUDIES) + 1) as advance:
        saving, dropped = dropping(bundles)
        write_table(command.out / "simulate_effects.csv", dropped)
        advance("effects")
        for name, rows in STUDIES.items():
            measured[name] = list(rows())
            write_table(command.out / f"simulate_{name}.csv", measured[name])
            for scene in dict.fromkeys(row.scene for row in measured[name]):
                _plot(command.out, name, scene, measured[name])
            advance(name)
    path = command.out / "simulate.md"
    path.write_text(page(measured, saving, dropped), encoding="utf-8")
    print(f"page: {path}")  # noqa: T201
    return 0


def _plot(folder: Path, study: str, scene: str, rows: Sequence[Measured]) -> None:
    own = [row for row in rows if row.scene == scene]
    points = [
        Point(
            cost=row.cpu_ms,
            error=max(row.error, FLOOR),
            series=row.setting,
            label=f"{row.setting} {row.step:g}" if row.step else row.setting,
        )
        for row in own
    ]
    plot_front(
        folder / picture_name(study, scene),
        points,
        title=f"{study}: {scene}",
        cost="CPU ms",
        error=f"error, {own[0].unit}",
    )
