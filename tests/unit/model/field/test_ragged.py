"""Padding and packing undo each other, whatever the owners hold."""

import pytest
import torch

from model.field.ragged import ragged


@pytest.mark.parametrize("owner", [[0], [0, 0, 2], [1, 1, 1, 3], [3, 3, 3]])
def test_packing_undoes_padding(owner: list[int]) -> None:
    values = torch.arange(2.0 * len(owner)).reshape(-1, 2) + 1.0
    rows = ragged(torch.tensor(owner), 4)
    table = rows.padded(values)
    assert table.shape == (4, max(owner.count(k) for k in range(4)), 2)
    assert torch.equal(rows.packed(table), values)
    for k in range(4):
        own = values[torch.tensor(owner) == k]
        assert torch.equal(table[k, : len(own)], own)
        assert not table[k, len(own) :].any()
