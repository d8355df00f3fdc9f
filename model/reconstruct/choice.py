"""Which views the network is shown: those that its training draws, from as many sides as can be."""

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from artgen.core.mesh import Floats
from model.data.config import DataConfig
from model.reconstruct.capture import Capture
from model.reconstruct.sight import Sphere

SLACK_DEG = 8.0
"""By which a view may lie outside of what training draws; photographs are framed by eye."""
MOST_TRIED = 6
"""Sets of views that the network is shown."""
MOST_SETS = 5000
"""Sets of views that are compared; more views than that are thinned evenly first."""


@dataclass(frozen=True, kw_only=True)
class Choice:
    """Views by their number in each state.

    Attributes:
        others: sets as good, but for being less spread, widest first; at most `MOST_TRIED`.
        told: what a user should know, a sentence each.
    """

    views: tuple[int, ...]
    others: tuple[tuple[int, ...], ...] = ()
    told: tuple[str, ...]


def chosen_views(capture: Capture, sphere: Sphere, data: DataConfig) -> Choice:
    """As many views as the network was trained on, or all there are if those are fewer."""
    ways = view_directions(capture, sphere)
    off = np.array([strangeness_deg(way, data) for way in ways])
    count = min(data.views, len(ways))
    known = np.flatnonzero(off <= SLACK_DEG).tolist()
    if len(known) < count:
        views = tuple(sorted(np.argsort(off, kind="stable")[:count].tolist()))
        worst = max(views, key=lambda view: off[view])
        told = (
            f"the network was trained on views up to {data.azimuth_deg:g} degrees from the front, "
            f"{data.elevation_deg[0]:g} to {data.elevation_deg[1]:g} high; view {worst} is "
            f"{off[worst]:.0f} degrees off that, so expect less of the result",
        )
        return Choice(views=views, told=told if off[worst] > SLACK_DEG else ())
    first, *others = widest(ways, known, count)
    return Choice(views=first, others=tuple(others), told=())


def view_directions(capture: Capture, sphere: Sphere) -> Floats:
    """(V, 3) unit vectors from the object to the cameras of each view, in the mean over states."""
    poses = capture.camera_from_world
    eyes = -np.einsum("tvji,tvj->tvi", poses[..., :3, :3], poses[..., :3, 3])
    ways = eyes - sphere.center
    mean = (ways / np.linalg.norm(ways, axis=-1, keepdims=True)).mean(axis=0)
    return np.asarray(mean / np.linalg.norm(mean, axis=-1, keepdims=True))


def strangeness_deg(way: Floats, data: DataConfig) -> float:
    """How far a direction lies outside of those that training draws."""
    x, y, z = way.tolist()
    azimuth = abs(math.degrees(math.atan2(x, -y)))
    elevation = math.degrees(math.asin(max(-1.0, min(1.0, z))))
    low, high = data.elevation_deg
    return max(azimuth - data.azimuth_deg, low - elevation, elevation - high, 0.0)


def widest(ways: Floats, known: list[int], count: int) -> list[tuple[int, ...]]:
    """Sets of views among `known`, those first whose two closest directions lie farthest apart."""
    while math.comb(len(known), count) > MOST_SETS:
        left = max(len(known) // 2, count)
        known = [known[k] for k in np.linspace(0, len(known) - 1, left).astype(int)]
    if count == 1:
        nearest = sorted(known, key=lambda view: (float(ways[view][1]), view))
        return [(view,) for view in nearest[:MOST_TRIED]]
    cosines = ways @ ways.T

    def closest(views: tuple[int, ...]) -> float:
        return max(float(cosines[a, b]) for a, b in combinations(views, 2))

    ranked = sorted(combinations(known, count), key=lambda views: (round(closest(views), 9), views))
    return ranked[:MOST_TRIED]
