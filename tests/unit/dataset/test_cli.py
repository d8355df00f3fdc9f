"""`artgen shard`."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from artgen.core.errors import ShardError, UsageError
from artgen.dataset.cli import shard
from artgen.dataset.reader import ShardDataset
from artgen.run_folder import locked
from tests.unit.dataset.runs import OPENING_DEG, made_run


def test_shards_and_catalog_are_made_and_what_was_left_out_is_said(tmp_path, capsys):
    """Exit code 1: done, but some assets are missing."""
    out = made_run(tmp_path / "out")
    assert shard([str(out), "--per-shard", "2"]) == 1
    said = capsys.readouterr().out
    assert f"{len(OPENING_DEG)} samples" in said
    assert "left out: laptop_000004: L3.clearance: lid: lid hits base" in said
    assert (out / "shards" / "dataset.json").exists()
    assert (out / "catalog" / "assets.parquet").exists()


def test_the_exit_code_is_zero_when_every_asset_was_packed(tmp_path):
    out = made_run(tmp_path / "out")
    for place in ("failed/laptop/000004", "failed/laptop/000005", "assets/cabinet/000001"):
        (out / place).rename(tmp_path / place.replace("/", "_"))
    assert shard([str(out)]) == 0


@pytest.mark.parametrize("words", [["--per-shard", "0"], ["nowhere"]])
def test_bad_options_are_refused(tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out").mkdir()
    with pytest.raises(UsageError):
        shard(words)


def test_a_folder_without_samples_is_refused(tmp_path):
    with pytest.raises(ShardError, match="holds no sample"):
        shard([str(tmp_path)])
    assert not (tmp_path / "shards").exists()


def test_a_folder_in_use_is_refused(tmp_path, monkeypatch):
    """The lock may be taken again within a process, so another process must hold it."""
    code = (
        "import sys, pathlib; from artgen.run_folder import locked\n"
        "with locked(pathlib.Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code, tmp_path],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as holder:
        assert holder.stdout.readline() == "held\n"
        with pytest.raises(UsageError, match="another artgen run"):
            shard([str(tmp_path)])
        holder.stdin.close()
    with locked(tmp_path):
        pass


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    """A run with its shards."""
    out = made_run(tmp_path_factory.mktemp("packed") / "out")
    shard(["pack", str(out), "--per-shard", "2"])
    return out


@pytest.fixture
def run(packed, tmp_path):
    """A copy to spoil."""
    return Path(shutil.copytree(packed, tmp_path / "out"))


def test_pack_may_be_said(packed, tmp_path):
    out = made_run(tmp_path / "out")
    shard([str(out), "--per-shard", "2"])
    assert content(out / "shards") == content(packed / "shards")


@pytest.mark.parametrize("place", ["", "shards", "shards/train-000000.tar"])
def test_verify_passes_what_is_whole_and_names_what_is_not(run, capsys, place):
    assert shard(["verify", str(run / place)]) == 0
    assert "damaged places: 0" in capsys.readouterr().out
    tar = run / "shards" / "train-000000.tar"
    data = bytearray(tar.read_bytes())
    data[600] ^= 1
    tar.write_bytes(data)
    assert shard(["verify", str(run / place)]) == 1
    said = capsys.readouterr().out
    assert f"damaged: {tar}: laptop_000000.meta.json (offset 512)" in said
    assert "damaged places: 1" in said


def test_repack_restores_a_damaged_shard(run, packed, capsys):
    (run / "shards" / "train-000000.tar").write_bytes(b"")
    assert shard(["repack", str(run), "--shard", "train-000000"]) == 0
    assert "restored" in capsys.readouterr().out
    assert shard(["verify", str(run)]) == 0
    tar = "shards/train-000000.tar"
    assert (run / tar).read_bytes() == (packed / tar).read_bytes()


def test_repack_changes_the_size_of_shards_and_back(run, packed, tmp_path):
    other, back = tmp_path / "other", tmp_path / "back"
    shard(["repack", str(run / "shards"), "--into", str(other), "--per-shard", "3"])
    shard(["repack", str(other), "--into", str(back), "--per-shard", "2"])
    assert content(back) == content(packed / "shards")


def test_publish_copies_a_run_to_a_store(packed, bucket, capsys):
    assert shard(["publish", str(packed), bucket.url]) == 0
    assert f"{len(OPENING_DEG)} samples" in capsys.readouterr().out
    assert shard(["verify", bucket.url, f"{bucket.url}/train-000000.tar"]) == 0
    assert ShardDataset(bucket.url).ids == ShardDataset(packed / "shards").ids


@pytest.mark.parametrize(
    "words",
    [
        ["verify", "nowhere"],
        ["repack", "nowhere"],
        ["repack", "out", "--per-shard", "0"],
        ["publish", "out", "elsewhere"],
    ],
)
def test_bad_words_are_refused(packed, monkeypatch, words):
    monkeypatch.chdir(packed.parent)
    with pytest.raises(UsageError):
        shard(words)


def content(folder):
    """Name to bytes of every shard, sidecar and list."""
    kinds = (".tar", ".json", ".parquet")
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix in kinds}
