"""One task of a render farm: some items of a manifest, each rendered whole or not at all."""

import json
import logging
import os
import shutil
import sys
import time
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import bpy

from artgen.core.errors import UsageError
from artgen.farm_manifest import DONE, Item, count_items, damage, image_record, read_items
from blender_scripts import render
from blender_scripts.claimed_folder import claimed, publish, sweep
from blender_scripts.frame_ranges import Asked, asked, chosen
from blender_scripts.reports import private_stdout

log = logging.getLogger("blender_scripts.farm_task")


def main(argv: list[str]) -> int:
    """Render what the arguments ask for; one JSON line for each item on stdout."""
    logging.basicConfig(level=logging.INFO, format="%(name)s: %(message)s")
    try:
        task, items = _asked_items(argv)
    except UsageError as error:
        print(f"render_shard: {error}", file=sys.stderr)  # noqa: T201
        return 2
    threads = task.threads or _cores()
    # Before the first image: the denoiser reads these once. It would pin its threads, so that all
    # tasks of a machine share one core, and take all cores whatever Cycles is given.
    os.environ["OIDN_SET_AFFINITY"] = "0"
    os.environ["OIDN_NUM_THREADS"] = str(threads)
    reports, failed = private_stdout(), 0
    for number, item in items:
        outcome = settled(item, task.manifest.parent, _out(task), threads)
        failed += outcome["status"] == "failed"
        line = {"item": number, "name": item.name, **outcome}
        print(json.dumps(line), file=reports, flush=True)
    return 1 if failed else 0


def _asked_items(argv: list[str]) -> tuple[Asked, list[tuple[int, Item]]]:
    task = asked(argv)
    numbers = chosen(task.stated, os.environ, count_items(task.manifest))
    items = list(read_items(task.manifest, set(numbers)))
    try:
        _out(task).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"--out {_out(task)}: cannot be written ({error.strerror})") from error
    return task, items


def _out(task: Asked) -> Path:
    return task.out or task.manifest.parent / "items"


def _cores() -> int:
    """Cores that this process may use, which farms often restrict."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def settled(item: Item, root: Path, out: Path, threads: int) -> dict[str, Any]:
    """What became of an item: kept, rendered, or failed with its fault in an error file.

    Args:
        root: the manifest's folder.
        out: receives the item's folder.
    """
    started, folder, fault = time.perf_counter(), out / item.name, out / f"{item.name}.error.json"
    if damage(folder, item) is None:
        fault.unlink(missing_ok=True)
        return {"status": "kept", "images": len(item.files)}
    try:
        sweep(out, item.name)
        _render(item, root, folder, threads)
        fault.unlink(missing_ok=True)
    except Exception as error:  # One item must not end its chunk, whatever is wrong with it.
        log.exception("%s failed", item.name)
        cause = f"{type(error).__name__}: {' '.join(str(error).split())}"
        _set_aside(fault, {"item": item.digest, "error": cause})
        return {"status": "failed", "error": cause}
    seconds = round(time.perf_counter() - started, 3)
    return {"status": "rendered", "images": len(item.files), "seconds": seconds}


def _render(item: Item, root: Path, folder: Path, threads: int) -> None:
    """Render into a folder of our own, write `done.json` last, give it the item's name."""
    with claimed(folder) as partial:
        job = item.render_job(root, partial)
        report = render.run(asdict(job), threads)
        done = {
            "item": item.digest,
            "images": {name: image_record(partial / name) for name in item.files},
            "blender": bpy.app.version_string,
            "cpu": report["cpu"],
        }
        _write(partial / DONE, done)
        publish(partial, folder, taken=lambda: damage(folder, item) is None)


def _set_aside(fault: Path, record: Mapping[str, str]) -> None:
    """Tell those who collect; where even that fails, the report on stdout has told it."""
    partial = fault.with_name(f".{fault.name}.{os.getpid()}.partial")
    try:
        _write(partial, record)
        partial.replace(fault)
    except OSError:
        log.exception("%s cannot be written", fault)
        shutil.rmtree(partial, ignore_errors=True)


def _write(path: Path, record: Mapping[str, Any]) -> None:
    path.write_text(json.dumps(record, sort_keys=True, indent=1) + "\n", encoding="utf-8")
