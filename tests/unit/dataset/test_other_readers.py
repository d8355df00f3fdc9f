"""Tars open with the webdataset library, with Hugging Face `datasets`, and the index with DuckDB:
every member, the same pixels."""

import importlib
import io
from pathlib import Path

import duckdb
import numpy as np
import pytest
import webdataset
from PIL import Image

from artgen.dataset.index import crc32c
from artgen.dataset.members import decoded, encoded
from artgen.dataset.reader import open_shard
from artgen.dataset.shard import index_path, write_shard
from tests.unit.dataset.scenes import assert_same, made_sample, with_extras

IDS = ("cabinet_000002", "laptop_000000", "laptop_000003")


@pytest.fixture(scope="module")
def tar(tmp_path_factory) -> Path:
    """Three samples that differ in category, joints and seeds, with all that is optional."""
    path = tmp_path_factory.mktemp("foreign") / "train-000000.tar"
    samples = [with_extras(made_sample(name, parts=4 - k, seed=k)) for k, name in enumerate(IDS)]
    write_shard(path, map(encoded, samples))
    return path


@pytest.fixture(scope="module")
def members(tar) -> dict[str, dict[str, bytes]]:
    """Asset id to member name to bytes, as we read them."""
    shard = open_shard(tar)
    return {name: shard.members(name) for name in IDS}


def test_webdataset_reads_every_member(tar, members):
    items = list(webdataset.WebDataset(str(tar), shardshuffle=False))
    assert [item["__key__"] for item in items] == list(IDS)
    for item in items:
        asset_id = item["__key__"]
        found = {name: data for name, data in item.items() if not name.startswith("__")}
        assert found == members[asset_id]
        assert_same(decoded(found.__getitem__, where="webdataset"), open_shard(tar).read(asset_id))


@pytest.fixture
def hugging_face(monkeypatch, tmp_path):
    """The `datasets` library with no way to the network and a cache of its own."""
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    monkeypatch.setenv("HF_DATASETS_OFFLINE", "1")
    monkeypatch.setenv("HF_HOME", str(tmp_path / "hugging_face"))
    return importlib.import_module("datasets")


@pytest.mark.parametrize("streaming", [True, False])
def test_hugging_face_datasets_read_every_member(tar, members, hugging_face, tmp_path, streaming):
    """Images come decoded; a 16-bit PNG keeps its codes."""
    items = list(
        hugging_face.load_dataset(
            "webdataset",
            data_files={"train": str(tar)},
            split="train",
            streaming=streaming,
            cache_dir=str(tmp_path / "cache"),
        )
    )
    assert [item["__key__"] for item in items] == list(IDS)
    for item in items:
        expected = members[item["__key__"]]
        assert {name for name in item if not name.startswith("__")} == set(expected)
        assert item["meta.json"]["asset_id"] == item["__key__"]
        for name, data in expected.items():
            if name.endswith((".png", ".webp")):
                ours = np.asarray(Image.open(io.BytesIO(data)))
                np.testing.assert_array_equal(np.asarray(item[name]), ours, err_msg=name)
            elif name.endswith(".exr"):
                assert item[name] == data


def test_duckdb_finds_a_member_and_its_bytes_are_where_the_index_says(tar, members):
    rows = duckdb.sql(
        f"SELECT asset_id, name, \"offset\", size, crc32c FROM '{index_path(tar)}'"
    ).fetchall()
    content = tar.read_bytes()
    assert len(rows) == sum(map(len, members.values()))
    for asset_id, name, offset, size, checksum in rows:
        data = content[offset : offset + size]
        assert data == members[asset_id][name]
        assert crc32c(data) == checksum
