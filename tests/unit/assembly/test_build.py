"""Libraries built by commands: the same at any number of workers, resumed, bundles beside ours."""

import pytest

from artgen.assembly.build import build_library
from artgen.assembly.cli import assemble, library
from artgen.assembly.harvest import embedded
from artgen.assembly.library import Library
from artgen.core.errors import UsageError
from artgen.progress import silent

FEW = {"cabinet": 3}


def built(folder, workers):
    return build_library(
        folder, made=embedded(FEW), bundles=(), workers=workers, show=silent, sharp=True
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
