"""The objects of a study, parted once: nested sets to learn from, and one set to be judged on."""

import json
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.core.jsonio import file_hash, write_json
from artgen.core.stream import Stream
from artgen.dataset.split import Split, split_of
from model.data.library import Library, read_library, taken, write_library

HELD_OUT = "held_out.npz"
ORIGIN = "objects.json"
"""What the sets were taken from, and how many are judged on."""


def training_path(folder: Path, count: int) -> Path:
    """Where the set of `count` objects to learn from lies."""
    return folder / f"train_{count:05d}.npz"


def write_objects(
    library: Path,
    folder: Path,
    *,
    counts: Sequence[int],
    held_out: int,
    slots: int,
    at_most: bool = False,
) -> None:
    """Write `train_COUNT.npz` for every count and `held_out.npz`, unless they are there.

    Training sets come of the split train, each within the next larger one; the held-out set of the
    split test. All hold the categories in turn, and of each category the objects that a draw by
    their ids puts first.

    Args:
        at_most: whether fewer will do where the library has no more.

    Raises:
        UsageError: the library has too few objects, or the folder holds those of another library,
            or another number of held-out ones.
    """
    _check_origin(library, folder, held_out=held_out, slots=slots)
    wanted: list[tuple[Path, Split, int]] = [
        (training_path(folder, count), "train", count) for count in counts
    ]
    wanted.append((folder / HELD_OUT, "test", held_out))
    missing = [row for row in wanted if not row[0].exists()]
    if not missing:
        return
    whole = read_library(library)
    for path, split, count in missing:
        ranked = ranked_positions(whole, split, slots)
        if not ranked or (len(ranked) < count and not at_most):
            raise UsageError(
                f"{library}: {len(ranked)} objects of the split {split} have at most {slots} "
                f"parts, {count} are asked for; make a larger library (artgen train-data) or ask "
                "for fewer"
            )
        write_library(path, taken(whole, ranked[:count]))
    write_json(folder / ORIGIN, _origin(library, held_out, slots))


def _origin(library: Path, held_out: int, slots: int) -> Mapping[str, object]:
    """A library that is gone is taken for the one that was there."""
    known = {"library": file_hash(library)} if library.exists() else {}
    return {**known, "held_out": held_out, "slots": slots}


def _check_origin(library: Path, folder: Path, *, held_out: int, slots: int) -> None:
    path = folder / ORIGIN
    if not path.exists():
        return
    found, ours = json.loads(path.read_text(encoding="utf-8")), _origin(library, held_out, slots)
    for key in sorted(set(found) & set(ours)):
        if found[key] != ours[key]:
            raise UsageError(
                f"{folder}: its objects were taken with {key} {found[key]}, now it is {ours[key]}; "
                "runs on other objects do not compare: give the same ones, or choose another --out"
            )


def ranked_positions(library: Library, split: Split, slots: int) -> list[int]:
    """Positions of a split's objects that fit, the categories in turn."""
    by_category: dict[str, list[tuple[float, int]]] = defaultdict(list)
    for k, (name, parts) in enumerate(zip(library.ids, library.part_counts, strict=True)):
        if parts <= slots and split_of(name, library.donors(k)) == split:
            draw = float(Stream(0, "training study", name).generator().random())
            by_category[library.categories[k]].append((draw, k))
    ranked = [
        (rank, category, k)
        for category, own in by_category.items()
        for rank, (_, k) in enumerate(sorted(own))
    ]
    return [k for _, _, k in sorted(ranked)]
