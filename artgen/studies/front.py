"""The Pareto front: settings that no other beats in both price and error."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray


def pareto_front(costs: Sequence[float], errors: Sequence[float]) -> NDArray[np.bool_]:
    """(N,) whether no other point is at most as dear and at most as wrong, and less in one.

    Of equal points the first counts; errors that are not finite are never on the front.
    """
    cost, error = np.asarray(costs, float), np.asarray(errors, float)
    order = np.lexsort((np.arange(len(cost)), error, cost))
    front = np.zeros(len(cost), bool)
    best = np.inf
    for k in order.tolist():
        if error[k] < best:
            front[k], best = True, error[k]
    return front
