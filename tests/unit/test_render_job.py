"""A render job that cannot be carried out is refused with the place and the number."""

import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from artgen.core.camera import Camera
from artgen.core.errors import RenderError
from artgen.render_job import LightRig, RenderJob, Shot, Sky, Transport

DARK = Sky(nadir=(0.0,) * 3, horizon=(0.0,) * 3, zenith=(0.0,) * 3)
STILL = {"base": np.eye(4)}
CAMERA = Camera(focal=50.0, size=(32, 24), camera_from_world=np.eye(4)).stated
JOB = RenderJob(
    glb="a.glb",
    folder=".",
    cameras=(CAMERA,),
    states=(STILL,),
    rig=LightRig(name="none", lights=(), sky=DARK),
    transport=Transport(
        diffuse=1, glossy=1, transmission=0, transparent=1, clamp_indirect=0.0, panes=()
    ),
    shots=(Shot(file="0.exr", camera=0, state=0, part=None, box=(0, 0, 32, 24), samples=1),),
    seed=0,
)


def shot(**changes: object) -> tuple[Shot, ...]:
    return (replace(JOB.shots[0], **changes),)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"cameras": (replace(CAMERA, focal=math.nan),)}, "camera 0 has focal nan px"),
        ({"cameras": (replace(CAMERA, focal=-1.0),)}, "camera 0 has focal -1.0 px"),
        ({"states": ({"base": np.full((4, 4), np.nan)},)}, "state 0 puts base at"),
        ({"states": ({"base": np.eye(3)},)}, "expected 16 finite numbers"),
        ({"exposures": ((STILL,), (STILL,))}, "2 exposures for 1 states"),
        ({"exposures": (({"base": np.full((4, 4), np.inf)},),)}, "exposure 0 puts base"),
        ({"shots": shot(box=(0, 0, 0, 24))}, r"shot 0.exr has window \(0, 0, 0, 24\)"),
        ({"shots": shot(box=(0, 0, 33, 24))}, "an area inside 32 x 24"),
        ({"shots": shot(camera=1)}, "asks for camera 1 and state 0; the job has 1 cameras"),
        ({"shots": shot(state=-1)}, "state -1"),
        ({"shots": shot(samples=0)}, "0 paths a pixel"),
    ],
)
def test_nonsense_is_refused(changes: dict[str, object], said: str) -> None:
    with pytest.raises(RenderError, match=said):
        replace(JOB, **changes)  # type: ignore[arg-type]


BARE = """
import sys
from unittest.mock import MagicMock
sys.path.insert(0, {root!r})
for name in ("bpy", "mathutils"):
    sys.modules[name] = MagicMock()
import blender_scripts.render
foreign = {{name.partition(".")[0] for name in sys.modules}} - set(sys.stdlib_module_names)
foreign -= {{"artgen", "blender_scripts", "bpy", "mathutils", "__main__", "__mp_main__"}}
assert not foreign, foreign
"""


def test_the_render_path_needs_bpy_and_the_standard_library_alone() -> None:
    """In a Python without site-packages, as Blender's own on a render farm may be."""
    root = str(Path(__file__).parents[2])
    ran = subprocess.run(
        [sys.executable, "-I", "-S", "-c", BARE.format(root=root)], capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr
