"""Which objects lie at paths, and what is told of the rest."""

from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.ingest.found import NO_FOLDERS, Found, found_files, found_folders, named


def folder(root: Path, name: str) -> Path:
    (root / name).mkdir(parents=True)
    (root / name / "mobility_v2.json").write_text("[]")
    return root / name


def test_a_folder_of_many_is_looked_through_and_nothing_is_passed_over(tmp_path: Path) -> None:
    data = tmp_path / "data"
    for name in ("7", "45940", "mit Leerzeichen"):
        folder(data, name)
    (data / "empty").mkdir()
    (data / "100.zip").write_bytes(b"PK")
    (data / "README").write_text("not an object")
    (data / ".cache").mkdir()
    (data / "away").symlink_to(tmp_path, target_is_directory=True)
    found = {entry.path.name: entry.problem for entry in found_folders([data])}
    assert sorted(found) == ["100.zip", "45940", "7", "away", "empty", "mit Leerzeichen"]
    assert "unpack it first" in found["100.zip"]
    assert "a link that leaves" in found["away"]
    assert found["45940"] is None
    assert found["empty"] is None


def test_a_folder_without_an_object_is_told(tmp_path: Path) -> None:
    """`0 objects` was a success: a mistyped path, or a folder of archives, looked finished."""
    data = tmp_path / "data"
    data.mkdir()
    for _ in range(2):
        (entry,) = found_folders([data])
        assert entry == Found(path=data, problem=NO_FOLDERS)
        (data / "readme.txt").write_text("")


@pytest.mark.parametrize("suffix", ["zip", "tar", "tar.gz", "tgz", "bz2", "xz", "7z", "RAR"])
def test_archives_are_told_whatever_packed_them(suffix: str, tmp_path: Path) -> None:
    (tmp_path / f"45940.{suffix}").write_bytes(b"")
    (entry,) = found_folders([tmp_path])
    assert "unpack it first" in entry.problem


def test_links_that_lead_nowhere_are_told(tmp_path: Path) -> None:
    for name in ("45940", "gone.urdf"):
        (tmp_path / name).symlink_to(tmp_path / "nowhere")
    told = "is a link that leads nowhere"
    assert [e.problem for e in found_folders([tmp_path])] == [told, told]
    assert [(e.path.name, e.problem) for e in found_files([tmp_path], (".urdf",))] == [
        ("gone.urdf", told)
    ]


def test_the_folder_that_one_stands_in_has_a_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was `pm_`, which other runs share."""
    monkeypatch.chdir(folder(tmp_path, "45940"))
    assert [name for name, _ in named(found_folders([Path()]), "partnet")] == ["pm_45940"]


def test_an_object_named_twice_is_one(tmp_path: Path) -> None:
    own = folder(tmp_path, "45940")
    assert len(found_folders([own, tmp_path, own])) == 1


def test_what_is_no_folder_is_told(tmp_path: Path) -> None:
    (tmp_path / "45940.zip").write_bytes(b"PK")
    problems = [e.problem for e in found_folders([tmp_path / "45940.zip", tmp_path / "none"])]
    assert "is a file (.zip)" in problems[0]
    assert problems[1] == "does not exist; check the path"


def test_no_path_is_an_error() -> None:
    with pytest.raises(UsageError, match="needs a folder"):
        found_folders([])
    with pytest.raises(UsageError, match=r"\.urdf"):
        found_files([], (".urdf",))


def test_names_are_fit_for_files_and_twins_are_numbered(tmp_path: Path) -> None:
    for parent in ("a", "b"):
        folder(tmp_path / parent, "45940")
    folder(tmp_path / "c", "Шкаф 1")
    found = found_folders([tmp_path / "a", tmp_path / "b", tmp_path / "c"])
    assert [name for name, _ in named(found, "partnet")] == ["pm_45940", "pm_45940_2", "pm_1"]


def test_files_of_a_kind_are_found_below_folders(tmp_path: Path) -> None:
    (tmp_path / "x/y").mkdir(parents=True)
    (tmp_path / "x/y/Robot One.urdf").write_text("<robot/>")
    (tmp_path / "x/other.txt").write_text("")
    found = found_files([tmp_path, tmp_path / "x/other.txt"], (".urdf",))
    assert [(e.path.name, e.problem) for e in found] == [
        ("Robot One.urdf", None), ("other.txt", "is no .urdf")
    ]  # fmt: skip
    assert named(found, "urdf")[0][0] == "urdf_y_robot_one"
