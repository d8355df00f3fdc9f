"""What a source of training items promises."""

from collections.abc import Mapping, Sequence
from typing import Protocol, TypeVar

import torch

from artgen.core.stream import Stream
from model.batch import Batch
from model.data.config import DataConfig
from model.data.order import Row

Planned = TypeVar("Planned")


class Source(Protocol[Planned]):
    """Items by position; every answer is a function of the arguments alone.

    `plan` draws: states, cameras, lights; numpy, picklable, in any process. `batch` shows: images
    and rays, on the device that trains where it can.
    """

    @property
    def left_out(self) -> Mapping[str, str]:
        """Asset id to the reason why no position holds it; what was left out is never silent."""
        ...

    def __len__(self) -> int: ...

    def order(self, seed: int) -> Row:
        """Which position comes at each place of the endless row of items."""
        ...

    def plan(self, position: int, config: DataConfig, stream: Stream) -> Planned:
        """Everything that chance decides about one item."""
        ...

    def batch(self, planned: Sequence[Planned], config: DataConfig, device: torch.device) -> Batch:
        """The items together, on the device."""
        ...
