"""Turned knobs that stand upright on lids."""

import numpy as np

from artgen.geometry.profile import arc
from artgen.geometry.solid import Solid, revolve, slab


def turned_knob(
    radius: float, height: float, *, segments: int = 28, neck: float = 0.55
) -> tuple[Solid, tuple[Solid, ...]]:
    """(solid, contact boxes) of a knob of `radius` on z = 0: foot, waist, domed head.

    Args:
        neck: radius of the waist as a share of the head's.
    """
    slim, foot = neck * radius, 0.80 * radius
    head = arc((0.0, 0.0), 1.0, -0.75, np.pi / 2.0, 8) * (radius, 0.28 * height)
    head += (0.0, 0.72 * height)
    waist = [
        (0.0, 0.0), (foot, 0.0), (foot, 0.06 * height), (0.92 * slim + 0.08 * foot, 0.16 * height),
        (slim, 0.28 * height), (1.08 * slim, 0.42 * height),
    ]  # fmt: skip
    head[-1, 0] = 0.0
    solid = revolve(np.concatenate([waist, head]), segments=segments)
    half, core = 0.74 * radius, 0.75 * slim
    return solid, (
        slab((-half, -half, 0.52 * height), (half, half, 0.92 * height)),
        slab((-core, -core, 0.0), (core, core, 0.52 * height)),
    )
