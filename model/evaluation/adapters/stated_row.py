"""An object in a stranger's JSON, whose values are checked as they are taken."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from artgen.articulation.targets import PRISMATIC, REVOLUTE
from artgen.core.errors import ModelError
from artgen.core.mesh import Floats

KINDS: Mapping[str, int] = {
    **dict.fromkeys(("rotate", "revolute", "r", "hinge"), REVOLUTE),
    **dict.fromkeys(("translate", "prismatic", "p", "slider"), PRISMATIC),
}
RIGID = 1e-2
"""How far R R^T of a learned rotation, which float32 rounds and optimizers drift, may be off."""


@dataclass(frozen=True)
class Row:
    """What a file states of one joint or part.

    Attributes:
        file: for messages.
        told: which row it is, for messages.
        stated: as JSON has it; whatever is taken from it is checked.
    """

    file: Path
    told: str
    stated: Any

    def __post_init__(self) -> None:
        if not isinstance(self.stated, Mapping):
            raise ModelError(
                f"{self.file}: {self.told} is {self.stated!r:.80}, expected an object with keys"
            )

    def __contains__(self, key: str) -> bool:
        return key in self.stated

    def value(self, key: str) -> Any:
        """Whatever is stated under a key.

        Raises:
            ModelError: nothing is.
        """
        if key not in self.stated:
            known = ", ".join(sorted(self.stated)) or "nothing"
            raise ModelError(f"{self.file}: {self.told} states no {key}, only {known}")
        return self.stated[key]

    def below(self, key: str) -> "Row":
        """The row under a key."""
        return Row(self.file, f"{key} of {self.told}", self.value(key))

    def name(self, key: str) -> int | str:
        """What other rows name this one by."""
        found = self.value(key)
        if isinstance(found, int | str):
            return found
        raise self._wrong(key, "a whole number or a word")

    def kind(self, key: str) -> int:
        """REVOLUTE or PRISMATIC."""
        return kind_of(self.file, self.value(key))

    def number(self, key: str) -> float:
        """A number, or the first of a list of one."""
        found = self._numbers(key, "a finite number")
        if found.size != 1:
            raise self._wrong(key, "a finite number")
        return float(found.ravel()[0])

    def numbers(self, key: str, count: int) -> Floats:
        """(count,), also of a row or a column."""
        found = self._numbers(key, f"{count} finite numbers")
        if found.size != count:
            raise self._wrong(key, f"{count} finite numbers")
        return found.ravel()

    def vector(self, key: str) -> Floats:
        """(3,)."""
        return self.numbers(key, 3)

    def rotation(self, key: str) -> Floats:
        """(3, 3), also where it is written as nine numbers."""
        found = self._numbers(key, "a rotation of 3 x 3 finite numbers")
        if found.size != 9:
            raise self._wrong(key, "a rotation of 3 x 3 finite numbers")
        turn = found.reshape(3, 3)
        if np.abs(turn @ turn.T - np.eye(3)).max() > RIGID or np.linalg.det(turn) < 0.0:
            raise self._wrong(key, "a rotation: R R^T = I, det R = 1")
        return turn

    def _numbers(self, key: str, expected: str) -> Floats:
        try:
            found = np.array(self.value(key), float)
        except (ValueError, TypeError, OverflowError) as error:
            raise self._wrong(key, expected) from error
        if not np.isfinite(found).all():
            raise self._wrong(key, expected)
        return found

    def _wrong(self, key: str, expected: str) -> ModelError:
        stated = self.stated[key]
        return ModelError(
            f"{self.file}: {key} of {self.told} is {stated!r:.80}, expected {expected}"
        )


def kind_of(file: Path, word: Any) -> int:
    """REVOLUTE or PRISMATIC by any of the words for them.

    Raises:
        ModelError: it is none of them.
    """
    if isinstance(word, str) and word in KINDS:
        return KINDS[word]
    raise ModelError(f"{file}: joint type {word!r:.80} is none of {', '.join(sorted(KINDS))}")
