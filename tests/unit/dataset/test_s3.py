"""Shards on S3 read as local ones do, by ranges; of two publishers one wins. Against moto."""

import multiprocessing
import shutil
import sys
import threading
from pathlib import Path

import pytest

from artgen.core.errors import ShardError, UsageError
from artgen.dataset import object_store
from artgen.dataset.contents import CONTENTS
from artgen.dataset.packing import pack, stage
from artgen.dataset.publish import publish
from artgen.dataset.reader import ShardDataset, open_shard
from artgen.dataset.store import LocalStore, opened_store
from artgen.dataset.verify import folder_damages
from tests.unit.dataset.scenes import assert_same, made_sample

IDS = tuple(f"laptop_{k:06d}" for k in range(5))


@pytest.fixture(scope="module")
def packed(tmp_path_factory) -> Path:
    """Five samples, one of them in the test split, in three shards."""
    root = tmp_path_factory.mktemp("packed")
    for k, name in enumerate(IDS):
        stage(root / f"{name[-6:]}.tar", made_sample(name, seed=k, states=2, views=12))
    pack(root.glob("*.tar"), root / "shards", per_shard=2)
    return root / "shards"


@pytest.fixture(scope="module")
def packed_otherwise(packed, tmp_path_factory) -> Path:
    """The same samples in other shards."""
    folder = tmp_path_factory.mktemp("otherwise")
    pack(packed.parent.glob("*.tar"), folder, per_shard=1)
    return folder


