"""What an update of each arm costs here, measured on a few, and what a whole study would cost."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import torch

from artgen.studies.table import markdown_table
from model.batch import Batch
from model.config import Config
from model.data.library import read_library
from model.data.loader import batches
from model.data.soup_source import SoupSource
from model.field_study.timing import timed
from model.network.art import Art
from model.training.distributed import Team, joined
from model.training.objective import Objective
from model.training.run_state import begun
from model.training.schedule import moment_at
from model.training.train import accumulate, update
from model.training_study.cells import Cell

REPEATS = 3
"""Measurements, of which the first only warms up and the fastest counts."""


@dataclass(frozen=True, kw_only=True)
class Price:
    """Of one arm: CPU seconds of one process, or seconds of a GPU.

    Attributes:
        casting: of the images and rays of a batch.
        first, last: of an update at the beginning of a run, and at its end, where it may render.
        whole: of one run, its score left out.
    """

    arm: str
    casting: float
    first: float
    last: float
    whole: float


def priced(cells: Sequence[Cell], library: Path, *, objects: int, device: str) -> Iterator[Price]:
    """A price for every arm among some cells.

    Args:
        library: whose objects are measured on.
        objects: that a run would learn from.
    """
    by_arm: dict[str, Cell] = {}
    for cell in cells:
        by_arm.setdefault(cell.arm, cell)
    whole = read_library(library)
    with joined({}, device=device) as team:
        for arm, cell in by_arm.items():
            config = cell.stages[-1]
            source = SoupSource(whole, split="train", slots=config.data.slots)
            row = batches(source, config.data, device=team.device)
            batch, casting_ms = timed(lambda row=row: next(row), team.device.type, REPEATS)  # type: ignore[misc]
            first, last = _update_prices(config, batch, team)
            scenes, steps = cell.material.scenes, cell.steps
            casts = steps if scenes is None else scenes * objects / config.data.batch
            learned = sum(updates_price(stage, first, last) for stage in cell.stages)
            yield Price(
                arm=arm,
                casting=casting_ms / 1e3,
                first=first,
                last=last,
                whole=casts * casting_ms / 1e3 + learned,
            )


def _update_prices(config: Config, batch: Batch, team: Team) -> tuple[float, float]:
    """Seconds of the first and of the last update of a run."""
    torch.manual_seed(0)
    train = config.train
    objective = Objective(
        Art(config.model),
        config.weights,
        precision=train.precision,
        field_precision=train.field_precision,
    )
    run = begun(objective, train, items=config.data.batch, team=team)

    def updated(step: int) -> None:
        run.step = step
        update(run, accumulate(run, [batch], moment_at(train, step)))

    first, last = (
        timed(lambda step=step: updated(step), team.device.type, REPEATS)[1]  # type: ignore[misc]
        for step in (0, train.steps - 1)
    )
    return first / 1e3, last / 1e3


def updates_price(stage: Config, first: float, last: float) -> float:
    """Seconds of all updates of a stage."""
    share = stage.train.rendered
    return stage.train.steps * (share * first + (1.0 - share) * last)


def price_table(prices: Sequence[Price], seeds: int) -> str:
    """For the terminal, and for pages."""
    rows = [
        (f"`{p.arm}`", f"{p.casting:.2f}", f"{p.first:.2f}", f"{p.last:.2f}", f"{p.whole:.0f}")
        for p in prices
    ]
    total = seeds * sum(price.whole for price in prices) / 3600.0
    header = ("arm", "casting a batch, s", "first update, s", "last update, s", "a run, s")
    return f"{markdown_table(header, rows)}\n\n{seeds} seeds: {total:.1f} h, scores left out"
