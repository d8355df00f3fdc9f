"""`artgen sheet`: what a category looks like, as one picture of many seeds, closed and open."""

import io
import math
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro
from PIL import Image

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import obeying, required_state, travel
from artgen.core.camera import framed, orbit_direction
from artgen.core.errors import UsageError
from artgen.core.jsonio import plain, write_bytes
from artgen.core.mesh import Floats
from artgen.export import Bundle, read_bundle
from artgen.export.layout import GLB
from artgen.imaging import Bytes, display, read_exr
from artgen.pipeline import BYTES_PER_ASSET, AssetTask, Outcome, build_assets, plan
from artgen.progress import progress
from artgen.render_job import RenderJob, Shot
from artgen.rules import parse_override
from artgen.run_folder import RunFolder, opened
from artgen.studio import portrait_rig
from artgen.system_libraries import check_libraries
from artgen.transport import needed_transport
from artgen.worker import BlenderWorker
from renders.contact_sheet import grid, labeled, on_paper
from renders.subject import hull_corners, loaded_meshes, moved_corners

COLUMNS = 4
"""Assets a row; each takes two images."""
OPEN = 0.7
"""Share of its travel by which a joint is shown open."""
SLACK = 0.02
"""Share of its travel by which a joint that others wait for opens further than they need."""
DIRECTION = orbit_direction(math.radians(32.0), math.radians(20.0))
FOV = math.radians(30.0)
FILL = 0.95
GLASS = 4
"""Times the paths: how much of a pixel glass covers is not denoised."""
TIMEOUT_S = 300.0
JPEG_QUALITY = 88


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """Make assets of some categories and show each closed and open in one picture a category.

    The pictures are for looking at, by people who write rules: `artgen sheet toolbox --count 8`.
    """

    categories: Annotated[tuple[str, ...], tyro.conf.Positional]
    """Which categories."""
    count: int = 24
    """Assets of each."""
    seed: int = 2026
    """Root of all randomness."""
    set: tuple[str, ...] = ()
    """Parameters to set, as for `artgen generate`."""
    size: int = 192
    """Width of an image, px."""
    paths: int = 16
    """Light paths a pixel, denoised; four times as many where there is glass."""
    out: Path = Path("sheets")
    """Folder that receives <category>.jpg."""
    work: Path | None = None
    """Run folder that keeps the assets; a second sheet from it makes what is missing."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes that make assets side by side."""


def sheet(argv: Sequence[str]) -> int:
    """A picture of many seeds of a category, closed and open."""
    command = tyro.cli(Sheet, args=list(argv), prog="artgen sheet")
    least = min(command.count, command.paths, command.workers)
    if not command.categories or command.size < 16 or least < 1:
        raise UsageError(
            f"artgen sheet: found {len(command.categories)} categories, --count {command.count}, "
            f"--paths {command.paths}, --workers {command.workers} and --size {command.size}; "
            "expected at least 1 of each and --size 16"
        )
    check_libraries()
    tasks = plan(
        command.categories,
        command.count * len(set(command.categories)),
        command.seed,
        overrides=[parse_override(word) for word in command.set],
    )
    with tempfile.TemporaryDirectory() as scratch:
        home = command.work or Path(scratch) / "run"
        with opened(home, seed=command.seed, need_bytes=len(tasks) * BYTES_PER_ASSET) as run:
            outcomes = build_assets(run, tasks, workers=command.workers)
            failed = {
                outcome.asset_id: outcome for outcome in outcomes if outcome.status == "failed"
            }
            _tell_failed(failed.values())
            places = _places([task for task in tasks if task.asset_id not in failed], run)
            _write_sheets(command, places, Path(scratch) / "blender.log")
    if command.work:
        print(f"assets: {command.work}")  # noqa: T201
    return int(bool(failed))


def _tell_failed(outcomes: Iterable[Outcome]) -> None:
    """A line for each asset that did not pass."""
    for outcome in outcomes:
        print(f"failed {outcome.asset_id}: {outcome.message}")  # noqa: T201


