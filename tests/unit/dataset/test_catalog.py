"""The catalog answers questions in one line, and its bytes follow from the assets alone."""

import json
import shutil

import duckdb
import pandas as pd
import pyarrow.parquet as pq
import pytest

from artgen.core.errors import ShardError
from artgen.dataset.catalog import ASSETS, SAMPLES, asset_rows, write_catalog
from artgen.dataset.folder import shard_folder
from artgen.dataset.packing import Packing
from artgen.dataset.reader import ShardDataset, open_shard
from artgen.dataset.split import split_of
from tests.unit.dataset.runs import OPENING_DEG, WIDE, made_run


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run folder with shards and catalog."""
    out = made_run(tmp_path_factory.mktemp("run"))
    return shard_folder(out, per_shard=2), out


def test_an_ingested_asset_has_the_split_of_its_family(tmp_path):
    """That of its own id was another for a third of PartNet-Mobility's ids than a library gave."""
    out = made_run(tmp_path)
    path = out / "assets" / "laptop" / "000002" / "manifest.json"
    other = next(f"x:{k}" for k in range(99) if split_of(f"x:{k}") != split_of("laptop_000002"))
    source = {"dataset": "x", "id": "0", "family": other}
    path.write_text(json.dumps({**json.loads(path.read_text()), "source": source}))
    packing = Packing(per_shard=1, shards=(), left_out={})
    row = next(row for row in asset_rows(out, packing) if row["asset_id"] == "laptop_000002")
    assert row["split"] == split_of(other)
    assert row["donors"] == [other]


def test_duckdb_finds_the_laptops_that_open_past_120_degrees(run, monkeypatch):
    monkeypatch.chdir(run[1])
    for condition in (
        "opening_deg > 120",
        "len(list_filter(joints, lambda j: j.type = 'revolute' AND j.upper_deg > 120)) > 0",
    ):
        rows = duckdb.sql(
            "SELECT asset_id FROM 'catalog/assets.parquet' "
            f"WHERE category = 'laptop' AND verdict = 'valid' AND {condition}"
        ).fetchall()
        assert [name for (name,) in rows] == WIDE


def test_pandas_finds_the_laptops_that_open_past_120_degrees(run):
    assets = pd.read_parquet(run[1] / "catalog" / "assets.parquet")
    laptops = assets.query("category == 'laptop' and verdict == 'valid'")
    assert laptops.query("opening_deg > 120").asset_id.tolist() == WIDE
    wide = laptops.joints.map(lambda joints: any(j["upper_deg"] > 120 for j in joints))
    assert laptops[wide].asset_id.tolist() == WIDE


def test_every_asset_has_one_row_with_what_its_manifest_states(run):
    sharded, out = run
    rows = {row["asset_id"]: row for row in pq.read_table(sharded.catalog[0]).to_pylist()}
    assert list(rows) == sorted([*OPENING_DEG, "cabinet_000001", "laptop_000004", "laptop_000005"])
    stated = json.loads((out / "assets" / "laptop" / "000002" / "manifest.json").read_text())
    row = rows["laptop_000002"]
    assert (row["mass"], row["radius"], row["seed"]) == (stated["mass"], stated["radius"], 7)
    assert row["width"] == stated["bounds"][1][0] - stated["bounds"][0][0]
    assert row["joints"][0]["upper"] == stated["joints"][0]["upper"]
    assert [part["name"] for part in row["parts"]] == [part["name"] for part in stated["parts"]]
    assert (row["files"], row["bytes"], row["folder"]) == (1, 3, "assets/laptop/000002")
    assert (row["verdict"], row["reason"], row["split"]) == (
        "valid",
        None,
        split_of("laptop_000002"),
    )


def test_assets_without_a_sample_say_why(run):
    rows = {row["asset_id"]: row for row in pq.read_table(run[0].catalog[0]).to_pylist()}
    expected = {
        "cabinet_000001": ("valid", "not rendered"),
        "laptop_000004": ("failed", "L3.clearance: lid: lid hits base"),
        "laptop_000005": ("failed", "worker crashed"),
    }
    for name, verdict in expected.items():
        assert (rows[name]["verdict"], rows[name]["reason"]) == verdict
        assert rows[name]["shard"] is None
    assert run[0].packing.left_out == {name: reason for name, (_, reason) in expected.items()}


def test_sliders_have_no_degrees(run):
    rows = {row["asset_id"]: row for row in pq.read_table(run[0].catalog[0]).to_pylist()}
    slides = [joint for joint in rows["cabinet_000001"]["joints"] if joint["type"] == "prismatic"]
    assert slides
    assert all(joint["upper_deg"] is None for joint in slides)
    assert rows["cabinet_000001"]["travel"] == max(joint["upper"] for joint in slides)
    assert rows["laptop_000000"]["travel"] is None


def test_every_packed_sample_has_one_row_that_leads_to_it(run):
    sharded, _ = run
    rows = pq.read_table(sharded.catalog[1]).to_pylist()
    assert [row["asset_id"] for row in rows] == sorted(OPENING_DEG)
    for row in rows:
        sample = open_shard(sharded.shards / row["shard"]).read(row["asset_id"])
        shape = (row["states"], row["views"], row["parts"], row["height"], row["width"])
        assert shape == sample.shape
        names = [joint.name for joint in sample.meta.joints]
        assert [[dict(q)[name] for name in names] for q in row["q"]] == sample.q.tolist()
        assert row["shard"].startswith(row["split"])


def test_no_asset_leaks_from_one_split_to_another(run):
    ids = {
        path.name.split("-")[0]: ShardDataset(run[0].shards, split=path.name.split("-")[0]).ids
        for path in run[0].shards.glob("*.tar")
    }
    assert sorted(name for group in ids.values() for name in group) == sorted(OPENING_DEG)
    for split, group in ids.items():
        assert {split_of(name) for name in group} == {split}


def test_columns_are_those_of_the_schema(run):
    for path, columns in zip(run[0].catalog, (ASSETS, SAMPLES), strict=True):
        assert pq.read_schema(path).equals(columns)


def test_the_same_run_gives_the_same_bytes(run, tmp_path):
    sharded, _ = run
    again = shard_folder(made_run(tmp_path / "again"), per_shard=2)
    for ours, theirs in zip(sharded.catalog, again.catalog, strict=True):
        assert ours.read_bytes() == theirs.read_bytes()


def test_an_old_bundle_schema_is_named_with_ours_and_a_remedy(run, tmp_path):
    out = tmp_path / "old"
    shutil.copytree(run[1], out)
    path = out / "assets" / "laptop" / "000000" / "manifest.json"
    path.write_text(path.read_text().replace("artgen-bundle/2", "artgen-bundle/0"))
    with pytest.raises(ShardError, match=r"'artgen-bundle/0'.*'artgen-bundle/2'; generate"):
        write_catalog(out, run[0].packing)
