"""`artgen export partnet` writes below --out alone, and loses no bundle among twins."""

import json
import shutil
from pathlib import Path

import pytest

from artgen.core.errors import ExportError
from artgen.export import write_bundle
from artgen.ingest.export_cli import export_bundle, partnet
from artgen.textures.library import TextureLibrary
from artgen.worker import BlenderWorker
from tests.made import finished


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory, blender: BlenderWorker) -> Path:
    folder = tmp_path_factory.mktemp("bundle")
    library = TextureLibrary(tmp_path_factory.mktemp("textures"))
    write_bundle(finished("bucket", 0), folder, library=library, worker=blender, thumbnail=b"none")
    return folder


def copied(bundle: Path, folder: Path, **changed: object) -> Path:
    """A bundle with some keys of its manifest changed."""
    shutil.copytree(bundle, folder)
    manifest = json.loads((folder / "manifest.json").read_text())
    (folder / "manifest.json").write_text(json.dumps({**manifest, **changed}))
    return folder


@pytest.mark.blender
@pytest.mark.parametrize(
    "asset_id", ["../../escaped", "/tmp/escaped", "..", ".", "", ".git", "a/b", "a.partial",
                 "a\n", "a" * 101, 7]
)  # fmt: skip
def test_an_asset_id_that_is_no_name_writes_nothing(
    asset_id: object, bundle: Path, tmp_path: Path
) -> None:
    """A manifest that said `../../escaped` was written beside --out's parent."""
    evil = copied(bundle, tmp_path / "evil", asset_id=asset_id)
    before = set(tmp_path.rglob("*"))
    with pytest.raises(ExportError, match="no name of a folder"):
        export_bundle(evil, tmp_path / "x/y/out", doubled=False)
    assert set(tmp_path.rglob("*")) == before


@pytest.mark.blender
def test_bundles_of_one_id_are_both_written_and_kept(bundle: Path, tmp_path: Path) -> None:
    """The second of two runs' bucket_000000 counted as kept and went missing."""
    copied(bundle, tmp_path / "in/a", seed=1)
    copied(bundle, tmp_path / "in/b", seed=2)
    shutil.copytree(tmp_path / "in/a", tmp_path / "in/c")
    words = [str(tmp_path / "in"), "--out", str(tmp_path / "out")]
    assert partnet(words) == 0
    names = ["bucket_000000", "bucket_000000_2"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == names
    times = {path: path.stat().st_mtime_ns for path in (tmp_path / "out").rglob("*")}
    assert partnet(words) == 0
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "out").rglob("*")} == times
