"""Numbers as text that reads back to the same float64."""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from artgen.core.errors import ExportError
from artgen.core.mesh import Floats


def exact(values: ArrayLike) -> str:
    """Shortest decimals, separated by blanks, that read back to the same float64; -0.0 becomes 0.0.

    Raises:
        ExportError: a value is not finite.
    """
    return " ".join(number(float(v)) for v in np.ravel(np.asarray(values, np.float64)))


def number(value: float) -> str:
    """One exact number."""
    if not math.isfinite(value):
        raise ExportError(
            f"{value} cannot be written; every number in a file must be finite, so check the part "
            "or joint it belongs to"
        )
    return repr(value + 0.0)


def rows(keyword: str, values: Floats) -> Iterable[str]:
    """`keyword a b c` for each row of an (N, K) array; the values are finite already."""
    template = f"{keyword} " + " ".join(["%r"] * values.shape[1])
    return (template % tuple(row) for row in (values + 0.0).tolist())


def parsed(text: str) -> tuple[float, ...]:
    """What `exact` wrote."""
    return tuple(float(word) for word in text.split())
