"""What leaving effects off saves on real assets, and what dropping a needed one would cost."""

import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.export.layout import MANIFEST
from artgen.simulation.paths import agreement, price_of_dropping
from artgen.validate import load_bounds
from artgen.validate.promise import SECONDS, proving_tasks
from artgen.validate.read import read_subject
from artgen.validate.subject import Source


@dataclass(frozen=True, kw_only=True)
class Dropped:
    """A needed effect, dropped, over all tasks that called for it.

    Attributes:
        tasks: how many did.
        largest, median: difference of a joint's path, as a share of its range.
    """

    effect: str
    tasks: int
    largest: float
    median: float


@dataclass(frozen=True, kw_only=True)
class Saving:
    """All tasks together: settling, and pushing each joint, for a second.

    Attributes:
        difference: largest, of the paths with the needed effects from those with all.
        equal: tasks whose paths are equal bit for bit.
        cpu_ms, cpu_ms_all: with the needed effects, and with all.
    """

    assets: int
    tasks: int
    difference: float
    equal: int
    cpu_ms: float
    cpu_ms_all: float


def dropping(bundles: Sequence[Path]) -> tuple[Saving, list[Dropped]]:
    """Measured on bundles."""
    differences: list[float] = []
    lean, full = 0.0, 0.0
    prices: dict[str, list[float]] = {}
    for folder in bundles:
        source = Source(format="bundle", file=folder / MANIFEST, root=folder)
        subject = read_subject(source, load_bounds(None))
        model = subject.simulated
        for task, force in proving_tasks(subject, model):
            found = agreement(model, task, seconds=SECONDS, force=force)
            differences.append(found.difference)
            lean, full = lean + found.seconds, full + found.seconds_all
            for effect, price in price_of_dropping(
                model, task, seconds=SECONDS, force=force
            ).items():
                prices.setdefault(effect.value, []).append(price)
    rows = [
        Dropped(effect=name, tasks=len(own), largest=max(own), median=statistics.median(own))
        for name, own in prices.items()
    ]
    saving = Saving(
        assets=len(bundles),
        tasks=len(differences),
        difference=max(differences),
        equal=sum(difference == 0.0 for difference in differences),
        cpu_ms=1e3 * lean,
        cpu_ms_all=1e3 * full,
    )
    return saving, rows
