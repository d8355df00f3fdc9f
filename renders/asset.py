"""One asset from bundle to staged sample."""

import shutil
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

from artgen.core.jsonio import plain
from artgen.core.stream import Stream
from artgen.dataset.packing import stage
from artgen.export import Bundle
from artgen.worker import BlenderWorker
from renders.collect import collected
from renders.plan import plan_render
from renders.settings import Settings

TIMEOUT_S = 900.0
"""A sample takes 10 to 30 CPU s at 128 px; large images on a busy machine take more."""


def render_asset(
    bundle: Bundle,
    sample_path: Path,
    *,
    settings: Settings,
    seed: int,
    scratch: Path,
    worker: BlenderWorker,
) -> Mapping[str, float]:
    """Render, label and stage one asset's sample; seconds by stage.

    Everything drawn depends on (seed, asset id) alone; the file appears whole or not at all.

    Raises:
        WorkerError: Blender failed. RenderError: an image cannot be right.
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
        planned = time.perf_counter()
        worker.run(plain(plan.job), timeout_s=TIMEOUT_S)
        rendered = time.perf_counter()
        sample = collected(plan, folder)
        sample_path.parent.mkdir(parents=True, exist_ok=True)
        stage(sample_path, sample)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return {
        "plan": planned - started,
        "render": rendered - planned,
        "collect": time.perf_counter() - rendered,
    }
