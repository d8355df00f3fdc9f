"""Which sample comes next: a permutation of every epoch, resumed exactly, on any number of ranks.

The order of an epoch is a function of (seed, epoch) alone. All ranks walk it together: of the
samples that follow a cursor, rank r takes every `world_size`-th. The cursor counts samples of the
whole job, so a state that was saved by two ranks continues on four, and nothing is seen twice or
left out.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from artgen.core.errors import UsageError

STATE_SCHEMA = "artgen-sampler/1"


class ResumableSampler:
    """Positions of a map-style dataset for one rank; PyTorch's DataLoader takes it as `sampler`.

    Iterating gives the rest of the current epoch for this rank and does not move the cursor, since
    a loader's workers run ahead of the training step. The training loop says what it has consumed:

        for batch in loader:
            step(batch)
            sampler.advance(min(global_batch, sampler.left))    # samples of all ranks together
        sampler.next_epoch()

    `state_dict()` is plain JSON, equal on all ranks; save it with a checkpoint.
    """

    def __init__(
        self,
        size: int,
        *,
        seed: int,
        rank: int = 0,
        world_size: int = 1,
        block: int | None = None,
    ) -> None:
        """Samplers of one job differ in `rank` alone.

        Args:
            size: length of the dataset.
            block: shuffle runs of so many neighbors, and the samples within each run, instead of
                all samples; reads of remote shards then stay near each other. None shuffles freely.

        Raises:
            UsageError: a number is out of its range.
        """
        if size < 1 or seed < 0 or (block is not None and block < 1):
            raise UsageError(
                f"size {size}, seed {seed}, block {block}: a sampler needs a size and a block of "
                "at least 1 and a seed of at least 0"
            )
        if not 0 <= rank < world_size:
            raise UsageError(f"rank {rank} of {world_size}; ranks run from 0 to world_size - 1")
        self.size, self.seed, self.block = size, seed, block
        self.rank, self.world_size = rank, world_size
        self.epoch, self.consumed = 0, 0

    def __iter__(self) -> Iterator[int]:
        return iter(self.order()[self.consumed + self.rank :: self.world_size].tolist())

    def __len__(self) -> int:
        """Samples that are left for this rank in this epoch; ranks differ by one at most."""
        left = self.size - self.consumed - self.rank
        return max(0, -(-left // self.world_size))

    def order(self) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
        """(size,) the positions of the whole epoch, for all ranks."""
        generator = np.random.Generator(np.random.PCG64([self.seed, self.epoch]))
        if self.block is None:
            return generator.permutation(self.size)
        blocks = np.split(np.arange(self.size), range(self.block, self.size, self.block))
        runs = [generator.permutation(blocks[k]) for k in generator.permutation(len(blocks))]
        return np.concatenate(runs)

    @property
    def left(self) -> int:
        """Samples of this epoch that no rank has consumed yet."""
        return self.size - self.consumed

    def advance(self, count: int) -> None:
        """Note that `count` more samples were consumed by all ranks together.

        Raises:
            UsageError: the epoch has not that many left.
        """
        if not 0 <= count <= self.left:
            raise UsageError(
                f"{count} samples consumed, but {self.left} of {self.size} are left in epoch "
                f"{self.epoch}; count each once, and call next_epoch() at the end"
            )
        self.consumed += count

    def next_epoch(self) -> None:
        """Begin the next epoch, in another order."""
        self.epoch, self.consumed = self.epoch + 1, 0

    def state_dict(self) -> dict[str, Any]:
        """Where the job is; the same on every rank, and without rank and world size."""
        return {
            "schema": STATE_SCHEMA,
            "size": self.size,
            "seed": self.seed,
            "block": self.block,
            "epoch": self.epoch,
            "consumed": self.consumed,
        }

    def load_state_dict(self, state: Mapping[str, Any]) -> None:
        """Continue where `state_dict` was taken, on this rank of this world size.

        Raises:
            UsageError: it is of another schema, or of a dataset of another size or order.
        """
        own = self.state_dict()
        for key in ("schema", "size", "seed", "block"):
            if state.get(key) != own[key]:
                raise UsageError(
                    f"the sampler's state has {key} {state.get(key)!r}, this sampler {own[key]!r}; "
                    "resume with the dataset and options it was saved with"
                )
        self.epoch, self.consumed = int(state["epoch"]), int(state["consumed"])
