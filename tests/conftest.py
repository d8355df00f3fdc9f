"""One Blender process for all tests of a session."""

from collections.abc import Iterator

import pytest

from artgen.worker import BlenderWorker


@pytest.fixture(scope="session")
def blender(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BlenderWorker]:
    with BlenderWorker(tmp_path_factory.mktemp("blender") / "blender.log") as worker:
        yield worker
