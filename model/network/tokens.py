"""Tokens of images and of part slots: what enters the trunk.

B objects, T states, V views, F = T * V images, N patches of an image, P part slots, K tokens of a
slot, D channels, S pixels of an image's side, digits a length.
"""

import dataclasses
import math

import torch
from torch import Tensor, nn
from torch.nn import functional

from artgen.core.errors import ModelError
from model.batch import Images
from model.config import ImageTokens, ModelConfig
from model.field.rays import pixel_rays, plucker, waves
from model.network.encoders import Encoder, make_encoder
from model.precision import full, full_precision

PLANES = 6
"""Planes of a hexa-plane: xy+ xy- yz+ yz- xz+ xz-."""


SIZES = (0.6, 0.5, 1.0, 0.6)
"""Usual root mean squares of colors in [-1, 1], of rays (unit directions, moments within the
sphere), of state vectors and of features."""


class ImageTokenizer(nn.Module):
    """Patches, rays, state and semantics of an image, concatenated and projected once.

    Views are told apart by their rays alone, states by a learned vector.
    """

    def __init__(self, config: ImageTokens, width: int) -> None:
        super().__init__()
        self.config = config
        self.encoder: Encoder | None = make_encoder(config.encoder, frozen=config.frozen)
        self.state = nn.Embedding(config.states, config.state_dim)
        pixels = config.patch_px**2
        self.widths = [pixels * (4 if config.alpha else 3)]
        numbers = 6 * (1 + 2 * config.ray_octaves)
        self.widths += [numbers * (pixels if config.rays == "pixel" else 1), config.state_dim]
        self.widths += [] if self.encoder is None else [self.encoder.dim]
        self.project = nn.Linear(sum(self.widths), width)

    def balance(self) -> None:
        """Draw the projection so that patch, ray, state and semantics begin with equal shares.

        Drawn alike, the 6 numbers of a ray would be drowned by the 192 of a patch's colors, and the
        network would learn late where it looks.
        """
        columns = torch.split(self.project.weight, self.widths, dim=1)
        for block, size in zip(columns, SIZES, strict=False):
            share = 1.0 / (size * math.sqrt(block.shape[1] * len(columns)))
            nn.init.trunc_normal_(block, std=share)
        nn.init.zeros_(self.project.bias)

    def forward(self, images: Images) -> Tensor:
        """(B, F, N, D), states slowest, patches row by row.

        Raises:
            ModelError: the images have another size, or more states, than the network was made for.
        """
        checked_images(images, self.config)
        images = withheld(images) if self.config.blind else images
        parts = [self._patches(images), self._rays(images), self._states(images)]
        if self.encoder is not None:
            parts.append(self._semantics(images, self.encoder))
        tokens: Tensor = self.project(torch.cat(parts, dim=-1))
        return tokens

    def _patches(self, images: Images) -> Tensor:
        pixels = 2.0 * images.rgb_BTV3HW - 1.0
        if self.config.alpha:
            pixels = torch.cat([pixels, 2.0 * images.alpha_BTVHW.unsqueeze(3) - 1.0], dim=3)
        return patches(pixels.flatten(1, 2), self.config.patch_px)

    def _rays(self, images: Images) -> Tensor:
        """Directions and moments with all digits, whatever the precision around: rounded to
        bfloat16, neighboring patches would share their ray."""
        config = self.config
        step = config.patch_px if config.rays == "patch" else 1
        with full_precision(images.rgb_BTV3HW):
            side = config.image_px // step
            middles = (torch.arange(side, device=images.rgb_BTV3HW.device) + 0.5) * step
            y, x = torch.meshgrid(middles, middles, indexing="ij")
            origin, direction = pixel_rays(
                images.intrinsics_BTV33.flatten(1, 2),
                images.camera_from_world_BTV44.flatten(1, 2),
                torch.stack([x, y], dim=-1).reshape(-1, 2),
            )
            coded_BFND = waves(plucker(origin, direction), config.ray_octaves)
            coded_BFDSS = torch.unflatten(coded_BFND, 2, (side, side)).movedim(-1, 2)
        return patches(coded_BFDSS, config.patch_px // step)

    def _states(self, images: Images) -> Tensor:
        objects, states, views = images.rgb_BTV3HW.shape[:3]
        count = (self.config.image_px // self.config.patch_px) ** 2
        vectors = self.state.weight[:states, None].expand(states, views, -1).flatten(0, 1)
        return vectors[None, :, None].expand(objects, -1, count, -1)

    def _semantics(self, images: Images, encoder: Encoder) -> Tensor:
        frames = images.rgb_BTV3HW.flatten(0, 2)
        side = self.config.image_px // self.config.patch_px
        with torch.set_grad_enabled(torch.is_grad_enabled() and encoder.learned):
            features = encoder(frames)
        on_grid = functional.interpolate(
            full(features),
            size=(side, side),
            mode="bilinear",
            align_corners=False,
            antialias=True,
        )
        tokens_FND = on_grid.flatten(2).transpose(1, 2)
        return torch.unflatten(tokens_FND, 0, (images.rgb_BTV3HW.shape[0], -1))


def patches(pixels_BFCSS: Tensor, patch_px: int) -> Tensor:
    """(B, F, N, C * patch_px^2): square patches, row by row; channels slowest within a patch."""
    side = pixels_BFCSS.shape[-1] // patch_px
    columns = torch.unflatten(pixels_BFCSS, -1, (side, patch_px))
    tiles = torch.unflatten(columns, -3, (side, patch_px))
    return tiles.permute(0, 1, 3, 5, 2, 4, 6).flatten(4).flatten(2, 3)


def checked_images(images: Images, config: ImageTokens) -> None:
    """Refuse images that the network was not made for.

    Raises:
        ModelError: another size or more states.
    """
    states, (height, width) = images.rgb_BTV3HW.shape[1], images.rgb_BTV3HW.shape[-2:]
    if (height, width) != (config.image_px, config.image_px):
        raise ModelError(
            f"images of {width} x {height} px; this network reads {config.image_px} x "
            f"{config.image_px} px; crop and resize them to that"
        )
    if states > config.states:
        raise ModelError(
            f"images of {states} states; this network was made for {config.states} at most; give "
            "fewer or train one with a larger `images.states`"
        )


def withheld(images: Images) -> Images:
    """The cameras of the images, without what they show: gray, no mask."""
    return dataclasses.replace(
        images,
        rgb_BTV3HW=torch.full_like(images.rgb_BTV3HW, 0.5),
        alpha_BTVHW=torch.zeros_like(images.alpha_BTVHW),
    )


class SlotTokens(nn.Module):
    """Learned tokens of the part slots; slot 0 is the base, the others in canonical order.

    A slot's tokens are: one for its articulation (unless that is the mean of the plane tokens), one
    for each state where the settings ask for them, and one for each place of its six planes.
    """

    def __init__(self, config: ModelConfig) -> None:
        super().__init__()
        grids = config.planes is not None and config.planes.tokens == "planes"
        self.places = PLANES * config.planes.grid**2 if config.planes and grids else 0
        self.own = 0 if config.slot_vector == "mean" and self.places else 1
        count, width = self.own + self.places, config.trunk.width
        sets = config.slots if config.slot_embedding == "separate" else 1
        self.token_PKD = nn.Parameter(torch.zeros(sets, count, width))
        self.number_PD = nn.Parameter(torch.zeros(config.slots, width))
        by_state = config.motion == "state_tokens"
        self.state = nn.Linear(config.images.state_dim, width, bias=False) if by_state else None

    def forward(self, objects: int, slots: int, state_TE: Tensor) -> Tensor:
        """(B, P, K, D) for the first P slots; `state_TE` holds the states' learned vectors."""
        tokens = self.token_PKD[:slots] + self.number_PD[:slots, None]
        if self.state is not None:
            by_state = self.number_PD[:slots, None] + self.state(state_TE)
            tokens = torch.cat([tokens[:, : self.own], by_state, tokens[:, self.own :]], dim=1)
        return tokens.expand(objects, -1, -1, -1)

    def split(self, tokens_BPKD: Tensor) -> tuple[Tensor, Tensor | None, Tensor | None]:
        """The vector of each slot (B, P, D), its state tokens (B, P, T, D), its plane tokens."""
        end = tokens_BPKD.shape[2] - self.places
        by_state = tokens_BPKD[:, :, self.own : end] if self.state is not None else None
        planes = tokens_BPKD[:, :, end:] if self.places else None
        if self.own:
            return tokens_BPKD[:, :, 0], by_state, planes
        return tokens_BPKD[:, :, end:].mean(dim=2), by_state, planes
