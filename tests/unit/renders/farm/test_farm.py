"""Plan, render in any number of tasks on bare machines, collect: the same bytes as `artgen render`.

Tasks run in a Python without site-packages, by way of a stand-in for Blender's command line.
"""

import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import UsageError
from artgen.export import Bundle
from artgen.farm_manifest import DONE
from artgen.imaging import read_exr
from renders.cli import render
from renders.farm.cli import farm

pytestmark = [pytest.mark.blender, pytest.mark.xdist_group("farm")]

ROOT = Path(__file__).parents[4]
SHARD = str(ROOT / "blender_scripts" / "render_shard.py")
LOOK = ["--views", "2", "--states", "2", "--size", "24", "--accuracy", "2spp", "--seed", "4"]
LOOK += ["--light", "softboxes", "--ground", "--workers", "1"]
NAMES = ["chest_000001", "chest_000002"]
BARE = """
import runpy, sys
sys.path.append({links!r})
sys.argv[0] = "blender"
runpy.run_path({stand_in!r}, run_name="__main__")
"""


@pytest.fixture(scope="module")
def bundles(bundle: Bundle, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two chests of different seeds."""
    root = tmp_path_factory.mktemp("source") / "chests"
    for name in NAMES:
        copy = root / name
        shutil.copytree(bundle.folder, copy)
        stated = json.loads((copy / "manifest.json").read_text())
        (copy / "manifest.json").write_text(json.dumps({**stated, "asset_id": name}))
    return root


@pytest.fixture(scope="module")
def planned(bundles: Path) -> Path:
    """A farm's folder, moved after it was planned: nothing in it knows where it lay."""
    there, here = bundles.parent / "elsewhere" / "farm", bundles.parent / "farm"
    assert farm(["plan", str(bundles), "--out", str(there), *LOOK]) == 0
    shutil.copytree(there, here)
    shutil.rmtree(there.parent)
    return here


@pytest.fixture
def fresh(planned: Path, tmp_path: Path) -> Path:
    """A copy of the farm's folder without images; bundles stay where they are."""
    folder = tmp_path / "farm"
    shutil.copytree(planned, folder, ignore=shutil.ignore_patterns("items"))
    return folder


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The stand-in, in a Python that has bpy, the numpy that every Blender has, and no more."""
    folder = tmp_path_factory.mktemp("blender")
    links = folder / "links"
    links.mkdir()
    (links / "bpy").symlink_to(Path(find_spec("bpy").origin or "").parent)
    for part in ("numpy", "numpy.libs"):
        (links / part).symlink_to(Path(np.__file__).parents[1] / part)
    stand_in = str(ROOT / "tests" / "stand_in_blender.py")
    (folder / "bare.py").write_text(BARE.format(links=str(links), stand_in=stand_in))
    call = shlex.join([sys.executable, "-I", "-S", str(folder / "bare.py")])
    script = folder / "blender"
    script.write_text(f'#!/bin/sh\nexec {call} "$@"\n')
    script.chmod(0o755)
    return script


@pytest.fixture(scope="module")
def rendered(planned: Path, program: Path) -> Path:
    """Both items, rendered by two tasks with different words."""
    for words in (["-f", "1", "--"], ["--", "--start", "0", "--end", "0", "--threads", "2"]):
        told = subprocess.run(
            [str(program), *FLAGS, SHARD, *words, "--manifest", str(planned / "manifest.jsonl")],
            capture_output=True,
            text=True,
            check=False,
        )
        assert told.returncode == 0, told.stderr
        (line,) = told.stdout.splitlines()
        assert json.loads(line)["status"] == "rendered"
    return planned


FLAGS = ["-b", "--factory-startup", "--python-exit-code", "1", "-P"]


def task(folder: Path, *words: str) -> subprocess.Popen[str]:
    """A task by plain Python, in some other folder."""
    return subprocess.Popen(
        [sys.executable, SHARD, "--manifest", str(folder / "manifest.jsonl"), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd="/",
    )


def collect(folder: Path, bundles: Path, out: Path) -> list[str]:
    words = ["collect", str(folder), "--source", str(bundles), "--out", str(out)]
    return [*words, "--workers", "1"]


def outcomes(running: subprocess.Popen[str], code: int) -> list[tuple[int, str]]:
    told, said = running.communicate(timeout=300)
    assert running.returncode == code, said
    lines = [json.loads(line) for line in told.splitlines()]
    return [(line["item"], line["status"]) for line in lines]


def pixels(folder: Path) -> dict[str, bytes]:
    return {path.name: read_exr(path).tobytes() for path in sorted(folder.glob("*.exr"))}


def test_collected_samples_are_those_of_artgen_render(
    rendered: Path, bundles: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Byte for byte, with lights as images and a floor."""
    assert render([str(bundles), "--out", str(tmp_path / "here"), *LOOK]) == 0
    capsys.readouterr()
    assert farm(collect(rendered, bundles, tmp_path / "there")) == 0
    assert "2 of 2 items collected" in capsys.readouterr().out
    whole = {p.name: p.read_bytes() for p in (tmp_path / "here" / "samples").rglob("*.tar")}
    assert sorted(whole) == ["000001.tar", "000002.tar"]
    came = {p.name: p.read_bytes() for p in (tmp_path / "there" / "samples").rglob("*.tar")}
    assert came == whole


def test_a_second_task_keeps_what_is_whole(rendered: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in (rendered / "items").rglob("*")}
    assert outcomes(task(rendered, "--frames", "0-1"), 0) == [(0, "kept"), (1, "kept")]
    assert {path: path.stat().st_mtime_ns for path in (rendered / "items").rglob("*")} == before


def test_a_task_killed_mid_item_leaves_nothing_half_written_and_a_rerun_finishes_it(
    fresh: Path, rendered: Path
) -> None:
    items = fresh / "items"
    running = task(fresh, "--frames", "0")
    while not list(items.glob(".*.partial/*.exr")):
        assert running.poll() is None
        time.sleep(0.002)
    os.kill(running.pid, signal.SIGKILL)
    running.communicate()
    (left,) = items.iterdir()
    assert left.name.startswith(f".{NAMES[0]}.")
    assert outcomes(task(fresh, "--frames", "0"), 0) == [(0, "rendered")]
    assert [path.name for path in items.iterdir()] == [NAMES[0]]
    assert pixels(items / NAMES[0]) == pixels(rendered / "items" / NAMES[0])


def test_tasks_that_race_for_an_item_do_not_corrupt_it(fresh: Path, rendered: Path) -> None:
    racing = [task(fresh, "--frames", "1", "--out", str(fresh / "out")) for _ in range(2)]
    for running in racing:
        ((number, status),) = outcomes(running, 0)
        assert (number, status in ("rendered", "kept")) == (1, True)
    assert [path.name for path in (fresh / "out").iterdir()] == [NAMES[1]]
    assert pixels(fresh / "out" / NAMES[1]) == pixels(rendered / "items" / NAMES[1])


def test_a_failing_item_is_set_aside_and_the_rest_goes_on(
    fresh: Path, rendered: Path, bundles: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Then images are damaged, and collecting says which items to render again."""
    shutil.copytree(rendered / "items" / NAMES[1], fresh / "items" / NAMES[1])
    glb = fresh / "assets" / f"{NAMES[0]}.glb"
    whole = glb.read_bytes()
    glb.write_bytes(whole[:-1])
    assert outcomes(task(fresh), 1) == [(0, "failed"), (1, "kept")]
    fault = fresh / "items" / f"{NAMES[0]}.error.json"
    assert "copy it again" in json.loads(fault.read_text())["error"]
    image = fresh / "items" / NAMES[1] / "000003.exr"
    image.write_bytes(image.read_bytes()[:-1])
    assert farm(collect(fresh, bundles, tmp_path / "out")) == 1
    told = capsys.readouterr().out
    assert "0 of 2 items collected" in told
    assert "to be rendered again: --frames 0-1" in told
    assert f"failed {NAMES[0]}: RenderError: " in told
    assert "000003.exr: is not the image that was rendered" in told
    glb.write_bytes(whole)
    assert outcomes(task(fresh), 0) == [(0, "rendered"), (1, "rendered")]
    assert not fault.exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--manifest", "none.jsonl"], "none.jsonl: cannot be read"),
        (["--start", "1", "--end", "2"], "item 2 is outside the manifest, whose items are 0 to 1"),
        (["--frames", "1"], "line 1 (from 0) is no item"),
    ],
)
def test_a_call_without_sense_ends_with_2_and_one_line(
    fresh: Path, program: Path, words: list[str], message: str
) -> None:
    manifest = fresh / "manifest.jsonl"
    manifest.write_text(manifest.read_text().splitlines()[0] + "\n{\n")
    if "--manifest" not in words:
        words = ["--manifest", str(manifest), *words]
    told = subprocess.run(
        [str(program), *FLAGS, SHARD, "--", *words], capture_output=True, text=True, check=False
    )
    assert told.returncode == 2
    (line,) = told.stderr.splitlines()
    assert line.startswith("render_shard: ")
    assert message in line
    assert not told.stdout


def test_the_stand_in_hides_faults_as_blender_does(program: Path, tmp_path: Path) -> None:
    """Why the flag is there, and why it is first."""
    script = tmp_path / "raises.py"
    script.write_text("raise ValueError")
    codes = [
        subprocess.run([str(program), "-b", *words], capture_output=True, check=False).returncode
        for words in (
            ["-P", str(script)],
            ["--python-exit-code", "9", "-P", str(script)],
            ["-P", str(script), "--python-exit-code", "9"],
        )
    ]
    assert codes == [0, 9, 0]


def test_a_plan_is_not_mixed_with_another(planned: Path, bundles: Path, tmp_path: Path) -> None:
    words = ["plan", str(bundles), "--out", str(planned)]
    with pytest.raises(UsageError, match="was planned with other settings or another seed"):
        farm([*words, *LOOK, "--seed", "5"])
    with pytest.raises(UsageError, match="farms render with cycles alone"):
        farm([*words, "--backend", "fast"])
    (tmp_path / "foreign").touch()
    with pytest.raises(UsageError, match="holds files that are no plan"):
        farm(["plan", str(bundles), "--out", str(tmp_path), *LOOK])
    with pytest.raises(UsageError, match="name a folder that `artgen farm plan` wrote"):
        farm(["collect", str(bundles)])
    with pytest.raises(UsageError, match="no farm action 'pack'; known: plan, export, collect"):
        farm(["pack"])


def test_planning_again_changes_nothing_and_keeps_images(rendered: Path, bundles: Path) -> None:
    before = (rendered / "manifest.jsonl").read_bytes()
    assert farm(["plan", str(bundles), "--out", str(rendered), *LOOK]) == 0
    assert (rendered / "manifest.jsonl").read_bytes() == before
    assert (rendered / "items" / NAMES[0] / DONE).is_file()


def test_a_bundle_that_changed_is_not_collected(
    fresh: Path, rendered: Path, bundles: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(rendered / "items", fresh / "items")
    shutil.copytree(bundles, tmp_path / "chests")
    with (tmp_path / "chests" / NAMES[0] / "asset.glb").open("ab") as stream:
        stream.write(b" ")
    shutil.rmtree(tmp_path / "chests" / NAMES[1])
    assert farm(collect(fresh, tmp_path / "chests", tmp_path / "out")) == 1
    told = capsys.readouterr().out
    assert "changed since `artgen farm plan`" in told
    assert "its bundle is gone; name its folder by --source" in told