def listing(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def remote(url: str) -> dict[str, bytes]:
    store = opened_store(url)
    return {name: store.read(name) for name in store.sizes()}


def test_what_is_published_is_read_as_it_is_here(packed, bucket):
    url = f"{bucket.url}/deep/prefix"
    publish(packed, url)
    assert remote(url) == listing(packed)
    here, there = ShardDataset(packed), ShardDataset(url)
    assert there.ids == here.ids == tuple(sorted(IDS, key=here.position))
    for position in range(len(here)):
        assert_same(there[position], here[position])
    some = {"states": [1], "views": [3, 7]}
    assert_same(there.load(2, **some), here.load(2, **some))
    assert ShardDataset(url, split="test").ids == ShardDataset(packed, split="test").ids
    assert list(folder_damages(opened_store(url))) == []
    assert open_shard(f"{url}/train-000000.tar").manifest.file == "train-000000.tar"


def test_only_ranges_of_what_was_asked_for_are_fetched(packed, bucket, monkeypatch):
    """obstore joins ranges less than 1 MiB apart, so one request brings a small sample's views;
    from the first byte asked for to the last, and no more."""
    publish(packed, bucket.url)
    dataset = ShardDataset(bucket.url)
    shard, asset_id = dataset.shard(2)
    bucket.requests.clear()
    dataset.load(2, states=[1], views=[10])
    places = {place.name: place for place in shard.index[asset_id]}
    first, last = places["meta.json"], places["s1v10.parts.normal.webp"]
    wanted = f"bytes={first.offset}-{last.offset + last.size - 1}"
    assert [(method, span) for method, _, span in bucket.requests] == [("GET", wanted)]


def test_a_dataset_goes_to_spawned_workers(packed, bucket):
    publish(packed, bucket.url)
    dataset = ShardDataset(bucket.url)
    dataset.load(0)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert_same(pool.map(dataset.load, [3])[0], dataset[3])


def test_of_two_packings_one_wins_and_the_other_changes_nothing(packed, packed_otherwise, bucket):
    publish(packed, bucket.url)
    with pytest.raises(ShardError, match=r"dataset\.json: is from another packing"):
        publish(packed_otherwise, bucket.url)
    assert remote(bucket.url) == listing(packed)


def test_of_two_packers_at_once_one_wins_cleanly(packed, packed_otherwise, bucket):
    folders, lost = [packed, packed_otherwise], []
    barrier = threading.Barrier(2)

    def run(folder):
        barrier.wait()
        try:
            publish(folder, bucket.url)
        except ShardError as error:
            lost.append((folder, str(error)))

    threads = [threading.Thread(target=run, args=(folder,)) for folder in folders]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    ((loser, message),) = lost
    (winner,) = (folder for folder in folders if folder != loser)
    assert "another packing" in message
    assert remote(bucket.url) == listing(winner)
    assert len(ShardDataset(bucket.url)) == len(IDS)


def test_two_publishers_of_the_same_packing_both_succeed(packed, bucket, tmp_path):
    shutil.copytree(packed, tmp_path / "copy")
    publish(packed, bucket.url)
    bucket.requests.clear()
    publish(tmp_path / "copy", bucket.url)
    tars = [key for method, key, _ in bucket.requests if method == "PUT" and key.endswith(".tar")]
    assert tars == []
    assert remote(bucket.url) == listing(packed)


def test_a_publisher_that_died_is_seen_by_readers_and_finished_by_the_next(
    packed, bucket, monkeypatch
):
    """It dies at its n-th write, for every n."""
    put, put_new = object_store.ObjectStore.put, object_store.ObjectStore.put_new
    for count in range(1, 10):
        url, left = f"{bucket.url}/{count}", [count]

        def mortal(act, left=left):
            def acted(*args):
                left[0] -= 1
                if left[0] < 0:
                    raise KeyboardInterrupt
                return act(*args)

            return acted

        with monkeypatch.context() as patch:
            patch.setattr(object_store.ObjectStore, "put", mortal(put))
            patch.setattr(object_store.ObjectStore, "put_new", mortal(put_new))
            with pytest.raises(KeyboardInterrupt):
                publish(packed, url)
        with pytest.raises(ShardError, match=r"is missing beside it|lists it, but it is not here"):
            ShardDataset(url)
        publish(packed, url)
        assert remote(url) == listing(packed)


def test_a_folder_that_is_not_whole_is_not_published(packed, bucket, tmp_path):
    shutil.copytree(packed, tmp_path / "copy")
    content = bytearray((tmp_path / "copy" / "train-000000.tar").read_bytes())
    content[600] ^= 1
    (tmp_path / "copy" / "train-000000.tar").write_bytes(content)
    with pytest.raises(ShardError, match="is not whole"):
        publish(tmp_path / "copy", bucket.url)
    (tmp_path / "copy" / CONTENTS).unlink()
    with pytest.raises(ShardError, match="packing has not finished"):
        publish(tmp_path / "copy", bucket.url)
    assert remote(bucket.url) == {}


def test_damage_on_the_store_is_named_with_shard_key_and_offset(packed, bucket):
    publish(packed, bucket.url)
    shard = open_shard(f"{bucket.url}/train-000000.tar")
    place = shard.index[shard.manifest.ids[0]][3]
    key = f"{shard.manifest.ids[0]}.{place.name}"
    content = bytearray(LocalStore(packed).read("train-000000.tar"))
    content[place.offset] ^= 1
    object_store.ObjectStore(bucket.url).put("train-000000.tar", bytes(content))
    url = f"{bucket.url}/train-000000.tar"
    with pytest.raises(ShardError, match=rf"{url}: {key} \(offset {place.offset}"):
        ShardDataset(bucket.url).load(1)  # the first is in the test split
    (damage,) = folder_damages(opened_store(bucket.url))
    assert (damage.shard, damage.key, damage.offset) == (url, key, place.offset)
    object_store.ObjectStore(bucket.url).put("train-000000.tar", bytes(content[:9000]))
    damage, *_ = folder_damages(opened_store(bucket.url))
    assert (damage.shard, damage.offset) == (url, 9000)
    assert "truncated" in damage.reason


def test_a_missing_bucket_is_one_line(packed, bucket):
    with pytest.raises(ShardError, match="holds no complete shard"):
        ShardDataset(f"{bucket.url}/empty")
    with pytest.raises(ShardError, match="404.*check the bucket's name") as refused:
        ShardDataset("s3://there-is-no-such-bucket")
    assert "\n" not in str(refused.value)
    with pytest.raises(ShardError, match="no such bucket"):
        publish(packed, "s3://there-is-no-such-bucket/prefix")
    with pytest.raises(UsageError, match="is no URL"):
        publish(packed, str(packed))


def test_without_obstore_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "artgen.dataset.object_store", None)
    with pytest.raises(UsageError, match=r"artgen\[s3\]"):
        opened_store("s3://bucket/prefix")
