"""One run at a time, in its own folder, of one seed."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.run_folder import SCHEMA, locked, opened, settled

HOLDER = """
import sys, time
from pathlib import Path
from artgen.run_folder import opened
with opened(Path(sys.argv[1]), seed=0):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_a_new_folder_is_recorded_and_found_again(tmp_path: Path) -> None:
    root = tmp_path / "out"
    with opened(root, seed=3):
        assert json.loads((root / "run.json").read_text())["schema"] == SCHEMA
    before = (root / "run.json").read_bytes()
    with opened(root, seed=3) as folder:
        assert folder.assets == root / "assets"
    assert (root / "run.json").read_bytes() == before


def test_a_second_run_at_once_is_stopped_and_the_first_goes_on(tmp_path: Path) -> None:
    root = tmp_path / "out"
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLDER, str(root)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert holder.stdout is not None
    assert holder.stdout.readline() == "held\n"
    with (
        pytest.raises(UsageError, match="another artgen run is writing here"),
        opened(root, seed=0),
    ):
        pass
    holder.communicate("")
    assert holder.returncode == 0
    with opened(root, seed=0):
        pass


def test_stages_of_one_run_may_lock_again(tmp_path: Path) -> None:
    with opened(tmp_path / "out", seed=0) as folder, locked(folder.root):
        assert (folder.root / ".lock").exists()


def test_foreign_files_stop_the_run_and_stay(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(UsageError, match="holds thesis.tex, which artgen did not make"):
        opened(tmp_path, seed=0).__enter__()
    assert (tmp_path / "thesis.tex").read_text() == "years of work"
    assert not (tmp_path / "run.json").exists()


@pytest.mark.parametrize(
    ("record", "message"),
    [
        ('{"schema": "artgen-run/0", "seed": 0}', "schema 'artgen-run/0', this artgen writes"),
        ('{"schema": "artgen-run/1", "seed": 5}', "begun with seed 5, not 0"),
        ("{", "not valid JSON"),
    ],
)
def test_another_schema_or_seed_is_refused_and_kept(tmp_path: Path, record, message) -> None:
    (tmp_path / "run.json").write_text(record)
    with pytest.raises(UsageError, match=message):
        opened(tmp_path, seed=0).__enter__()
    assert (tmp_path / "run.json").read_text() == record


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("")
    with pytest.raises(UsageError, match="is a file"):
        opened(tmp_path / "out", seed=0).__enter__()


def test_too_little_space_is_said_before_anything_is_made(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"MB free, about \d+ MB needed"):
        opened(tmp_path / "out", seed=0, need_bytes=10**18).__enter__()
    assert not (tmp_path / "out" / "assets").exists()


def test_a_staged_folder_comes_home_alone(tmp_path: Path) -> None:
    """Neither the old content at home nor an earlier run's in the other place stays."""
    staged, home, other = tmp_path / "staged", tmp_path / "assets/x/0", tmp_path / "failed/x/0"
    for folder, name in ((staged, "new"), (home, "old"), (other, "older")):
        folder.mkdir(parents=True)
        (folder / name).write_text(name)
    settled(staged, home=home, other=other)
    assert [path.name for path in home.iterdir()] == ["new"]
    assert not staged.exists()
    assert not other.exists()
