"""Does every tool load a bundle? Errors by tool; an empty text is a pass."""

import json
import shutil
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path

import mujoco
import pinocchio
import yourdfpy
from pxr import Usd, UsdValidation

from artgen.validate import validate_bundle

NODE_FOLDER = Path(".cache/gltf-validator")
SCRIPT = """
const validator = require('gltf-validator'), fs = require('fs');
for (const file of process.argv.slice(1)) {
  validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 20})
    .then(r => console.log(JSON.stringify({file, errors: r.issues.numErrors,
       warnings: r.issues.numWarnings, messages: r.issues.messages})));
}
"""


def artgen_accepts(folder: Path) -> str:
    """Our own validation."""
    return "; ".join(finding.cause for finding in validate_bundle(folder).findings)


def mujoco_loads(folder: Path) -> str:
    """MJCF and URDF compile; the cache is off, since files of one name are rewritten in tests."""
    mujoco.mj_setCacheCapacity(mujoco.mj_getCache(), 0)
    for file in ("asset.xml", "asset.urdf"):
        mujoco.MjModel.from_xml_path(str(folder / file))
    return ""


def yourdfpy_loads(folder: Path) -> str:
    """The URDF and all of its meshes."""
    robot = yourdfpy.URDF.load(str(folder / "asset.urdf"), load_collision_meshes=True)
    return "" if robot.validate() else "; ".join(str(error) for error in robot.errors)


def pinocchio_loads(folder: Path) -> str:
    """The URDF as a model with every moving joint."""
    model = pinocchio.buildModelFromUrdf(str(folder / "asset.urdf"))
    joints = json.loads((folder / "manifest.json").read_text())["joints"]
    return (
        "" if model.njoints - 1 == len(joints) else f"{model.njoints - 1} of {len(joints)} joints"
    )


def usd_validates(folder: Path) -> str:
    """All validators of usd-core without an error."""
    stage = Usd.Stage.Open(str(next(folder.glob("asset.usd*"))))
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    errors = [error for error in context.Validate(stage) if error.GetType().name == "Error"]
    return "; ".join(error.GetMessage() for error in errors)


CHECKS: Mapping[str, Callable[[Path], str]] = {
    "artgen validate": artgen_accepts,
    "MuJoCo": mujoco_loads,
    "yourdfpy": yourdfpy_loads,
    "pinocchio": pinocchio_loads,
    "UsdValidation": usd_validates,
}


def verdicts(folder: Path) -> dict[str, str]:
    """Tool to error text; an exception is an error too."""
    found = {}
    for tool, check in CHECKS.items():
        try:
            found[tool] = check(folder)
        except Exception as error:
            found[tool] = f"{type(error).__name__}: {error}"
    return found


def gltf_verdicts(folders: list[Path]) -> dict[Path, dict[str, int]] | None:
    """Errors and warnings by Khronos' validator, or None where Node.js is missing."""
    if shutil.which("npm") is None:
        return None
    if not (NODE_FOLDER / "node_modules").exists():
        NODE_FOLDER.mkdir(parents=True, exist_ok=True)
        subprocess.run(
            [
                "npm",
                "install",
                "--silent",
                "--prefix",
                str(NODE_FOLDER),
                "gltf-validator@2.0.0-dev.3.10",
            ],
            check=True,
        )
    told = subprocess.run(
        ["node", "-e", SCRIPT, *(str((folder / "asset.glb").resolve()) for folder in folders)],
        cwd=NODE_FOLDER,
        capture_output=True,
        text=True,
        check=True,
    )
    rows = [json.loads(line) for line in told.stdout.splitlines()]
    return {
        Path(row["file"]).parent: {"errors": row["errors"], "warnings": row["warnings"]}
        for row in rows
    }
