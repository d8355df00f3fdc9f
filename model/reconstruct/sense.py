"""Shapes that make no sense are replaced by something simple: a box with round edges.

Networks that are unsure fill the same space with several parts, or a part with shreds. Exact
booleans of such shapes take minutes and leave splinters; a box says honestly how much is known.
"""

from collections.abc import Mapping

import numpy as np

from artgen.geometry.solid import Solid
from model.reconstruct.guess import PartGuess, Told
from model.reconstruct.shapes import rounded_box

MOST_SHARED = 0.5
"""Share of a moving part's volume that may lie in other moving parts."""
MOST_SHARED_BASE = 0.8
"""Share of the base's volume that may lie in moving parts; a solid cabinet holds its drawers."""
RAGGED = 1.5
"""Triangles that are left over the number asked for, as a multiple of it."""


def sensible(
    solids: Mapping[int, Solid],
    guesses: Mapping[int, PartGuess],
    budgets: Mapping[int, int],
    carriers: Mapping[int, int],
) -> tuple[dict[int, Solid], list[Told]]:
    """The solids, senseless ones replaced, and what was replaced why.

    Args:
        budgets: slot to the triangles that were asked for.
        carriers: slot to the slot that carries it; what carries may hold what it carries.
    """
    found, told = dict(solids), list[Told]()
    for slot, solid in solids.items():
        count, share = solid.manifold.num_tri(), shared(slot, solids, carriers)
        why = ""
        if count > RAGGED * budgets[slot]:
            why = f"its surface is ragged ({count} triangles where {budgets[slot]} should do)"
        elif share > (MOST_SHARED_BASE if slot == 0 else MOST_SHARED):
            why = f"{share:.0%} of it lies within other parts"
        if why and not guesses[slot].boxed:  # It is that box already.
            found[slot] = rounded_box(guesses[slot])
            told.append((slot, f"{why}; a rounded box of the predicted size stands for it"))
    return found, told


def shared(slot: int, solids: Mapping[int, Solid], carriers: Mapping[int, int]) -> float:
    """Share of a part's volume that lies in moving parts which neither carry it nor hang on it;
    what lies in two counts twice."""
    own = solids[slot]
    total = 0.0
    for other, solid in solids.items():
        tied = slot and (carriers.get(slot) == other or carriers.get(other) == slot)
        if other not in (0, slot) and not tied and meet(own, solid):
            total += (own & solid).volume
    return total / own.volume


def meet(one: Solid, other: Solid) -> bool:
    """Whether the boxes of two solids share a volume."""
    lower = np.maximum(one.bounds[0], other.bounds[0])
    return bool((lower < np.minimum(one.bounds[1], other.bounds[1])).all())
