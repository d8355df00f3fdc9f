"""Cells trained and judged one after another, and what is known of all of them at any time."""

import time
from collections.abc import Callable, Sequence
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.progress import Show
from model.training_study.cells import Cell, network_at, network_path, trained
from model.training_study.judge import Judge
from model.training_study.scores import Score

Tell = Callable[[str], None]


def share_of(cells: Sequence[Cell], share: str) -> Sequence[Cell]:
    """Those cells that are ours where K/N says that we are the K-th of N, from 1.

    Raises:
        UsageError: it says something else.
    """
    first, slash, last = share.partition("/")
    if not (slash and first.isdecimal() and last.isdecimal() and 1 <= int(first) <= int(last)):
        raise UsageError(f"--share {share}: expected K/N, such as 1/4 for the first of four")
    return cells[int(first) - 1 :: int(last)]


def run_cells(
    cells: Sequence[Cell], folder: Path, judge: Judge, *, device: str, show: Show, tell: Tell
) -> None:
    """Train and judge every cell; those that are done already are passed over.

    Raises:
        UsageError: the folder holds cells of other settings.
        ModelError: a training failed; the others' results stay.
    """
    missing = [cell for cell in cells if _kept(cell, folder, judge) is None]
    total, done, started = sum(cell.steps for cell in missing), 0, time.perf_counter()
    for k, cell in enumerate(missing, 1):
        left = ""
        if done:
            hours = (time.perf_counter() - started) / 3600.0 * (total - done) / done
            left = f"; about {hours:.1f} h left at this pace"
        tell(f"cell {k} of {len(missing)}: {cell.name}, {cell.steps} updates{left}")
        trained(cell, folder, device=device, show=show)
        judged(cell, folder, judge)
        done += cell.steps


def judged(cell: Cell, folder: Path, judge: Judge) -> Score:
    """The cell's score; its curve's points are judged as well."""
    for step in cell.curve:
        network = network_at(cell, folder, step)
        judge.score(str(network), point_folder(cell, folder, step), shapes=_shapes(cell))
    return judge.score(str(network_path(cell, folder)), _place(cell, folder), shapes=_shapes(cell))


def known(cells: Sequence[Cell], folder: Path, judge: Judge) -> dict[str, dict[int, Score]]:
    """Arm and seed to the score, of all cells that are done."""
    found: dict[str, dict[int, Score]] = {}
    for cell in cells:
        if score := _kept(cell, folder, judge):
            found.setdefault(cell.arm, {})[cell.seed] = score
    return found


def known_points(cell: Cell, folder: Path, judge: Judge) -> dict[int, Score]:
    """Update to the score of the network as it was then, of all that were judged."""
    if network_path(cell, folder).exists():
        found = {
            step: judge.kept(
                str(network_at(cell, folder, step)),
                point_folder(cell, folder, step),
                shapes=_shapes(cell),
            )
            for step in cell.curve
        }
        return {step: score for step, score in found.items() if score is not None}
    return {}


def point_folder(cell: Cell, folder: Path, step: int) -> Path:
    """Where the score of a point of a curve lies."""
    return folder / cell.name / f"score_step_{step:08d}"


def _place(cell: Cell, folder: Path) -> Path:
    return folder / cell.name / "score"


def _kept(cell: Cell, folder: Path, judge: Judge) -> Score | None:
    network = network_path(cell, folder)
    return judge.kept(str(network), _place(cell, folder), shapes=_shapes(cell))


def _shapes(cell: Cell) -> bool:
    return cell.stages[-1].model.planes is not None
