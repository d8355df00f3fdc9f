"""The trunk: image tokens and part tokens through cross- and self-attention, X X X S.

B objects, F images of an object (states times views), N tokens of an image, P part slots, K tokens
of a slot, D channels. Every block is residual and normalizes what it reads, not what it adds to.
"""

import torch
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from model.config import Trunk
from model.network.attention import Attention, Mlp, norm

Changed = tuple[Tensor | None, Tensor | None]
"""Image and part tokens after a block; None where a stream stays as it is. A block that handed its
input on would look to FSDP2 as if it made it."""


class Reading(nn.Module):
    """One stream reads another, then thinks: attention and network, both residual."""

    def __init__(self, trunk: Trunk) -> None:
        super().__init__()
        self.norm_asking = norm(trunk.width)
        self.norm_seen = norm(trunk.width)
        self.attention = Attention(trunk.width, trunk.heads, qk_norm=trunk.qk_norm)
        self.norm_mlp = norm(trunk.width)
        self.mlp = Mlp(trunk.width, trunk.mlp_ratio)

    def forward(
        self, asking_BXD: Tensor, seen_BYD: Tensor, seen_valid_BM: Tensor | None = None
    ) -> Tensor:
        """The asking tokens after reading, in their own shape.

        Args:
            asking_BXD, seen_BYD: tokens in one dimension or several.
            seen_valid_BM: over all seen tokens in a row.
        """
        read_BND = self.attention(
            self.norm_asking(asking_BXD).flatten(1, -2),
            self.norm_seen(seen_BYD).flatten(1, -2),
            seen_valid_BM,
        )
        asking_BXD = asking_BXD + read_BND.view_as(asking_BXD)
        thought: Tensor = asking_BXD + self.mlp(self.norm_mlp(asking_BXD))
        return thought


class CrossBlock(nn.Module):
    """ART's cross-attention layer: image tokens read part tokens, or the other way, or both."""

    def __init__(self, trunk: Trunk, *, image_goes_on: bool) -> None:
        super().__init__()
        asks = trunk.direction
        self.part_reads = Reading(trunk) if asks != "image_from_part" else None
        image_reads = asks != "part_from_image" and image_goes_on
        self.image_reads = Reading(trunk) if image_reads else None

    def forward(self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor) -> Changed:
        """Where both read, parts do first."""
        image, part = None, None
        if self.part_reads is not None:
            part = part_BPKD = self.part_reads(part_BPKD, image_BFND)
        if self.image_reads is not None:
            held_BM = _of_tokens(valid_BP, part_BPKD.shape[2])
            image = self.image_reads(image_BFND, part_BPKD, held_BM)
        return image, part


class SelfBlock(nn.Module):
    """ART's self-attention layer over the concatenation of both streams.

    With `within`, tokens see those of their own image or of their own part alone. Where no part
    reads images any more, image tokens are seen but stay as they are.
    """

    def __init__(self, trunk: Trunk, *, within: bool, image_goes_on: bool) -> None:
        super().__init__()
        self.within, self.image_goes_on = within, image_goes_on
        self.norm_part, self.norm_mlp_part = norm(trunk.width), norm(trunk.width)
        self.attention = Attention(trunk.width, trunk.heads, qk_norm=trunk.qk_norm)
        self.mlp_part = Mlp(trunk.width, trunk.mlp_ratio)
        if image_goes_on or not within:
            self.norm_image = norm(trunk.width)
        if image_goes_on:
            self.norm_mlp_image = norm(trunk.width)
            shared = trunk.shared_mlp
            self.mlp_image = self.mlp_part if shared else Mlp(trunk.width, trunk.mlp_ratio)

    def forward(self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor) -> Changed:
        """Parts always; images where a later block reads them."""
        reads = self._within if self.within else self._jointly
        image_read, part_read = reads(image_BFND, part_BPKD, valid_BP)
        part_BPKD = part_BPKD + part_read
        part_BPKD = part_BPKD + self.mlp_part(self.norm_mlp_part(part_BPKD))
        if image_read is None:
            return None, part_BPKD
        image_BFND = image_BFND + image_read
        return image_BFND + self.mlp_image(self.norm_mlp_image(image_BFND)), part_BPKD

    def _jointly(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor | None, Tensor]:
        image = self.norm_image(image_BFND).flatten(1, 2)
        part = self.norm_part(part_BPKD).flatten(1, 2)
        part_valid = _of_tokens(valid_BP, part_BPKD.shape[2])
        valid = torch.cat([part_valid.new_ones(image.shape[:2]), part_valid], dim=1)
        tokens = torch.cat([image, part], dim=1)
        if not self.image_goes_on:
            return None, self.attention(part, tokens, valid).view_as(part_BPKD)
        read, count = self.attention(tokens, tokens, valid), image.shape[1]
        return read[:, :count].view_as(image_BFND), read[:, count:].view_as(part_BPKD)

    def _within(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor | None, Tensor]:
        part = self.norm_part(part_BPKD).flatten(0, 1)
        part_read = self.attention(part, part).view_as(part_BPKD)
        if not self.image_goes_on:
            return None, part_read
        image = self.norm_image(image_BFND).flatten(0, 1)
        return self.attention(image, image).view_as(image_BFND), part_read


class TrunkBlocks(nn.Module):
    """All blocks, in the layout of the settings."""

    def __init__(self, trunk: Trunk) -> None:
        super().__init__()
        self.recompute = trunk.recompute
        readers = "S" if trunk.direction == "image_from_part" else "SX"
        self.blocks = nn.ModuleList()
        for index, letter in enumerate(trunk.layout):
            goes_on = any(later in readers for later in trunk.layout[index + 1 :])
            if letter == "X":
                self.blocks.append(CrossBlock(trunk, image_goes_on=goes_on))
            else:
                within = letter == "W"
                self.blocks.append(SelfBlock(trunk, within=within, image_goes_on=goes_on))

    def forward(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Both streams after the last block; slots that are not valid are read by nobody.

        The image tokens are those that the last reading part saw.
        """
        for block in self.blocks:
            streams = image_BFND, part_BPKD, valid_BP
            if self.recompute and self.training:
                image, part = checkpoint(block, *streams, use_reentrant=False)
            else:
                image, part = block(*streams)
            image_BFND = image_BFND if image is None else image
            part_BPKD = part_BPKD if part is None else part
        return image_BFND, part_BPKD


def _of_tokens(valid_BP: Tensor, count: int) -> Tensor:
    """(B, P * count): whether a token's slot is valid."""
    return valid_BP.repeat_interleave(count, dim=1)
