"""Licences of a set: marked beside the shards, and what may not be handed on is refused."""

import json
from dataclasses import replace

import pytest

from artgen.core.errors import ShardError
from artgen.core.jsonio import write_json
from artgen.dataset import folder as packing
from artgen.dataset.catalog import asset_rows
from artgen.dataset.cli import shard
from artgen.dataset.folder import shard_folder
from artgen.dataset.packing import stage
from artgen.dataset.terms import TERMS
from artgen.export.manifest import manifest
from renders.sources import found_bundles
from tests.strategies import chest
from tests.unit.dataset.runs import made_run
from tests.unit.dataset.scenes import made_sample

PARTNET = {"id": "LicenseRef-PartNet-Mobility", "text": "research only", "distributable": False}
BOUND = "assets/laptop/000002/manifest.json"


def restated(path, **facts):
    write_json(path, {**json.loads(path.read_text()), **facts})


def test_a_set_of_our_own_may_be_handed_on(tmp_path):
    out = made_run(tmp_path / "out")
    assert shard([str(out), "--public"]) == 1  # Some assets were left out, none was refused.
    terms = json.loads((out / "shards" / TERMS).read_text())
    assert terms == {
        "bound": [], "distributable": True, "licences": {"LicenseRef-artgen-output": 5},
        "sources": {},
    }  # fmt: skip


def test_one_asset_that_may_not_be_handed_on_binds_the_set(tmp_path):
    out = made_run(tmp_path / "out")
    restated(out / BOUND, licence=PARTNET)
    with pytest.raises(ShardError, match=r"1 assets may not be handed on \(laptop_000002\)"):
        shard([str(out), "--public"])
    assert not (out / "shards").exists()
    shard([str(out)])
    terms = json.loads((out / "shards" / TERMS).read_text())
    assert terms["distributable"] is False
    assert terms["bound"] == ["laptop_000002"]
    with pytest.raises(ShardError, match="may not be handed on"):
        shard(["publish", str(out), f"file://{tmp_path}/store", "--public"])


def test_a_foreign_source_without_terms_may_not_be_handed_on(tmp_path):
    out = made_run(tmp_path / "out")
    restated(out / BOUND, source={"dataset": "urdf", "id": "x"})
    with pytest.raises(ShardError, match="laptop_000002"):
        shard([str(out), "--public"])


def test_shards_whose_terms_are_not_known_are_not_handed_on(tmp_path):
    out = made_run(tmp_path / "out")
    shard([str(out)])
    (out / "shards" / TERMS).unlink()
    with pytest.raises(ShardError, match="nobody can tell"):
        shard(["publish", str(out), f"file://{tmp_path}/store", "--public"])


INGESTED = ("storage_furniture/pm_45940", "pm_45940")
ASSEMBLED = ("assembled/000000", "assembled_000000")


def foreign_run(out, place, asset_id, **provenance):
    """A run of `artgen ingest` or `artgen assemble`, rendered in place, as `artgen render` does."""
    obj = replace(chest(), category="storage_furniture", asset_id=asset_id, provenance=provenance)
    home = out / "assets" / place
    home.mkdir(parents=True)
    (home / "asset.glb").write_bytes(b"glb")
    write_json(home / "manifest.json", manifest(obj, home))
    (found,) = found_bundles(out)
    stage(out / "samples" / found.sample, made_sample(asset_id, seed=1, views=1))
    return out


@pytest.mark.parametrize(("place", "asset_id"), [INGESTED, ASSEMBLED])
def test_rendered_in_place_ingested_and_assembled_assets_are_packed(tmp_path, place, asset_id):
    """Their folders are called otherwise than those of generated ones: nothing was packed, and so
    nothing refused."""
    out = foreign_run(tmp_path / "out", place, asset_id, licence={"id": "CC-BY-4.0"})
    made = shard_folder(out, public=True)
    assert [id for shard in made.packing.shards for id in shard.ids] == [asset_id]
    (row,) = asset_rows(out, made.packing)
    assert (row["asset_id"], row["category"]) == (asset_id, "storage_furniture")
    assert row["shard"] is not None


