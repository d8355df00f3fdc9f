"""Seals around openings."""

import numpy as np

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.density import RUBBER
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright


def opening_gasket(
    *,
    left: float,
    right: float,
    bottom: float,
    top: float,
    corner: float,
    width: float,
    thickness: float,
    front: float,
    surface: SurfaceSpec,
) -> Body:
    """A soft frame around an opening in the plane y = `front`, sticking out towards -y.

    Args:
        left: x of the opening's left edge, m.
        right: x of its right edge.
        bottom: z of its lower edge.
        top: z of its upper edge.
        corner: radius of the opening's corners.
        width: of the seal across the frame.
        thickness: how far it stands out.
        front: y of the plane that it lies on.
    """
    width_x, height = right - left, top - bottom
    inner = rounded_rectangle(height, width_x, corner)
    outer = rounded_rectangle(height + 2 * width, width_x + 2 * width, corner + width)
    middle = np.array([(bottom + top) / 2.0, (left + right) / 2.0])  # a drawing of (z, x)
    ring = upright(prism(outer + middle, thickness, holes=[inner + middle]), "y")
    return Body(
        solid=ring.at(y=front - thickness),
        surface=surface.name,
        density=RUBBER,
        edge=min(0.35 * thickness, 0.25 * width),
    )


def lip_seal(*, half_length: float, y: float, z: float, thickness: float) -> Solid:
    """A strip along x that stands out by `thickness` towards +y from the plane `y`."""
    return slab((-half_length, y, z), (half_length, y + thickness, z + 0.008))
