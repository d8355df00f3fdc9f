"""Runs: deterministic, resumable, no object twice; what cannot be made says why.

12: equal seeds give equal objects, other seeds others. 13: of two equal objects one is set aside.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console

from artgen.assembly.assemble import Assembled, GivenUp, assembled, finished
from artgen.assembly.build import sharp
from artgen.assembly.choice import Market
from artgen.assembly.cli import tell_terms
from artgen.assembly.harvest import Made, made_source
from artgen.assembly.library import Library, write_library
from artgen.assembly.looks import stuff_of
from artgen.assembly.run import (
    AssembleTask,
    Bench,
    check_kept,
    make_object,
    new_object,
    opened_market,
    set_twins_aside,
)
from artgen.core.errors import ExportError, UsageError
from artgen.core.jsonio import write_json
from artgen.core.licence import PARTNET
from artgen.core.stream import Stream
from artgen.export.manifest import versions
from artgen.run_folder import RunFolder
from tests.exported import write_without_blender

WHAT = "storage_furniture"


def content(new):
    obj = finished(new, asset_id="x", provenance={})
    arrays = [part.mesh.vertices for part in obj.parts] + [part.mesh.uv for part in obj.parts]
    return arrays + [part.mesh.atlas for part in obj.parts], obj.provenance["hashes"]


def test_12_equal_seeds_give_equal_objects_in_any_process_and_order(market):
    """Another process has read nothing yet and makes the second object first."""
    other = Market(Library(market.library.folder), ("storage_furniture", "cabinet"))
    there = {k: new_object(other, WHAT, 5, k) for k in (1, 0)}
    for index in (0, 1):
        here = new_object(market, WHAT, 5, index)
        assert isinstance(here, Assembled)
        assert here.sources == there[index].sources
        for one, same in zip(content(here)[0], content(there[index])[0], strict=True):
            assert np.array_equal(one, same)


def written(new, folder):
    """Every file of a bundle that needs no Blender, by its path: bytes."""
    write_without_blender(finished(new, asset_id="x", provenance={"seed": 5}), folder)
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_12_equal_seeds_give_equal_bytes(market, tmp_path):
    """OBJ, URDF, MJCF and USD of an object made twice, by a process that made another before; the
    control is another seed. Of GLB and thumbnails see the next one."""
    other = Market(Library(market.library.folder), ("storage_furniture", "cabinet"))
    new_object(other, WHAT, 5, 3)
    here, there, seed = (
        written(new_object(m, WHAT, s, 0), tmp_path / name)
        for m, s, name in ((market, 5, "a"), (other, 5, "b"), (market, 6, "c"))
    )
    assert {"asset.urdf", "asset.xml", "asset.usdc"} <= here.keys()
    assert here == there
    assert any(here.get(name) != content for name, content in seed.items())


@pytest.mark.blender
def test_12_whole_bundles_are_equal_whatever_the_process_made_before(library, tmp_path):
    """Every file, GLB, textures, thumbnail and the validation's report included; run b makes
    another object first, as a second worker would."""
    bundles = {}
    for name, indices in (("a", (0,)), ("b", (1, 0))):
        folder = RunFolder(tmp_path / name)
        bench = Bench(folder, library.folder, WHAT)
        tasks = [replace(task(k, seed=5), library=library.folder) for k in indices]
        with bench.tools.blender:
            made = [make_object(one, bench) for one in tasks]
        assert [outcome.status for outcome in made] == ["made"] * len(indices), made
        home = tasks[-1].place(folder.assets)
        bundles[name] = {
            str(p.relative_to(home)): p.read_bytes() for p in home.rglob("*") if p.is_file()
        }
    assert "asset.glb" in bundles["a"]
    assert "manifest.json" in bundles["a"]
    assert bundles["a"] == bundles["b"]


def test_12_other_seeds_and_indices_give_other_objects(market):
    made = [new_object(market, WHAT, seed, index) for seed in (1, 2) for index in range(6)]
    hashes = [new.hashes["object"] for new in made if isinstance(new, Assembled)]
    assert len(hashes) >= 10
    assert len(set(hashes)) == len(hashes)


def test_templates_are_dealt_out_evenly(market):
    count = len(market.template_ids)
    dealt = [new_object(market, WHAT, 3, index).template for index in range(2 * count)]
    assert sorted(dealt[:count]) == sorted(dealt[count:]) == sorted(market.template_ids)
    assert dealt[:count] != dealt[count:]


def test_new_objects_change_fronts_and_keep_the_body(cases):
    for case in cases:
        slots = len(case.new.seams)
        changed = {e["part"] for e in case.new.given}
        assert len(changed) >= slots / 2.0
        assert np.array_equal(case.new.parts[0][2].mesh.faces, case.template.base.mesh.faces)
        used = {e["source"] for e in case.new.given}
        assert case.template.id not in used


def test_where_no_handle_is_offered_each_front_keeps_its_own(market, monkeypatch):
    """A split of few sources may have none; there was no first one to try."""
    monkeypatch.setattr(Market, "handle_order", lambda self, split, stream: [])
    made = [new_object(market, WHAT, 1, index) for index in range(4)]
    objects = [new for new in made if isinstance(new, Assembled)]
    handles = [(e["source"], new.template) for new in objects for e in new.sources
               if e["piece"] == "handle"]  # fmt: skip
    assert handles
    assert all(source == template for source, template in handles)


def test_one_wood_one_metal(cases):
    """All panels of fronts look alike, and all handles."""
    for case in cases:
        by_name = {s.name: s for s in case.new.surfaces}
        assert sum(name.startswith("front") and s.recipe in ("wood", "paint")
                   for name, s in by_name.items()) <= 1  # fmt: skip
        shown = set()
        for name in case.new.seams:
            handle = case.new.layer(name, "handle")
            shown |= {case.new.surfaces[k].name for k in handle.slots} if handle else set()
        assert len({n for n in shown if by_name[n].metallic > 0.5 or n == "handle"}) <= 1


def test_a_flap_that_no_donor_replaces_has_the_wood_of_the_other_fronts(tmp_path, made_sources):
    """A whole flap keeps its shape, its leather and its lock, and is not left in its old wood."""
    family = {"family": "cabinet_6_000000"}
    secretary = next(s for s in made_sources if s.id == "storage_furniture_6_000001")
    fewer = [m for m in secretary.members if not m.name.startswith("small")]
    assert len(fewer) < 8
    others = [replace(s, **family) for s in made_sources if s.id != secretary.id]
    write_library(
        tmp_path, [replace(secretary, members=tuple(fewer), **family), *others], recipe={}
    )
    market = Market(Library(tmp_path), ("storage_furniture", "cabinet"))
    found = [assembled(market, secretary.id, Stream(k)) for k in range(6)]
    new = next(new for new in found if isinstance(new, Assembled) and "flap" not in new.seams)
    fronts = [new.layer(name, "body") for name in new.seams if "drawer" in name]

    def panels(piece):
        return {k for k in piece.slots if stuff_of(new.surfaces[k]) in ("wood", "paint")}

    flap = new.piece("flap")
    assert panels(flap) == {k for piece in fronts for k in panels(piece)}
    assert set(flap.slots) > panels(flap)


def test_what_cannot_be_made_says_why(market):
    lonely = Market(market.library, ("storage_furniture", "cabinet"))
    lonely.__dict__["suitable"] = {key: () for key in market.suitable}
    found = assembled(lonely, market.template_ids[0], Stream(0))
    assert isinstance(found, GivenUp)
    assert "would be the template's own" in found.reason
    assert found.tried


def task(index, seed=1):
    return AssembleTask(what=WHAT, index=index, seed=seed, library=RunFolder("x").root)


def stated(folder, index, **facts):
    home = task(index).place(folder.assets)
    home.mkdir(parents=True)
    write_json(home / "manifest.json", {"seed": 1, "library": "d", "versions": versions(), **facts})


def test_13_of_equal_objects_the_first_stays(tmp_path):
    folder = RunFolder(tmp_path)
    for index, digest in enumerate(("a", "b", "a")):
        stated(folder, index, hashes={"object": digest})
    tasks = [task(index) for index in (2, 0, 1)]
    outcomes = set_twins_aside(folder, tasks)
    assert [(o.asset_id, o.message) for o in outcomes] == [
        ("assembled_000002", "is the same object as assembled_000000")
    ]
    assert sorted(p.parent.name for p in folder.assets.rglob("manifest.json")) == [
        "000000",
        "000001",
    ]
    error = json.loads((task(2).place(folder.failed) / "error.json").read_text())
    assert "same object" in error["error"]


def test_13_two_identical_seeds_are_caught(market):
    """The control: the same seed twice is the same object."""
    one, other = (new_object(market, WHAT, 1, 0) for _ in range(2))
    assert one.hashes["object"] == other.hashes["object"]
    repainted = replace(
        other, surfaces=tuple(replace(s, color=(0.1, 0.2, 0.3)) for s in other.surfaces)
    )
    assert repainted.hashes["object"] != one.hashes["object"]


def test_a_run_goes_on_where_it_stopped_but_not_with_another_library(tmp_path):
    folder = RunFolder(tmp_path)
    stated(folder, 0)
    assert check_kept(folder, [task(0), task(1)], "d") == {"assembled_000000"}
    with pytest.raises(UsageError, match="another library"):
        check_kept(folder, [task(0)], "e")
    with pytest.raises(UsageError, match="another seed"):
        check_kept(folder, [replace(task(0), seed=2)], "d")


@pytest.mark.parametrize("category", ["safe", "cabinet"])
def test_a_library_from_which_nothing_can_be_made_says_so(tmp_path, category):
    """A safe is no template, and one cabinet alone has no donors: each object of a run was an
    internal fault, a division by zero."""
    write_library(tmp_path, [made_source(Made(category=category, index=0), sharp)], recipe={})
    with pytest.raises(UsageError, match="nothing can be made from its 1 sources"):
        opened_market(tmp_path, WHAT)


def test_a_damaged_manifest_of_an_earlier_run_is_told(tmp_path):
    folder = RunFolder(tmp_path)
    stated(folder, 0)
    (task(0).place(folder.assets) / "manifest.json").write_text("{")
    with pytest.raises(ExportError, match="remove its folder"):
        check_kept(folder, [task(0)], "d")
    with pytest.raises(ExportError, match="remove its folder"):
        set_twins_aside(folder, [task(0)])


def test_who_assembles_from_bound_sources_is_told(tmp_path, made_sources, library, capsys):
    console = Console(width=400)
    tell_terms(library, console)
    assert not capsys.readouterr().out
    write_library(tmp_path, [replace(made_sources[0], licence=PARTNET)], recipe={})
    tell_terms(Library(tmp_path), console)
    assert (
        f"1 sources of the library may not be handed on ({PARTNET.id})" in capsys.readouterr().out
    )
