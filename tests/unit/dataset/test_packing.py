"""Which bytes a packing makes depends on its samples alone: not on order, kills or full disks."""

import json
import resource
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import ShardError
from artgen.dataset.members import encoded
from artgen.dataset.packing import pack, stage
from artgen.dataset.reader import ShardDataset, open_shard
from artgen.dataset.repack import repack, restore
from artgen.dataset.shard import is_whole, write_shard
from artgen.dataset.split import SPLITS, split_of
from tests.unit.dataset.packed_by_force import PER_SHARD
from tests.unit.dataset.scenes import made_sample

IDS = tuple(f"laptop_{index:06d}" for index in range(8))


@pytest.fixture(scope="module")
def staged(tmp_path_factory) -> Path:
    """Eight samples, each in its own small tar."""
    folder = tmp_path_factory.mktemp("samples") / "laptop"
    for k, name in enumerate(IDS):
        stage(folder / f"{name[-6:]}.tar", made_sample(name, seed=k, states=1, parts=2))
    return folder


@pytest.fixture(scope="module")
def packed(staged, tmp_path_factory) -> Path:
    """What an undisturbed packing makes of them."""
    folder = tmp_path_factory.mktemp("shards")
    pack(staged.glob("*.tar"), folder, per_shard=PER_SHARD)
    return folder


def content(folder: Path) -> dict[str, bytes]:
    """Name to bytes of every file."""
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


@settings(deadline=None, max_examples=6)
@given(order=st.permutations(IDS))
def test_the_order_of_samples_shows_in_no_byte(staged, packed, tmp_path_factory, order):
    folder = tmp_path_factory.mktemp("permuted")
    pack([staged / f"{name[-6:]}.tar" for name in order], folder, per_shard=PER_SHARD)
    assert content(folder) == content(packed)


def test_packing_and_writing_directly_give_the_same_tar(packed, tmp_path):
    ids = open_shard(packed / "train-000000.tar").manifest.ids
    samples = [made_sample(name, seed=IDS.index(name), states=1, parts=2) for name in ids]
    write_shard(tmp_path / "train-000000.tar", map(encoded, samples))
    expected = (packed / "train-000000.tar").read_bytes()
    assert (tmp_path / "train-000000.tar").read_bytes() == expected


def test_every_asset_is_packed_once_and_in_its_own_split(packed):
    found = {split: set() for split in SPLITS}
    for path in packed.glob("*.tar"):
        manifest = is_whole(path)
        assert 1 <= manifest.samples <= PER_SHARD
        found[path.name.split("-")[0]] |= set(manifest.ids)
    assert sorted(name for ids in found.values() for name in ids) == sorted(IDS)
    for split, ids in found.items():
        assert {split_of(name) for name in ids} <= {split}
    assert len(list(packed.glob("*.tar"))) == 5  # seven in train, one in test


def test_packing_again_touches_no_complete_shard(staged, tmp_path):
    pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    before = {path.name: path.stat().st_mtime_ns for path in tmp_path.glob("*.tar")}
    pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    assert {path.name: path.stat().st_mtime_ns for path in tmp_path.glob("*.tar")} == before


def test_a_corrupt_shard_is_packed_again(staged, packed, tmp_path):
    pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    spoilt = bytearray((tmp_path / "train-000001.tar").read_bytes())
    spoilt[700] ^= 1
    (tmp_path / "train-000001.tar").write_bytes(spoilt)
    pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    assert content(tmp_path) == content(packed)


def test_shards_of_another_packing_go_and_foreign_files_stay(staged, packed, tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    pack(staged.glob("*.tar"), tmp_path, per_shard=1)
    pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    assert content(tmp_path) == {**content(packed), "notes.txt": b"mine"}
    assert len(ShardDataset(tmp_path)) == len(IDS)


def test_assets_left_out_are_listed_with_their_reasons(staged, tmp_path):
    spoilt = tmp_path / "samples" / "laptop" / "000008.tar"
    stage(spoilt, made_sample("laptop_000008"))
    spoilt.write_bytes(b"")
    packing = pack(
        [*staged.glob("*.tar"), spoilt],
        tmp_path / "shards",
        left_out={"laptop_000009": "lid hits base"},
    )
    listed = json.loads((tmp_path / "shards" / "dataset.json").read_text())["left_out"]
    assert listed == packing.left_out
    assert listed["laptop_000009"] == "lid hits base"
    assert "truncated" in listed["laptop_000008"]
    assert sorted(packing.shard_of) == sorted(IDS)


def test_one_asset_staged_twice_is_refused(staged, tmp_path):
    again = tmp_path / "000000.tar"
    stage(again, made_sample(IDS[0]))
    with pytest.raises(ShardError, match="laptop_000000 is in"):
        pack([*staged.glob("*.tar"), again], tmp_path / "shards")


def test_no_samples_per_shard_is_refused(tmp_path):
    with pytest.raises(ShardError, match="at least 1"):
        pack([], tmp_path, per_shard=0)


def test_a_kill_at_any_instant_leaves_complete_shards_and_the_next_run_the_same_bytes(
    staged, packed, tmp_path
):
    """Shards are whole or absent after a SIGKILL at any of many touches of the disk."""
    command = [sys.executable, "-m", "tests.unit.dataset.packed_by_force", staged, tmp_path]
    subprocess.run(command, check=True, cwd=Path(__file__).parents[3])
    runs = sorted(tmp_path.iterdir(), key=lambda path: int(path.name))
    assert len(runs) > 10
    unfinished = 0
    for folder in runs:
        complete = [is_whole(path) for path in folder.glob("*.tar")]
        assert all(shard.sha256 == is_whole(packed / shard.file).sha256 for shard in complete)
        unfinished += len(complete) < len(list(packed.glob("*.tar")))
        pack(staged.glob("*.tar"), folder, per_shard=PER_SHARD)
        assert content(folder) == content(packed)
    assert unfinished > 8


def test_a_full_disk_is_one_clear_error_and_leaves_nothing_half_written(staged, packed, tmp_path):
    """A file size limit stands for the full disk: the kernel refuses the write in the same way."""
    largest = max(path.stat().st_size for path in packed.glob("*.tar"))
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (largest - 1, limits[1]))
    try:
        with pytest.raises(
            ShardError, match=r"cannot be written .*File too large.* free some space"
        ):
            pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
    assert not list(tmp_path.glob("*.partial"))
    assert not (tmp_path / "dataset.json").exists()
    for path in tmp_path.glob("*.tar"):
        is_whole(path)
    pack(staged.glob("*.tar"), tmp_path, per_shard=PER_SHARD)
    assert content(tmp_path) == content(packed)


