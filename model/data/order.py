"""Which item comes at which place of the endless row of items that all ranks read."""

from typing import Protocol

from artgen.dataset.sampler import ResumableSampler


class Row(Protocol):
    """An endless row of positions of a source."""

    def at(self, place: int) -> int:
        """The position at a place, from 0."""
        ...


class Permutations:
    """Every epoch a permutation of its own; place c is a function of (size, seed, c) alone.

    All ranks share one row and take their share of every batch of it, so that a run may go on from
    any place on any number of ranks, and no item is seen twice or left out in an epoch.
    """

    def __init__(self, size: int, *, seed: int) -> None:
        self._sampler = ResumableSampler(size, seed=seed)
        self._epoch = self._sampler.order()

    def at(self, place: int) -> int:
        """The position at a place, from 0."""
        epoch, offset = divmod(place, self._sampler.size)
        if epoch != self._sampler.epoch:
            self._sampler.load_state_dict({**self._sampler.state_dict(), "epoch": epoch})
            self._epoch = self._sampler.order()
        return int(self._epoch[offset])
