"""Random streams addressed by name: a draw depends on its address alone, never on call order."""

import hashlib
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, slots=True)
class Stream:
    """An address in the tree of all randomness.

    `Stream(seed, "laptop", 17).child("lid", "thickness").generator()` yields the same numbers on
    every machine, in any order and at any parallelism. NEP 19 keeps the PCG64 bit stream stable.
    """

    seed: int
    path: tuple[str, ...] = ()

    def __init__(self, seed: int, *path: str | int) -> None:
        object.__setattr__(self, "seed", int(seed))
        object.__setattr__(self, "path", tuple(str(step) for step in path))

    def child(self, *path: str | int) -> "Stream":
        """The stream at a longer address."""
        return Stream(self.seed, *self.path, *path)

    def generator(self) -> np.random.Generator:
        """A fresh numpy generator; two calls give two generators in the same state."""
        # The unit separator cannot occur in a name, so ("a", "b") and ("ab",) differ.
        address = "\x1f".join((str(self.seed), *self.path))
        digest = hashlib.sha256(address.encode()).digest()
        return np.random.Generator(np.random.PCG64(int.from_bytes(digest, "big")))
