"""A file appears whole or not at all."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from artgen.core.errors import ExportError
from artgen.core.jsonio import (
    canonical_json,
    content_hash,
    fill_folder_atomically,
    read_object,
    write_bytes,
    write_json,
)

KILLED = """
import os, signal, sys
from pathlib import Path
from artgen.core.jsonio import fill_folder_atomically
def fill(partial):
    (partial / "one").write_text("new")
    os.kill(os.getpid(), signal.SIGKILL)
fill_folder_atomically(Path(sys.argv[1]), fill)
"""


def test_canonical_json_ignores_key_order_and_keeps_every_digit() -> None:
    assert canonical_json({"b": 0.1, "a": (1, 2)}) == '{"a":[1,2],"b":0.1}'
    assert content_hash({"a": 1, "b": 2}) == content_hash({"b": 2, "a": 1})


def test_not_a_number_is_refused() -> None:
    with pytest.raises(ValueError, match="JSON"):
        canonical_json({"a": float("nan")})


@pytest.mark.parametrize(
    "content", [None, b"", b"{", b'"text"', b"[]", b"\xff", b"[" * 100_000], ids=repr
)
def test_what_is_no_object_of_ours_is_told_with_its_remedy(
    content: bytes | None, tmp_path: Path
) -> None:
    """Missing, empty, cut, of another kind, no text, nested without end: one error for all."""
    path = tmp_path / "manifest.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ExportError, match=r"manifest\.json cannot be read \(.+\); make it anew"):
        read_object(path, remedy="make it anew")


def test_what_was_written_is_read(tmp_path: Path) -> None:
    write_json(tmp_path / "a.json", {"x": 1 / 3, "y": [1, {}]})
    assert read_object(tmp_path / "a.json", remedy="") == {"x": 1 / 3, "y": [1, {}]}


def test_equal_values_give_equal_bytes(tmp_path: Path) -> None:
    write_json(tmp_path / "a.json", {"x": 1 / 3, "y": [1, 2]})
    write_json(tmp_path / "b.json", {"y": [1, 2], "x": 1 / 3})
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_a_failed_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "kept"
    write_bytes(path, b"old")
    with pytest.raises(TypeError):
        write_bytes(path, "not bytes")  # type: ignore[arg-type]
    assert path.read_bytes() == b"old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["kept"]


def test_a_failed_fill_leaves_the_old_folder(tmp_path: Path) -> None:
    folder = tmp_path / "bundle"

    def fill(partial: Path) -> None:
        (partial / "one").write_text("1")

    def fail(partial: Path) -> None:
        (partial / "one").write_text("2")
        raise RuntimeError("stop")

    fill_folder_atomically(folder, fill)
    with pytest.raises(RuntimeError, match="stop"):
        fill_folder_atomically(folder, fail)
    assert (folder / "one").read_text() == "1"
    assert [p.name for p in tmp_path.iterdir()] == ["bundle"]


def test_a_process_killed_while_filling_leaves_no_folder_and_the_next_one_succeeds(
    tmp_path: Path,
) -> None:
    folder = tmp_path / "bundle"
    killed = subprocess.run([sys.executable, "-c", KILLED, str(folder)], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert not folder.exists()
    fill_folder_atomically(folder, lambda partial: (partial / "two").write_text("2") and None)
    assert sorted(p.name for p in folder.iterdir()) == ["two"]
    assert [path.name for path in tmp_path.iterdir()] == ["bundle"]
