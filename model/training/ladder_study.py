"""`artgen study ladder`: can the network learn one object by heart?"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import tyro

from artgen.core.errors import UsageError
from artgen.progress import progress
from model.config import Config
from model.training.recipes import multiview
from model.training.settings import changed

RAYS = 20_000
"""Of the object's images, in all; a fifth of them is measured on."""
SETTINGS = (
    *("data.batch=1", "data.targets_from=inputs", "data.target_views=2", "data.background=white"),
    *(f"data.rays={RAYS}", "train.warmup_steps=50", "train.learning_rate=0.002"),
    *("train.inverse_beta=[10, 100]", "train.coarse=16", "train.samples=12"),
    *("train.picture_every=0", "train.log_every=10"),
)


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """Learn one object by heart in three rungs: masks under the true joints; boxes and joints as
    well; colors as well. Measured on rays that were not trained on. About five minutes of a CPU;
    an interrupted climb resumes.

    Goals: mask IoU above 0.95 on every rung, PSNR above 30 dB on the last.
    """

    category: str = "cabinet"
    """Of the object."""
    index: int = 0
    """Which object of the category."""
    seed: int = 0
    """Root of the object and of all draws."""
    steps: int = 250
    """Updates on the first two rungs; the last has four times as many."""
    rays: int = 512
    """Rays of one update."""
    out: Path = Path("out/studies/ladder")
    """Receives the logs, the checkpoints and ladder.csv and .png."""
    set: tuple[str, ...] = ()
    """Settings to change, as in `artgen train`."""


def ladder(argv: Sequence[str]) -> int:
    """The overfit ladder: masks, joints, colors of one object."""
    command = tyro.cli(Ladder, args=list(argv), prog="artgen study ladder")
    if min(command.steps, command.rays) < 1:
        raise UsageError(f"--steps {command.steps} and --rays {command.rays} must be at least 1")
    # Torch takes seconds to import.
    from model.precision import flushed_denormals
    from model.training.ladder import Specimen, write_ladder

    specimen = Specimen(category=command.category, seed=command.seed, index=command.index)
    with flushed_denormals():
        for row in write_ladder(
            specimen,
            _config(command),
            steps=command.steps,
            rays=command.rays,
            folder=command.out,
            show=progress,
        ):
            print(row)  # noqa: T201
    return 0


def _config(command: Ladder) -> Config:
    config = changed(multiview("nano"), (*SETTINGS, *command.set))
    seeded = dataclasses.replace(config.train, seed=command.seed)
    return dataclasses.replace(config, train=seeded)
