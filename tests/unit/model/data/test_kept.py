"""Kept scenes are read, and cast, by whoever draws."""

import dataclasses
import os
from pathlib import Path
from typing import Any

import pytest

from model.batch import Batch
from model.data import loader
from model.data.kept import Kept
from model.data.loader import batches
from model.data.soup_source import SoupSource
from tests.unit.model.data.small import CONFIG, assert_equal, library


class Elsewhere(SoupSource):
    """Casts nothing in the process that trains."""

    trainer = os.getpid()

    def batch(self, *args: Any) -> Batch:
        assert os.getpid() != self.trainer
        return super().batch(*args)


def test_beside_a_gpu_workers_cast_and_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The process that trains would cast one by one while the GPU waits."""
    expected = next(batches(Kept(SoupSource(library(), slots=6), 1, tmp_path / "here"), CONFIG))
    monkeypatch.setattr(loader, "_shown_by_workers", lambda device: False)
    kept = Kept(Elsewhere(library(), slots=6), 1, tmp_path / "there")
    config = dataclasses.replace(CONFIG, workers=1)
    assert_equal(next(batches(kept, config)), expected)
