"""The picture of a bundle: three-quarter view, ajar, transparent ground."""

import math
import tempfile
from pathlib import Path

import numpy as np

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import open_state
from artgen.articulation.types import ArticulatedObject
from artgen.core.camera import framed, orbit_direction
from artgen.core.jsonio import plain
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.imaging import display, png_file, read_exr
from artgen.render_job import RenderJob, Shot
from artgen.studio import portrait_rig
from artgen.transport import needed_transport
from artgen.worker import BlenderWorker

SIZE = 256
SAMPLES = 5
"""With the denoiser, 34 to 36 dB at 256 px; 8 would give 36 to 39 dB for 0.7 CPU s more."""
OPEN = 0.6
"""Share of every joint's travel; shows what moves and still the whole front."""
DIRECTION = orbit_direction(math.radians(32.0), math.radians(20.0))
FOV = math.radians(30.0)
FILL = 0.95
TIMEOUT_S = 120.0


def thumbnail_png(obj: ArticulatedObject, *, glb: Path, worker: BlenderWorker) -> bytes:
    """The GLB of `obj` as the content of a PNG file: 256 x 256 px, sRGB with straight alpha.

    Raises:
        WorkerError: Blender failed. RenderError: the image cannot be read back.
    """
    with tempfile.TemporaryDirectory() as scratch:
        job = thumbnail_job(obj, glb=glb, folder=Path(scratch))
        worker.run(plain(job), timeout_s=TIMEOUT_S)
        return png_file(display(read_exr(Path(scratch) / job.shots[0].file)))


def thumbnail_job(obj: ArticulatedObject, *, glb: Path, folder: Path) -> RenderJob:
    """One view of the object ajar."""
    state = open_state(obj.joints, obj.preconditions, OPEN)
    poses = forward_kinematics(obj.base.name, obj.joints, state)
    points: Floats = np.concatenate(
        [apply(poses[part.name], part.mesh.vertices) for part in obj.parts]
    )
    low, high = points.min(axis=0), points.max(axis=0)
    view = framed(points, direction=DIRECTION, fov=FOV, size=(SIZE, SIZE), fill=FILL)
    shot = Shot(
        file="view.exr", camera=0, state=0, part=None, box=(0, 0, SIZE, SIZE), samples=SAMPLES
    )
    rig = portrait_rig(center=(low + high) / 2.0, radius=float(np.linalg.norm(high - low) / 2.0))
    return RenderJob(
        glb=str(glb.resolve()),
        folder=str(folder),
        cameras=(view.stated,),
        states=(poses,),
        rig=rig,
        transport=needed_transport(obj.surfaces, rig),
        shots=(shot,),
        seed=0,
    )