@pytest.mark.parametrize(
    ("place", "asset_id", "provenance"),
    [
        (*INGESTED, {"source": {"dataset": "partnet-mobility", "id": "45940"}}),
        (*ASSEMBLED, {"sources": [{"part": "door", "source": "pm_1", "licence": PARTNET["id"]}]}),
    ],
)
def test_what_is_made_from_partnet_is_refused_where_it_really_lies(
    tmp_path, place, asset_id, provenance
):
    free = {"id": "CC0-1.0", "distributable": True}
    out = foreign_run(tmp_path / "out", place, asset_id, licence=free, **provenance)
    with pytest.raises(ShardError, match=rf"1 assets may not be handed on \({asset_id}\)"):
        shard([str(out), "--public"])
    assert not (out / "shards").exists()


def test_works_that_a_set_is_made_from_are_named_by_licence(tmp_path):
    """CC-BY asks for the maker's name, which bundles hold and shards do not."""
    told = [
        {"part": "base", "source": "cabinet_6_000001", "licence": "LicenseRef-artgen-output"},
        {"part": "door", "source": "urdf_fridge", "licence": "CC-BY-4.0"},
    ]
    out = foreign_run(tmp_path / "out", *ASSEMBLED, sources=told, licence={"id": "CC-BY-4.0"})
    shard_folder(out)
    terms = json.loads((out / "shards" / TERMS).read_text())
    assert terms["sources"] == {"CC-BY-4.0": ["urdf_fridge"]}


def test_published_shards_have_their_terms_with_them(tmp_path):
    """They stayed at home, so nobody could tell what lay in the store."""
    out = made_run(tmp_path / "out")
    restated(out / BOUND, licence=PARTNET)
    shard([str(out)])
    (tmp_path / "store").mkdir()
    shard(["publish", str(out), f"file://{tmp_path}/store"])
    there = (tmp_path / "store" / TERMS).read_bytes()
    assert there == (out / "shards" / TERMS).read_bytes()
    assert json.loads(there)["distributable"] is False


def test_packing_that_was_interrupted_leaves_no_terms_of_older_shards(tmp_path, monkeypatch):
    """Else shards that hold a bound asset lie beside terms that know of none."""
    out = made_run(tmp_path / "out")
    shard([str(out)])
    restated(out / BOUND, licence=PARTNET)

    def killed(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(packing, "write_terms", killed)
    with pytest.raises(KeyboardInterrupt):
        shard([str(out)])
    with pytest.raises(ShardError, match="nobody can tell"):
        shard(["publish", str(out), f"file://{tmp_path}/store", "--public"])


def test_shards_packed_anew_from_others_without_terms_have_none(tmp_path):
    out, into = made_run(tmp_path / "out"), tmp_path / "into"
    shard([str(out)])
    shard(["repack", str(out / "shards"), "--into", str(into)])
    assert (into / TERMS).exists()
    (out / "shards" / TERMS).unlink()
    shard(["repack", str(out / "shards"), "--into", str(into), "--per-shard", "2"])
    with pytest.raises(ShardError, match="nobody can tell"):
        shard(["publish", str(into), f"file://{tmp_path}/store", "--public"])


@pytest.mark.parametrize("facts", [{"bound": []}, {"bound": [], "distributable": False},
                                   {"bound": ["x"], "distributable": True}])  # fmt: skip
def test_terms_that_contradict_themselves_are_not_believed(tmp_path, facts):
    out = made_run(tmp_path / "out")
    shard([str(out)])
    write_json(out / "shards" / TERMS, facts)
    with pytest.raises(ShardError, match="nobody can tell"):
        shard(["publish", str(out), f"file://{tmp_path}/store", "--public"])
