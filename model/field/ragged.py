"""Rows that belong to owners, some to more than others, laid out as one padded table and back."""

from dataclasses import dataclass

import torch
from torch import Tensor


@dataclass(frozen=True)
class Ragged:
    """Where K rows lie in a table of `owners` x `most` places.

    Attributes:
        owner_K: whose row it is.
        place_K: which of its owner's rows it is.
        owners: how many owners there are, with rows or without.
        most: rows of the owner who has most.
    """

    owner_K: Tensor
    place_K: Tensor
    owners: int
    most: int

    def padded(self, values_KX: Tensor) -> Tensor:
        """(owners, most, X) with zeros where an owner has fewer rows."""
        table = values_KX.new_zeros(self.owners, self.most, *values_KX.shape[1:])
        return table.index_put((self.owner_K, self.place_K), values_KX)

    def packed(self, table: Tensor) -> Tensor:
        """(K, X) the rows out of (owners, most, X)."""
        return table[self.owner_K, self.place_K]


def ragged(owner_K: Tensor, owners: int) -> Ragged:
    """The layout of rows whose owners do not decrease."""
    held = torch.bincount(owner_K, minlength=owners)
    place_K = torch.arange(len(owner_K), device=owner_K.device)
    place_K = place_K - (held.cumsum(0) - held)[owner_K]
    return Ragged(owner_K, place_K, owners, int(held.max()))
