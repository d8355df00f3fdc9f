"""Which views the network is shown: those that its training draws, from as many sides as can be."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from artgen.core.mesh import Floats
from model.data.config import DataConfig
from model.reconstruct.capture import Capture
from model.reconstruct.sight import Sphere

SLACK_DEG = 8.0
"""By which a view may lie outside of what training draws; photographs are framed by eye."""
APART_DEG = 15.0
"""By which the cameras of one view may differ from state to state before that is told, where
training keeps them."""
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
    off = np.array([[strangeness_deg(way, data) for way in seen] for seen in ways]).max(axis=0)
    count = min(data.views, len(off))
    known = np.flatnonzero(off <= SLACK_DEG).tolist()
    if len(known) >= count:
        first, *others = widest(ways, known, count)
        shown = sorted(set(first).union(*others))
        told = told_apart(capture, ways, shown, data)
        return Choice(views=first, others=tuple(others), told=told)
    views = tuple(sorted(np.argsort(off, kind="stable")[:count].tolist()))
    worst = max(views, key=lambda view: off[view])
    strange = (
        f"the network was trained on views up to {data.azimuth_deg:g} degrees from the front, "
        f"{data.elevation_deg[0]:g} to {data.elevation_deg[1]:g} high; view {worst} is "
        f"{off[worst]:.0f} degrees off that, so expect less of the result"
    )
    return Choice(views=views, told=(strange, *told_apart(capture, ways, views, data)))


def view_directions(capture: Capture, sphere: Sphere) -> Floats:
    """(T, V, 3) unit vectors from the object to the cameras."""
    poses = capture.camera_from_world
    eyes = -np.einsum("tvji,tvj->tvi", poses[..., :3, :3], poses[..., :3, 3])
    ways = eyes - sphere.center
    return np.asarray(ways / np.linalg.norm(ways, axis=-1, keepdims=True))


def told_apart(
    capture: Capture, ways: Floats, shown: Sequence[int], data: DataConfig
) -> tuple[str, ...]:
    """A sentence where a view that is shown was taken from elsewhere in a later state, if training
    keeps cameras where they are."""
    half = np.linalg.norm(ways - ways[:1], axis=-1) / 2.0
    off = np.degrees(2.0 * np.arcsin(np.minimum(half, 1.0)))[:, list(shown)]
    state, place = divmod(int(off.argmax()), len(shown))
    if not data.same_cameras or off[state, place] <= APART_DEG:
        return ()
    files = [capture.files[k][shown[place]] for k in (0, state)]
    return (
        f"{files[1]} was taken {off[state, place]:.0f} degrees from {files[0]}, the nearest image "
        f"of state {capture.states[0]} that is left for it; the network was trained on states "
        "seen from the same places, so expect less of the result",
    )


def strangeness_deg(way: Floats, data: DataConfig) -> float:
    """How far a direction lies outside of those that training draws."""
    x, y, z = way.tolist()
    azimuth = abs(math.degrees(math.atan2(x, -y)))
    elevation = math.degrees(math.asin(max(-1.0, min(1.0, z))))
    low, high = data.elevation_deg
    return max(azimuth - data.azimuth_deg, low - elevation, elevation - high, 0.0)


def widest(ways: Floats, known: list[int], count: int) -> list[tuple[int, ...]]:
    """Sets of views among `known`, those first whose two closest directions lie farthest apart.

    Args:
        ways: (T, V, 3) directions; of all states those count that are closest.
    """
    while math.comb(len(known), count) > MOST_SETS:
        left = max(len(known) // 2, count)
        known = [known[k] for k in np.linspace(0, len(known) - 1, left).astype(int)]
    if count == 1:
        nearest = sorted(known, key=lambda view: (float(ways[:, view, 1].max()), view))
        return [(view,) for view in nearest[:MOST_TRIED]]
    cosines = (ways @ ways.swapaxes(1, 2)).max(axis=0)

    def closest(views: tuple[int, ...]) -> float:
        return max(float(cosines[a, b]) for a, b in combinations(views, 2))

    ranked = sorted(combinations(known, count), key=lambda views: (round(closest(views), 9), views))
    return ranked[:MOST_TRIED]