def _places(tasks: Sequence[AssetTask], run: RunFolder) -> Mapping[str, Sequence[Path]]:
    """Category to the folders of its assets."""
    places: dict[str, list[Path]] = {}
    for task in tasks:
        places.setdefault(task.category, []).append(task.place(run.assets))
    return places


def _write_sheets(command: Sheet, places: Mapping[str, Sequence[Path]], log: Path) -> None:
    """A picture of each category of which something passed."""
    if places:
        with BlenderWorker(log, threads=os.cpu_count() or 1) as worker:
            for category, folders in places.items():
                _write_sheet(category, command, folders, worker)
    for category in command.categories:
        if category not in places:
            print(f"no sheet of {category}: none of its {command.count} passed")  # noqa: T201


def _write_sheet(
    category: str, command: Sheet, folders: Sequence[Path], worker: BlenderWorker
) -> None:
    """`<out>/<category>.jpg` of the assets that passed."""
    cells = []
    with progress(category, len(folders)) as advance:
        for folder in folders:
            bundle = read_bundle(folder)
            pictures = pictures_of(bundle, size=command.size, paths=command.paths, worker=worker)
            cells.append(labeled(bundle.asset_id, pictures))
            advance(bundle.asset_id)
    place = command.out / f"{category}.jpg"
    stream = io.BytesIO()
    Image.fromarray(grid(cells, columns=COLUMNS)).save(stream, "JPEG", quality=JPEG_QUALITY)
    write_bytes(place, stream.getvalue())
    print(f"sheet: {place}")  # noqa: T201


def pictures_of(bundle: Bundle, *, size: int, paths: int, worker: BlenderWorker) -> list[Bytes]:
    """(size, size, 3) sRGB on paper: closed, then open, each filling its image."""
    with tempfile.TemporaryDirectory() as folder:
        job = sheet_job(bundle, size=size, paths=paths, folder=Path(folder))
        worker.run(plain(job), timeout_s=TIMEOUT_S)
        return [on_paper(display(read_exr(Path(folder) / shot.file))) for shot in job.shots]


def sheet_job(bundle: Bundle, *, size: int, paths: int, folder: Path) -> RenderJob:
    """Two shots of one bundle from one direction: at rest, and open."""
    names = [part.name for part in bundle.parts]
    corners = [hull_corners(mesh.vertices) for mesh in loaded_meshes(bundle)]
    states: list[Mapping[str, float]] = [{}, shown_open(bundle)]
    poses = [forward_kinematics(names[0], bundle.joints, state) for state in states]
    clouds = [moved_corners(names, corners, [pose]) for pose in poses]
    views = [
        framed(cloud, direction=DIRECTION, fov=FOV, size=(size, size), fill=FILL)
        for cloud in clouds
    ]
    low, high = _box(np.concatenate(clouds))
    rig = portrait_rig(center=(low + high) / 2.0, radius=float(np.linalg.norm(high - low) / 2.0))
    glassy = any(surface.transmission > 0.0 for surface in bundle.surfaces)
    return RenderJob(
        glb=str(bundle.folder.resolve() / GLB),
        folder=str(folder),
        cameras=tuple(view.stated for view in views),
        states=tuple(poses),
        rig=rig,
        transport=needed_transport(bundle.surfaces, rig),
        shots=tuple(
            Shot(file=f"{k}.exr", camera=k, state=k, part=None, box=(0, 0, size, size),
                 samples=GLASS * paths if glassy else paths)
            for k in range(len(views))
        ),
        seed=0,
    )  # fmt: skip


def shown_open(bundle: Bundle) -> dict[str, float]:
    """Every free joint at `OPEN` of its upper limit, further where others wait for it."""
    uppers = {joint.name: travel(joint)[1] for joint in bundle.joints if joint.mimic is None}
    q = {name: OPEN * upper for name, upper in uppers.items()}
    for joint in bundle.joints:
        for name, least in required_state(joint.name, bundle.preconditions).items():
            wanted = least + SLACK * uppers[name]
            q[name] = max(q[name], min(wanted, uppers[name]))
    return obeying(bundle.preconditions, q)


def _box(points: Floats) -> tuple[Floats, Floats]:
    return points.min(axis=0), points.max(axis=0)
