"""`artgen study backends`: the fast backend beside Cycles, in seconds, decibels and pictures."""

import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.export import Bundle, read_bundle
from artgen.export.layout import MANIFEST
from artgen.imaging import Bytes, Singles, display, png_file
from artgen.run_folder import RunFolder
from artgen.studies.table import write_table
from renders.backends import BACKENDS, CYCLES, Backend
from renders.collect import cast
from renders.contact_sheet import on_paper
from renders.plan import RenderPlan, plan_render
from renders.settings import Settings

SEED = 2026
WARM_PX = 16
"""What a process does once (Blender's start, compiling shaders) falls to images of this size."""


@dataclass(frozen=True, kw_only=True)
class Backends:
    """Render one asset of every category with both backends: CPU seconds, decibels, pictures."""

    out: Annotated[Path, tyro.conf.Positional] = Path("out")
    """Folder of a run of `artgen generate`."""
    sizes: tuple[int, ...] = (128, 256)
    """Widths of the images, px."""
    views: int = 4
    """Cameras per asset."""
    accuracy: str = "standard"
    """Of Cycles."""
    table: Path = Path("docs/studies/backends.csv")
    """Receives a row per asset, size and kind of image."""
    picture: Path = Path("docs/images/fast_backend.png")
    """Receives images of the largest size, Cycles left of fast, an asset a row."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """All composites, or all parts alone, of one asset at one size.

    Attributes:
        parts, images: of the whole sample.
        cycles_cpu_s, fast_cpu_s: all of these images, composites and parts; warm.
        labels_cpu_s: all labels of the sample.
        psnr_db: of sRGB where Cycles' alpha is above one half, over all images of the kind.
        bias, error: mean and mean absolute difference there, fast minus Cycles, in 8-bit codes.
    """

    asset_id: str
    size: int
    kind: str
    parts: int
    images: int
    cycles_cpu_s: float
    fast_cpu_s: float
    labels_cpu_s: float
    ratio: float
    psnr_db: float
    bias: float
    error: float


def backends(argv: Sequence[str]) -> int:
    """Measure the fast backend against Cycles."""
    command = tyro.cli(Backends, args=list(argv), prog="artgen study backends")
    bundles = [read_bundle(path) for path in _first_of_each(RunFolder(command.out).assets)]
    rows: list[Row] = []
    pictures: dict[str, Bytes] = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        pair = [BACKENDS[name](folder / "blender.log", 1) for name in ("cycles", "fast")]
        for size in (WARM_PX, *sorted(command.sizes)):
            for bundle in bundles:
                plan = _planned(command, bundle, folder, size)
                cycles, fast = (measured(backend, plan, folder) for backend in pair)
                pictures[bundle.asset_id] = side_by_side(plan, cycles.images, fast.images)
                started = time.process_time()
                cast(plan)
                labels = time.process_time() - started
                if size != WARM_PX:
                    rows += compared(plan, cycles, fast, labels_cpu_s=labels)
    write_table(command.table, rows)
    write_bytes(command.picture, png_file(np.concatenate(list(pictures.values()))))
    for row in rows:
        where = f"{row.asset_id} {row.size} px {row.kind}"
        print(f"{where}: {row.ratio:.0f} times, {row.psnr_db:.1f} dB")  # noqa: T201
    return 0


@dataclass(frozen=True, kw_only=True, eq=False)
class Measured:
    """Images of a plan, and the CPU seconds of this process and of Blender's that they took."""

    images: Sequence[Singles]
    cpu_s: float


def _planned(command: Backends, bundle: Bundle, folder: Path, size: int) -> RenderPlan:
    """The same plan for both backends."""
    settings = Settings(views=command.views, states=2, size=size, accuracy=command.accuracy)
    stream = Stream(SEED, "study", bundle.asset_id)
    return plan_render(bundle, stream, settings=settings, folder=folder)


def measured(backend: Backend, plan: RenderPlan, folder: Path) -> Measured:
    """Render everything that a sample needs, and read it."""
    started = time.process_time()
    pictures = backend.pictures(plan, folder)
    images = list(pictures.images)
    here = time.process_time() - started
    elsewhere = sum(pictures.cpu.values()) if backend.shading == CYCLES else 0.0
    return Measured(images=images, cpu_s=here + elsewhere)


def compared(
    plan: RenderPlan, cycles: Measured, fast: Measured, *, labels_cpu_s: float
) -> list[Row]:
    """One row for the composites, one for the parts alone."""
    rows = []
    for kind, alone in (("composite", False), ("part", True)):
        chosen = [k for k, shot in enumerate(plan.passes.shots) if (shot.part is not None) == alone]
        pairs = [difference(cycles.images[k], fast.images[k]) for k in chosen]
        gap = np.concatenate(pairs)
        rows.append(
            Row(
                asset_id=plan.bundle.asset_id,
                size=plan.settings.size,
                kind=kind,
                parts=len(plan.meshes),
                images=len(plan.passes.shots),
                cycles_cpu_s=cycles.cpu_s,
                fast_cpu_s=fast.cpu_s,
                labels_cpu_s=labels_cpu_s,
                ratio=cycles.cpu_s / fast.cpu_s,
                psnr_db=float(-10.0 * np.log10(max(np.mean((gap / 255.0) ** 2), 1e-12))),
                bias=float(gap.mean()),
                error=float(np.abs(gap).mean()),
            )
        )
    return rows


def difference(one: Singles, two: Singles) -> Floats:
    """(N, 3) `two` minus `one` in 8-bit sRGB codes, where `one` is more than half covered."""
    seen = one[..., 3] > 0.5
    a, b = (display(image)[..., :3][seen].astype(np.float64) for image in (one, two))
    return np.asarray(b - a)


def side_by_side(plan: RenderPlan, left: Sequence[Singles], right: Sequence[Singles]) -> Bytes:
    """(H, 4 W, 3) on paper: the first view at rest by both backends, then the last state of the
    second view by both."""
    chosen = (plan.passes.composite[0][0], plan.passes.composite[-1][1 % len(plan.cameras)])
    pictures = [on_paper(display(images[k])) for k in chosen for images in (left, right)]
    return np.concatenate(pictures, axis=1)


def _first_of_each(assets: Path) -> list[Path]:
    """One bundle of every category.

    Raises:
        UsageError: there is none.
    """
    first: dict[str, Path] = {}
    for path in sorted(assets.glob(f"*/*/{MANIFEST}")):
        first.setdefault(path.parent.parent.name, path.parent)
    if not first:
        raise UsageError(f"{assets}: holds no bundle; make some with `artgen generate`")
    return list(first.values())
