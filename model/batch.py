"""What the model reads and what it is held to, as tensors: images, articulation, rays, batch.

Units of this package: lengths in radii of the object's bounding sphere, the sphere's center at
zero, axes of the object frame at rest (z up, front -y). One radius in m is kept beside, so that
results leave in meters.

Letters in names: B objects, T states, V views, P part slots, R rays, H W pixels, digits a length.
"""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import torch
from torch import Tensor

FIXED, REVOLUTE, PRISMATIC = 0, 1, 2
"""Joint types, as in `artgen.articulation.targets`."""


class TensorBlock:
    """A frozen dataclass of tensors (None where absent) and of other blocks."""

    def mapped(self, change: Callable[[Tensor], Tensor]) -> Self:
        """The same block with every tensor changed."""
        changed: dict[str, object] = {}
        for name, value in _fields(self).items():
            if isinstance(value, Tensor):
                changed[name] = change(value)
            elif isinstance(value, TensorBlock):
                changed[name] = value.mapped(change)
        return dataclasses.replace(self, **changed)  # type: ignore[type-var]

    def to(self, device: torch.device | str) -> Self:
        """The same block on another device; ready when it comes to the CPU, where nothing waits."""
        aside = torch.device(device).type != "cpu"
        return self.mapped(lambda tensor: tensor.to(device, non_blocking=aside))


def _fields(block: TensorBlock) -> dict[str, object]:
    names = (field.name for field in dataclasses.fields(block))  # type: ignore[arg-type]
    return {name: getattr(block, name) for name in names}


@dataclass(frozen=True, kw_only=True)
class Images(TensorBlock):
    """What the network sees: T states by V views, cropped to squares around the foreground.

    Attributes:
        rgb_BTV3HW: float32 sRGB in [0, 1], the foreground over the recipe's background color.
        alpha_BTVHW: float32 in [0, 1].
        intrinsics_BTV33: px after the crop; the middle of the first pixel is (0.5, 0.5).
        camera_from_world_BTV44: rigid, OpenCV axes, radii.
    """

    rgb_BTV3HW: Tensor
    alpha_BTVHW: Tensor
    intrinsics_BTV33: Tensor
    camera_from_world_BTV44: Tensor


@dataclass(frozen=True, kw_only=True)
class Articulation(TensorBlock):
    """ART's (B, C, D, O, S) of every slot and, beyond the paper, limits and parents.

    The same type holds what is true and what was predicted; slot 0 is the base.

    Attributes:
        valid_BP: bool, whether a slot holds a part.
        center_BP3: middle of the part's box at rest.
        size_BP3: full side lengths of that box.
        type_BP: int64 FIXED, REVOLUTE or PRISMATIC; FIXED for the base and for empty slots.
        axis_BP3: unit direction, positive motion opens; zero for fixed parts.
        origin_BP3: point of the axis nearest to the box's center; zero unless revolute.
        motion_BTP: S in [-1, 1] of the part's own joint: q / (2 pi), or q in radii / 2.
        limits_BP2: lower and upper end of the joint in the unit of `motion`.
        parent_BP: int64 slot of the parent; 0 for parts of the base, -1 for base and empty slots.
    """

    valid_BP: Tensor
    center_BP3: Tensor
    size_BP3: Tensor
    type_BP: Tensor
    axis_BP3: Tensor
    origin_BP3: Tensor
    motion_BTP: Tensor
    limits_BP2: Tensor
    parent_BP: Tensor


@dataclass(frozen=True, kw_only=True)
class Rays(TensorBlock):
    """Rays through supervised pixels, with what each part shows there alone and all show together.

    Colors are premultiplied by their alpha, so they need no background.

    Attributes:
        origin_BR3: camera centers.
        direction_BR3: unit vectors, world frame.
        state_BR: int64 index of the state that a ray looks at.
        part_rgb_BPR3: premultiplied color of each part seen alone (amodal).
        part_alpha_BPR: its coverage.
        rgb_BR3: premultiplied color of the whole object.
        alpha_BR: its coverage.
        distance_BR: to the first surface along the ray; 0 where there is none. None if unknown.
        patch: (height, width) where rays are whole patches in row order, for perceptual losses.
    """

    origin_BR3: Tensor
    direction_BR3: Tensor
    state_BR: Tensor
    part_rgb_BPR3: Tensor
    part_alpha_BPR: Tensor
    rgb_BR3: Tensor
    alpha_BR: Tensor
    distance_BR: Tensor | None = None
    patch: tuple[int, int] | None = None


@dataclass(frozen=True, kw_only=True)
class Batch(TensorBlock):
    """B training items; what the network sees, what it is held to.

    Attributes:
        radius_B: one radius in m.
        rays: None where articulation alone is learnt.
        asset_ids: one a training item.
        categories: one a training item.
    """

    images: Images
    truth: Articulation
    radius_B: Tensor
    rays: Rays | None = None
    asset_ids: tuple[str, ...] = ()
    categories: tuple[str, ...] = ()
