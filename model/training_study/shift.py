"""`artgen study shift`: how a trained network fares where it was not trained."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from artgen.core.errors import UsageError

NAME = "shift"


@dataclass(frozen=True, kw_only=True)
class Shift:
    """One network under other images, other objects and wrong poses.

    Judged on ray-cast images of held-out objects first, which is what it was trained on; then on
    the same objects under noisy poses; then on rendered shards and on ray-cast images of the same
    objects as the shards hold; then on categories that it never saw. Judged before, nothing is
    judged again.

    For example:

    artgen study shift art.safetensors --library lib.npz

    artgen study shift art.safetensors --library lib.npz --shards fast=out/fast/shards \\
        cycles=out/cycles/shards --unseen safe cardboard_box
    """

    network: Annotated[Path, tyro.conf.arg(metavar="NETWORK"), tyro.conf.Positional]
    """File of the network (art.safetensors)."""
    library: Path
    """Objects (artgen train-data); of the split test. For shards it must hold their objects."""
    shards: tuple[str, ...] = ()
    """NAME=FOLDER of rendered shards, such as fast=out/fast/shards."""
    unseen: tuple[str, ...] = ()
    """Categories that the network was not trained on; their objects are made from seeds."""
    noise_deg: tuple[float, ...] = (1.0, 2.0, 5.0)
    """Deviations of the turn, about each axis, by which stated poses are off."""
    noise: tuple[float, ...] = (0.01, 0.02, 0.05)
    """Deviations of their shift along each axis, radii."""
    held_out: int = 100
    """Objects of every condition at most."""
    out: Path = Path("out/studies/shift")
    """Receives the scores, shift.csv, shift.png and shift.md."""


def study(argv: Sequence[str]) -> int:
    """One network on other renderers, unseen categories and noisy poses."""
    command = tyro.cli(Shift, args=list(argv), prog="artgen study shift")
    if not command.network.is_file():
        raise UsageError(f"{command.network}: no such file; expected art.safetensors of a training")
    if command.held_out < 1 or min((*command.noise, *command.noise_deg), default=1.0) <= 0.0:
        raise UsageError(
            f"--held-out {command.held_out} must be at least 1, --noise {command.noise} and "
            f"--noise-deg {command.noise_deg} above 0"
        )
    shard_folders(command)
    from model.training_study.shift_run import run  # Torch takes seconds to import.

    print(f"page: {run(command)}")  # noqa: T201
    return 0


def shard_folders(command: Shift) -> dict[str, Path]:
    """Name to folder, as `--shards` says.

    Raises:
        UsageError: a word has another form, or its folder does not exist.
    """
    found = {}
    for word in command.shards:
        name, equals, folder = word.partition("=")
        if not (name and equals and Path(folder).is_dir()):
            raise UsageError(f"--shards {word}: expected NAME=FOLDER of rendered shards")
        found[name] = Path(folder)
    return found
