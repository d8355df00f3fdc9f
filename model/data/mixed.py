"""Several sources in one, each with its share of the items."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from model.batch import Batch
from model.data.config import DataConfig
from model.data.items import Source
from model.data.merge import chosen, merged
from model.data.order import Row

BLOCK = 100
"""Places among which every source has its whole share, in an order drawn for each block."""


@dataclass(frozen=True)
class _Tagged:
    """A planned item, and which source planned it."""

    source: int
    planned: Any


class Mixed:
    """Sources by weight; each passes through its own items at its own pace.

    Shares are whole hundredths. A small source comes round more often than a large one; over one of
    its passes, each of its items is seen once.
    """

    def __init__(self, sources: Sequence[tuple[Source[Any], float]]) -> None:
        """Mix (source, weight) pairs.

        Raises:
            ModelError: there is none, or a weight is so small that a source would never come.
        """
        weights = np.array([weight for _, weight in sources], float)
        if not len(weights) or weights.min() <= 0.0 or not np.isfinite(weights).all():
            raise ModelError(f"weights {weights.tolist()}: name at least one source, each above 0")
        self.sources = tuple(source for source, _ in sources)
        self.counts = _hundredths(weights)
        if self.counts.min() < 1:
            raise ModelError(
                f"weights {weights.tolist()}: a source has less than a hundredth of the items; "
                "leave it out, or raise its weight (--shard-share of artgen train)"
            )
        self._starts = np.cumsum([0, *(len(source) for source in self.sources)])

    @property
    def left_out(self) -> Mapping[str, str]:
        """Of all sources."""
        return {name: why for source in self.sources for name, why in source.left_out.items()}

    def __len__(self) -> int:
        return int(self._starts[-1])

    def order(self, seed: int) -> Row:
        """The sources' own rows, woven together."""
        rows = [source.order(seed) for source in self.sources]
        return _Woven(rows, self._starts[:-1], self.counts, seed)

    def plan(self, position: int, config: DataConfig, stream: Stream) -> _Tagged:
        """The item of the source that the position belongs to."""
        k = int(np.searchsorted(self._starts, position, side="right")) - 1
        own = position - int(self._starts[k])
        return _Tagged(k, self.sources[k].plan(own, config, stream))

    def batch(self, planned: Sequence[_Tagged], config: DataConfig, device: torch.device) -> Batch:
        """Each source shows its own items; the order stays."""
        groups = [
            [i for i, item in enumerate(planned) if item.source == k]
            for k in range(len(self.sources))
        ]
        shown = [
            self.sources[k].batch([planned[i].planned for i in group], config, device)
            for k, group in enumerate(groups)
            if group
        ]
        came = [i for group in groups for i in group]
        return chosen(merged(shown), np.argsort(came).tolist())


def mixed_by_number(sources: Sequence[Source[Any]]) -> Source[Any]:
    """All items alike, but for small sources: each has a hundredth at least.

    Raises:
        ModelError: there is none, or more than can have that.
    """
    if len(sources) == 1:
        return sources[0]
    if not 1 < len(sources) <= BLOCK:
        raise ModelError(f"{len(sources)} sources to mix; expected 1 to {BLOCK}")
    shares = _raised(np.array([len(source) for source in sources], float))
    return Mixed(list(zip(sources, shares.tolist(), strict=True)))


class _Woven:
    """A row that takes so many of every hundred places from each of several rows."""

    def __init__(
        self, rows: Sequence[Row], starts: NDArray[np.int64], counts: NDArray[np.int64], seed: int
    ) -> None:
        self._rows, self._starts, self._counts, self._seed = rows, starts, counts, seed
        self._block, self._pattern = -1, counts

    def at(self, place: int) -> int:
        """The position, counted through all sources."""
        block, offset = divmod(place, BLOCK)
        if block != self._block:
            rng = Stream(self._seed, "mix", block).generator()
            self._pattern = rng.permutation(np.repeat(np.arange(len(self._rows)), self._counts))
            self._block = block
        k = int(self._pattern[offset])
        before = int((self._pattern[:offset] == k).sum())
        own = block * int(self._counts[k]) + before
        return int(self._starts[k]) + self._rows[k].at(own)


def _raised(weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Shares in proportion to the weights, those below a hundredth raised to one."""
    low = np.zeros(len(weights), bool)
    while True:
        rest = 1.0 - low.sum() / BLOCK
        shares = np.where(low, 1.0 / BLOCK, rest * weights / weights[~low].sum())
        if not (below := shares < 1.0 / BLOCK).any():
            return shares
        low |= below


def _hundredths(weights: NDArray[np.float64]) -> NDArray[np.int64]:
    """Whole shares of `BLOCK` that come nearest to the weights (largest remainder)."""
    exact = BLOCK * weights / weights.sum()
    counts: NDArray[np.int64] = np.floor(exact).astype(np.int64)
    for k in np.argsort(counts - exact, kind="stable")[: BLOCK - int(counts.sum())]:
        counts[k] += 1
    return counts
