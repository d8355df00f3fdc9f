"""What a rule may draw from: one small class per distribution, each naming its bounds."""

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

Value = float | int | str | bool


class Distribution(Protocol):
    """Draws one value; `check` lists what is wrong with its numbers."""

    def draw(self, rng: np.random.Generator) -> Value:
        """One value."""
        ...

    def check(self) -> str | None:
        """What is wrong, or None."""
        ...


@dataclass(frozen=True)
class Uniform:
    """Evenly between two bounds."""

    lower: float
    upper: float

    def draw(self, rng: np.random.Generator) -> float:
        """One value in [lower, upper)."""
        return float(rng.uniform(self.lower, self.upper))

    def check(self) -> str | None:
        """Bounds must be in order."""
        return _ordered(self.lower, self.upper)


@dataclass(frozen=True)
class LogUniform:
    """Evenly in the logarithm: every octave alike."""

    lower: float
    upper: float

    def draw(self, rng: np.random.Generator) -> float:
        """One value in [lower, upper)."""
        return float(math.exp(rng.uniform(math.log(self.lower), math.log(self.upper))))

    def check(self) -> str | None:
        """Bounds must be positive and in order."""
        if self.lower <= 0.0:
            return f"lower {self.lower} must be > 0 for a log_uniform"
        return _ordered(self.lower, self.upper)


@dataclass(frozen=True)
class Normal:
    """A bell curve, redrawn until it falls within two standard deviations."""

    mean: float
    deviation: float

    def draw(self, rng: np.random.Generator) -> float:
        """One value within mean +- 2 deviation."""
        while True:
            step = float(rng.standard_normal())
            if abs(step) <= 2.0:
                return self.mean + self.deviation * step

    def check(self) -> str | None:
        """The deviation must be positive."""
        return None if self.deviation > 0.0 else f"deviation {self.deviation} must be > 0"


@dataclass(frozen=True)
class Integer:
    """Whole numbers, both bounds included."""

    lower: int
    upper: int

    def draw(self, rng: np.random.Generator) -> int:
        """One value in lower ... upper."""
        return int(rng.integers(self.lower, self.upper, endpoint=True))

    def check(self) -> str | None:
        """Bounds must be whole and in order; one value alone is allowed."""
        if any(isinstance(v, float) for v in (self.lower, self.upper)):
            return f"bounds {self.lower}, {self.upper} must be whole numbers"
        return f"lower {self.lower} > upper {self.upper}" if self.lower > self.upper else None


@dataclass(frozen=True)
class Choice:
    """One of a list, by weight."""

    options: tuple[Value, ...]
    weights: tuple[float, ...]

    def draw(self, rng: np.random.Generator) -> Value:
        """One of the options."""
        share = np.cumsum(self.weights) / sum(self.weights)
        return self.options[int(np.searchsorted(share, rng.random(), side="right"))]

    def check(self) -> str | None:
        """There must be an option, and one weight >= 0 for each."""
        if not self.options:
            return "the list is empty"
        if len(self.weights) != len(self.options):
            return f"{len(self.weights)} weights for {len(self.options)} options"
        if min(self.weights) < 0.0 or sum(self.weights) <= 0.0:
            return f"weights {list(self.weights)} must be >= 0 with a positive sum"
        return None


@dataclass(frozen=True)
class Chance:
    """True with a probability."""

    probability: float

    def draw(self, rng: np.random.Generator) -> bool:
        """True or False."""
        return bool(rng.random() < self.probability)

    def check(self) -> str | None:
        """A probability lies in [0, 1]."""
        return None if 0.0 <= self.probability <= 1.0 else f"{self.probability} lies outside [0, 1]"


def _ordered(lower: float, upper: float) -> str | None:
    if lower < upper:
        return None
    return f"is empty (lower {lower} >= upper {upper}); write the smaller bound first"
