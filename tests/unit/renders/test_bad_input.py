"""Whatever is wrong with one asset costs one clear line and that asset; a rerun finishes it."""

import dataclasses
import json
import re
import resource
import shutil
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import RenderError, WorkerError
from artgen.core.stream import Stream
from artgen.export import Bundle, read_bundle
from renders import run
from renders.cli import render
from renders.pictures import Pictures
from renders.plan import RenderPlan, plan_render
from renders.run import RenderTask
from renders.settings import Settings

pytestmark = pytest.mark.blender

SMALL = ["--views", "1", "--states", "1", "--size", "16", "--accuracy", "1spp", "--workers", "1"]


def damage_manifest(folder: Path) -> None:
    (folder / "manifest.json").write_text('{"schema": "artgen-bundle/2", "asset_id"')


def damage_limit(folder: Path) -> None:
    stated = json.loads((folder / "manifest.json").read_text())
    stated["joints"][0]["upper"] = -1.0
    (folder / "manifest.json").write_text(json.dumps(stated))


def edit_mesh(part: str, edit: Callable[[str], str]) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        (mesh,) = folder.glob(f"meshes/*_{part}.obj")
        mesh.write_text(edit(mesh.read_text()))

    return damage


def scaled(factor: float) -> Callable[[str], str]:
    def edit(text: str) -> str:
        lines = []
        for line in text.splitlines():
            if line.startswith("v "):
                x, y, z = (factor * float(word) for word in line.split()[1:])
                line = f"v {x} {y} {z}"
            lines.append(line)
        return "\n".join(lines)

    return edit


def remove_mesh(folder: Path) -> None:
    next(iter(sorted(folder.glob("meshes/*_door.obj")))).unlink()


def all_meshes(edit: Callable[[str], str]) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        for mesh in folder.glob("meshes/*.obj"):
            mesh.write_text(edit(mesh.read_text()))

    return damage


