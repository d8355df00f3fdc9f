"""Parts that are sunk deep into each other are parted by a plane: each keeps its side.

Cutting one by the shape of the other would leave shells and crescents of two guesses that cannot
both be right; a plane between them leaves two plain shapes.
"""

from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from artgen.geometry.solid import Solid


@dataclass(frozen=True, kw_only=True, eq=False)
class Parting:
    """Two solids on their sides of a plane.

    Attributes:
        lost: the larger of the shares of their volumes that the two lose.
    """

    one: Solid
    other: Solid
    axis: int
    lost: float


def partings(one: Solid, other: Solid, gap: float) -> list[Parting]:
    """Two solids parted by planes `gap` m between them: across each axis the one that takes least
    from whom it takes most, the best of them first; none where none leaves both.

    Planes are tried in the middle and at both ends of what the two share along each axis.
    """
    lower = np.maximum(one.bounds[0], other.bounds[0])
    upper = np.minimum(one.bounds[1], other.bounds[1])
    found = []
    for axis in range(3):
        tried = [
            _at(one, other, axis, float(height), sign, gap)
            for height in (lower[axis], (lower[axis] + upper[axis]) / 2.0, upper[axis])
            for sign in (1.0, -1.0)
        ]
        left = [own for own in tried if own is not None]
        found += [min(left, key=lambda own: own.lost)] if left else []
    return sorted(found, key=lambda own: own.lost)


def _at(
    one: Solid, other: Solid, axis: int, height: float, sign: float, gap: float
) -> Parting | None:
    """`one` on the side of a plane that `sign` points to, `other` on the other."""
    normal = sign * np.eye(3)[axis]
    above = beyond(one, normal, sign * height + gap / 2.0)
    below = beyond(other, -normal, -sign * height + gap / 2.0)
    if above.is_empty or below.is_empty:
        return None
    lost = max(1.0 - above.volume / one.volume, 1.0 - below.volume / other.volume)
    return Parting(one=above, other=below, axis=axis, lost=lost)


def beyond(solid: Solid, normal: Floats, height: float) -> Solid:
    """What of a solid has `normal @ x >= height`."""
    return Solid(solid.manifold.trim_by_plane(normal, height))
