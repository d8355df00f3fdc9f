"""Training items from a library of soups: drawn on the CPU, ray-cast where the model trains."""

import logging
from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor

from artgen.core.conventions import ART_SLOTS
from artgen.core.errors import ModelError
from artgen.core.stream import Stream
from artgen.dataset.split import Split, divided, split_of
from model.batch import Batch, Images, Rays
from model.data.cameras import Cameras, state_cameras
from model.data.config import DataConfig
from model.data.crop import window_intrinsics
from model.data.frames import framed_images
from model.data.library import Library
from model.data.order import Permutations
from model.data.pick import picked
from model.data.scene import Scene, drawn_scene
from model.data.shuffle import shuffled
from model.data.stage import (
    Stage,
    cast,
    colors,
    depths,
    frame_windows,
    photographs,
    staged,
)
from model.data.truth import articulation

log = logging.getLogger(__name__)


class SoupSource:
    """Items of the objects of a library that lie in a split and fit into the slots."""

    def __init__(
        self, library: Library, *, split: Split | None = None, slots: int = ART_SLOTS
    ) -> None:
        """Choose the objects.

        Raises:
            ModelError: no object is left.
        """
        self.library = library
        inside, self.left_out = [], dict[str, str]()
        for k, (name, count) in enumerate(zip(library.ids, library.part_counts, strict=True)):
            own = split_of(name, library.donors(k))
            if split is not None and own is None:
                self.left_out[name] = divided(library.donors(k))
            elif split in (None, own) and count > slots:
                self.left_out[name] = f"{count} parts, {slots} slots"
            elif split in (None, own):
                inside.append(k)
        self.positions = tuple(inside)
        if self.left_out:
            log.warning(
                "%d of %d objects are left out, such as %s: %s",
                *(len(self.left_out), len(self.left_out) + len(inside)),
                *next(iter(self.left_out.items())),
            )
        if not self.positions:
            raise ModelError(
                f"none of {len(library)} objects lies in split {split} and has at most {slots} "
                "parts; make a larger library or raise the slots"
            )

    def __len__(self) -> int:
        return len(self.positions)

    def order(self, seed: int) -> Permutations:
        """A permutation for every epoch."""
        return Permutations(len(self), seed=seed)

    def plan(self, position: int, config: DataConfig, stream: Stream) -> Scene:
        """One item of the object at a position, drawn."""
        return drawn_scene(self.library[self.positions[position]], config, stream)

    def batch(self, planned: Sequence[Scene], config: DataConfig, device: torch.device) -> Batch:
        """The items, cast on the device."""
        batch = shown(planned, config, device)
        return shuffled(batch) if config.part_order == "shuffled" else batch


def shown(scenes: Sequence[Scene], config: DataConfig, device: torch.device) -> Batch:
    """Scenes as a batch: images of their inputs, and rays through their targets."""
    stage = staged(scenes, device)
    inputs = state_cameras([scene.inputs for scene in scenes], device)
    rgba = photographs(stage, inputs, size=config.render_px)
    images = framed_images(
        rgba.view(len(scenes), config.states, config.views, *rgba.shape[2:]),
        [scene.stated for scene in scenes],
        [scene.background for scene in scenes],
        size=config.input_px,
    )
    return Batch(
        images=images,
        truth=articulation([scene.truth for scene in scenes], device),
        radius_B=torch.tensor([scene.truth.radius for scene in scenes], device=device),
        rays=_rays(stage, scenes, inputs, images, config) if config.rays else None,
        asset_ids=tuple(scene.asset_id for scene in scenes),
        categories=tuple(scene.category for scene in scenes),
    )


