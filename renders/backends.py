"""Who makes the pictures of a plan: Cycles in a Blender process, or the fast rasterizer here."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Protocol, overload

from artgen.core.errors import RenderError
from artgen.core.jsonio import plain
from artgen.imaging import Singles, read_exr
from artgen.render_job import Shot
from artgen.system_libraries import check_libraries
from artgen.worker import BlenderWorker
from renders.fast.backend import FastBackend
from renders.fast.context import check_rasterizer
from renders.pictures import Pictures
from renders.plan import RenderPlan

CYCLES = "cycles"
TIMEOUT_S = 900.0
TIMEOUT_PER_IMAGE_S = 2.0
TIMEOUT_PER_PATH_S = 3e-5
"""A path takes 1e-6 CPU s and an image 0.03 s; a machine that is thirty times slower, or that many
times shared, is still waited for."""


class Backend(Protocol):
    """Makes the images of a plan.

    Attributes:
        shading: names the shading model; every sample records it.
    """

    shading: str

    def pictures(self, plan: RenderPlan, folder: Path) -> Pictures:
        """All images of the plan; may use files in `folder`."""


class CyclesBackend:
    """Path tracing by a Blender process."""

    shading = CYCLES

    def __init__(self, worker: BlenderWorker) -> None:
        self._worker = worker

    def pictures(self, plan: RenderPlan, folder: Path) -> Pictures:
        """Blender writes the files; each is read when it is asked for.

        Raises:
            WorkerError: Blender failed.
        """
        report = self._worker.run(plain(plan.job), timeout_s=patience(plan.job.shots))
        return Pictures(
            images=ExrImages(plan, folder),
            cpu=report["cpu"],
            effects=plan.job.transport.described(),
        )


def patience(shots: Sequence[Shot]) -> float:
    """Seconds after which a job that is not done hangs."""
    paths = 0
    for shot in shots:
        left, top, right, bottom = shot.box
        paths += (right - left) * (bottom - top) * shot.samples
    return TIMEOUT_S + TIMEOUT_PER_IMAGE_S * len(shots) + TIMEOUT_PER_PATH_S * paths


class ExrImages(Sequence[Singles]):
    """The images of a plan's shots in a folder, read one at a time: all of them may be large."""

    def __init__(self, plan: RenderPlan, folder: Path) -> None:
        self._shots = plan.passes.shots
        self._folder = folder

    def __len__(self) -> int:
        return len(self._shots)

    @overload
    def __getitem__(self, index: int) -> Singles: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Singles]: ...

    def __getitem__(self, index: int | slice) -> Singles | Sequence[Singles]:
        """One image or several.

        Raises:
            RenderError: a file is missing, of another size, or not finite.
        """
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        shot = self._shots[index]
        path = self._folder / shot.file
        image = read_exr(path)
        left, top, right, bottom = shot.box
        if image.shape[:2] != (bottom - top, right - left):
            raise RenderError(
                f"{path} is {image.shape[1]} x {image.shape[0]} px, its window "
                f"{right - left} x {bottom - top}; Blender rounded the window's border"
            )
        return image


def cycles_backend(log: Path, threads: int) -> Backend:
    """Cycles in a process that is started when first needed."""
    return CyclesBackend(BlenderWorker(log, threads=threads))


def fast_backend(_: Path, threads: int) -> Backend:
    """The rasterizer, which logs nothing."""
    return FastBackend(threads=threads)


MakeBackend = Callable[[Path, int], Backend]
"""From a log file and a number of threads to a backend of this process; a function of a module, so
that other processes can be told of it."""

BACKENDS: Mapping[str, MakeBackend] = {CYCLES: cycles_backend, "fast": fast_backend}
"""By `Settings.backend`."""

CHECKS: Mapping[str, Callable[[], None]] = {CYCLES: check_libraries, "fast": check_rasterizer}
"""By `Settings.backend`: raises UsageError where this machine lacks what the backend needs."""
