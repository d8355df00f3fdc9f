import dataclasses

import pytest

from artgen.core.errors import ModelError
from artgen.progress import silent
from model.data import make
from model.data.library import read_library
from model.data.make import Request, dealt, make_library
from tests.strategies import drawer_unit
from tests.unit.model.data.small import written_bundle

REQUEST = Request(counts={"cabinet": 3, "cardboard_box": 2}, seed=4, tolerance=0.02)


@pytest.fixture(autouse=True)
def _small_chunks(monkeypatch):
    monkeypatch.setattr(make, "CHUNK", 2)


def test_objects_are_dealt_out_in_turn():
    assert dealt(["a", "b", "c"], 8) == {"a": 3, "b": 3, "c": 2}


def test_an_interrupted_run_goes_on_and_ends_in_the_same_bytes(tmp_path, monkeypatch):
    whole, cut = tmp_path / "whole.npz", tmp_path / "cut.npz"
    make_library(whole, REQUEST, workers=1, show=silent)
    built = []

    def interrupted(tasks, work, **options):
        for task in tasks:
            if built:
                raise KeyboardInterrupt
            built.append(task.asset_id)
            yield work(task)

    with monkeypatch.context() as patch:
        patch.setattr(make, "run_in_processes", interrupted)
        with pytest.raises(KeyboardInterrupt):
            make_library(cut, REQUEST, workers=1, show=silent)
    again = []

    def here(tasks, work, **options):
        for task in tasks:
            again.append(task.asset_id)
            yield work(task)

    monkeypatch.setattr(make, "run_in_processes", here)
    assert make_library(cut, REQUEST, workers=1, show=silent) == {}
    assert built == ["cabinet_000000"]
    assert again == ["cabinet_000002", "cardboard_box_000000"]
    assert cut.read_bytes() == whole.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cut.npz", "whole.npz"]
    assert read_library(cut).ids[-1] == "cardboard_box_000001"


def test_another_library_is_not_overwritten(tmp_path):
    path = tmp_path / "a.npz"
    path.write_bytes(b"notes of mine")
    with pytest.raises(ModelError, match="is no library"):
        make_library(path, REQUEST, workers=1, show=silent)
    assert path.read_bytes() == b"notes of mine"


def test_an_object_that_cannot_be_built_is_reported(tmp_path, monkeypatch):
    real = make.seed_soup

    def failing(category, seed, index, *, tolerance):
        if index == 1:
            raise ModelError("no valid sample")
        return real(category, seed, index, tolerance=tolerance)

    monkeypatch.setattr(make, "seed_soup", failing)
    monkeypatch.setattr(make, "run_in_processes", lambda tasks, work, **_: map(work, tasks))
    failed = make_library(tmp_path / "a.npz", REQUEST, workers=1, show=silent)
    assert failed == {
        "cabinet_000001": "no valid sample",
        "cardboard_box_000001": "no valid sample",
    }
    assert len(read_library(tmp_path / "a.npz")) == 3


def test_bundles_join_and_ids_must_differ(tmp_path, monkeypatch):
    monkeypatch.setattr(make, "run_in_processes", lambda tasks, work, **_: map(work, tasks))
    folder = written_bundle(drawer_unit(), tmp_path / "bundle")
    request = dataclasses.replace(REQUEST, counts={"cabinet": 1}, bundles=(folder,))
    make_library(tmp_path / "a.npz", request, workers=1, show=silent)
    assert read_library(tmp_path / "a.npz").ids == ("cabinet_000000", drawer_unit().asset_id)
    twice = dataclasses.replace(request, bundles=(folder, folder))
    with pytest.raises(ModelError, match="1 objects have the id of another"):
        make_library(tmp_path / "b.npz", twice, workers=1, show=silent)


def test_a_chunk_of_failures_is_an_error(tmp_path, monkeypatch):
    def failing(*_, **__):
        raise ModelError("no valid sample")

    monkeypatch.setattr(make, "seed_soup", failing)
    monkeypatch.setattr(make, "run_in_processes", lambda tasks, work, **_: map(work, tasks))
    with pytest.raises(ModelError, match="none of 2 objects"):
        make_library(tmp_path / "a.npz", REQUEST, workers=1, show=silent)
