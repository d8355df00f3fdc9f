"""Libraries built by commands: the same at any number of workers, resumed, bundles beside ours."""

import json
import shutil
from dataclasses import replace

import pytest

from artgen.assembly import build, harvest
from artgen.assembly.build import build_library, claim
from artgen.assembly.cli import assemble, library
from artgen.assembly.harvest import Made, bundle_folders, bundle_id, embedded
from artgen.assembly.library import Library
from artgen.core.errors import ExportError, UsageError
from artgen.dataset.split import families_of, split_of
from artgen.progress import silent
from tests.made import finished

FEW = {"cabinet": 3}


def built(folder, workers, *, sharp=True):
    return build_library(
        folder, made=embedded(FEW), bundles=(), workers=workers, show=silent, sharp=sharp
    )


def content(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*")
            if p.is_file() and "scratch" not in p.parts}  # fmt: skip


def test_workers_and_resuming_change_nothing(tmp_path):
    digest, faults = built(tmp_path / "one", 1)
    assert not faults
    assert Library(tmp_path / "one").digest == digest
    for path in list((tmp_path / "one" / "sources").iterdir())[:2]:
        path.unlink()
    (tmp_path / "one" / "library.json").unlink()
    assert built(tmp_path / "one", 1)[0] == digest
    assert built(tmp_path / "two", 2)[0] == digest
    assert content(tmp_path / "one") == content(tmp_path / "two")


@pytest.mark.parametrize("key", ["edition", "sharp", "artgen"])
def test_sources_made_otherwise_are_not_taken_for_ones_own(tmp_path, monkeypatch, key):
    """Sharp ones once stayed in a library that said it was not; an older artgen's too."""
    source = tmp_path / "sources" / "cabinet_6_000000.json"
    claim(tmp_path, sharp=True)
    source.parent.mkdir()
    source.write_text("{}")
    claim(tmp_path, sharp=True)
    if key != "sharp":
        monkeypatch.setattr(build, {"edition": "EDITION", "artgen": "__version__"}[key], "other")
    with pytest.raises(UsageError, match="choose a new --out"):
        built(tmp_path, 1, sharp=key != "sharp")
    assert source.read_text() == "{}"
    assert not (tmp_path / "library.json").exists()


def test_sources_of_unknown_making_are_refused(tmp_path):
    (tmp_path / "sources").mkdir()
    (tmp_path / "sources" / "x.json").write_text("{}")
    with pytest.raises(UsageError, match="does not state"):
        built(tmp_path, 1)


def with_manifest(bundle, folder, **changes):
    """A copy of a bundle whose manifest says something else."""
    shutil.copytree(bundle, folder)
    path = folder / "manifest.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), **changes}))
    return folder


@pytest.mark.blender
def test_bundles_of_one_name_are_sources_of_their_own_in_any_order(tmp_path, bundle):
    """Object 0 of two runs with different seeds: the second once overwrote the first, so that the
    order of the folders, or a race, told which of them the library held."""
    runs = [with_manifest(bundle, tmp_path / f"run{seed}", seed=seed) for seed in (0, 1)]
    digests = []
    for name, order, workers in (("a", runs, 1), ("b", runs[::-1], 2)):
        home = tmp_path / name
        digest, faults = build_library(home, made=(), bundles=order, workers=workers, show=silent)
        assert not faults
        sources = {path.stem for path in (home / "sources").iterdir()}
        assert sources == {bundle_id(run) for run in runs}
        digests.append(digest)
    assert digests[0] == digests[1]
    assert content(tmp_path / "a") == content(tmp_path / "b")


@pytest.mark.blender
def test_a_bundle_that_is_there_twice_is_taken_in_once_and_told(tmp_path, bundle):
    copy = shutil.copytree(bundle, tmp_path / "copy")
    two = [bundle, copy]
    digest, faults = build_library(tmp_path / "a", made=(), bundles=two, workers=1, show=silent)
    assert [(f.task, f.fault) for f in faults] == [(str(copy), f"is the same as {bundle}")]
    one = [copy]
    assert build_library(tmp_path / "b", made=(), bundles=one, workers=1, show=silent)[0] == digest
    assert content(tmp_path / "a") == content(tmp_path / "b")


