"""Whole images of an articulated field, without gradient, as many rays at a time as memory holds.

Letters: B objects, T states, V views, P parts, R rays, H W pixels, digits a length.
"""

from dataclasses import dataclass

import torch
from torch import Tensor

from model.batch import Articulation, TensorBlock
from model.field.plane_field import Field
from model.field.rays import pixel_middles, pixel_rays
from model.field.volume import RayColors, render_along

RAYS = 1 << 14
"""Rays of all objects together that are rendered at once."""


@dataclass(frozen=True, kw_only=True)
class Pictures(TensorBlock):
    """What cameras see; colors premultiplied by alpha.

    Attributes:
        rgb_BTV3HW, alpha_BTVHW: of all parts together.
        distance_BTVHW: along the ray, radii; 0 where nothing is.
        part_rgb_BPTV3HW, part_alpha_BPTVHW: of each part alone.
    """

    rgb_BTV3HW: Tensor
    alpha_BTVHW: Tensor
    distance_BTVHW: Tensor
    part_rgb_BPTV3HW: Tensor
    part_alpha_BPTVHW: Tensor

    def over(self, background: float) -> Tensor:
        """(B, T, V, 3, H, W) the whole object over a gray."""
        return self.rgb_BTV3HW + background * (1.0 - self.alpha_BTVHW)[:, :, :, None]


@torch.no_grad()
def pictures(
    field: Field,
    articulation: Articulation,
    intrinsics_BTV33: Tensor,
    camera_from_world_BTV44: Tensor,
    *,
    height: int,
    width: int,
    inverse_beta: Tensor | float,
    samples: int,
    coarse: int = 0,
) -> Pictures:
    """Images of every state by every camera; options as those of `render_along`."""
    batch, states, views = intrinsics_BTV33.shape[:3]
    pixels = pixel_middles(height, width, intrinsics_BTV33.device)
    rays = pixel_rays(intrinsics_BTV33, camera_from_world_BTV44, pixels)
    origin_BR3, direction_BR3 = (value.reshape(batch, -1, 3) for value in rays)
    state_T = torch.arange(states, device=pixels.device)
    state_R = state_T.repeat_interleave(views * height * width)
    most = max(RAYS // batch, 1)
    pieces = [
        render_along(
            *(field, articulation, origin, direction, state.expand(batch, -1)),
            inverse_beta=inverse_beta,
            samples=samples,
            coarse=coarse,
        )
        for origin, direction, state in zip(
            torch.split(origin_BR3, most, dim=1),
            torch.split(direction_BR3, most, dim=1),
            torch.split(state_R, most),
            strict=True,
        )
    ]
    return _laid_out(pieces, (states, views, height, width))


def _laid_out(pieces: list[RayColors], shape: tuple[int, int, int, int]) -> Pictures:
    def image(name: str) -> Tensor:
        rays = name.rsplit("_", 1)[1].index("R")
        return torch.cat([getattr(piece, name) for piece in pieces], dim=rays)

    rgb, part_rgb = image("rgb_BR3"), image("part_rgb_BPR3")
    batch, parts = part_rgb.shape[:2]
    return Pictures(
        rgb_BTV3HW=rgb.reshape(batch, *shape, 3).movedim(-1, 3),
        alpha_BTVHW=image("alpha_BR").reshape(batch, *shape),
        distance_BTVHW=image("distance_BR").reshape(batch, *shape),
        part_rgb_BPTV3HW=part_rgb.reshape(batch, parts, *shape, 3).movedim(-1, 4),
        part_alpha_BPTVHW=image("part_alpha_BPR").reshape(batch, parts, *shape),
    )
