"""The folder that travels to a farm and back: a manifest, the files it names, and the images."""

import json
import os
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from artgen.core.errors import UsageError
from artgen.core.jsonio import file_hash, plain, replace_atomically, write_json
from artgen.farm_manifest import Item
from renders.plan import RenderPlan
from renders.settings import CameraSettings, SensorSettings, Settings

SCHEMA = "artgen-farm/1"
RECORD = "farm.json"
MANIFEST = "manifest.jsonl"
ITEMS = "items"


@dataclass(frozen=True, kw_only=True)
class Farm:
    """What was planned.

    Attributes:
        source: run, folder of bundles, or bundle.
    """

    source: Path
    settings: Settings
    seed: int


def write_farm(root: Path, farm: Farm) -> None:
    """Write farm.json, or check that the folder was planned alike.

    Raises:
        UsageError: the folder holds another plan, or foreign files.
    """
    source = Path(os.path.relpath(farm.source.resolve(), root.resolve()))
    stated = plain({**vars(farm), "source": source, "schema": SCHEMA})
    if (root / RECORD).exists():
        if {**_stated(root), "source": stated["source"]} != stated:
            raise UsageError(
                f"{root}: was planned with other settings or another seed (see {RECORD}); choose "
                "another --out"
            )
    elif root.exists() and any(root.iterdir()):
        raise UsageError(f"{root}: holds files that are no plan; choose another --out")
    write_json(root / RECORD, stated)


def read_farm(root: Path) -> Farm:
    """What `write_farm` wrote.

    Raises:
        UsageError: there is no farm.json, or it cannot be read.
    """
    stated = _stated(root)
    try:
        return Farm(
            source=Path(os.path.normpath(root.resolve() / stated["source"])),
            settings=_settings(stated["settings"]),
            seed=int(stated["seed"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise _unreadable(root, error) from error


def _stated(root: Path) -> dict[str, Any]:
    try:
        return dict(json.loads((root / RECORD).read_text(encoding="utf-8")))
    except (OSError, TypeError, ValueError) as error:
        raise _unreadable(root, error) from error


def _unreadable(root: Path, error: Exception) -> UsageError:
    return UsageError(
        f"{root / RECORD}: cannot be read ({error}); name a folder that `artgen farm plan` wrote"
    )


def _settings(stated: Mapping[str, Any]) -> Settings:
    cameras = dict(stated["cameras"])
    typed = {
        "cameras": CameraSettings(**{**cameras, "fov": tuple(cameras["fov"])}),
        "sensor": SensorSettings(**stated["sensor"]),
        "extras": tuple(stated["extras"]),
    }
    return Settings(**{**stated, **typed})


def portable(plan: RenderPlan) -> tuple[Item, dict[str, Path]]:
    """The item of a plan, and the files it names: path in the folder to where each lies now."""
    name = plan.bundle.asset_id
    job = plain(plan.job)
    files = {f"assets/{name}.glb": Path(plan.job.glb)}
    job["glb"], job["folder"] = f"assets/{name}.glb", ""
    if (environment := plan.job.rig.environment) is not None:
        relative = f"environments/{Path(environment.file).name}"  # Named by its content.
        files[relative] = Path(environment.file)
        job["rig"]["environment"]["file"] = relative
    inputs = {relative: file_hash(path) for relative, path in sorted(files.items())}
    return Item.stated(name, job, inputs), files


def bring(root: Path, files: Mapping[str, Path], inputs: Mapping[str, str]) -> None:
    """Put files into the folder: linked where the disk can, else copied; those there are kept."""
    for relative, source in files.items():
        path = root / relative
        if path.exists() and file_hash(path) == inputs[relative]:
            continue
        replace_atomically(path, partial(_link, source))


def _link(source: Path, path: Path) -> None:
    path.unlink(missing_ok=True)
    try:
        os.link(source, path)
    except OSError:  # Another disk, or one without links.
        shutil.copyfile(source, path)
