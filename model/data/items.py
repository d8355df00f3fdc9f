"""What a source of training items promises, and what an item is before it becomes tensors."""

from collections.abc import Mapping, Sequence
from typing import Generic, Protocol, TypeVar

import torch

from artgen.core.stream import Stream
from model.batch import Batch
from model.data.config import DataConfig

Planned = TypeVar("Planned")


class Source(Protocol, Generic[Planned]):
    """Items by position; both halves are functions of their arguments alone.

    `plan` draws: states, cameras, lights; numpy, picklable, in any process. `batch` shows: images
    and rays, on the device that trains where it can. `left_out` says which objects are
    not among the items, and why; it is never silent.
    """

    @property
    def left_out(self) -> Mapping[str, str]:
        """Asset id to the reason why no position holds it."""
        ...

    def __len__(self) -> int: ...

    def plan(self, position: int, config: DataConfig, stream: Stream) -> Planned:
        """Everything that chance decides about one item."""
        ...

    def batch(self, planned: Sequence[Planned], config: DataConfig, device: torch.device) -> Batch:
        """The items together, on the device."""
        ...
