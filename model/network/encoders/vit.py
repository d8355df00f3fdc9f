"""DINOv2's vision transformer (Oquab et al. 2023), from a folder with its weights.

Two layouts of names are read: that of torch.hub's `.pth` files and that of transformers'
`model.safetensors`. Sizes S, B and L, with or without register tokens. F images, N patches,
D channels.
"""

import re
from collections.abc import Mapping
from pathlib import Path

import torch
from safetensors.torch import load_file
from torch import Tensor, nn
from torch.nn import functional

from artgen.core.errors import ModelError

MEAN, DEVIATION = (0.485, 0.456, 0.406), (0.229, 0.224, 0.225)
HEAD = 64
"""Channels of an attention head, in every size."""
NORM_EPSILON = 1e-6

RENAMES = (
    (r"^embeddings\.position_embeddings$", "pos_embed"),
    (r"^embeddings\.patch_embeddings\.projection\.", "patch_embed.proj."),
    (r"^embeddings\.(cls_token|mask_token|register_tokens)$", r"\1"),
    (r"^encoder\.layer\.", "blocks."),
    (r"\.attention\.output\.dense\.", ".attn.proj."),
    (r"\.layer_scale([12])\.lambda1$", r".ls\1.gamma"),
    (r"^layernorm\.", "norm."),
)
"""From transformers' names to torch.hub's."""


class Scale(nn.Module):
    """A learned factor for each channel."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.gamma = nn.Parameter(torch.ones(width))

    def forward(self, tokens_FND: Tensor) -> Tensor:
        """Scaled tokens."""
        return tokens_FND * self.gamma


class SelfAttention(nn.Module):
    """Attention with biases, as this transformer was trained."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.qkv = nn.Linear(width, 3 * width)
        self.proj = nn.Linear(width, width)

    def forward(self, tokens_FND: Tensor) -> Tensor:
        """(F, N, D) of what was read."""
        by_head = torch.unflatten(self.qkv(tokens_FND), -1, (3, -1, HEAD)).permute(2, 0, 3, 1, 4)
        read = functional.scaled_dot_product_attention(by_head[0], by_head[1], by_head[2])
        projected: Tensor = self.proj(read.transpose(1, 2).flatten(2))
        return projected


class VitBlock(nn.Module):
    """Attention and network, both scaled and residual."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.norm1, self.norm2 = (nn.LayerNorm(width, eps=NORM_EPSILON) for _ in range(2))
        self.attn = SelfAttention(width)
        self.ls1, self.ls2 = Scale(width), Scale(width)
        self.mlp = nn.ModuleDict(
            {"fc1": nn.Linear(width, 4 * width), "fc2": nn.Linear(4 * width, width)}
        )

    def forward(self, tokens_FND: Tensor) -> Tensor:
        """The tokens after the block."""
        tokens_FND = tokens_FND + self.ls1(self.attn(self.norm1(tokens_FND)))
        hidden = functional.gelu(self.mlp["fc1"](self.norm2(tokens_FND)))
        thought: Tensor = tokens_FND + self.ls2(self.mlp["fc2"](hidden))
        return thought


class VisionTransformer(nn.Module):
    """Normalized patch tokens of the last block, as a map."""

    def __init__(self, *, width: int, depth: int, patch: int, places: int, registers: int) -> None:
        super().__init__()
        self.patch = patch
        self.cls_token = nn.Parameter(torch.zeros(1, 1, width))
        self.pos_embed = nn.Parameter(torch.zeros(1, 1 + places, width))
        self.register_tokens = nn.Parameter(torch.zeros(1, registers, width))
        self.patch_embed = nn.ModuleDict({"proj": nn.Conv2d(3, width, patch, stride=patch)})
        self.blocks = nn.ModuleList(VitBlock(width) for _ in range(depth))
        self.norm = nn.LayerNorm(width, eps=NORM_EPSILON)

    def forward(self, frames_F3SS: Tensor) -> Tensor:
        """(F, D, rows, columns): images are resized to the nearest whole number of patches."""
        side = max(round(frames_F3SS.shape[-1] / self.patch), 1)
        size = (side * self.patch, side * self.patch)
        if frames_F3SS.shape[-2:] != size:
            frames_F3SS = functional.interpolate(frames_F3SS, size, mode="bicubic", antialias=True)
        places = self.patch_embed["proj"](frames_F3SS).flatten(2).transpose(1, 2)
        places = places + self._positions(side)
        first = (self.cls_token + self.pos_embed[:, :1]).expand(len(places), -1, -1)
        registers = self.register_tokens.expand(len(places), -1, -1)
        tokens = torch.cat([first, registers, places], dim=1)
        for block in self.blocks:
            tokens = block(tokens)
        tokens = self.norm(tokens)[:, 1 + registers.shape[1] :]
        return torch.unflatten(tokens.transpose(1, 2), 2, (side, side))

    def _positions(self, side: int) -> Tensor:
        """(1, side^2, D) learned positions, resampled to another grid."""
        learned = self.pos_embed[:, 1:]
        grid = round(learned.shape[1] ** 0.5)
        if grid == side:
            return learned
        square = torch.unflatten(learned.transpose(1, 2), 2, (grid, grid))
        resized = functional.interpolate(square, (side, side), mode="bicubic")
        return resized.flatten(2).transpose(1, 2)


def weights_file(folder: Path) -> Path:
    """The one file with weights in a folder.

    Raises:
        ModelError: there is none, or there are several.
    """
    found = sorted([*folder.glob("*.safetensors"), *folder.glob("*.pth")])
    if len(found) != 1:
        raise ModelError(
            f"{folder}: {len(found)} files of weights, expected one model.safetensors "
            "(transformers) or one dinov2_*.pth (torch.hub); see docs/art_model.md"
        )
    return found[0]


def loaded(path: Path) -> VisionTransformer:
    """The transformer with the weights of a file; its size follows from theirs.

    Raises:
        ModelError: the file holds no DINOv2 of size S, B or L.
    """
    try:
        suffix = path.suffix == ".safetensors"
        raw = load_file(path) if suffix else torch.load(path, map_location="cpu", weights_only=True)
        weights = hub_names(raw)
        width, _, patch, _ = weights["patch_embed.proj.weight"].shape
        weights.setdefault("register_tokens", torch.zeros(1, 0, width))
        network = VisionTransformer(
            width=width,
            depth=len({name.split(".")[1] for name in weights if name.startswith("blocks.")}),
            patch=patch,
            places=weights["pos_embed"].shape[1] - 1,
            registers=weights["register_tokens"].shape[1],
        )
        network.load_state_dict(weights)
    except (RuntimeError, KeyError, EOFError, OSError, ValueError) as error:
        raise ModelError(
            f"{path}: {error}; expected the weights of a DINOv2 of size S, B or L"
        ) from error
    return network


def hub_names(weights: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Weights under torch.hub's names, whichever they came under; the mask token is left out."""
    named: dict[str, Tensor] = {}
    for name, tensor in weights.items():
        for pattern, replacement in RENAMES:
            name = re.sub(pattern, replacement, name)
        named[name] = tensor
    named.pop("mask_token", None)
    for name in [name for name in named if ".attention.attention.query." in name]:
        triple = [
            named.pop(name.replace(".query.", f".{word}.")) for word in ("query", "key", "value")
        ]
        named[name.replace(".attention.attention.query.", ".attn.qkv.")] = torch.cat(triple)
    return named
