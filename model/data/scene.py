"""Scene: an object in some states, its cameras and its light, before any ray is cast."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import sample_states
from artgen.articulation.targets import targets
from artgen.articulation.types import Joint, Precondition, State
from artgen.core.mesh import Floats, Ints
from artgen.core.stream import Stream
from model.data.config import DataConfig, Motion
from model.data.draws import background_color, chosen_views
from model.data.look import Look, drawn_look
from model.data.pick import ray_draws
from model.data.soup import Soup
from model.data.truth import Truth, counted_from, truth
from model.data.views import Views, drawn_views, stated_views


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """One planned item; numpy, picklable. Lengths in radii, the sphere's center at zero.

    Attributes:
        vertices: (V, 3) float32 at rest.
        faces: (F, 3) int32.
        part: (F,) index of the part.
        body: (F,) rank of the body.
        looks: (F, 6) float32 as `Soup.looks`, a triangle each, colors jittered.
        poses: (T, P, 4, 4) where parts at rest are in each state; identity in empty slots.
        inputs: the V cameras a state that the network sees, before the crop.
        stated: the same as the network is told them.
        others: W cameras a state that supervise, or None.
        chosen: (T, W) which inputs supervise where there are no others.
        background: (3,) sRGB.
        draws: (K, 4) in [0, 1) that pick the rays.
    """

    asset_id: str
    category: str
    truth: Truth
    vertices: NDArray[np.float32]
    faces: Ints
    part: NDArray[np.uint8]
    body: NDArray[np.uint16]
    looks: NDArray[np.float32]
    poses: NDArray[np.float32]
    inputs: Views
    stated: Views
    others: Views | None
    chosen: NDArray[np.int64]
    look: Look
    background: NDArray[np.float32]
    draws: NDArray[np.float32]


def drawn_scene(soup: Soup, config: DataConfig, stream: Stream) -> Scene:
    """One item of an object; every draw has its name under the stream.

    Raises:
        ModelError: the object has more parts than slots.
    """
    states = drawn_states(soup.joints, soup.preconditions, config, stream.child("states"))
    aims = targets(
        soup.parts, list(soup.bounds), soup.joints, states, center=soup.center, radius=soup.radius
    )
    found = truth(aims, radius=soup.radius, slots=config.slots)
    poses = _poses(soup, states, config.slots)
    corners = _box_corners((soup.bounds - soup.center) / soup.radius)
    turned = np.einsum("tpij,pkj->tpki", poses[:, : len(corners), :3, :3], corners)
    points = turned + poses[:, : len(corners), None, :3, 3]
    seen = points.reshape(len(states), -1, 3)
    inputs = _views(seen, config, stream.child("inputs"), config.views)
    if config.rest == "first":
        found = counted_from(found, 0, poses[0], _bounds_in(soup, poses[0]))
    look = drawn_look(len(soup.looks), stream.child("look"))
    looks = soup.looks.astype(np.float64)
    looks[:, :3] = np.clip(looks[:, :3] * look.gains, 0.0, 1.0)
    return Scene(
        asset_id=soup.asset_id,
        category=soup.category,
        truth=found,
        vertices=((soup.vertices - soup.center) / soup.radius).astype(np.float32),
        faces=soup.faces,
        part=soup.part,
        body=soup.body,
        looks=looks.astype(np.float32)[soup.surface],
        poses=poses.astype(np.float32),
        inputs=inputs,
        stated=stated_views(inputs, config, stream.child("pose noise")),
        others=_others(seen, config, stream.child("others")),
        chosen=chosen_views(config, config.views, stream.child("chosen")),
        look=look,
        background=background_color(config.background, stream.child("background")),
        draws=ray_draws(config, stream.child("rays")),
    )


def _poses(soup: Soup, states: Sequence[State], slots: int) -> Floats:
    """(T, P, 4, 4) where parts at rest are in each state, radii; identity in empty slots, and where
    nothing moves a part."""
    poses = np.tile(np.eye(4), (len(states), slots, 1, 1))
    for t, state in enumerate(states):
        by_name = forward_kinematics(soup.parts[0], soup.joints, state)
        moved = np.stack([by_name.get(name, np.eye(4)) for name in soup.parts])
        poses[t, : len(moved)] = centered(moved, soup.center, soup.radius)
    return poses


def _bounds_in(soup: Soup, poses: Floats) -> Floats:
    """(P, 2, 3) boxes of the parts' triangles where a state puts them, radii."""
    corners = (soup.vertices[soup.faces] - soup.center) / soup.radius
    boxes = []
    for part, pose in enumerate(poses[: len(soup.parts)]):
        points = corners[soup.part == part].reshape(-1, 3) @ pose[:3, :3].T + pose[:3, 3]
        boxes.append([points.min(axis=0), points.max(axis=0)])
    return np.array(boxes)


def drawn_states(
    joints: tuple[Joint, ...],
    preconditions: tuple[Precondition, ...],
    config: DataConfig,
    stream: Stream,
) -> list[dict[str, float]]:
    """T states, as `DataConfig.motion` says."""
    if config.motion == "rest":
        return [{} for _ in range(config.states)]
    different: dict[Motion, int] = {"states": config.states, "one": 1}
    drawn = sample_states(joints, preconditions, stream, different[config.motion])
    return [drawn[t % len(drawn)] for t in range(config.states)]


def centered(poses: Floats, center: Floats, radius: float) -> Floats:
    """(..., 4, 4) motions of the object frame in m as motions about the center in radii."""
    moved = poses.copy()
    moved[..., :3, 3] += poses[..., :3, :3] @ center - center
    moved[..., :3, 3] /= radius
    return moved


def _views(points: Floats, config: DataConfig, stream: Stream, count: int) -> Views:
    return drawn_views(points, config, stream, count=count, size=config.render_px)


def _others(points: Floats, config: DataConfig, stream: Stream) -> Views | None:
    if config.targets_from == "inputs" or not config.rays:
        return None
    return _views(points, config, stream, config.target_views)


def _box_corners(bounds: Floats) -> Floats:
    """(P, 8, 3) corners of boxes (P, 2, 3)."""
    picks = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    return bounds[:, picks, np.arange(3)]
