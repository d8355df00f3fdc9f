"""A perfect cabinet, and photographs of it, made once for the tests of this folder."""

from pathlib import Path

import pytest

from model.reconstruct.assemble import Assembled, Wishes, assemble
from model.reconstruct.capture import Capture, read_capture
from model.reconstruct.rig import read_rig
from tests.unit.model.reconstruct.perfect import cabinet
from tests.unit.model.reconstruct.studio import photographed


@pytest.fixture(scope="session")
def perfect() -> Assembled:
    """Door and drawer fit."""
    return assemble(cabinet(), Wishes(asset_id="perfect"))


@pytest.fixture(scope="session")
def photographs(perfect: Assembled, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two states by four views of it, and cameras.json; nobody may write there."""
    return photographed(perfect, tmp_path_factory.mktemp("photographs"))


@pytest.fixture(scope="session")
def capture(photographs: Path) -> Capture:
    """What is read of them."""
    return read_capture(photographs, read_rig(photographs / "cameras.json", photographs))
