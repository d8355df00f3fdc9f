"""Parts with open surfaces, which most fragments of PartNet-Mobility are: templates and donors like
any others, weighed as the sheets that they were ingested as."""

from dataclasses import replace

import numpy as np
import pytest

from artgen.articulation.types import ArticulatedObject
from artgen.assembly.assemble import Assembled, assembled, finished
from artgen.assembly.case import case_of
from artgen.assembly.choice import Market
from artgen.assembly.fit import moved_piece
from artgen.assembly.invariants import broken
from artgen.assembly.library import Library, is_slot, write_library
from artgen.assembly.piece import joined, picked, piece_of_part, weighed
from artgen.assembly.source import Source, shells_of, source_of_object
from artgen.assembly.store import read_source
from artgen.core.jsonio import plain
from artgen.core.licence import licence_of
from artgen.core.stream import Stream
from artgen.export.manifest import closed_volume, open_bodies
from artgen.geometry.measure import closed
from artgen.ingest.build import build
from artgen.ingest.options import Options
from artgen.ingest.partnet.folder import read_partnet
from artgen.validate.origin import origin_of
from tests.unit.ingest.folders import box_obj, cabinet

BACKLESS = (0, 1, 2, 3, 5)
"""Sides of a box without the one that looks away from the viewer."""
SHEET = (5,)
DOOR = "original-7"


def ingested(place, *, door=BACKLESS, handle=True, higher=0.0) -> ArticulatedObject:
    """The cabinet of the tests of ingest, its fragments open as they are in the data set.

    Args:
        door: sides that the door shows.
        handle: whether it has one.
        higher: mesh units by which the door is longer.
    """
    folder = cabinet()
    if not handle:
        folder.objs[8] = []
    lower, upper = folder.boxes[DOOR]
    folder.boxes[DOOR] = (lower, (upper[0], upper[1] - higher, upper[2]))
    for stem, span in folder.boxes.items():
        own = door if stem == DOOR else BACKLESS
        folder.texts[stem] = box_obj(span, name=stem, sides=own)
    root = folder.write(place)
    return build(
        read_partnet(root), Options(pieces=0), asset_id="pm_x", category="storage_furniture"
    ).obj


def source_from(obj: ArticulatedObject, id: str) -> Source:
    return source_of_object(
        obj, id=id, licence=licence_of(obj.provenance), dataset="partnet-mobility", family="f"
    )


@pytest.fixture(scope="module")
def backless(tmp_path_factory) -> ArticulatedObject:
    return ingested(tmp_path_factory.mktemp("pm") / "1")


@pytest.fixture(scope="module")
def sources(tmp_path_factory, backless) -> list[Source]:
    other = ingested(tmp_path_factory.mktemp("pm") / "2", higher=0.1)
    return [source_from(backless, "one"), source_from(other, "two")]


@pytest.fixture(scope="module")
def shells_library(tmp_path_factory, sources) -> Library:
    folder = tmp_path_factory.mktemp("library")
    write_library(folder, sources, recipe={})
    return Library(folder)


@pytest.fixture(scope="module")
def new(shells_library) -> Assembled:
    market = Market(shells_library, ("storage_furniture",))
    made = assembled(market, "one", Stream(0))
    assert isinstance(made, Assembled), made
    return made


def same_mass(one, other) -> None:
    """Densities divide by the very integrals that masses multiply by: a few roundings."""
    assert one.mass == pytest.approx(other.mass, rel=1e-12)
    np.testing.assert_allclose(one.center, other.center, rtol=0, atol=1e-12)
    np.testing.assert_allclose(one.inertia, other.inertia, rtol=1e-9, atol=1e-12)


def test_open_parts_weigh_what_they_weighed_when_they_came_in(backless):
    """A base whose boards have no backs raised `not a rigid body`; a door lost 73 % of its mass."""
    for part in backless.parts:
        piece = piece_of_part(part, shells_of(backless.provenance, part.name))
        assert len(piece.shells) == len(piece.densities)
        same_mass(weighed(piece), part.mass)


