"""The embedded library: built once a machine, by one process at a time, never used when damaged."""

import logging
import os
import shutil
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier, Event

import pytest

from artgen.assembly import embedded, harvest
from artgen.assembly.build import Taken, build_library
from artgen.assembly.embedded import IDLE_S, MOST, cache_folder, embedded_library, made_of
from artgen.assembly.library import Library
from artgen.core.errors import ArtgenError
from artgen.progress import silent

FEW = harvest.embedded({"cabinet": 2})


class Builder:
    """Writes some files in place of a library and counts how often."""

    def __init__(self) -> None:
        self.built = 0
        self.faults: list[Taken] = []

    def __call__(self, folder: Path, **_: object) -> tuple[str, list[Taken]]:
        self.built += 1
        for name in ("library.json", "sources/a.json", "meshes/b.npz", "scratch/log"):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(name)
        return "digest", self.faults


@pytest.fixture
def builder(monkeypatch: pytest.MonkeyPatch) -> Builder:
    found = Builder()
    monkeypatch.setattr(embedded, "build_library", found)
    return found


def kept(cache: Path | None, own: Path = Path("nowhere")) -> Path:
    return embedded_library(cache, own=own, workers=1, show=silent)


def test_it_is_the_library_that_is_built_of_its_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(embedded, "embedded", lambda: FEW)
    home = embedded_library(tmp_path / "cache", own=tmp_path, workers=1, show=silent, sharp=True)
    digest, _ = build_library(
        tmp_path / "own", made=FEW, bundles=(), workers=1, show=silent, sharp=True
    )
    assert Library(home).digest == digest
    assert Library(home).entries == Library(tmp_path / "own").entries


def test_it_is_built_once_for_all_runs(tmp_path: Path, builder: Builder) -> None:
    """Found: every new --out built its 138 sources anew."""
    homes = {kept(tmp_path / "cache", tmp_path / f"run{k}") for k in range(3)}
    assert builder.built == 1
    assert [home.parent for home in homes] == [tmp_path / "cache"]
    assert not (homes.pop() / "scratch").exists()
    assert {path.name for path in tmp_path.iterdir()} == {"cache"}


DAMAGES: dict[str, Callable[[Path], object]] = {
    "another byte": lambda home: (home / "meshes" / "b.npz").write_text("meshes/c.npz"),
    "cut": lambda home: (home / "sources" / "a.json").write_text("sources"),
    "gone": lambda home: (home / "library.json").unlink(),
    "one more": lambda home: (home / "sources" / "z.json").write_text("z"),
    "no sums": lambda home: (home / embedded.SUMS).unlink(),
    "cut sums": lambda home: (home / embedded.SUMS).write_text("{"),
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES.keys())
def test_one_that_is_damaged_is_built_anew(
    damage: Callable[[Path], object], tmp_path: Path, builder: Builder
) -> None:
    home = kept(tmp_path)
    damage(home)
    assert kept(tmp_path) == home
    assert builder.built == 2
    assert (home / "meshes" / "b.npz").read_text() == "meshes/b.npz"
    assert not (home / "sources" / "z.json").exists()
    kept(tmp_path)
    assert builder.built == 2


def test_two_that_need_it_at_once_build_it_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """The first builds until the second has said that it waits."""
    begun, told, write = Barrier(2, timeout=20), Event(), Builder()

    def build(folder: Path, **_: object) -> tuple[str, list[Taken]]:
        begun.wait()
        assert told.wait(20)
        return write(folder)

    class Listener(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            told.set()

    monkeypatch.setattr(embedded, "build_library", build)
    monkeypatch.setattr(embedded.log, "handlers", [Listener()])
    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(kept, tmp_path)
        begun.wait()
        second = pool.submit(kept, tmp_path)
        assert first.result() == second.result()
    assert write.built == 1
    assert "another artgen builds" in caplog.text


def test_one_that_lacks_a_source_is_not_used(tmp_path: Path, builder: Builder) -> None:
    builder.faults = [Taken(task="safe_6_000001", fault="it crashed")]
    for _ in range(2):
        with pytest.raises(ArtgenError, match=r"1 sources .* \(safe_6_000001: it crashed\)"):
            kept(tmp_path)
    builder.faults = []
    assert kept(tmp_path).is_dir()
    assert builder.built == 3


def test_where_the_cache_cannot_be_written_each_run_has_its_own(
    tmp_path: Path, builder: Builder
) -> None:
    (tmp_path / "file").touch()
    for cache in (None, tmp_path / "file" / "cache"):
        assert kept(cache, tmp_path / "work").parent == tmp_path / "work"
    assert builder.built == 1


def test_its_name_tells_all_that_it_depends_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A source, a rule, Blender's scripts, a library's version, what it is made from."""
    for place in ("artgen/generators/safe.py", "category_rules/safe.toml"):
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text("1")
    monkeypatch.setattr(embedded, "ROOT", tmp_path)
    names = [made_of()]
    assert made_of() == names[0]
    for place in ("artgen/generators/safe.py", "category_rules/safe.toml"):
        (tmp_path / place).write_text("2")
        names.append(made_of())
    (tmp_path / "blender_scripts").mkdir()
    (tmp_path / "blender_scripts" / "bevel.py").touch()
    names.append(made_of())
    monkeypatch.setattr(embedded, "versions", lambda: {"manifold3d": "9"})
    names.append(made_of())
    monkeypatch.setattr(embedded, "embedded", lambda: FEW)
    names.append(made_of())
    assert len(set(names)) == 6


def test_those_of_older_code_go_once_they_are_idle(
    tmp_path: Path, builder: Builder, monkeypatch: pytest.MonkeyPatch
) -> None:
    home = kept(tmp_path)
    now = home.stat().st_mtime
    ages = [0.0, *(IDLE_S * k for k in range(2, MOST + 4))]
    for k, age in enumerate(ages):
        old = shutil.copytree(home, tmp_path / f"library-{k}")
        os.utime(old, (now - age, now - age))
    (tmp_path / "library-of-mine.txt").touch()
    monkeypatch.setattr(embedded, "made_of", lambda: "f" * 64)
    new = kept(tmp_path)
    left = {path for path in tmp_path.glob("library-*") if path.is_dir()}
    # The new one and the MOST - 1 used last: the first, and those of no and the least ages.
    assert left == {new, home, *(tmp_path / f"library-{k}" for k in range(MOST - 2))}
    assert (tmp_path / "library-of-mine.txt").exists()


@pytest.mark.parametrize(
    ("environment", "place"),
    [
        ({"HOME": "/home/a"}, "/home/a/.cache/artgen"),
        ({"HOME": "/home/a", "XDG_CACHE_HOME": "/c"}, "/c/artgen"),
        ({"HOME": "/home/a", "XDG_CACHE_HOME": "c"}, "/home/a/.cache/artgen"),
        ({"HOME": "/home/a", "XDG_CACHE_HOME": "/c", "ARTGEN_CACHE": "/d"}, "/d"),
        ({"HOME": "", "XDG_CACHE_HOME": ""}, None),
        ({}, None),
    ],
)
def test_the_cache_lies_where_the_system_keeps_such(
    environment: dict[str, str], place: str | None
) -> None:
    assert cache_folder(environment) == (None if place is None else Path(place))