def test_ids_of_bundles_are_names_of_files_whatever_a_manifest_says(tmp_path):
    for k, own in enumerate(["../../x", "a/b c", "Schrank ä\n", "x" * 400, None, 7]):
        folder = tmp_path / str(k)
        folder.mkdir()
        manifest = {"asset_id": "x", "source": {"dataset": "urdf", "id": own}}
        (folder / "manifest.json").write_text(json.dumps(manifest))
        id = bundle_id(folder)
        (tmp_path / f"{id}.json").touch()
        assert (tmp_path / f"{id}.json").parent == tmp_path
    (folder / "manifest.json").write_text("[]")
    with pytest.raises(ExportError, match="no JSON object"):
        bundle_id(folder)
    (folder / "manifest.json").write_text("{")
    with pytest.raises(ExportError, match="cannot be read"):
        bundle_id(folder)


def test_a_library_and_the_catalog_give_an_ingested_bundle_one_split(tmp_path, monkeypatch):
    """387 of 2,347 ids of PartNet-Mobility were for training in one and for testing in the other:
    one asked with the asset's id, the other with the data set's. Ten ids show it."""
    splits = set()
    for number in range(45000, 45010):
        family = f"partnet-mobility:{number}"
        source = {"dataset": "partnet-mobility", "id": str(number), "family": family}
        manifest = {"asset_id": f"pm_{number}", "source": source}
        (tmp_path / "manifest.json").write_text(json.dumps(manifest))
        obj = replace(finished("cabinet", 0), asset_id=f"pm_{number}", provenance=manifest)
        monkeypatch.setattr(harvest, "finished_object", lambda folder, obj=obj: obj)
        found = split_of(harvest.bundle_source(tmp_path).family)
        assert found == split_of(obj.asset_id, families_of(manifest)) == split_of(family)
        splits.add((found, split_of(obj.asset_id)))
    assert any(found != by_id for found, by_id in splits)


def test_a_bundle_made_of_others_parts_is_no_source(tmp_path):
    (tmp_path / "manifest.json").write_text('{"donors": ["a", "b"]}')
    with pytest.raises(UsageError, match="others' parts"):
        harvest.bundle_source(tmp_path)


def stated(folder, text):
    folder.mkdir(parents=True)
    (folder / "manifest.json").write_text(text)
    return folder


def test_one_damaged_bundle_costs_itself_alone_and_assembled_ones_are_told(tmp_path, capsys):
    """One ended the whole build; the other was left out in silence."""
    damaged = stated(tmp_path / "in/a", "{")
    assembled = stated(tmp_path / "in/b", '{"donors": ["x", "y"]}')
    bundles = bundle_folders([tmp_path / "in", tmp_path / "in/a"])
    made = [Made(category="safe", index=0)]
    home = tmp_path / "library"
    _, faults = build_library(home, made=made, bundles=bundles, workers=1, show=silent, sharp=True)
    assert [fault.task for fault in faults] == [str(damaged), str(assembled)]
    assert "cannot be read" in faults[0].fault
    assert "others' parts" in faults[1].fault
    assert {e.source for e in Library(home).entries} == {"safe_6_000000"}


def test_what_a_run_has_set_aside_is_no_source_unless_it_is_named(tmp_path):
    """`artgen library build out/ingested` took in what ingest had found to be of no use."""
    passed = stated(tmp_path / "run/assets/chair/pm_1", "{}")
    failed = stated(tmp_path / "run/failed/chair/pm_2", "{}")
    stated(tmp_path / "run/work/staged/pm_3", "{}")
    (tmp_path / "run/run.json").write_text("{}")
    assert bundle_folders([tmp_path / "run"]) == bundle_folders([tmp_path]) == [passed]
    assert bundle_folders([tmp_path / "run/failed"]) == [failed]


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (library, ["list"]),
        (library, ["build", "--no-embedded"]),
        (library, ["build", "nowhere", "--no-embedded"]),
        (assemble, ["storage_furnitur"]),
        (assemble, ["storage_furniture", "--count", "0"]),
    ],
)
def test_bad_words_are_refused(tmp_path, monkeypatch, command, words):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UsageError):
        command(words)
    assert not any(tmp_path.iterdir())


def test_a_folder_of_bundles_that_holds_none_is_told(tmp_path):
    with pytest.raises(UsageError, match="holds no bundle"):
        library(["build", str(tmp_path), "--no-embedded", "--out", str(tmp_path / "l")])
