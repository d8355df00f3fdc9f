"""`artgen shard`."""

import subprocess
import sys

import pytest

from artgen.core.errors import ShardError, UsageError
from artgen.dataset.cli import shard
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
