"""Licences of a set: marked beside the shards, and what may not be handed on is refused."""

import json

import pytest

from artgen.core.errors import ShardError
from artgen.core.jsonio import write_json
from artgen.dataset.cli import shard
from artgen.dataset.terms import TERMS
from tests.unit.dataset.runs import made_run

PARTNET = {"id": "LicenseRef-PartNet-Mobility", "text": "research only", "distributable": False}
BOUND = "assets/laptop/000002/manifest.json"


def restated(path, **facts):
    write_json(path, {**json.loads(path.read_text()), **facts})


def test_a_set_of_our_own_may_be_handed_on(tmp_path):
    out = made_run(tmp_path / "out")
    assert shard([str(out), "--public"]) == 1  # Some assets were left out, none was refused.
    terms = json.loads((out / "shards" / TERMS).read_text())
    assert terms == {
        "bound": [], "distributable": True, "licences": {"LicenseRef-artgen-output": 5}
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
