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
    """A soft strip along sides and top of an opening in the plane y = `front`, towards -y.

    Its feet stand on the opening's lower edge, where the door's own lip seals.

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
    low = bottom - corner - 2.0 * width  # the frame's lower corners, to be cut away
    width_x, height = right - left, top - low
    inner = rounded_rectangle(height, width_x, corner)
    outer = rounded_rectangle(height + 2 * width, width_x + 2 * width, corner + width)
    middle = np.array([(low + top) / 2.0, (left + right) / 2.0])  # a drawing of (z, x)
    ring = upright(prism(outer + middle, thickness, holes=[inner + middle]), "y")
    below = slab((left - 1.0, -1.0, bottom - 1.0), (right + 1.0, 1.0, bottom))
    return Body(
        solid=ring.at(y=front - thickness) - below,
        surface=surface.name,
        density=RUBBER,
    )


def lip_seal(*, half_length: float, y: float, z: float, thickness: float) -> Solid:
    """A strip along x that stands out by `thickness` towards +y from the plane `y`."""
    return slab((-half_length, y, z), (half_length, y + thickness, z + 0.008))
