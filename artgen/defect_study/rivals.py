"""Other loaders and checkers of URDF files, each in a process of its own.

They run where they are installed; a loader that accepts a spoilt file without a word has missed the
defect.
"""

import contextlib
import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

TIMEOUT_S = 300.0
"""For all files of one process."""
HANG_S = 5.0
"""check_urdf needs milliseconds, and runs for ever on a link that is its own parent."""

_LOOP = """
import json, sys, warnings
warnings.simplefilter("ignore")
{setup}
with open(sys.argv[1], "w") as answers:
    for path in sys.argv[2:]:
        try:
            {load}
            said = ""
        except BaseException as error:
            said = f"{{type(error).__name__}}: {{error}}"[:200]
        print(json.dumps(said or ""), file=answers, flush=True)
"""
PYTHON: Mapping[str, tuple[str, str]] = {
    "MuJoCo": ("import mujoco", "mujoco.MjModel.from_xml_path(path)"),
    "yourdfpy": (
        "import yourdfpy",
        "robot = yourdfpy.URDF.load(path)\n            assert robot.validate(), robot.errors",
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
        "            Parser(plant).AddModels(path); plant.Finalize()",
    ),
}
CHECK_URDF = "check_urdf"
NAMES = (CHECK_URDF, *PYTHON)


def verdicts(rival: str, files: Sequence[Path]) -> dict[Path, str] | None:
    """File to the rival's complaint, empty where it accepts; None where it is not installed.

    A process that dies or hangs on a file has refused it; the next files get a fresh one.
    """
    if rival == CHECK_URDF:
        return _by_check_urdf(files)
    found: list[str] = []
    while len(found) < len(files):
        answered = _run(rival, files[len(found) :])
        if answered is None:
            return None
        found += answered
        if len(found) < len(files):
            found.append("the process died or hung")
    return dict(zip(files, found, strict=True))


def _run(rival: str, files: Sequence[Path]) -> list[str] | None:
    """Complaints in the order of the files, up to where the process ended; None if it never began.

    Answers go to a file of their own, as loaders print what they like.
    """
    setup, load = PYTHON[rival]
    with tempfile.TemporaryDirectory() as folder:
        answers = Path(folder) / "answers"
        script = _LOOP.format(setup=setup, load=load)
        command = [sys.executable, "-c", script, str(answers), *map(str, files)]
        with contextlib.suppress(subprocess.TimeoutExpired):
            subprocess.run(command, capture_output=True, timeout=TIMEOUT_S, check=False)
        if not answers.exists():
            return None
        return [json.loads(line) for line in answers.read_text(encoding="utf-8").splitlines()]


def _by_check_urdf(files: Sequence[Path]) -> dict[Path, str] | None:
    program = shutil.which(CHECK_URDF)
    if program is None:
        return None
    found = {}
    for file in files:
        try:
            done = subprocess.run(
                [program, str(file)], capture_output=True, text=True, timeout=HANG_S, check=False
            )
        except subprocess.TimeoutExpired:
            found[file] = "the process hung"
            continue
        complaint = (done.stderr.strip().splitlines() or ["refused"])[-1]
        found[file] = complaint if done.returncode else ""
    return found
