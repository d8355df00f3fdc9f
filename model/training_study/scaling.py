"""`artgen study scaling`: what more objects and more updates buy."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import tyro

from artgen.core.errors import UsageError
from model.config import Size

NAME = "scaling"


@dataclass(frozen=True, kw_only=True)
class Scaling:
    """Quality against the number of objects, at equal updates; and against updates, along the runs
    on the most objects.

    The sets of objects lie within each other and hold all categories evenly; every run is judged
    on the same held-out objects. Points along a run are moving averages of weights whose learning
    rate has not fallen yet, so they lie below what a run of that length would reach. The mean
    layout of each set stands beside, as what needs no images. Each run is a folder that resumes;
    several processes may take a --share each.

    For example:

    artgen study scaling --library lib.npz

    artgen study scaling --library lib.npz --counts 50 200 --seeds 1 --steps 160 --scenes 2
    """

    library: Path
    """Objects (artgen train-data); of the split train for learning, of test for judging."""
    counts: tuple[int, ...] = (100, 300, 900, 2_700)
    """Objects to learn from."""
    seeds: int = 2
    """From how many seeds."""
    kind: Literal["boxes", "shapes"] = "boxes"
    """Boxes and joints alone, or shapes as well."""
    size: Size = "nano"
    """Of the network."""
    steps: int = 2_400
    """Updates of a run."""
    points: int = 8
    """Points of the curve along a run; a divisor of the updates."""
    batch: int = 16
    """Objects of an update."""
    scenes: int | None = 4
    """Scenes of every object, kept on disk; None draws new ones each time."""
    held_out: int = 100
    """Objects to be judged on."""
    device: Literal["auto", "cpu", "cuda"] = "auto"
    """Where to train."""
    share: str = "1/1"
    """K/N: take every N-th run, beginning with the K-th."""
    set: tuple[str, ...] = ()
    """Settings to change in all runs, as in `artgen train`."""
    dry: bool = False
    """Train nothing: write the page from what is there."""
    out: Path = Path("out/studies/scaling")
    """Receives the objects, the runs, scaling.csv, scaling_objects.png, scaling_updates.png and
    scaling.md."""


def study(argv: Sequence[str]) -> int:
    """Quality against the number of objects, and against updates."""
    command = tyro.cli(Scaling, args=list(argv), prog="artgen study scaling")
    counts = command.counts
    if not counts or min(counts) < 1 or list(counts) != sorted(set(counts)):
        raise UsageError(f"--counts {counts}: name at least one, each larger than the one before")
    if min(command.seeds, command.held_out, command.points) < 1:
        raise UsageError(
            f"--seeds {command.seeds}, --held-out {command.held_out} and --points "
            f"{command.points} must be at least 1"
        )
    from model.training_study.scaling_run import run  # Torch takes seconds to import.

    print(f"page: {run(command)}")  # noqa: T201
    return 0
