"""A sample cut or padded to ART's fixed number of part slots."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.targets import Targets
from artgen.core.conventions import ART_SLOTS
from artgen.core.errors import ShardError
from artgen.dataset.sample import BACKGROUND, LEFT_OUT, Sample


def to_slots(sample: Sample, slots: int = ART_SLOTS) -> Sample:
    """The sample with exactly `slots` part slots.

    Missing parts become empty slots (`Sample.valid` is False, arrays are zero, parent is -1). Of
    too many parts the last in canonical order go, each with all parts that hang on it, so that
    every kept part still has its parent; their names join `meta.parts_left_out` and their pixels
    in `part_id` become LEFT_OUT.
    """
    if slots < 1:
        raise ShardError(
            f"{sample.meta.asset_id}: {slots} slots cannot hold the base; ask for >= 1"
        )
    count = len(sample.meta.parts)
    kept = _kept(sample.targets.parent[:count].tolist(), slots)
    new_index = np.full(256, LEFT_OUT, np.uint8)
    new_index[kept] = np.arange(len(kept))
    new_index[BACKGROUND] = BACKGROUND
    lost = tuple(sample.meta.parts[k].name for k in range(count) if k not in kept)
    meta = replace(
        sample.meta,
        parts=tuple(sample.meta.parts[k] for k in kept),
        slots=slots,
        parts_left_out=sample.meta.parts_left_out + lost,
    )
    return replace(
        sample,
        meta=meta,
        targets=_targets(sample.targets, kept, slots, new_index),
        part_id=new_index[sample.part_id],
        part_rgba=_slotted(sample.part_rgba, kept, slots, axis=2),
        part_depth=_slotted(sample.part_depth, kept, slots, axis=2),
        part_normal=_slotted(sample.part_normal, kept, slots, axis=2),
    )


def _kept(parents: list[int], slots: int) -> list[int]:
    kept = list(range(len(parents)))
    while len(kept) > slots:
        gone = {kept[-1]}
        for _ in kept:
            gone |= {k for k in kept if parents[k] in gone}
        kept = [k for k in kept if k not in gone]
    return kept


def _targets(
    targets: Targets, kept: list[int], slots: int, new_index: NDArray[np.uint8]
) -> Targets:
    parent = np.full(slots, -1, np.int8)
    for place, k in enumerate(kept):
        if targets.parent[k] >= 0:
            parent[place] = new_index[targets.parent[k]]
    return Targets(
        bounds=_slotted(targets.bounds, kept, slots, axis=0),
        type=_slotted(targets.type, kept, slots, axis=0),
        axis=_slotted(targets.axis, kept, slots, axis=0),
        origin=_slotted(targets.origin, kept, slots, axis=0),
        motion=_slotted(targets.motion, kept, slots, axis=1),
        parent=parent,
        limits=_slotted(targets.limits, kept, slots, axis=0),
        movable=_slotted(targets.movable, kept, slots, axis=0),
    )


def _slotted(array: NDArray[Any], kept: list[int], slots: int, *, axis: int) -> NDArray[Any]:
    """Rows `kept` of an axis, followed by zeros up to `slots`."""
    padding = [(0, 0)] * array.ndim
    padding[axis] = (0, slots - len(kept))
    return np.pad(np.take(array, kept, axis=axis), padding)
