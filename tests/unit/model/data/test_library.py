import dataclasses

import numpy as np
import pytest

from artgen.core.errors import ModelError
from model.data.library import STEPS, joined, packed, read_library, taken, write_library
from model.data.soup import Soup
from tests.unit.model.data.small import library, soup


def test_a_library_gives_its_soups_back(tmp_path):
    write_library(tmp_path / "a.npz", library())
    back = read_library(tmp_path / "a.npz")
    assert len(back) == 6
    for k, name in enumerate(back.ids):
        category, index = name.rsplit("_", 1)
        _assert_same(back[k], soup(category, int(index)))


def test_joining_is_packing_together():
    soups = [soup("cabinet", 0), soup("laptop"), soup("cabinet", 1)]
    whole, parts = packed(soups), joined([packed(soups[:1]), packed(soups[1:])])
    assert whole.ids == parts.ids
    assert np.array_equal(whole.starts, parts.starts)
    for name, column in whole.columns.items():
        assert np.array_equal(column, parts.columns[name]), name


def test_what_is_taken_is_what_would_have_been_packed():
    chosen = taken(library(), [4, 0, 3])
    alone = packed([soup("cardboard_box"), soup("cabinet", 0), soup("laptop")])
    assert chosen.ids == alone.ids
    assert chosen.categories == alone.categories
    assert np.array_equal(chosen.starts, alone.starts)
    for name, column in alone.columns.items():
        assert np.array_equal(column, chosen.columns[name]), name


def test_equal_libraries_are_equal_bytes(tmp_path):
    for name in ("a.npz", "b.npz"):
        write_library(tmp_path / name, packed([soup("laptop")]))
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_slices_are_lists():
    assert [made.category for made in library()[3:5]] == ["laptop", "cardboard_box"]


@pytest.mark.parametrize("kept", [0, 100, 20_000])
def test_a_truncated_library_is_named(tmp_path, kept):
    path = tmp_path / "a.npz"
    write_library(path, library())
    path.write_bytes(path.read_bytes()[:kept])
    with pytest.raises(ModelError, match=r"a\.npz: is no library.*train-data"):
        read_library(path)


def test_a_missing_library_says_how_to_make_one(tmp_path):
    with pytest.raises(ModelError, match="no such library; make one with"):
        read_library(tmp_path / "none.npz")


def test_another_npz_is_refused(tmp_path):
    np.savez(tmp_path / "a.npz", names=np.frombuffer(b"{}", np.uint8))
    with pytest.raises(ModelError, match="is no library"):
        read_library(tmp_path / "a.npz")


def test_nothing_is_no_library():
    with pytest.raises(ModelError, match="no soup"):
        packed([])


def test_more_vertices_than_16_bits_name_are_refused():
    made = soup("laptop")
    many = np.zeros((STEPS + 1, 3), np.float32)
    with pytest.raises(ModelError, match="larger tolerance"):
        packed([dataclasses.replace(made, vertices=many)])


def _assert_same(found: Soup, expected: Soup) -> None:
    exact = ("asset_id", "category", "parts", "joints", "preconditions", "radius")
    assert [getattr(found, name) for name in exact] == [getattr(expected, name) for name in exact]
    for name in ("bounds", "center", "faces", "part", "body", "surface", "looks"):
        assert np.array_equal(getattr(found, name), getattr(expected, name)), name
    extent = np.ptp(expected.vertices, axis=0)
    # Half a step, and the float32 roundings of coordinates up to 3 m before and after (3e-7).
    assert (np.abs(found.vertices - expected.vertices) <= extent / STEPS / 2 + 6e-7).all()