def test_samples_and_shards_of_any_size_are_packed_to_the_same_bytes(staged, packed, tmp_path):
    pack(staged.glob("*.tar"), tmp_path / "three", per_shard=3)
    repack(tmp_path / "three", tmp_path / "two", per_shard=PER_SHARD)
    assert content(tmp_path / "two") == content(packed)


@pytest.mark.parametrize("name", ["train-000001", "train-000001.tar"])
def test_one_shard_is_restored_to_its_bytes(staged, packed, tmp_path, name):
    pack(staged.glob("*.tar"), tmp_path / "shards", per_shard=PER_SHARD)
    others = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "shards").iterdir()}
    for path in (tmp_path / "shards").glob("train-000001*"):
        path.write_bytes(path.read_bytes()[:100])
        del others[path.name]
    restore(staged, tmp_path / "shards", name)
    assert content(tmp_path / "shards") == content(packed)
    kept = {path: (tmp_path / "shards" / path).stat().st_mtime_ns for path in others}
    assert kept == others


def test_a_shard_is_restored_from_a_copy_in_other_shards(staged, packed, tmp_path):
    pack(staged.glob("*.tar"), tmp_path / "shards", per_shard=PER_SHARD)
    pack(staged.glob("*.tar"), tmp_path / "copy", per_shard=3)
    (tmp_path / "shards" / "test-000000.tar").unlink()
    restore(tmp_path / "copy", tmp_path / "shards", "test-000000")
    assert content(tmp_path / "shards") == content(packed)


def test_what_cannot_be_restored_says_why(staged, packed, tmp_path):
    pack(staged.glob("*.tar"), tmp_path / "shards", per_shard=PER_SHARD)
    with pytest.raises(ShardError, match=r"lists no val-000000\.tar; its shards are train-000000"):
        restore(staged, tmp_path / "shards", "val-000000")
    with pytest.raises(ShardError, match="into itself"):
        repack(tmp_path / "shards", tmp_path / "shards", per_shard=1)
    with pytest.raises(ShardError, match="holds no sample of train-000003"):
        restore(tmp_path / "shards", tmp_path / "shards", "train-000003")
    (tmp_path / "empty").mkdir()
    with pytest.raises(ShardError, match="neither samples"):
        restore(tmp_path / "empty", tmp_path / "shards", "train-000000")
    for k, name in enumerate(IDS):
        stage(tmp_path / "changed" / f"{name}.tar", made_sample(name, seed=k + 1, states=1))
    with pytest.raises(ShardError, match="have changed since"):
        restore(tmp_path / "changed", tmp_path / "shards", "train-000000")


def test_an_asset_goes_where_all_its_donors_are_or_nowhere(tmp_path):
    """laptop_000001 and laptop_000009 are test assets, laptop_000000 is for training."""
    lent = {
        "chair_000000": ("laptop_000001",),
        "chair_000001": ("laptop_000001", "laptop_000009"),
        "chair_000002": ("laptop_000000", "laptop_000001"),
        "chair_000003": ("laptop_000000",),
    }
    for name, donors in lent.items():
        sample = made_sample(name, states=1, views=1, parts=1)
        stage(tmp_path / f"{name}.tar", replace(sample, meta=replace(sample.meta, donors=donors)))
    packing = pack(tmp_path.glob("*.tar"), tmp_path / "shards")
    assert packing.shard_of == {
        "chair_000000": "test-000000.tar",
        "chair_000001": "test-000000.tar",
        "chair_000003": "train-000000.tar",
    }
    assert packing.left_out == {
        "chair_000002": "borrows parts from different splits: laptop_000000 (train), "
        "laptop_000001 (test)"
    }
