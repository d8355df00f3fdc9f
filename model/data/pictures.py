"""Pictures: one item read from a shard, decoded only as far as it is needed."""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.targets import Targets
from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from artgen.dataset.codec import DepthRange, read_gray16, read_rgba
from artgen.dataset.members import sample_facts
from model.data.config import DataConfig
from model.data.draws import background_color
from model.data.pick import ray_draws
from model.data.truth import Truth, truth
from model.data.views import Views, stated_views


@dataclass(frozen=True, kw_only=True, eq=False)
class Pictures:
    """One planned item, its images read; lengths in radii, the sphere's center at zero.

    N target images; H x W px as rendered, so rays go through pixel centers of whole images.

    Attributes:
        rgba: (T, V, H, W, 4) uint8 of the network's views.
        inputs: their cameras, as the network is told them.
        targets: cameras of the target images, (N, 1, ...).
        state: (N,) state of each target image.
        target_rgba: (N, H, W, 4) uint8.
        depth: (N, H, W) float32 m along the camera's z axis.
        part_rgba: (N, P, H, W, 4) uint8 of each part alone, in slots.
        background: (3,) sRGB.
        draws: (K, 4) in [0, 1) that pick the rays.
    """

    asset_id: str
    category: str
    truth: Truth
    rgba: NDArray[np.uint8]
    inputs: Views
    targets: Views
    state: NDArray[np.int64]
    target_rgba: NDArray[np.uint8]
    depth: NDArray[np.float32]
    part_rgba: NDArray[np.uint8]
    background: NDArray[np.float32]
    draws: NDArray[np.float32]


class Reading:
    """The members of one sample, decoded as far as an item needs them."""

    def __init__(self, members: Mapping[str, bytes], where: str) -> None:
        self._members, self._where = members, where
        self._facts = sample_facts(self._member, where=where)
        with np.load(io.BytesIO(self._member("arrays.npz")), allow_pickle=False) as arrays:
            self._arrays = {name: arrays[name] for name in arrays.files}

    def _member(self, name: str) -> bytes:
        if name not in self._members:
            raise ModelError(f"{self._where}: has no member {name}; pack the shard again")
        return self._members[name]

    def pictures(
        self,
        config: DataConfig,
        stream: Stream,
        states: Sequence[int],
        views: Sequence[int],
        others: Sequence[int],
    ) -> Pictures:
        """The item that sees `views` of each of the states, and is held to the `others`."""
        pairs = [(t, v) for t in states for v in others] if config.rays else []
        seen = {(t, v): self._rgba(t, v) for t in states for v in views}
        return Pictures(
            asset_id=self._facts["asset_id"],
            category=self._facts["category"],
            truth=self._truth(states, config.slots),
            rgba=np.stack([np.stack([seen[t, v] for v in views]) for t in states]),
            inputs=stated_views(
                self._views([[(t, v) for v in views] for t in states]),
                config,
                stream.child("pose noise"),
            ),
            targets=self._views([[pair] for pair in pairs]),
            state=np.repeat(np.arange(len(states)), len(others))[: len(pairs)],
            target_rgba=_stacked([self._rgba(t, v) for t, v in pairs]),
            depth=_stacked([self._depth(f"s{t}v{v:02d}.depth.png") for t, v in pairs]),
            part_rgba=_stacked([self._parts(t, v, config.slots) for t, v in pairs]),
            background=background_color(config.background, stream.child("background")),
            draws=ray_draws(config, stream.child("rays")),
        )

    def _rgba(self, t: int, v: int) -> NDArray[np.uint8]:
        return read_rgba(self._member(f"s{t}v{v:02d}.rgba.webp"))

    def _depth(self, name: str) -> NDArray[np.float32]:
        span = DepthRange(**self._facts["depth_range"])
        return span.decode(read_gray16(self._member(name)))

    def _parts(self, t: int, v: int, slots: int) -> NDArray[np.uint8]:
        """(P, H, W, 4) each part alone; rays are drawn in, and held to, what its alpha covers."""
        strip = read_rgba(self._member(f"s{t}v{v:02d}.parts.rgba.webp"))
        width, height = (int(length) for length in self._arrays["size"])
        parts = strip.reshape(-1, height, width, 4)[: len(self._facts["parts"])]
        return np.pad(parts, [(0, slots - len(parts)), (0, 0), (0, 0), (0, 0)])

    def _truth(self, states: Sequence[int], slots: int) -> Truth:
        names = ("bounds", "type", "axis", "origin", "parent", "limits", "movable")
        count = len(self._facts["parts"])
        own = {name: self._arrays[name][:count] for name in names}
        motion = self._arrays["motion"][list(states), :count]
        aims = Targets(**own, motion=motion)
        return truth(aims, radius=float(self._arrays["radius"]), slots=slots)

    def _views(self, pairs: Sequence[Sequence[tuple[int, int]]]) -> Views:
        """Cameras of rows of (state, view), about the sphere's center, in radii."""
        chosen = np.array(pairs, int).reshape(len(pairs), len(pairs[0]) if pairs else 0, 2)
        states, views = chosen[..., 0], chosen[..., 1]
        poses = self._arrays["camera_from_world"][states, views]
        poses[..., :3, 3] += poses[..., :3, :3] @ self._arrays["center"]
        poses[..., :3, 3] /= float(self._arrays["radius"])
        return Views(intrinsics=self._arrays["intrinsics"][views], camera_from_world=poses)


def _stacked(images: Sequence[NDArray[Any]]) -> NDArray[Any]:
    return np.stack(images) if images else np.zeros(0, np.uint8)