def test_taken_apart_and_put_together_nothing_is_lost(backless, sources):
    by_name = {part.name: part for part in backless.parts}
    assert any(member.handle is not None for member in sources[0].members)
    for member in sources[0].members:
        whole = joined(member.pieces)
        assert sorted(whole.shells) == list(range(len(whole.densities)))
        same_mass(weighed(whole), by_name[member.name].mass)


def test_shells_keep_to_their_bodies_when_bodies_are_picked_and_joined(backless):
    whole = replace(piece_of_part(backless.parts[0]), shells={1: 0.002, 3: 0.004})
    assert picked(whole, [3, 0, 1]).shells == {0: 0.004, 2: 0.002}
    both = joined([picked(whole, [0, 1]), picked(whole, [2, 3])])
    assert both.shells == {1: 0.002, 3: 0.004}


def test_a_sheet_twice_as_large_weighs_four_times_as_much(backless):
    """Its thickness stays; a closed body would weigh eight times as much."""
    part = backless.parts[0]
    piece = piece_of_part(part, shells_of(backless.provenance, part.name))
    large = moved_piece(piece, np.diag([2.0, 2.0, 2.0, 1.0]))
    assert weighed(large).mass == pytest.approx(4.0 * weighed(piece).mass, rel=1e-9)


def test_shells_come_out_of_a_library_as_they_went_in(shells_library, sources):
    for source in sources:
        found = read_source(shells_library.folder, source.id)
        assert [p.shells for p in found.pieces] == [p.shells for p in source.pieces]
        assert any(p.shells for p in found.pieces)


def test_an_object_of_open_parts_keeps_every_invariant(new, shells_library):
    assert {entry["source"] for entry in new.given} == {"two"}
    assert broken(case_of(new, shells_library)) == []


def test_its_manifest_tells_which_bodies_are_open(new):
    """As the manifest of an ingested object does, so that validation excuses just these."""
    obj = finished(new, asset_id="x", provenance={})
    said = plain(obj.provenance)
    origin = origin_of(said)
    assert origin.foreign
    assert origin.thickness == Options().thickness
    for part in obj.parts:
        bodies = np.asarray(part.mesh.body)
        opened = [k for k in range(bodies.max() + 1) if not closed(part.mesh.faces[bodies == k])]
        assert sorted(origin.shells[part.name]) == opened == open_bodies(said, part.name)
        assert closed_volume(part.mesh, opened) == 0.0
        assert part.densities is None
        assert part.mass.mass > 0.0


def test_a_door_that_is_a_flat_sheet_stays_with_its_object(tmp_path, sources):
    """It cost the whole object its place in the library: `a slab from ... is empty`. With a handle
    it is moved as a whole; bare it has no depth that could be brought to that of another."""
    held = source_from(ingested(tmp_path / "held", door=SHEET), "held")
    assert door_of(held).kind == "whole"
    bare = source_from(ingested(tmp_path / "bare", door=SHEET, handle=False), "bare")
    assert np.diff(door_of(bare).body.bounds, axis=0)[0, 1] == 0.0
    write_library(tmp_path / "library", [held, bare, *sources], recipe={})
    library = Library(tmp_path / "library")
    doors = {e.source: is_slot(e) for e in library.entries if e.label == "door"}
    assert doors == {"held": True, "bare": False, "one": True, "two": True}
    market = Market(library, ("storage_furniture",))
    for template in ("held", "bare"):
        made = assembled(market, template, Stream(0))
        assert isinstance(made, Assembled), made
        assert broken(case_of(made, library)) == []
        assert all(
            part.mass.mass > 0.0 for part in finished(made, asset_id="x", provenance={}).parts
        )


def door_of(source):
    return next(member for member in source.members if member.label == "door")
