"""Which bundles a run renders, where their samples go, and what it refuses to mix."""

import json
from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.run_folder import RunFolder
from renders.run import RenderTask, is_staged, planned_tasks
from renders.settings import CameraSettings, Settings
from renders.sources import found_bundles, rendering_folder

SETTINGS = Settings(views=2, states=2, size=32, accuracy="2spp")


def bundle(folder: Path, asset_id: str = "", category: str = "chest") -> Path:
    """A folder that is a bundle as far as planning can tell."""
    folder.mkdir(parents=True)
    stated = {"asset_id": asset_id, "category": category} if asset_id else {}
    (folder / "manifest.json").write_text(json.dumps(stated))
    return folder


def tasks_of(root: Path, settings: Settings = SETTINGS, seed: int = 0) -> list[RenderTask]:
    tasks, refused = planned_tasks(RunFolder(root), found_bundles(root), settings, seed)
    assert not refused
    return tasks


# --------------------------------------------------------------------------------------- finding


def test_a_folder_without_bundles_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="holds no bundle"):
        found_bundles(tmp_path)
    with pytest.raises(UsageError, match="no such folder"):
        found_bundles(tmp_path / "nowhere")


def test_bundles_are_found_at_any_depth_and_alone(tmp_path: Path) -> None:
    deep = bundle(tmp_path / "a" / "b" / "c", "scan_7", "scan")
    flat = bundle(tmp_path / "z", "mug_1", "mug")
    bundle(deep / "textures" / "not_a_bundle", "inner_1", "inner")
    bundle(tmp_path / "half.partial", "half_1", "half")
    assert [found.folder for found in found_bundles(tmp_path)] == [deep, flat]
    (alone,) = found_bundles(deep)
    assert (alone.asset_id, alone.category) == ("scan_7", "scan")
    assert alone.sample == Path("scan/7.tar")


def test_of_runs_the_valid_assets_are_taken(tmp_path: Path) -> None:
    for run in ("one", "two"):
        good = bundle(tmp_path / run / "assets" / "chest" / "000001", f"{run}_000001", run)
        bundle(tmp_path / run / "failed" / "chest" / "000002", f"{run}_000002", run)
        (tmp_path / run / "run.json").write_text("{}")
        assert [found.folder for found in found_bundles(tmp_path / run)] == [good]
    assert len(found_bundles(tmp_path)) == 2


def test_ids_that_clash_or_cannot_be_names_are_set_aside(tmp_path: Path) -> None:
    for name, asset_id in (("a", "mug_1"), ("b", "mug_1"), ("c", "mug.2"), ("d", "mug_3")):
        bundle(tmp_path / name, asset_id, "mug")
    out = RunFolder(tmp_path / "out")
    tasks, refused = planned_tasks(out, found_bundles(tmp_path), SETTINGS, 0)
    assert [task.asset_id for task in tasks] == ["mug_3"]
    assert [one.asset_id for one in refused] == ["mug_1", "mug_1", "mug.2"]
    assert "2 bundles call themselves mug_1" in refused[0].message
    assert "must be letters, digits, - and _" in refused[2].message


# ---------------------------------------------------------------------------------------- placing


def test_a_rendering_never_goes_into_a_bundle(tmp_path: Path) -> None:
    run, scans = tmp_path / "run", tmp_path / "scans"
    bundle(run / "assets" / "chest" / "000001", "chest_000001")
    one = bundle(scans / "one", "scan_1", "scan")
    assert rendering_folder(run, out=None, name=None) == run
    assert rendering_folder(run, out=None, name="mono") == run / "renders" / "mono"
    assert rendering_folder(scans, out=None, name=None) == tmp_path / "scans-renders"
    assert rendering_folder(one, out=None, name=None) == scans / "one-renders"
    assert rendering_folder(scans, out=tmp_path / "x", name=None) == tmp_path / "x"
    with pytest.raises(UsageError, match=r"lies inside the bundle .*one; choose another --out"):
        rendering_folder(scans, out=one / "renders", name=None)
    with pytest.raises(UsageError, match="--name a/b: expected letters"):
        rendering_folder(run, out=None, name="a/b")


# ------------------------------------------------------------------------------------- remembering


def test_other_settings_do_not_overwrite_samples(tmp_path: Path) -> None:
    bundle(tmp_path / "assets" / "chest" / "000001")
    (task,) = tasks_of(tmp_path)
    assert task.asset_id == "chest_000001"
    assert task.sample == tmp_path / "samples" / "chest" / "000001.tar"
    assert not is_staged(task)
    assert tasks_of(tmp_path) == [task]
    remembered = json.loads((tmp_path / "samples" / "settings.json").read_text())
    assert remembered["settings"]["size"] == 32
    with pytest.raises(UsageError, match=r"other size 32 \(now 64\).*--name of its own, or delete"):
        tasks_of(tmp_path, Settings(views=2, size=64, accuracy="2spp"))
    other = Settings(views=2, size=32, accuracy="2spp", cameras=CameraSettings(dolly=0.1))
    with pytest.raises(UsageError, match=r"other cameras\.dolly 0\.0 \(now 0\.1\)"):
        tasks_of(tmp_path, other)
    with pytest.raises(UsageError, match=r"other seed 0 \(now 1\)"):
        tasks_of(tmp_path, seed=1)


def test_a_damaged_memory_is_told(tmp_path: Path) -> None:
    bundle(tmp_path / "assets" / "chest" / "000001")
    tasks_of(tmp_path)
    (tmp_path / "samples" / "settings.json").write_text("{")
    with pytest.raises(UsageError, match=r"settings.json: is damaged .*delete that folder"):
        tasks_of(tmp_path)


def test_a_half_written_sample_is_rendered_again(tmp_path: Path) -> None:
    bundle(tmp_path / "assets" / "chest" / "000001")
    (task,) = tasks_of(tmp_path)
    task.sample.parent.mkdir(parents=True)
    task.sample.write_bytes(b"half a tar")
    assert not is_staged(task)
