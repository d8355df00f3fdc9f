"""Training items from rendered shards: batches as from soups, images as a renderer made them."""

import logging
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from artgen.core.conventions import ART_SLOTS
from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from artgen.dataset.reader import ShardDataset
from artgen.dataset.split import Split
from model.batch import Batch, Rays
from model.data.cameras import state_cameras
from model.data.config import DataConfig
from model.data.frames import framed_images
from model.data.merge import merged
from model.data.order import Permutations
from model.data.pick import picked
from model.data.pictures import Pictures, Reading
from model.data.shuffle import shuffled
from model.data.truth import articulation

log = logging.getLogger(__name__)


class ShardSource:
    """Items of the samples in a folder of shards, or under a URL."""

    def __init__(
        self, folder: Path | str, *, split: Split | None = None, slots: int = ART_SLOTS
    ) -> None:
        """Open the shards of a split and look at the facts of every sample.

        Raises:
            ShardError: there is none, or one is damaged.
            ModelError: no sample is left.
        """
        self._dataset = ShardDataset(folder, split=split)
        reasons = [self._reason(k, slots) for k in range(len(self._dataset))]
        self.positions = tuple(k for k, reason in enumerate(reasons) if reason is None)
        ids = self._dataset.ids
        self.left_out: Mapping[str, str] = {
            ids[k]: reason for k, reason in enumerate(reasons) if reason is not None
        }
        if self.left_out:
            log.warning("%s: %d of %d samples left out", folder, len(self.left_out), len(reasons))
        if not self.positions:
            raise ModelError(f"{folder}: no sample fits: {self.left_out}; raise the slots")

    def _reason(self, k: int, slots: int) -> str | None:
        """Why a sample cannot be used."""
        shard, asset_id = self._dataset.shard(k)
        facts = shard.facts(asset_id)
        count = len(facts["parts"])
        if facts["parts_left_out"]:
            return f"its shard lacks the parts {', '.join(facts['parts_left_out'])}"
        return f"{count} parts, {slots} slots" if count > slots else None

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def ids(self) -> tuple[str, ...]:
        """Asset id of every position."""
        return tuple(self._dataset.ids[k] for k in self.positions)

    def order(self, seed: int) -> Permutations:
        """A permutation for every epoch."""
        return Permutations(len(self), seed=seed)

    def plan(self, position: int, config: DataConfig, stream: Stream) -> Pictures:
        """One item: states and views chosen, and their images read.

        Raises:
            ModelError: the sample lacks what the settings ask for.
        """
        if config.rest != "closed":
            raise ModelError(
                f"data.rest {config.rest!r} needs the shapes of parts, and shards hold images "
                "alone; learn from a library (artgen train-data), or leave rest 'closed'"
            )
        shard, asset_id = self._dataset.shard(self.positions[position])
        facts = shard.facts(asset_id)
        states = _chosen_states(facts, config, stream.child("states"))
        views, others = _chosen_views(facts, config, stream.child("views"))
        members = shard.members(
            asset_id, states=sorted(set(states)), views=sorted({*views, *others})
        )
        return Reading(members, f"{shard.place}: {asset_id}").pictures(
            config, stream, states, views, others
        )

    def batch(self, planned: Sequence[Pictures], config: DataConfig, device: torch.device) -> Batch:
        """The items on the device; samples of different image sizes may come together."""
        batch = merged([_shown(item, config, device) for item in planned])
        return shuffled(batch) if config.part_order == "shuffled" else batch


def _chosen_states(facts: Mapping[str, Any], config: DataConfig, stream: Stream) -> list[int]:
    """Indices of T states of a sample.

    Raises:
        ModelError: it holds too few, or none at rest where rest is asked for.
    """
    rng = stream.generator()
    everything = facts["states"]
    if config.motion == "rest":
        usable = [t for t, q in enumerate(everything) if not any(q.values())]
    else:
        usable = list(range(len(everything)))
    needed = config.states if config.motion == "states" else 1
    if len(usable) < needed:
        raise ModelError(
            f"{facts['asset_id']}: {len(usable)} of {len(everything)} states can be used, motion "
            f"{config.motion!r} needs {needed}; render more states, or ask for fewer"
        )
    order = [usable[k] for k in rng.permutation(len(usable))][:needed]
    return [order[t % needed] for t in range(config.states)]


def _chosen_views(
    facts: Mapping[str, Any], config: DataConfig, stream: Stream
) -> tuple[list[int], list[int]]:
    """Indices of the V views that the network sees, and of the W that supervise.

    Raises:
        ModelError: the sample holds too few.
    """
    count = facts["shape"]["views"]
    if count < config.views:
        raise ModelError(
            f"{facts['asset_id']}: {count} views, the network sees {config.views}; render more, or "
            "ask for fewer"
        )
    order = stream.generator().permutation(count).tolist()
    inputs, others = order[: config.views], order[config.views :]
    if config.targets_from == "inputs" or not others:
        others = inputs
    return inputs, [others[k % len(others)] for k in range(config.target_views)]


def _shown(item: Pictures, config: DataConfig, device: torch.device) -> Batch:
    rgba = torch.from_numpy(item.rgba).to(device)[None]
    return Batch(
        images=framed_images(rgba, [item.inputs], [item.background], size=config.input_px),
        truth=articulation([item.truth], device),
        radius_B=torch.tensor([item.truth.radius], device=device),
        rays=_rays(item, config, device) if config.rays else None,
        asset_ids=(item.asset_id,),
        categories=(item.category,),
    )


def _rays(item: Pictures, config: DataConfig, device: torch.device) -> Rays:
    parts = torch.from_numpy(item.part_rgba).to(device)
    width = parts.shape[3]
    draws = torch.from_numpy(item.draws).to(device)[None]
    image_BR, pixel_BR = picked(parts[None, ..., 3] > 0, draws, config)
    image, pixel = image_BR[0], pixel_BR[0]
    whole = _premultiplied(
        torch.from_numpy(item.target_rgba).to(device).flatten(1, 2)[image, pixel]
    )
    alone = _premultiplied(parts.flatten(2, 3)[image, :, pixel])
    depth = torch.from_numpy(item.depth).to(device).flatten(1, 2)[image, pixel]
    cameras = state_cameras([item.targets], device)
    first = torch.zeros_like(image)
    sight = cameras.sights(first, image, pixel, width)
    length = sight.norm(dim=-1)
    return Rays(
        origin_BR3=cameras.center_BN3[:, image],
        direction_BR3=(sight / length[:, None])[None],
        state_BR=torch.from_numpy(item.state).to(device)[image][None],
        part_rgb_BPR3=alone[None, ..., :3].transpose(1, 2).contiguous(),
        part_alpha_BPR=alone[None, ..., 3].transpose(1, 2).contiguous(),
        rgb_BR3=whole[None, :, :3],
        alpha_BR=whole[None, :, 3],
        distance_BR=(depth / item.truth.radius * length)[None],
        patch=(config.patch_px, config.patch_px) if config.patch_px else None,
    )


def _premultiplied(rgba: Tensor) -> Tensor:
    straight = rgba.float() / 255.0
    return torch.cat([straight[..., :3] * straight[..., 3:], straight[..., 3:]], dim=-1)
