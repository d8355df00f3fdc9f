"""Procedural studios as images: a gray room with softboxes, strip lights or a window."""

from dataclasses import dataclass

import numpy as np

from artgen.core.camera import orbit_direction
from artgen.core.mesh import Floats
from renders.fast.filtered import directions


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A luminous rectangle on the wall of a room, seen from its middle.

    Attributes:
        azimuth, elevation: of its middle, as of cameras, rad.
        size: (width, height) over its distance.
        radiance: of its middle.
        warmth: red over green minus 1; blue over green is 1 minus it.
        edge: softness of the edge over its distance.
        panes: (across, up) parts that bars divide a window into.
    """

    azimuth: float
    elevation: float
    size: tuple[float, float]
    radiance: float
    warmth: float = 0.0
    edge: float = 0.06
    panes: tuple[int, int] = (1, 1)


BAR = 0.06
"""Share of a pane that a window's bars take."""


def room_map(panels: tuple[Panel, ...], *, walls: float, floor: float, height: int) -> Floats:
    """(H, 2 H, 3) radiance: walls that are brighter above, a floor, and the panels."""
    towards = directions(height)
    up = towards[..., 2:]
    shade = np.where(up > 0.0, 1.0 + 0.6 * up, 1.0 + (floor - 1.0) * np.minimum(-4.0 * up, 1.0))
    room = np.repeat(walls * shade, 3, axis=2)
    for panel in panels:
        share = _share(panel, towards)[..., None]
        color = panel.radiance * np.array([1.0 + panel.warmth, 1.0, 1.0 - panel.warmth])
        room = room + share * (color - room)
    return np.asarray(room)


def _share(panel: Panel, towards: Floats) -> Floats:
    """(H, 2 H) how much of a direction the panel fills; 0 to 1."""
    middle = orbit_direction(panel.azimuth, panel.elevation)
    right = np.cross([0.0, 0.0, 1.0], middle)
    right /= np.linalg.norm(right)
    above = np.cross(middle, right)
    ahead = towards @ middle
    near = np.where(ahead > 0.05, ahead, 1.0)
    x, y = towards @ right / near, towards @ above / near
    share = np.where(ahead > 0.05, 1.0, 0.0)
    for place, size, count in zip((x, y), panel.size, panel.panes, strict=True):
        share = share * _eased((size / 2.0 - np.abs(place)) / panel.edge + 0.5)
        if count > 1:
            pane = size / count
            to_bar = np.abs((place / pane + count / 2.0 + 0.5) % 1.0 - 0.5) * pane
            inner = np.abs(place) < size / 2.0 - pane / 2.0
            bar = _eased((to_bar - BAR * pane) / (panel.edge / 3.0) + 0.5)
            share = share * np.where(inner, bar, 1.0)
    return np.asarray(share)


def _eased(value: Floats) -> Floats:
    """Smooth from 0 to 1."""
    t = np.clip(value, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))
