"""One hash tells whether a library or a folder of shards still holds the same."""

import shutil
from pathlib import Path

from artgen.core.jsonio import file_hash
from artgen.dataset.members import EncodedSample
from artgen.dataset.shard import write_shard
from model.data.fingerprint import fingerprint


def packed_shard(path: Path, pixel: bytes) -> None:
    members = (("meta.json", b"{}"), ("s0.v0.rgba.png", pixel))
    write_shard(path, [EncodedSample(asset_id="laptop_000000", members=members)])


def test_a_library_is_told_by_its_bytes(tmp_path: Path) -> None:
    path = tmp_path / "library.npz"
    path.write_bytes(b"objects")
    assert fingerprint(path) == fingerprint(path, "train") == file_hash(path)


def test_shards_are_told_by_their_content_not_by_their_place(tmp_path: Path) -> None:
    """Scores of an older packing were kept: the path alone was looked at."""
    one = tmp_path / "one"
    packed_shard(one / "train-000000.tar", b"a")
    before = fingerprint(one)
    shutil.copytree(one, tmp_path / "two")
    assert fingerprint(tmp_path / "two") == before
    packed_shard(one / "train-000000.tar", b"b")
    assert fingerprint(one) != before


def test_other_splits_and_other_files_do_not_count(tmp_path: Path) -> None:
    packed_shard(tmp_path / "train-000000.tar", b"a")
    train, everything = fingerprint(tmp_path, "train"), fingerprint(tmp_path)
    packed_shard(tmp_path / "test-000000.tar", b"a")
    (tmp_path / "notes.json").write_text("{}")
    assert fingerprint(tmp_path, "train") == train
    assert fingerprint(tmp_path) != everything
