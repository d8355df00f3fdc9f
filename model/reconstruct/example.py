"""Images and cameras of a bundle, as someone with a turntable would take them: examples and tests.

    python -m model.reconstruct.example out/assets/cabinet/000001 examples/cabinet

Blender renders the object in some states from some sides, with transparent ground; `cameras.json`
says from where. The views are evenly spread around the front, the joints ever wider open.
"""

import math
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.states import open_state
from artgen.articulation.types import State
from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.errors import UsageError
from artgen.core.jsonio import fill_folder_atomically, plain, write_bytes, write_json
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from artgen.export import Bundle, read_bundle
from artgen.export.layout import GLB
from artgen.imaging import display, png_file, read_exr
from artgen.render_job import RenderJob, Shot
from artgen.studio import portrait_rig
from artgen.transport import needed_transport
from artgen.worker import BlenderWorker
from model.reconstruct.cameras import SCHEMA

FOV = math.radians(36.0)
FILL = 0.92
SAMPLES = 12
TIMEOUT_S = 600.0


@dataclass(frozen=True, kw_only=True)
class Example:
    """Render a bundle as input images with cameras, for artgen reconstruct."""

    bundle: Annotated[Path, tyro.conf.Positional]
    """Folder of the bundle."""
    out: Annotated[Path, tyro.conf.Positional]
    """New folder for images and cameras.json."""
    size: int = 256
    """Width and height of the images, px."""
    azimuths: tuple[float, ...] = (-55.0, -5.0, 40.0, 150.0)
    """Degrees from the front towards the right; one view each."""
    elevation: float = 22.0
    """Degrees above the horizon."""
    shares: tuple[float, ...] = (0.2, 0.75)
    """Share of every joint's way, one state each."""


def write_example(command: Example) -> None:
    """Fill a new folder with `state_T/view_V.png` and `cameras.json`.

    Raises:
        UsageError: the folder exists. ExportError: there is no bundle. WorkerError: Blender failed.
    """
    if command.out.exists():
        raise UsageError(f"{command.out}: exists, and nothing is overwritten; choose another")
    bundle = read_bundle(command.bundle)
    states = [open_state(bundle.joints, bundle.preconditions, share) for share in command.shares]
    cameras = example_cameras(bundle, states, command)

    def fill(folder: Path) -> None:
        pictures = rendered(bundle, states, cameras, command.size)
        views = []
        for (t, v), picture in pictures.items():
            name = f"state_{t}/view_{v}.png"
            write_bytes(folder / name, picture)
            views.append(
                {
                    "image": name,
                    "state": t,
                    "intrinsics": cameras[v].intrinsics,
                    "camera_from_world": cameras[v].camera_from_world,
                }
            )
        rig = {"schema": SCHEMA, "center": bundle.center, "radius": bundle.radius, "views": views}
        write_json(folder / "cameras.json", rig)

    fill_folder_atomically(command.out, fill)


def example_cameras(bundle: Bundle, states: Sequence[State], command: Example) -> list[Camera]:
    """One camera a side that shows the object in all states."""
    meshes = {part.name: bundle.load_mesh(part.name).vertices for part in bundle.parts}
    clouds: list[Floats] = []
    for state in states:
        poses = forward_kinematics(bundle.parts[0].name, bundle.joints, state)
        clouds += [apply(poses[name], vertices) for name, vertices in meshes.items()]
    points = np.concatenate(clouds)
    return [
        framed(
            points,
            direction=orbit_direction(math.radians(azimuth), math.radians(command.elevation)),
            fov=FOV,
            size=(command.size, command.size),
            fill=FILL,
        )
        for azimuth in command.azimuths
    ]


def rendered(
    bundle: Bundle, states: Sequence[State], cameras: Sequence[Camera], size: int
) -> dict[tuple[int, int], bytes]:
    """PNG of every state and view."""
    poses = tuple(
        forward_kinematics(bundle.parts[0].name, bundle.joints, state) for state in states
    )
    rig = portrait_rig(center=bundle.center, radius=bundle.radius)
    places = [(t, v) for t in range(len(states)) for v in range(len(cameras))]
    with tempfile.TemporaryDirectory() as scratch:
        job = RenderJob(
            glb=str((bundle.folder / GLB).resolve()),
            folder=scratch,
            cameras=tuple(camera.stated for camera in cameras),
            states=poses,
            rig=rig,
            transport=needed_transport(bundle.surfaces, rig),
            shots=tuple(
                Shot(
                    file=f"{t}_{v}.exr",
                    camera=v,
                    state=t,
                    part=None,
                    box=(0, 0, size, size),
                    samples=SAMPLES,
                )
                for t, v in places
            ),
            seed=0,
        )
        with BlenderWorker(Path(scratch) / "blender.log") as worker:
            worker.run(plain(job), timeout_s=TIMEOUT_S)
        return {
            (t, v): png_file(display(read_exr(Path(scratch) / f"{t}_{v}.exr"))) for t, v in places
        }


def main(argv: Sequence[str]) -> int:
    """Exit code of the command."""
    write_example(tyro.cli(Example, args=list(argv), prog="python -m model.reconstruct.example"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
