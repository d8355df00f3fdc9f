"""`artgen study ablations`: every claim about the training, by paired runs."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import tyro

from artgen.core.errors import UsageError, did_you_mean
from model.config import Size
from model.training_study.claims import ARMS, CLAIMS

NAME = "ablations"


@dataclass(frozen=True, kw_only=True)
class Ablations:
    """What makes training work: each claim of the paper as paired runs from several seeds.

    Order of parts, rest state, loss on parts, static pre-training, number of views, direction of
    attention, and whether images are used at all. Runs that learn boxes and joints alone where the
    claim allows it, with shapes where it needs them. Each run is a folder that resumes; the same
    command again goes on with what is missing, and several processes may take a --share each. The
    page, the tables and the plot are written from all runs that are done.

    For example:

    artgen study ablations --library lib.npz

    artgen study ablations --library lib.npz --claims order images --seeds 2 --steps 150

    artgen study ablations --library lib.npz --size s --device cuda --scenes None --steps 20000 \\
        --batch 64 --share 1/3
    """

    library: Path
    """Objects (artgen train-data); of the split train for learning, of test for judging."""
    claims: tuple[str, ...] = ()
    """Which claims; all if none is named: order, rest, part_loss, pretraining, views, direction,
    images."""
    seeds: int = 3
    """From how many seeds every arm is run."""
    size: Size = "nano"
    """Of the network."""
    steps: int = 1_000
    """Updates of a run."""
    batch: int = 16
    """Objects of an update."""
    objects: int = 800
    """Objects to learn from."""
    scenes: int | None = 3
    """Scenes of every object, kept on disk, as casting costs a CPU as much as learning; None
    draws new ones each time, which a GPU casts by itself."""
    held_out: int = 60
    """Objects to be judged on."""
    device: Literal["auto", "cpu", "cuda"] = "auto"
    """Where to train."""
    share: str = "1/1"
    """K/N: take every N-th run, beginning with the K-th."""
    set: tuple[str, ...] = ()
    """Settings to change in all runs, as in `artgen train`."""
    dry: bool = False
    """Train nothing: write the page from what is there, and list what is missing."""
    price: bool = False
    """Train nothing: measure a few updates of every arm, and say what the study would cost here."""
    out: Path = Path("out/studies/ablations")
    """Receives the objects, the runs, ablations.csv, ablations_claims.csv, ablations.png and
    ablations.md."""


def study(argv: Sequence[str]) -> int:
    """Which claims about the training reproduce: paired runs over seeds."""
    command = tyro.cli(Ablations, args=list(argv), prog="artgen study ablations")
    known = [claim.name for claim in CLAIMS]
    for name in command.claims:
        if name not in known:
            raise UsageError(
                f"--claims {name}: no such claim{did_you_mean(name, known)}; known: "
                f"{', '.join(known)}"
            )
    if min(command.seeds, command.objects, command.held_out) < 1:
        raise UsageError(
            f"--seeds {command.seeds}, --objects {command.objects} and --held-out "
            f"{command.held_out} must be at least 1"
        )
    from model.training_study.ablations_run import price, run  # Torch takes seconds to import.

    if command.price:
        print(price(command))  # noqa: T201
        return 0
    print(f"page: {run(command)}")  # noqa: T201
    return 0


def arms(claims: Sequence[str]) -> list[str]:
    """Names of the arms that some claims need, the usual ones first; all where none is named."""
    needed = {
        name
        for claim in CLAIMS
        if not claims or claim.name in claims
        for own in claim.comparisons
        for name in (own.arm, own.against)
    }
    usual = [name for name in ("boxes", "shapes") if name in needed]
    return usual + [name for name in ARMS if name in needed and name not in usual]
