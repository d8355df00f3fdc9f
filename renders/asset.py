"""One asset from bundle to staged sample."""

import shutil
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import psutil

from artgen.core.errors import RenderError
from artgen.core.stream import Stream
from artgen.dataset.packing import stage
from artgen.export import Bundle
from renders.backends import Backend
from renders.collect import collected
from renders.plan import RenderPlan, plan_render
from renders.settings import Settings

PIXEL_BYTES, PART_PIXEL_BYTES = 48, 20
"""Of a composite image with its labels and linear colors, and of each part alone."""
COPIES = 2.5
"""How much more images take while they are made and encoded: 7.3 MB a view and state were measured
at 128 px with 7 parts (2.4 times)."""


@dataclass(frozen=True, kw_only=True)
class Account:
    """What a sample cost.

    Attributes:
        composites, alone: images of all parts, and of parts alone.
        seconds: wall seconds by stage: plan, render, collect.
        cpu: CPU seconds of the backend by its own stages.
        effects: of light transport, as `Transport.described` states them.
    """

    composites: int
    alone: int
    seconds: Mapping[str, float]
    cpu: Mapping[str, float]
    effects: Mapping[str, Mapping[str, object]]


def render_asset(
    bundle: Bundle,
    sample_path: Path,
    *,
    settings: Settings,
    seed: int,
    scratch: Path,
    backend: Backend,
) -> Account:
    """Render, label and stage one asset's sample; what that cost.

    Everything drawn depends on (seed, asset id) alone; the file appears whole or not at all.

    Raises:
        WorkerError: Blender failed. RenderError: an image cannot be right, the object cannot be
            rendered, or its images exceed the memory that is free.
    """
    scratch.mkdir(parents=True, exist_ok=True)
    folder = Path(tempfile.mkdtemp(dir=scratch, prefix=f"{bundle.asset_id}-"))
    try:
        started = time.perf_counter()
        plan = plan_render(
            bundle,
            Stream(seed, "render", bundle.asset_id),
            settings=settings,
            folder=folder,
        )
        check_memory(plan, psutil.virtual_memory().available)
        planned = time.perf_counter()
        pictures = backend.pictures(plan, folder)
        rendered = time.perf_counter()
        sample = collected(plan, pictures.images, shading=backend.shading)
        sample_path.parent.mkdir(parents=True, exist_ok=True)
        stage(sample_path, sample)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    composites = sum(shot.part is None for shot in plan.passes.shots)
    return Account(
        composites=composites,
        alone=len(plan.passes.shots) - composites,
        seconds={
            "plan": planned - started,
            "render": rendered - planned,
            "collect": time.perf_counter() - rendered,
        },
        cpu=pictures.cpu,
        effects=pictures.effects,
    )


def check_memory(plan: RenderPlan, free: int) -> None:
    """Refuse a sample whose images would not fit.

    Args:
        free: bytes.

    Raises:
        RenderError: they would not.
    """
    views, states, parts = len(plan.cameras), len(plan.states), len(plan.meshes)
    width, height = plan.cameras[0].size
    each = width * height * (PIXEL_BYTES + PART_PIXEL_BYTES * parts)
    needed = COPIES * each * views * states
    if needed > free:
        raise RenderError(
            f"{plan.bundle.asset_id}: {views} views x {states} states of {parts} parts at {width} "
            f"px take about {needed / 1e9:.1f} GB of memory, {free / 1e9:.1f} GB are free; ask for "
            "fewer --views, --states or --workers, or a smaller --size"
        )
