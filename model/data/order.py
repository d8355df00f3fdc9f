"""Which item comes at which place of the endless row of items that all ranks read."""

from dataclasses import dataclass

from artgen.dataset.sampler import ResumableSampler


@dataclass(frozen=True)
class Visit:
    """One place of the row.

    Attributes:
        position: of the source.
        epoch: how often the source was passed through before.
    """

    position: int
    epoch: int


class Order:
    """Every epoch a permutation of its own; place c is a function of (seed, c) alone.

    All ranks share one row and take their share of every batch of it, so that a run may go on from
    any place on any number of ranks, and no item is seen twice or left out in an epoch.
    """

    def __init__(self, size: int, *, seed: int) -> None:
        self._sampler = ResumableSampler(size, seed=seed)
        self._row = self._sampler.order()

    def visit(self, place: int) -> Visit:
        """What comes at a place, from 0."""
        epoch, offset = divmod(place, self._sampler.size)
        if epoch != self._sampler.epoch:
            self._sampler.load_state_dict({**self._sampler.state_dict(), "epoch": epoch})
            self._row = self._sampler.order()
        return Visit(int(self._row[offset]), epoch)
