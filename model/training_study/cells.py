"""A cell of a study: one training run, of one stage or several, in a folder of its own."""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.core.jsonio import plain
from artgen.progress import Show
from model.config import Config
from model.training.checkpoint import checkpoint_path
from model.training.material import Material
from model.training.run_state import differences
from model.training.session import RESULT, run_session

CHECKPOINTS = "checkpoints"


@dataclass(frozen=True, kw_only=True)
class Cell:
    """One run.

    Attributes:
        arm: what is varied; cells of one arm differ in their seed alone.
        stages: settings of runs one after another, each begun with the weights of the one before.
        material: what all of them learn from.
        curve: updates of the last stage at which its weights are kept as well.
    """

    arm: str
    seed: int
    stages: tuple[Config, ...]
    material: Material
    curve: tuple[int, ...] = ()

    @property
    def name(self) -> str:
        """Of its folder."""
        return f"{self.arm}_seed{self.seed}"

    @property
    def steps(self) -> int:
        """Updates in all."""
        return sum(stage.train.steps for stage in self.stages)


def stage_folder(cell: Cell, folder: Path, stage: int) -> Path:
    """The run folder of one stage; negative ones count from the last."""
    return folder / cell.name / f"stage_{stage % len(cell.stages)}"


def network_path(cell: Cell, folder: Path) -> Path:
    """Where the trained network of a cell lies."""
    return stage_folder(cell, folder, -1) / RESULT


def trained(cell: Cell, folder: Path, *, device: str, show: Show) -> Path:
    """Train the cell, or what is left of it; the path of its network.

    Checkpoints of finished stages are removed, but for those of a curve.

    Raises:
        UsageError: the folder holds a cell of other settings.
        ModelError: the training failed.
    """
    start: Path | None = None
    for k, config in enumerate(cell.stages):
        place = stage_folder(cell, folder, k)
        if (place / RESULT).exists():
            _check_finished(place, config, cell.material)
        else:
            run_session(
                config, cell.material, place, environment={}, start=start, device=device, show=show
            )
        if not cell.curve:
            shutil.rmtree(place / CHECKPOINTS, ignore_errors=True)
        start = place / RESULT
    return network_path(cell, folder)


def _check_finished(place: Path, config: Config, material: Material) -> None:
    found = json.loads((place / "config.json").read_text(encoding="utf-8"))
    stated = {"config": plain(config), "material": plain(material)}
    if lines := differences(found, stated):
        raise UsageError(
            f"{place}: holds a run of other settings: {'; '.join(lines[:5])}; give the same ones, "
            "or choose another --out"
        )


def network_at(cell: Cell, folder: Path, step: int) -> Path:
    """The network as it was after some updates of the last stage: a checkpoint."""
    return checkpoint_path(stage_folder(cell, folder, -1), step)
