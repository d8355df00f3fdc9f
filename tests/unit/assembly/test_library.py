"""A library on disk: what goes in comes out, rows tell what pieces are, equal input equal bytes."""

import json
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest

from artgen.assembly.choice import Market, suits
from artgen.assembly.library import MOST_PARTS, Library, is_slot, seal_library, write_library
from artgen.assembly.shape_hash import shape_hash
from artgen.assembly.store import read_source
from artgen.core.errors import UsageError
from artgen.core.licence import KNOWN
from artgen.core.stream import Stream
from artgen.dataset.split import split_of


def files(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes()
            for p in sorted(folder.rglob("*")) if p.is_file()}  # fmt: skip


def test_sources_come_out_as_they_went_in(library, made_sources):
    for source in made_sources[:4]:
        found = read_source(library.folder, source.id)
        assert found.surfaces == source.surfaces
        assert found.preconditions == source.preconditions
        for one, other in zip(found.members, source.members, strict=True):
            assert (one.name, one.kind, one.side) == (other.name, other.kind, other.side)
            assert one.joint == other.joint
        for one, other in zip(found.pieces, source.pieces, strict=True):
            assert one.grips == other.grips
            assert one.densities == other.densities
            for key in ("vertices", "faces", "uv", "slot", "body"):
                assert np.array_equal(getattr(one.mesh, key), getattr(other.mesh, key))
            assert len(one.collision) == len(other.collision)
            for a, b in zip(one.collision, other.collision, strict=True):
                assert np.array_equal(a.triangles, b.triangles)


def test_equal_sources_give_equal_bytes_in_any_order(tmp_path, made_sources):
    digests = [
        write_library(tmp_path / name, order, recipe={})
        for name, order in (("a", made_sources[:3]), ("b", made_sources[2::-1]))
    ]
    assert digests[0] == digests[1]
    assert files(tmp_path / "a") == files(tmp_path / "b")


def test_the_index_tells_boxes_sides_handles_and_licences(tmp_path, made_sources):
    partnet = KNOWN["LicenseRef-PartNet-Mobility"]
    write_library(tmp_path, [replace(made_sources[0], licence=partnet)], recipe={})
    rows = pq.read_table(tmp_path / "index.parquet").to_pylist()
    source = made_sources[0]
    assert [row["name"] for row in rows] == ["base", *(m.name for m in source.members)]
    for row, piece in zip(rows, [source.base, *(m.body for m in source.members)], strict=True):
        assert np.allclose(
            (row["width"], row["depth"], row["height"]), np.diff(piece.bounds, axis=0)
        )
        assert (row["licence"], row["distributable"]) == (partnet.id, False)


def test_a_shape_is_not_offered_in_two_splits(tmp_path, made_sources):
    """A source that comes twice, as two families that lie in different splits."""
    one = made_sources[0]
    twin = replace(one, id=f"{one.id}_twin", family="cabinet_6_000001")
    other = next(f"x{k}" for k in range(99) if split_of(f"x{k}") != split_of("cabinet_6_000001"))
    write_library(tmp_path, [replace(one, family=other), twin], recipe={})
    entries = Library(tmp_path).entries
    splits = {}
    for entry in entries:
        assert splits.setdefault(entry.shape, entry.split) == entry.split


def test_a_handle_is_not_offered_in_two_splits(tmp_path, made_sources):
    """Fronts alone were held apart: one knob was offered in all three splits."""
    one, two = made_sources[:2]
    knob = next(member.handle for member in one.members if member.handle)
    given = tuple(replace(m, handle=knob) if m.handle else m for m in two.members)
    families = {split_of(f"x{k}"): f"x{k}" for k in range(99)}
    sources = [
        replace(one, family=families["val"]),
        replace(two, family=families["train"], members=given),
    ]
    write_library(tmp_path, sources, recipe={})
    market = Market(Library(tmp_path), ("storage_furniture", "cabinet"))
    shape = shape_hash(knob.mesh)
    assert {e.split for e in market.handles if e.handle_shape == shape} == {"train", "val"}
    offered = [
        split
        for split in ("train", "val", "test")
        for entry in market.handle_order(split, Stream(0))
        if entry.handle_shape == shape
    ]
    first = min(sources, key=lambda source: source.id)
    assert offered == [split_of(first.family)]


def test_a_folder_that_is_no_library_is_told(tmp_path):
    with pytest.raises(UsageError, match="artgen library build"):
        Library(tmp_path)
    (tmp_path / "library.json").write_text(json.dumps({"schema": "artgen-library/0"}))
    with pytest.raises(UsageError, match="artgen-library/0"):
        Library(tmp_path)
    with pytest.raises(UsageError, match="nobody"):
        seal_library(tmp_path, ["nobody"], recipe={})


def test_templates_are_small_and_have_fronts_to_change(library, market):
    for template in market.template_ids:
        members = library.members(template)
        assert len(members) + 1 <= MOST_PARTS
        slots = [e for e in members if is_slot(e)]
        assert np.mean([bool(market.suitable[e.source, e.number]) for e in slots]) > 0.5


def test_donors_suit_by_kind_side_proportion_and_split(market):
    entries = [e for e in market.donors if e.label == "door" and e.kind == "front"]
    door = next(e for e in entries if e.side == "left")
    twin = replace(door, source="other")
    assert suits(twin, door)
    assert suits(replace(twin, side="right"), door)
    for change in (
        {"source": door.source}, {"side": "bottom"}, {"side": "along"}, {"kind": "whole"},
        {"label": "drawer"}, {"joint": "prismatic"}, {"split": "nowhere"},
        {"width": 2.1 * door.width}, {"depth": 3.1 * door.depth}, {"stuffs": "print wood"},
        {"width": 2.6 * door.width, "height": 2.6 * door.height},
    ):  # fmt: skip
        assert not suits(replace(twin, **change), door), change


def test_weights_even_out_the_use_of_donors(market):
    """Expected use under the weights is nearer to even than under equal chances."""
    rows = [np.array(places) for places in market.suitable.values() if places]

    def spread(weights):
        use = np.zeros(len(weights))
        for places in rows:
            use[places] += weights[places] / weights[places].sum()
        used = use[use > 0.0]
        return used.std() / used.mean()

    assert spread(market.weights) < 0.7 * spread(np.ones(len(market.donors)))


def test_groups_hold_every_slot_once(market):
    for template in market.template_ids:
        for k in range(3):
            groups = market.groups(template, Stream(k))
            names = [slot.name for group in groups for slot in group.slots]
            wanted = [e.name for e in market.library.members(template) if is_slot(e)]
            assert sorted(names) == sorted(wanted)


def test_a_market_of_another_process_is_the_same(market):
    again = Market(Library(market.library.folder), ("storage_furniture", "cabinet"))
    assert again.template_ids == market.template_ids
    assert np.array_equal(again.weights, market.weights)
