"""The objects of a study: splits, nesting, categories in turn."""

from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.dataset.split import split_of
from model.data.library import read_library, taken, write_library
from model.training_study.objects import (
    HELD_OUT,
    ranked_positions,
    training_path,
    write_objects,
)
from tests.unit.model.training_study.small_study import TEST, TRAIN, small_library


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_library(tmp_path_factory.mktemp("objects"))


def test_sets_lie_within_each_other_and_hold_the_categories_in_turn(
    library: Path, tmp_path: Path
) -> None:
    write_objects(library, tmp_path, counts=(2, 4), held_out=3, slots=8)
    few, more = (read_library(training_path(tmp_path, count)) for count in (2, 4))
    assert more.ids[:2] == few.ids
    assert set(few.categories) == set(more.categories[2:]) == {"laptop", "cabinet"}
    assert set(more.ids) == {f"{name}_{index:06d}" for name, index in TRAIN}
    held_out = read_library(tmp_path / HELD_OUT)
    assert set(held_out.ids) == {f"{name}_{index:06d}" for name, index in TEST}
    assert {split_of(name) for name in held_out.ids} == {"test"}


def test_what_is_there_stays(library: Path, tmp_path: Path) -> None:
    write_objects(library, tmp_path, counts=(2,), held_out=1, slots=8)
    before = (tmp_path / HELD_OUT).stat().st_mtime_ns
    write_objects(tmp_path / "gone.npz", tmp_path, counts=(2,), held_out=1, slots=8)
    assert (tmp_path / HELD_OUT).stat().st_mtime_ns == before


def test_objects_of_another_library_or_another_number_are_refused(
    library: Path, tmp_path: Path
) -> None:
    """A study would otherwise be judged on one object and say that there were two."""
    folder, other = tmp_path / "objects", tmp_path / "other.npz"
    write_objects(library, folder, counts=(2,), held_out=1, slots=8)
    write_objects(library, folder, counts=(2, 4), held_out=1, slots=8)
    with pytest.raises(UsageError, match="held_out 1, now it is 2"):
        write_objects(library, folder, counts=(2,), held_out=2, slots=8)
    whole = read_library(library)
    write_library(other, taken(whole, range(1, len(whole))))
    with pytest.raises(UsageError, match="library"):
        write_objects(other, folder, counts=(2,), held_out=1, slots=8)


def test_too_few_objects_are_told(library: Path, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="3 objects of the split test .* 9 are asked for"):
        write_objects(library, tmp_path, counts=(), held_out=9, slots=8)
    write_objects(library, tmp_path, counts=(), held_out=9, slots=8, at_most=True)
    assert len(read_library(tmp_path / HELD_OUT)) == 3


def test_objects_that_do_not_fit_stay_out(library: Path) -> None:
    whole = read_library(library)
    kept = ranked_positions(whole, "train", 2)
    assert [whole.part_counts[k] for k in kept] == [2] * len(kept)
    assert 0 < len(kept) < 4