def target_cameras(
    stage: Stage, scenes: Sequence[Scene], inputs: Cameras, images: Images, config: DataConfig
) -> Cameras:
    """The T x W cameras whose rays supervise, at `target_px`, cropped as the inputs are."""
    device = images.rgb_BTV3HW.device
    others = [scene.others for scene in scenes if scene.others is not None]
    if others:
        raw = state_cameras(others, device)
        windows = frame_windows(stage, raw).flatten(0, 1)
        matrices = raw.intrinsics_BN33.flatten(0, 1).double()
        cropped = window_intrinsics(matrices, windows, size=config.target_px).float()
        return Cameras(
            intrinsics_BN33=cropped.view_as(raw.intrinsics_BN33),
            camera_from_world_BN44=raw.camera_from_world_BN44,
            state_BN=raw.state_BN,
        )
    chosen = torch.from_numpy(np.stack([scene.chosen for scene in scenes])).to(device)
    item = torch.arange(len(scenes), device=device)[:, None, None]
    state = torch.arange(config.states, device=device)[None, :, None]
    matrices = images.intrinsics_BTV33[item, state, chosen] * (config.target_px / config.input_px)
    matrices[..., 2, 2] = 1.0
    return Cameras(
        intrinsics_BN33=matrices.flatten(1, 2),
        camera_from_world_BN44=inputs.camera_from_world_BN44.gather(
            1, (state * config.views + chosen).flatten(1)[..., None, None].expand(-1, -1, 4, 4)
        ),
        state_BN=state.expand_as(chosen).flatten(1, 2),
    )


def _rays(
    stage: Stage, scenes: Sequence[Scene], inputs: Cameras, images: Images, config: DataConfig
) -> Rays:
    cameras = target_cameras(stage, scenes, inputs, images, config)
    items, count = cameras.state_BN.shape
    parts = max(int(scene.truth.arrays["valid_P"].sum()) for scene in scenes)
    code = cast(stage, cameras, size=config.target_px, parts=parts).code_CHW
    code_BNPHW = code.view(items, count, parts, *code.shape[1:])
    draws = torch.from_numpy(np.stack([scene.draws for scene in scenes])).to(code.device)
    image_BR, pixel_BR = picked(code_BNPHW >= 0, draws, config)
    item_BR = torch.arange(items, device=code.device)[:, None].expand_as(image_BR)
    code_BRP = code_BNPHW.flatten(3)[item_BR, image_BR, :, pixel_BR]
    sight_BR3 = cameras.sights(item_BR, image_BR, pixel_BR, config.target_px)
    nearest_BR, first_BR = code_BRP.max(dim=2)
    part_rgb = _part_colors(stage, cameras, code_BRP, image_BR, pixel_BR, config.target_px)
    length = sight_BR3.norm(dim=-1)
    return Rays(
        origin_BR3=cameras.center_BN3[item_BR, image_BR],
        direction_BR3=sight_BR3 / length[..., None],
        state_BR=cameras.state_BN.gather(1, image_BR),
        part_rgb_BPR3=_slotted(part_rgb.transpose(1, 2), config.slots),
        part_alpha_BPR=_slotted((code_BRP >= 0).float().transpose(1, 2), config.slots),
        rgb_BR3=part_rgb.gather(2, first_BR[..., None, None].expand(-1, -1, 1, 3))[:, :, 0],
        alpha_BR=(nearest_BR >= 0).float(),
        distance_BR=depths(stage, cameras, nearest_BR) * length,
        patch=(config.patch_px, config.patch_px) if config.patch_px else None,
    )


def _slotted(array_BP: Tensor, slots: int) -> Tensor:
    """The array with empty slots, zeros, behind its parts."""
    full = array_BP.new_zeros(len(array_BP), slots, *array_BP.shape[2:])
    full[:, : array_BP.shape[1]] = array_BP
    return full


def _part_colors(
    stage: Stage,
    cameras: Cameras,
    code_BRP: Tensor,
    image_BR: Tensor,
    pixel_BR: Tensor,
    width: int,
) -> Tensor:
    """(B, R, P, 3) sRGB, zero where a part is not hit."""
    item, ray, part = torch.nonzero(code_BRP >= 0, as_tuple=True)
    color = torch.zeros(*code_BRP.shape, 3, device=code_BRP.device)
    color[item, ray, part] = colors(
        stage,
        cameras,
        code_BRP[item, ray, part],
        item,
        image_BR[item, ray],
        pixel_BR[item, ray],
        width,
    )
    return color
