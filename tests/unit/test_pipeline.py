"""One asset from rule to bundle: what is dealt out, kept, refused and set aside."""

import json
from pathlib import Path

import pytest

from artgen import pipeline
from artgen.core.errors import ExportError, RuleError, UsageError
from artgen.pipeline import AssetTask, Toolbox, check_kept, make_asset, plan
from artgen.rules import load_rule
from artgen.run_folder import RunFolder
from artgen.validate.report import Finding, Report

TASK = AssetTask(category="cabinet", index=3, seed=9)


def test_a_larger_count_only_adds_tasks() -> None:
    few, many = plan(["laptop", "cabinet"], 5, 1), plan(["laptop", "cabinet"], 9, 1)
    assert many[:5] == few
    assert [task.asset_id for task in few] == [
        "laptop_000000",
        "cabinet_000000",
        "laptop_000001",
        "cabinet_000001",
        "laptop_000002",
    ]


def test_nothing_to_make_and_unknown_categories_are_refused() -> None:
    with pytest.raises(UsageError, match="--count 0 makes nothing"):
        plan(["laptop"], 0, 1)
    with pytest.raises(RuleError, match="no category 'spaceship'"):
        plan(["laptop", "spaceship"], 2, 1)


def test_a_category_that_is_named_twice_is_one() -> None:
    """Found: two processes made the same asset at the same place at once."""
    names = [task.asset_id for task in plan(["safe", "bucket", "safe"], 4, 1)]
    assert names == ["safe_000000", "bucket_000000", "safe_000001", "bucket_000001"]


def manifest_of(task: AssetTask, root: Path, **change: object) -> Path:
    digest = load_rule(task.category).digest
    stated = {
        "seed": task.seed,
        "rule": {"digest": digest},
        "versions": {"artgen": pipeline.__version__},
        "occlusion": False,
    }
    path = task.place(root) / "manifest.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(stated | change))
    return path


def test_a_bundle_of_the_same_making_is_kept(tmp_path: Path) -> None:
    folder = RunFolder(tmp_path)
    manifest_of(TASK, folder.assets)
    assert check_kept(folder, [TASK]) == {"cabinet_000003"}
    assert check_kept(folder, [AssetTask(category="cabinet", index=4, seed=9)]) == set()


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"seed": 8}, "seed"),
        ({"rule": {"digest": "old"}}, "rule"),
        ({"versions": {"artgen": "0.0.1"}}, "artgen"),
        ({"occlusion": True}, "occlusion"),
    ],
)
def test_a_bundle_of_another_making_is_neither_kept_nor_overwritten(tmp_path, change, word) -> None:
    path = manifest_of(TASK, RunFolder(tmp_path).assets, **change)
    before = path.read_bytes()
    with pytest.raises(UsageError, match=f"made from another {word}; choose a new --out"):
        check_kept(RunFolder(tmp_path), [TASK])
    assert path.read_bytes() == before


@pytest.mark.parametrize("text", ["", "{", "[]"])
def test_a_damaged_bundle_is_told_with_its_place_and_what_to_do(tmp_path: Path, text: str) -> None:
    """Found: a cut manifest ended `artgen generate` in a traceback."""
    manifest_of(TASK, RunFolder(tmp_path).assets).write_text(text)
    with pytest.raises(ExportError, match=r"cabinet/000003/manifest\.json .* remove its folder"):
        check_kept(RunFolder(tmp_path), [TASK])


@pytest.mark.blender
def test_an_asset_that_fails_is_set_aside_with_its_report_and_comes_back_when_it_passes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = RunFolder(tmp_path)
    tools = Toolbox(folder, "test")
    finding = Finding(
        check="x.y", part="door", value=1.0, bound="<= 0", cause="planted", remedy="weed"
    )
    valid = pipeline.validate_bundle
    with tools.blender:
        monkeypatch.setattr(
            pipeline, "validate_bundle", lambda place: Report(asset="a", findings=(finding,))
        )
        outcome = make_asset(TASK, tools)
        assert (outcome.status, "planted" in outcome.message) == ("failed", True)
        aside = TASK.place(folder.failed)
        assert "planted" in (aside / "report.json").read_text()
        assert not TASK.place(folder.assets).exists()
        monkeypatch.setattr(pipeline, "validate_bundle", valid)
        assert make_asset(TASK, tools).status == "made"
    assert not aside.exists()
    assert json.loads((TASK.place(folder.assets) / "report.json").read_text())["findings"] == []
    assert set(outcome.seconds) == {"build", "finish", "export", "validate"}
