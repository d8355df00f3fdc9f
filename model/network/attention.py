"""Multi-head attention with normalized queries and keys, and a block's small network.

B batch, N asking tokens, M seen tokens, D channels, H heads, E channels of a head.
"""

import torch
from torch import Tensor, nn
from torch.nn import functional


def norm(width: int) -> nn.LayerNorm:
    """Normalization over the channels, with a scale and without a shift."""
    return nn.LayerNorm(width, bias=False)


class Attention(nn.Module):
    """Tokens read other tokens; without biases."""

    def __init__(self, width: int, heads: int, *, qk_norm: bool) -> None:
        super().__init__()
        self.heads = heads
        self.query = nn.Linear(width, width, bias=False)
        self.key_value = nn.Linear(width, 2 * width, bias=False)
        self.out = nn.Linear(width, width, bias=False)
        self.norm_query = norm(width // heads) if qk_norm else nn.Identity()
        self.norm_key = norm(width // heads) if qk_norm else nn.Identity()

    def forward(
        self, asking_BND: Tensor, seen_BMD: Tensor, seen_valid_BM: Tensor | None = None
    ) -> Tensor:
        """(B, N, D) of what was read; seen tokens that are not valid are read by nobody.

        Every row of `seen_valid_BM` must hold a valid token.
        """
        query_BHNE = self._by_head(self.query(asking_BND))
        key_BMD, value_BMD = self.key_value(seen_BMD).chunk(2, dim=-1)
        key_BHME = self.norm_key(self._by_head(key_BMD))
        value_BHME = self._by_head(value_BMD)
        read_BHNE = functional.scaled_dot_product_attention(
            self.norm_query(query_BHNE).to(value_BHME.dtype),
            key_BHME.to(value_BHME.dtype),
            value_BHME,
            attn_mask=None if seen_valid_BM is None else seen_valid_BM[:, None, None],
        )
        read: Tensor = self.out(read_BHNE.transpose(1, 2).flatten(2))
        return read

    def _by_head(self, tokens_BND: Tensor) -> Tensor:
        return torch.unflatten(tokens_BND, -1, (self.heads, -1)).transpose(1, 2)


class Mlp(nn.Module):
    """Two layers over each token."""

    def __init__(self, width: int, ratio: float) -> None:
        super().__init__()
        self.rise = nn.Linear(width, round(width * ratio))
        self.out = nn.Linear(round(width * ratio), width)

    def forward(self, tokens_BND: Tensor) -> Tensor:
        """(B, N, D) in, (B, N, D) out."""
        changed: Tensor = self.out(functional.gelu(self.rise(tokens_BND)))
        return changed
