"""One Blender process for all tests of a session, one thread a process, and how hypothesis draws.

Tests run side by side, one process a core; small tensors over more threads than cores cost ten
times the time. `HYPOTHESIS_PROFILE=explore` draws anew at every run and ten times as much; CI draws
the same.
"""

import os
from collections.abc import Iterator

os.environ.setdefault("OMP_NUM_THREADS", "1")  # Read once, when numpy and torch are imported.

import pytest
from hypothesis import settings

import artgen  # noqa: F401  # Chooses numpy's kernel, too.
from artgen.worker import BlenderWorker

settings.register_profile("ci", derandomize=True, deadline=None)
settings.register_profile("explore", max_examples=1000, deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "ci"))


@pytest.fixture(scope="session")
def blender(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BlenderWorker]:
    with BlenderWorker(tmp_path_factory.mktemp("blender") / "blender.log") as worker:
        yield worker