def cut_glb(folder: Path) -> None:
    whole = (folder / "asset.glb").read_bytes()
    (folder / "asset.glb").write_bytes(whole[: len(whole) // 2])


def remove_texture(folder: Path) -> None:
    """The first material shows an image that is not there."""
    raw = (folder / "asset.glb").read_bytes()
    (length,) = struct.unpack_from("<I", raw, 12)
    scene = json.loads(raw[20 : 20 + length])
    scene |= {"images": [{"uri": "gone.png"}], "textures": [{"source": 0}]}
    scene["materials"][0].setdefault("pbrMetallicRoughness", {})["baseColorTexture"] = {"index": 0}
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    chunk = struct.pack("<I4s", len(text), b"JSON") + text + raw[20 + length :]
    (folder / "asset.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunk)) + chunk)


DAMAGES: dict[str, tuple[Callable[[Path], None], str]] = {
    "cut manifest": (damage_manifest, r"manifest\.json cannot be read .*is .* an asset\?"),
    "impossible limit": (damage_limit, r"manifest\.json is damaged .*limit \[0\.0, -1\.0\]"),
    "missing mesh": (remove_mesh, r"_door\.obj cannot be read .*No such file"),
    "foreign mesh": (
        edit_mesh("door", lambda text: text + "hello\n"),
        r"_door\.obj cannot be read .*OBJ line 'hello'",
    ),
    "NaN": (
        edit_mesh("door", lambda text: re.sub(r"\nv \S+", "\nv nan", text, count=1)),
        r"_door\.obj cannot be read .*not finite",
    ),
    "zero size": (edit_mesh("door", scaled(0.0)), r"door is 0 m long .* no pixel can show it"),
    "too large": (all_meshes(scaled(1e4)), r"is .*e\+03 m across .*expected 0\.001 to 1000 m"),
    "cut GLB": (cut_glb, r"asset\.glb cannot be imported"),
    "missing texture": (remove_texture, r"lacks the texture|cannot be imported"),
}


def run_of(bundle: Bundle, root: Path, count: int) -> list[Path]:
    """A run of copies of the chest, by ascending id."""
    folders = [root / "assets" / "chest" / f"{k:06d}" for k in range(count)]
    for folder in folders:
        shutil.copytree(bundle.folder, folder)
        manifest = folder / "manifest.json"
        manifest.write_text(manifest.read_text().replace("chest_000001", f"chest_{folder.name}"))
        for mesh in sorted((folder / "meshes").iterdir()):
            mesh.rename(mesh.with_name(mesh.name.replace("000001", folder.name)))
    return folders


def test_each_fault_costs_its_asset_one_line_and_a_rerun_finishes(
    bundle: Bundle, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One run with every fault at once; then all bundles are mended."""
    root = tmp_path / "run"
    folders = run_of(bundle, root, len(DAMAGES) + 1)
    kept = [shutil.copytree(folder, tmp_path / "kept" / folder.name) for folder in folders]
    for folder, (damage, _) in zip(folders, DAMAGES.values(), strict=False):
        damage(folder)
    assert render([str(root), *SMALL]) == 1
    said = capsys.readouterr().out.splitlines()
    lines = [line for line in said if line.startswith("failed ")]
    assert len(lines) == len(DAMAGES)
    for folder, (_, expected), line in zip(folders, DAMAGES.values(), lines, strict=False):
        assert line.startswith(f"failed chest_{folder.name}: ")
        assert re.search(expected, line), line
    assert f"1 of {len(folders)} assets rendered" in said[-len(lines) - 1]
    for folder, whole in zip(folders, kept, strict=True):
        shutil.rmtree(folder)
        shutil.move(whole, folder)
    assert render([str(root), *SMALL]) == 0
    assert "failed" not in capsys.readouterr().out


def test_a_full_disk_sets_assets_aside_and_a_rerun_finishes(bundle: Bundle, tmp_path: Path) -> None:
    """A limit on file size stands in for a full disk: the sample's tar does not fit."""
    root = tmp_path / "run"
    run_of(bundle, root, 2)
    command = [sys.executable, "-m", "artgen", "render", str(root), *SMALL]
    told = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (12_000, 12_000)),
    )
    assert told.returncode != 0
    assert "Traceback" not in told.stderr + told.stdout
    assert "File too large); free some space" in told.stdout
    assert "0 of 2 assets rendered" in told.stdout
    assert not list(root.glob("samples/**/*.partial"))
    assert subprocess.run(command, capture_output=True, check=False).returncode == 0


class Crashing:
    """A backend whose Blender died, once."""

    shading = "cycles"

    def __init__(self) -> None:
        self.calls = 0

    def pictures(self, plan: RenderPlan, folder: Path) -> Pictures:
        self.calls += 1
        if self.calls == 1:
            raise WorkerError("Blender job 'render' failed: no report after 900 s; tried 2 times")
        shots = [shot.box for shot in plan.passes.shots]
        images = [np.zeros((b - t, r - x, 4), np.float32) for x, t, r, b in shots]
        return Pictures(images=images, cpu={})


def task_of(bundle: Bundle, folder: Path) -> RenderTask:
    return RenderTask(
        asset_id=bundle.asset_id,
        bundle=bundle.folder,
        sample=folder / "chest" / "1.tar",
        settings=Settings(views=1, states=1, size=16),
        seed=0,
    )


def test_a_crashed_or_hung_blender_costs_its_asset_alone(
    bundle: Bundle, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The worker itself kills and tries again (test_worker.py); here its last word is an error."""
    monkeypatch.setattr(run, "_worker", (Crashing(), tmp_path / "scratch"))
    task = task_of(bundle, tmp_path)
    first, again = run._task_in_worker(task), run._task_in_worker(task)
    assert first.message.startswith("Blender job 'render' failed: no report after 900 s")
    assert not again.message
    assert again.account is not None
    assert not list((tmp_path / "scratch").iterdir())


class Broken:
    """A backend with a mistake of ours."""

    shading = "cycles"

    def pictures(self, plan: RenderPlan, folder: Path) -> Pictures:
        raise KeyError("nobody thought of this")


def test_even_a_mistake_of_ours_costs_one_asset(
    bundle: Bundle, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run, "_worker", (Broken(), tmp_path))
    told = run._task_in_worker(task_of(bundle, tmp_path)).message
    assert re.fullmatch(
        r"unexpected KeyError\('nobody thought of this'\) \(test_bad_input\.py:\d+\); please .*",
        told,
    )


def test_a_camera_that_is_not_finite_never_reaches_blender(bundle: Bundle, tmp_path: Path) -> None:
    plan = plan_render(bundle, Stream(0), settings=Settings(views=1, size=16), folder=tmp_path)
    (camera,) = plan.job.cameras
    broken = dataclasses.replace(camera, focal=float("nan"))
    with pytest.raises(RenderError, match="camera 0 has focal nan"):
        dataclasses.replace(plan.job, cameras=(broken,))


def test_a_bundle_that_changes_its_mind_is_read_anew(bundle: Bundle, tmp_path: Path) -> None:
    """Meshes are read for every rendering: nothing of a damaged bundle is remembered."""
    folder = shutil.copytree(bundle.folder, tmp_path / "000001")
    remove_mesh(folder)
    with pytest.raises(RenderError, match="cannot be read"):
        plan_render(read_bundle(folder), Stream(0), settings=Settings(), folder=tmp_path)
