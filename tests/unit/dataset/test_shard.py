"""Shards come back bit-equal, and whatever happened to them since is found out."""

import io
import json
import shutil
import subprocess
import tarfile
from pathlib import Path

import numpy as np
import pytest
import webdataset
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.core.errors import ShardError
from artgen.dataset.codec import read_rgba
from artgen.dataset.members import encoded
from artgen.dataset.reader import ShardDataset, open_shard, read_shard
from artgen.dataset.shard import index_path, manifest_path, write_shard
from artgen.dataset.slots import to_slots
from tests.unit.dataset.scenes import assert_same, made_sample

IDS = ("laptop_000000", "laptop_000003", "laptop_000011")
EXACT = ("rgba", "part_id", "part_rgba", "part_mask")


def _samples():
    return [made_sample(name, seed=k) for k, name in enumerate(IDS)]


@pytest.fixture(scope="module")
def intact(tmp_path_factory) -> Path:
    """A shard of three samples; tests that spoil it copy it first."""
    path = tmp_path_factory.mktemp("shards") / "train-000000.tar"
    write_shard(path, map(encoded, _samples()))
    return path


@pytest.fixture
def copied(intact, tmp_path) -> Path:
    """A shard to spoil."""
    for path in (intact, index_path(intact), manifest_path(intact)):
        shutil.copy(path, tmp_path)
    return tmp_path / intact.name


@settings(deadline=None, max_examples=15)
@given(
    states=st.integers(1, 3),
    views=st.integers(1, 3),
    parts=st.integers(1, 9),
    height=st.integers(1, 9),
    width=st.integers(1, 9),
    seed=st.integers(0, 2**32),
)
def test_a_sample_of_any_shape_comes_back(tmp_path_factory, seed, **shape):
    """Colors, ids and masks are bit-equal at once; depths and normals are rounded by the first
    writing (`test_codec` bounds by how much) and bit-equal ever after."""
    folder = tmp_path_factory.mktemp("round_trip")
    sample = made_sample(seed=seed, **shape)
    write_shard(folder / "a.tar", [encoded(sample)])
    (once,) = read_shard(folder / "a.tar")
    for name in EXACT:
        np.testing.assert_array_equal(getattr(once, name), getattr(sample, name))
    write_shard(folder / "b.tar", [encoded(once)])
    (twice,) = read_shard(folder / "b.tar")
    assert_same(twice, once)
    assert (folder / "a.tar").read_bytes() == (folder / "b.tar").read_bytes()


def test_facts_cameras_and_targets_are_bit_equal(intact):
    sample = _samples()[1]
    back = open_shard(intact).read(IDS[1])
    assert back.meta == sample.meta
    assert back.cameras.size == sample.cameras.size
    assert back.radius == sample.radius
    np.testing.assert_array_equal(back.q, sample.q)
    np.testing.assert_array_equal(back.center, sample.center)
    for group in ("cameras", "targets"):
        for name, array in vars(getattr(sample, group)).items():
            np.testing.assert_array_equal(getattr(getattr(back, group), name), array)


def test_a_slotted_sample_comes_back(tmp_path):
    write_shard(tmp_path / "a.tar", [encoded(to_slots(made_sample(parts=5), 3))])
    write_shard(tmp_path / "b.tar", [encoded(to_slots(made_sample(parts=5), 8))])
    (cut,), (padded,) = read_shard(tmp_path / "a.tar"), read_shard(tmp_path / "b.tar")
    assert (cut.meta.slots, cut.meta.parts_left_out) == (3, ("door_3", "door_4"))
    assert padded.valid.tolist() == [True] * 5 + [False] * 3


def test_a_place_without_the_samples_asked_for_says_what_is_there_and_what_helps(intact, tmp_path):
    """Found: where all samples had fallen into val and test, the advice was to run what had just
    been run, `artgen shard`; and of the folder of a run, whose shards lie one further down."""
    message = "holds no test shard, but 1 of train; each .* make more of them"
    with pytest.raises(ShardError, match=message):
        ShardDataset(intact.parent, split="test")
    with pytest.raises(ShardError, match="holds no train shard; write some with `artgen shard`"):
        ShardDataset(tmp_path, split="train")
    (tmp_path / "run").mkdir()
    shutil.copytree(intact.parent, tmp_path / "run" / "shards")
    with pytest.raises(ShardError, match=f"lie in {tmp_path / 'run' / 'shards'}: name that"):
        ShardDataset(tmp_path / "run")
    with pytest.raises(ShardError, match="is no folder; name one of shards"):
        ShardDataset(tmp_path / "nowhere", split="train")


def test_some_states_and_views_are_read_as_the_whole_would_give_them(intact):
    dataset = ShardDataset(intact.parent)
    whole, some = dataset[2], dataset.load(2, states=[1], views=[1, 0])
    np.testing.assert_array_equal(some.part_normal, whole.part_normal[[1]][:, [1, 0]])
    np.testing.assert_array_equal(some.rgba, whole.rgba[[1]][:, [1, 0]])
    np.testing.assert_array_equal(some.q, whole.q[[1]])
    np.testing.assert_array_equal(some.targets.motion, whole.targets.motion[[1]])
    np.testing.assert_array_equal(some.cameras.intrinsics, whole.cameras.intrinsics[[1, 0]])
    with pytest.raises(ShardError, match="expected one or more of 0 to 1"):
        dataset.load(0, states=[2])


