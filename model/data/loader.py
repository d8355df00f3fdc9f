"""Batches: from a cursor on, the same at any number of workers and ranks."""

import itertools
import os
from collections.abc import Iterator, Sequence
from typing import Any, TypeVar

import torch
from torch.utils.data import DataLoader, Dataset

from artgen.core.errors import ArtgenError, ModelError
from artgen.core.stream import Stream
from model.batch import Batch
from model.data.config import DataConfig
from model.data.items import Source
from model.data.merge import merged

Planned = TypeVar("Planned")
CPU = torch.device("cpu")


def batches(
    source: Source[Any],
    config: DataConfig,
    cursor: int = 0,
    *,
    rank: int = 0,
    world: int = 1,
    device: torch.device | str = CPU,
) -> Iterator[Batch]:
    """Endless batches of `config.batch / world` items each, on the device.

    Item c of the endless row depends on (config, source, c) alone. Batch k of the iterator holds
    the items `cursor + k * config.batch` and following, of which this rank has its share, in order.
    With a GPU, workers draw and the device casts; without one, workers do both, item by item.

    Args:
        cursor: items that all ranks together have consumed.

    Raises:
        ModelError: the batch does not divide among the ranks, or an item cannot be made.
    """
    if cursor < 0 or not 0 <= rank < world or config.batch % world:
        raise ModelError(
            f"a batch of {config.batch} items for rank {rank} of {world} from cursor {cursor}: the "
            "batch must be a multiple of the ranks, the cursor at least 0"
        )
    where = torch.device(device)
    work = _Work(source, config, rank=rank, world=world, shows=_shown_by_workers(where))
    starts = itertools.count(cursor, config.batch)
    workers = min(config.workers, os.cpu_count() or 1)
    loader: DataLoader[Any] = DataLoader(
        work,
        sampler=starts,
        batch_size=None,
        num_workers=workers,
        collate_fn=_as_is,
        prefetch_factor=2 if workers else None,
    )
    for made in loader:
        if isinstance(made, ArtgenError):
            raise made
        yield made if isinstance(made, Batch) else source.batch(made, config, where)


class _Work(Dataset[Any]):
    """What one batch takes of a worker: its plans, or the batch itself where it is shown here."""

    def __init__(
        self, source: Source[Any], config: DataConfig, *, rank: int, world: int, shows: bool
    ) -> None:
        self._source, self._config, self._shows = source, config, shows
        self._share = config.batch // world
        self._first = rank * self._share
        self._row = source.order(config.seed)

    def __getitem__(self, start: int) -> Batch | Sequence[Any] | ArtgenError:
        """Faults of ours are handed over as they are; torch would wrap them in tracebacks."""
        try:
            return self._made(start)
        except ArtgenError as error:
            return error

    def _made(self, start: int) -> Batch | Sequence[Any]:
        places = range(start + self._first, start + self._first + self._share)
        if not self._shows:
            return [self._plan(place) for place in places]
        # One by one: an item is then the same bits in any company.
        shown = [self._source.batch([self._plan(p)], self._config, CPU) for p in places]
        return merged(shown)

    def _plan(self, place: int) -> Any:
        stream = Stream(self._config.seed, "item", place)
        return self._source.plan(self._row.at(place), self._config, stream)


def _shown_by_workers(device: torch.device) -> bool:
    """On a CPU workers cast too; a GPU casts whole batches itself."""
    return device.type == "cpu"


def _as_is(made: Any) -> Any:
    return made
