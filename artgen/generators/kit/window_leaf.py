"""The leaf of a glazed appliance door: outer skin, inner frame, glass pane, perforated screen."""

from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.density import GLASS
from artgen.generators.kit.heel_door import HeelDoor
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab, upright

REBATE = 0.006
"""m; how far the pane reaches behind the skin around the window."""
PANE = 0.003
SCREEN = 0.0015
"""m; thickness of the perforated sheet with its films."""
EASE = 0.0002
"""m; open joint around panes."""


@dataclass(frozen=True, kw_only=True)
class Window:
    """An opening in a leaf, in the door's drawing.

    Attributes:
        lower: its lower corner (x, z), m.
        upper: its upper corner.
        radius: of its corners.
    """

    lower: tuple[float, float]
    upper: tuple[float, float]
    radius: float

    def plate(self, front: float, back: float, *, grown: float = 0.0) -> Solid:
        """The window's area between two depths (y), larger by `grown` all around."""
        size = np.subtract(self.upper, self.lower) + 2.0 * grown
        middle = np.add(self.upper, self.lower) / 2.0
        outline: Floats = rounded_rectangle(
            size[1], size[0], max(0.001, self.radius + grown), segments=3
        )
        return upright(prism(outline, back - front), "y").at(
            x=float(middle[0]), y=front, z=float(middle[1])
        )

    def frame_pieces(self, door: HeelDoor) -> tuple[Solid, ...]:
        """Four boxes of the leaf around the window and one of its panes: what contact meets."""
        (x0, z0), (x1, z1), front = self.lower, self.upper, door.front
        back, heel = door.back, door.pin[1]
        return (
            slab((0.0, front, 0.0), (x0, heel, door.length)),
            slab((x1, front, 0.0), (door.width, back, door.length)),
            slab((x0, front, 0.0), (x1, back, z0)),
            slab((x0, front, z1), (x1, back, door.length)),
            slab((x0, front, z0), (x1, back, z1)),
        )


def skin(door: HeelDoor, window: Window, *, depth: float) -> Solid:
    """The outer skin, `depth` thick, open at the window and rebated behind for the pane."""
    inner = door.front + depth
    rebate = window.plate(door.front + 0.35 * depth, inner + 0.001, grown=REBATE)
    return door.layer(door.front, inner) - window.plate(door.front - 0.01, inner + 0.01) - rebate


def inner_frame(door: HeelDoor, window: Window, *, depth: float, bead: float) -> Solid:
    """The frame behind the skin with a bead around the window, sunk `bead` m into its back."""
    inner = door.front + depth
    frame = door.layer(inner, door.back) - window.plate(inner - 0.01, 0.01)
    ring = window.plate(door.back - bead, 0.01, grown=0.016)
    return frame - (ring - window.plate(door.back - 2.0 * bead, 0.02, grown=0.012))


def panes(
    door: HeelDoor, window: Window, *, depth: float, glass: str, screen: str
) -> tuple[Body, ...]:
    """The glass in its rebate and the perforated screen at the leaf's back."""
    low = door.front + 0.35 * depth + EASE
    front = window.plate(low, low + PANE, grown=REBATE - EASE)
    behind = window.plate(door.back - 0.003 - SCREEN, door.back - 0.003, grown=-EASE)
    return (
        Body(solid=front, surface=glass, density=GLASS),
        Body(solid=behind, surface=screen, density=2.0 * GLASS),
    )
