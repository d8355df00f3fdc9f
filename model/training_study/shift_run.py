"""The conditions of `artgen study shift`, judged one after another; its table, plot and page."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes
from artgen.core.stream import Stream
from artgen.dataset.split import Split
from artgen.progress import progress
from artgen.studies.table import write_table
from model.data.fingerprint import fingerprint
from model.data.library import read_library, taken, write_library
from model.data.make import Request, make_library
from model.data.shards import ShardSource
from model.data.soup import TOLERANCE
from model.precision import flushed_denormals
from model.training.art_file import load_art
from model.training.material import WORKERS
from model.training_study.claims import AXIS, CENTER, DCDIST, DGIOU, TYPE
from model.training_study.figures import plot_differences
from model.training_study.judge import Judge
from model.training_study.objects import HELD_OUT, write_objects
from model.training_study.pairs import difference
from model.training_study.scores import Score
from model.training_study.shift import NAME, Shift, shard_folders
from model.training_study.shift_page import ShiftRow, page, shift_rows
from model.training_study.tell import tell

DRAWN = (DGIOU, DCDIST, CENTER, TYPE, AXIS)
"""Metrics of the plot."""
USUAL = "ray-cast"


@dataclass(frozen=True, kw_only=True)
class Condition:
    """What a network is judged on.

    Attributes:
        truth: library or folder of shards.
        split: of it; None takes all.
        against: conditions with the same objects that it is compared with, object by object.
        pose_noise_deg, pose_noise: of the stated poses.
    """

    name: str
    truth: Path
    split: Split | None = None
    against: tuple[str, ...] = ()
    pose_noise_deg: float = 0.0
    pose_noise: float = 0.0


def run(command: Shift) -> Path:
    """The page, after all conditions."""
    _, config, _ = load_art(command.network)
    conditions = conditions_of(command, slots=config.data.slots)
    shapes = config.model.planes is not None
    scores: dict[str, Score] = {}
    with flushed_denormals():
        for k, own in enumerate(conditions, 1):
            tell(f"condition {k} of {len(conditions)}: {own.name}")
            judge = Judge(
                truth=own.truth,
                count=command.held_out,
                split=own.split,
                pose_noise_deg=own.pose_noise_deg,
                pose_noise=own.pose_noise,
            )
            folder = command.out / "scores" / own.name.replace(" ", "_")
            scores[own.name] = judge.score(str(command.network), folder, shapes=shapes)
    return write_results(command, conditions, scores)


def conditions_of(command: Shift, *, slots: int) -> list[Condition]:
    """All conditions; libraries that they need are written."""
    objects = command.out / "objects"
    write_objects(
        command.library, objects, counts=(), held_out=command.held_out, slots=slots, at_most=True
    )
    usual = Condition(name=USUAL, truth=objects / HELD_OUT)
    found = [usual]
    for degrees in command.noise_deg:
        noisy = replace(usual, name=f"poses off by {degrees:g} deg", pose_noise_deg=degrees)
        found.append(replace(noisy, against=(USUAL,)))
    for shift in command.noise:
        noisy = replace(usual, name=f"poses off by {shift:g} radii", pose_noise=shift)
        found.append(replace(noisy, against=(USUAL,)))
    renderers: list[str] = []
    for name, folder in shard_folders(command).items():
        same = f"{USUAL} of {name}"
        truth = objects / f"of_{name}_{fingerprint(folder, 'test')[:12]}.npz"
        _write_same(command.library, folder, truth, slots=slots)
        found.append(Condition(name=same, truth=truth))
        against = (same, *renderers)
        found.append(Condition(name=name, truth=folder, split="test", against=against))
        renderers.append(name)
    for category in command.unseen:
        truth = objects / f"unseen_{category}.npz"
        request = Request(counts={category: command.held_out}, seed=0, tolerance=TOLERANCE)
        make_library(truth, request, workers=WORKERS, show=progress)
        found.append(Condition(name=f"unseen {category}", truth=truth))
    return found


def _write_same(library: Path, shards: Path, path: Path, *, slots: int) -> None:
    """The library's own form of the test objects that lie in shards.

    Raises:
        UsageError: it holds none of them.
    """
    if path.exists():
        return
    whole = read_library(library)
    inside = set(ShardSource(shards, split="test", slots=slots).ids)
    positions = [k for k, name in enumerate(whole.ids) if name in inside]
    if not positions:
        raise UsageError(
            f"{library}: holds none of the test objects of {shards}, such as {min(inside)}; make "
            "it with the categories and the seed that were rendered"
        )
    write_library(path, taken(whole, positions))


def write_results(
    command: Shift, conditions: Sequence[Condition], scores: dict[str, Score]
) -> Path:
    """Table, plot and page."""
    pairs = {own.name: own.against for own in conditions}
    rows: list[ShiftRow] = shift_rows(scores, pairs)
    write_table(command.out / f"{NAME}.csv", rows)
    drawn = {}
    for name, other in [(own.name, other) for own in conditions for other in own.against]:
        both = {0: scores[name]}, {0: scores[other]}
        stream = Stream(0, "training study", NAME, name, other)
        found = [difference(metric, *both, stream.child(metric)) for metric in DRAWN]
        drawn[f"{name} - {other}"] = [own for own in found if own is not None]
    picture = None
    if any(drawn.values()):
        picture = f"{NAME}.png"
        plot_differences(command.out / picture, drawn, DRAWN)
    path = command.out / f"{NAME}.md"
    write_bytes(path, page(rows, network=command.network.name, picture=picture).encode())
    return path