def test_the_dataset_is_a_sequence_by_asset_id(intact):
    dataset = ShardDataset(intact.parent, split="train")
    assert dataset.ids == IDS
    assert [dataset[dataset.position(name)].meta.asset_id for name in IDS] == list(IDS)
    assert len(dataset) == len(list(dataset)) == 3
    with pytest.raises(ShardError, match="no shard holds"):
        dataset.position("laptop_000001")


def test_writing_again_gives_the_same_bytes(intact, tmp_path):
    again = tmp_path / intact.name
    write_shard(again, map(encoded, _samples()))
    for path in (lambda p: p, index_path, manifest_path):
        assert path(again).read_bytes() == path(intact).read_bytes()


def test_samples_out_of_order_or_given_twice_are_refused(tmp_path):
    first, second, _ = map(encoded, _samples())
    for group in ([second, first], [first, first], []):
        with pytest.raises(ShardError):
            write_shard(tmp_path / "a.tar", group)
        assert not list(tmp_path.iterdir())


def test_the_tar_is_plain_ustar_without_clock_or_owner(intact):
    listing = subprocess.run(["tar", "tf", intact], capture_output=True, text=True, check=True)
    names = listing.stdout.split()
    assert names[:3] == [
        f"{IDS[0]}.{name}" for name in ("meta.json", "arrays.npz", "s0v00.rgba.webp")
    ]
    assert len(names) == len(set(names)) == 3 * (2 + 2 * 2 * 7)
    with tarfile.open(intact) as tar:
        assert tar.pax_headers == {}
        for info in tar:
            assert (info.mtime, info.uid, info.gid, info.uname, info.gname) == (0, 0, 0, "", "")
            assert info.mode == 0o644


def test_the_index_points_at_the_bytes_of_every_member(intact):
    data = intact.read_bytes()
    shard = open_shard(intact)
    with tarfile.open(intact) as tar:
        for asset_id, places in shard.index.items():
            for place in places:
                expected = tar.extractfile(f"{asset_id}.{place.name}").read()
                assert data[place.offset : place.offset + place.size] == expected


def test_the_webdataset_library_reads_the_same_samples(intact):
    ours = list(read_shard(intact))
    theirs = list(webdataset.WebDataset(str(intact), shardshuffle=False))
    assert [item["__key__"] for item in theirs] == list(IDS)
    for item, sample in zip(theirs, ours, strict=True):
        assert json.loads(item["meta.json"])["asset_id"] == sample.meta.asset_id
        np.testing.assert_array_equal(read_rgba(item["s1v01.rgba.webp"]), sample.rgba[1, 1])
        arrays = np.load(io.BytesIO(item["arrays.npz"]))
        np.testing.assert_array_equal(arrays["motion"], sample.targets.motion)


@pytest.mark.parametrize("kept", [0, 511, 5000, -1])
def test_a_truncated_shard_is_detected(copied, kept):
    copied.write_bytes(copied.read_bytes()[:kept])
    with pytest.raises(ShardError, match="truncated"):
        list(read_shard(copied))


def test_a_shard_truncated_after_opening_is_detected(copied):
    shard = open_shard(copied)
    copied.write_bytes(copied.read_bytes()[:-20_000])
    with pytest.raises(ShardError, match="ends inside"):
        shard.read(IDS[2])


@pytest.mark.parametrize("sidecar", [index_path, manifest_path])
def test_a_missing_sidecar_is_named(copied, sidecar):
    sidecar(copied).unlink()
    with pytest.raises(ShardError, match=f"{sidecar(copied).name} is missing"):
        open_shard(copied)


def test_sidecars_without_their_tar_are_named(copied):
    copied.unlink()
    with pytest.raises(ShardError, match="only its sidecars"):
        open_shard(copied)


def test_an_old_shard_schema_is_named_with_ours_and_a_remedy(copied):
    facts = json.loads(manifest_path(copied).read_text())
    manifest_path(copied).write_text(json.dumps(facts | {"schema": "artgen-shard/0"}))
    with pytest.raises(ShardError, match=r"'artgen-shard/0'.*'artgen-shard/2'; pack again"):
        open_shard(copied)


def test_an_old_sample_schema_is_named_with_ours_and_a_remedy(tmp_path):
    sample = encoded(made_sample())
    old = sample.members[0][1].replace(b"artgen-sample/2", b"artgen-sample/1")
    members = (("meta.json", old), *sample.members[1:])
    path = tmp_path / "a.tar"
    write_shard(path, [type(sample)(asset_id=sample.asset_id, members=members)])
    with pytest.raises(ShardError, match=r"'artgen-sample/1'.*'artgen-sample/2'; render and pack"):
        list(read_shard(path))


def test_a_garbled_manifest_is_named(copied):
    manifest_path(copied).write_text("{")
    with pytest.raises(ShardError, match="not JSON"):
        open_shard(copied)
    manifest_path(copied).write_text('{"schema": "artgen-shard/2"}')
    with pytest.raises(ShardError, match="digest"):
        open_shard(copied)


def test_an_asset_in_two_shards_is_refused(copied):
    for path in (lambda p: p, index_path, manifest_path):
        source = path(copied)
        shutil.copy(source, path(copied.with_name("train-000001.tar")))
    with pytest.raises(ShardError, match="two shards"):
        ShardDataset(copied.parent)
