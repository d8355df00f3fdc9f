"""The trunk: image tokens and part tokens through cross- and self-attention, X X X S.

B objects, F images of an object (states times views), N tokens of an image, P part slots, K tokens
of a slot, D channels. Every block is residual and normalizes what it reads, not what it adds to.
"""

from itertools import cycle, islice

import torch
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from model.attention import Attention, Mlp, norm
from model.config import Trunk


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
        self, asking_BND: Tensor, seen_BMD: Tensor, seen_valid_BM: Tensor | None = None
    ) -> Tensor:
        """The asking tokens after reading."""
        asking_BND = asking_BND + self.attention(
            self.norm_asking(asking_BND), self.norm_seen(seen_BMD), seen_valid_BM
        )
        thought: Tensor = asking_BND + self.mlp(self.norm_mlp(asking_BND))
        return thought


class CrossBlock(nn.Module):
    """ART's cross-attention layer: image tokens read part tokens, or the other way, or both."""

    def __init__(self, trunk: Trunk) -> None:
        super().__init__()
        self.part_reads = Reading(trunk) if trunk.direction != "image_from_part" else None
        self.image_reads = Reading(trunk) if trunk.direction != "part_from_image" else None

    def forward(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Both streams; where both read, parts do first."""
        image, part = image_BFND.flatten(1, 2), part_BPKD.flatten(1, 2)
        if self.part_reads is not None:
            part = self.part_reads(part, image)
        if self.image_reads is not None:
            image = self.image_reads(image, part, _of_tokens(valid_BP, part_BPKD.shape[2]))
        return image.view_as(image_BFND), part.view_as(part_BPKD)


class SelfBlock(nn.Module):
    """ART's self-attention layer over the concatenation of both streams.

    With `within`, tokens see those of their own image or of their own part alone.
    """

    def __init__(self, trunk: Trunk, *, within: bool) -> None:
        super().__init__()
        self.within = within
        self.norm_image, self.norm_part = norm(trunk.width), norm(trunk.width)
        self.attention = Attention(trunk.width, trunk.heads, qk_norm=trunk.qk_norm)
        self.norm_mlp_image, self.norm_mlp_part = norm(trunk.width), norm(trunk.width)
        self.mlp_image = Mlp(trunk.width, trunk.mlp_ratio)
        self.mlp_part = self.mlp_image if trunk.shared_mlp else Mlp(trunk.width, trunk.mlp_ratio)

    def forward(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Both streams."""
        image, part = self.norm_image(image_BFND), self.norm_part(part_BPKD)
        read = self._within(image, part) if self.within else self._jointly(image, part, valid_BP)
        image_BFND, part_BPKD = image_BFND + read[0], part_BPKD + read[1]
        return (
            image_BFND + self.mlp_image(self.norm_mlp_image(image_BFND)),
            part_BPKD + self.mlp_part(self.norm_mlp_part(part_BPKD)),
        )

    def _jointly(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor, Tensor]:
        image, part = image_BFND.flatten(1, 2), part_BPKD.flatten(1, 2)
        part_valid = _of_tokens(valid_BP, part_BPKD.shape[2])
        image_valid = part_valid.new_ones(image.shape[:2])
        tokens = torch.cat([image, part], dim=1)
        read = self.attention(tokens, tokens, torch.cat([image_valid, part_valid], dim=1))
        count = image.shape[1]
        return read[:, :count].view_as(image_BFND), read[:, count:].view_as(part_BPKD)

    def _within(self, image_BFND: Tensor, part_BPKD: Tensor) -> tuple[Tensor, Tensor]:
        image, part = image_BFND.flatten(0, 1), part_BPKD.flatten(0, 1)
        return (
            self.attention(image, image).view_as(image_BFND),
            self.attention(part, part).view_as(part_BPKD),
        )


class TrunkBlocks(nn.Module):
    """All blocks, in the pattern of the settings."""

    def __init__(self, trunk: Trunk) -> None:
        super().__init__()
        self.recompute = trunk.recompute
        self.blocks = nn.ModuleList()
        selves = 0
        for letter in islice(cycle(trunk.pattern), trunk.blocks):
            if letter == "X":
                self.blocks.append(CrossBlock(trunk))
            else:
                within = trunk.scope == "alternate" and selves % 2 == 1
                self.blocks.append(SelfBlock(trunk, within=within))
                selves += 1

    def forward(
        self, image_BFND: Tensor, part_BPKD: Tensor, valid_BP: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Both streams after the last block; slots that are not valid are read by nobody."""
        streams = image_BFND, part_BPKD
        for block in self.blocks:
            if self.recompute and self.training:
                streams = checkpoint(block, *streams, valid_BP, use_reentrant=False)
            else:
                streams = block(*streams, valid_BP)
        return streams


def _of_tokens(valid_BP: Tensor, count: int) -> Tensor:
    """(B, P * count): whether a token's slot is valid."""
    return valid_BP.repeat_interleave(count, dim=1)
