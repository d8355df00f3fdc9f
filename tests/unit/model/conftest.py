"""Nothing of the model leaves the process in another state: gradients on, small numbers kept."""

from collections.abc import Iterator

import pytest
import torch


@pytest.fixture(autouse=True)
def _process_as_it_was() -> Iterator[None]:
    yield
    assert torch.is_grad_enabled()
    assert float(torch.tensor(1e-40) * 1.0) > 0.0
