"""Other loaders and checkers of URDF files, each in a process of its own.

They run where they are installed; a loader that accepts a spoilt file without a word has missed the
defect.
"""

import json
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

TIMEOUT_S = 120.0

_LOOP = """
import json, sys, warnings
warnings.simplefilter("ignore")
{setup}
print(json.dumps("ready"), flush=True)
for path in sys.argv[1:]:
    try:
        {load}
        print(json.dumps([path, ""]), flush=True)
    except BaseException as error:
        print(json.dumps([path, f"{{type(error).__name__}}: {{error}}"[:200]]), flush=True)
"""
PYTHON: Mapping[str, tuple[str, str]] = {
    "MuJoCo": ("import mujoco", "mujoco.MjModel.from_xml_path(path)"),
    "yourdfpy": (
        "import yourdfpy",
        "robot = yourdfpy.URDF.load(path)\n        assert robot.validate(), robot.errors",
    ),
    "urchin": ("import urchin", "urchin.URDF.load(path)"),
    "pinocchio": (
        "import os, pinocchio",
        "pinocchio.buildModelsFromUrdf(path, os.path.dirname(path))",
    ),
    "pybullet": (
        "import pybullet\npybullet.connect(pybullet.DIRECT)",
        "pybullet.loadURDF(path, useFixedBase=True)",
    ),
    "drake": (
        "from pydrake.multibody.plant import AddMultibodyPlantSceneGraph\n"
        "from pydrake.multibody.parsing import Parser\n"
        "from pydrake.systems.framework import DiagramBuilder",
        "plant, _ = AddMultibodyPlantSceneGraph(DiagramBuilder(), 0.0)\n"
        "        Parser(plant).AddModels(path); plant.Finalize()",
    ),
}
CHECK_URDF = "check_urdf"
NAMES = (CHECK_URDF, *PYTHON)


def verdicts(rival: str, files: Sequence[Path]) -> dict[Path, str] | None:
    """File to the rival's complaint, empty where it accepts; None where it is not installed.

    A process that dies on a file has refused it, and goes on with the next in a fresh process.
    """
    if rival == CHECK_URDF:
        return _by_check_urdf(files)
    found: dict[Path, str] = {}
    waiting = list(files)
    while waiting:
        answered, ready = _run(rival, waiting)
        if not ready:
            return None
        found |= answered
        waiting = waiting[len(answered) :]
        if waiting:
            found[waiting.pop(0)] = "the process died"
    return found


def _run(rival: str, files: Sequence[Path]) -> tuple[dict[Path, str], bool]:
    """Complaints in the order of the files, up to where the process ended; whether it started."""
    setup, load = PYTHON[rival]
    script = _LOOP.format(setup=setup, load=load)
    try:
        done = subprocess.run(
            [sys.executable, "-c", script, *map(str, files)],
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )
        output = done.stdout
    except subprocess.TimeoutExpired as error:
        output = (error.stdout or b"").decode()
    lines = [line for line in output.splitlines() if line.startswith(("[", '"'))]
    if not lines or json.loads(lines[0]) != "ready":
        return {}, False
    return {Path(path): said for path, said in map(json.loads, lines[1:])}, True


def _by_check_urdf(files: Sequence[Path]) -> dict[Path, str] | None:
    program = shutil.which(CHECK_URDF)
    if program is None:
        return None
    found = {}
    for file in files:
        done = subprocess.run(
            [program, str(file)], capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )
        complaint = (done.stderr.strip().splitlines() or ["refused"])[-1]
        found[file] = complaint if done.returncode else ""
    return found
