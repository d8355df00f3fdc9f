"""Captures of a reconstructed object, drawn by our own painter: images, masks and cameras."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from artgen.articulation.types import State
from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.jsonio import write_json
from artgen.core.mesh import Floats
from model.reconstruct.assemble import Assembled
from model.reconstruct.cameras import SCHEMA
from model.reconstruct.draw import Painter

AZIMUTHS = (-50.0, 10.0, 60.0, 170.0)
SIZE = 96
STATES = ({"part_1_joint": 0.3, "part_2_joint": 0.2}, {"part_1_joint": 1.2, "part_2_joint": 0.1})


def cameras(points: Floats, *, size: int = SIZE) -> list[Camera]:
    """Cameras around an object, each with another place for its optical axis."""
    return [
        framed(
            points,
            direction=orbit_direction(math.radians(azimuth), math.radians(20.0)),
            fov=math.radians(40.0),
            size=(size, size),
            fill=0.8,
            principal=(size / 2.0 + 3.0 * k, size / 2.0 - 2.0 * k),
        )
        for k, azimuth in enumerate(AZIMUTHS)
    ]


def photographed(
    done: Assembled, folder: Path, *, size: int = SIZE, states: Sequence[State] = STATES
) -> Path:
    """A folder with `state_T/view_V.png` and `cameras.json`; the world is the object frame."""
    painter = Painter(done.object, done.color, dim=1.0)
    points = np.concatenate([painter.points(state) for state in states])
    views = []
    for t, state in enumerate(states):
        (folder / f"state_{t}").mkdir(parents=True)
        for v, camera in enumerate(cameras(points, size=size)):
            picture = painter.paint(state, camera.intrinsics, camera.camera_from_world, camera.size)
            name = f"state_{t}/view_{v}.png"
            Image.fromarray(picture).save(folder / name)
            views.append(
                {
                    "image": name,
                    "intrinsics": camera.intrinsics,
                    "camera_from_world": camera.camera_from_world,
                }
            )
    rig = {"schema": SCHEMA, "views": views, "center": done.shift, "radius": 0.7}
    write_json(folder / "cameras.json", rig)
    return folder
