"""Laws of attention, and that torch's kernel computes what the formula says."""

import math

import pytest
import torch
from torch import Tensor

from model.network.attention import Attention, Mlp

NEAR = 1e-13
"""A few hundred float64 roundings of numbers of size 1."""


def tokens(count: int, seed: int = 0) -> Tensor:
    torch.manual_seed(seed)
    return torch.randn(2, count, 8, dtype=torch.float64)


def attention(*, qk_norm: bool = True) -> Attention:
    torch.manual_seed(9)
    return Attention(8, 2, qk_norm=qk_norm).double()


@pytest.mark.parametrize("qk_norm", [True, False])
def test_it_is_the_formula(qk_norm: bool) -> None:
    """Against loops over heads and tokens."""
    layer, asking, seen = attention(qk_norm=qk_norm).requires_grad_(False), tokens(3), tokens(5, 1)
    key, value = layer.key_value(seen).split(8, dim=-1)
    query, read = layer.query(asking), torch.zeros_like(asking)
    for b in range(2):
        for h in range(2):
            part = slice(4 * h, 4 * h + 4)
            for n in range(3):
                q = layer.norm_query(query[b, n, part])
                scores = [
                    float(q @ layer.norm_key(key[b, m, part])) / math.sqrt(4) for m in range(5)
                ]
                weights = [math.exp(score) for score in scores]
                for m in range(5):
                    read[b, n, part] += weights[m] / sum(weights) * value[b, m, part]
    torch.testing.assert_close(layer(asking, seen), layer.out(read), rtol=0, atol=NEAR)


def test_order_of_what_is_seen_does_not_matter() -> None:
    layer, asking, seen = attention(), tokens(3), tokens(5, 1)
    order = [4, 2, 0, 1, 3]
    torch.testing.assert_close(
        layer(asking, seen[:, order]), layer(asking, seen), rtol=0, atol=NEAR
    )


def test_order_of_who_asks_is_kept() -> None:
    layer, asking, seen = attention(), tokens(3), tokens(5, 1)
    order = [2, 0, 1]
    torch.testing.assert_close(
        layer(asking[:, order], seen), layer(asking, seen)[:, order], rtol=0, atol=NEAR
    )


def test_tokens_that_are_not_valid_are_read_by_nobody() -> None:
    layer, asking, seen = attention(), tokens(3), tokens(5, 1)
    valid = torch.tensor([[True, False, True, True, False], [False, True, True, True, True]])
    read = layer(asking, seen, valid)
    changed = torch.where(valid[..., None], seen, 1e3)
    assert torch.equal(layer(asking, changed, valid), read)
    alone = layer(asking[:1], seen[:1, [0, 2, 3]])
    torch.testing.assert_close(read[:1], alone, rtol=0, atol=NEAR)


def test_slopes_are_right() -> None:
    layer, asking, seen = attention(), tokens(2)[:1], tokens(3, 1)[:1]
    valid = torch.tensor([[True, False, True]])
    assert torch.autograd.gradcheck(
        lambda a, s: layer(a, s, valid), (asking.requires_grad_(), seen.requires_grad_())
    )
    network = Mlp(8, 2.0).double()
    assert torch.autograd.gradcheck(network, (asking,))
