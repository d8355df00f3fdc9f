"""Whatever byte of a shard is flipped, `verify` names it, or the byte means nothing to anybody."""

import json
import shutil
import tarfile
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from artgen.core.errors import ShardError
from artgen.dataset.contents import CONTENTS
from artgen.dataset.members import encoded
from artgen.dataset.packing import pack, stage
from artgen.dataset.reader import ShardDataset, open_shard, read_shard
from artgen.dataset.shard import HEADER, index_path, manifest_path, write_shard
from artgen.dataset.store import LocalStore
from artgen.dataset.verify import damages, folder_damages
from tests.unit.dataset.scenes import assert_same, made_sample, with_extras

IDS = ("laptop_000000", "laptop_000003")
PIXELS = {"states": 1, "views": 1, "parts": 2}


@pytest.fixture(scope="module")
def intact(tmp_path_factory) -> Path:
    """A shard of two samples, one with all that is optional."""
    path = tmp_path_factory.mktemp("intact") / "train-000000.tar"
    samples = (made_sample(IDS[0], **PIXELS), with_extras(made_sample(IDS[1], **PIXELS)))
    write_shard(path, map(encoded, samples))
    return path


@pytest.fixture(scope="module")
def whole(intact):
    """What it holds."""
    return list(read_shard(intact))


@pytest.fixture(scope="module")
def bench(intact, tmp_path_factory) -> Path:
    """A copy to spoil and to mend."""
    folder = tmp_path_factory.mktemp("bench")
    for path in (intact, index_path(intact), manifest_path(intact)):
        shutil.copy(path, folder)
    return folder / intact.name


class flipped:
    """One bit of a file is another while this lasts."""

    def __init__(self, path: Path, byte: int, bit: int) -> None:
        self.path, self.byte, self.mask = path, byte, 1 << bit

    def __enter__(self) -> None:
        self._turn()

    def __exit__(self, *fault: object) -> None:
        self._turn()

    def _turn(self) -> None:
        with self.path.open("r+b") as stream:
            stream.seek(self.byte)
            value = stream.read(1)[0]
            stream.seek(self.byte)
            stream.write(bytes([value ^ self.mask]))


def damages_of(path: Path):
    return list(damages(LocalStore(path.parent), path.name))


def spans(path: Path):
    """(first byte of the header, of the data, past the data, past the padding), key."""
    return [
        (
            place.offset - HEADER,
            place.offset,
            place.offset + place.size,
            place.offset + place.size + -place.size % HEADER,
            f"{asset_id}.{place.name}",
        )
        for asset_id, places in open_shard(path).index.items()
        for place in places
    ]


def test_a_whole_shard_has_no_damage(intact):
    assert damages_of(intact) == []


def test_members_headers_padding_and_the_end_are_the_whole_tar(intact):
    """So that the next test leaves no byte out."""
    expected = 0
    for start, _, _, stop, _ in spans(intact):
        assert start == expected
        expected = stop
    assert not intact.read_bytes()[expected:].strip(b"\0")


@settings(max_examples=300)
@given(place=st.integers(0, 10**9 - 1), bit=st.integers(0, 7))
@example(place=0, bit=0)
def test_any_flipped_bit_of_a_tar_is_named_with_shard_key_and_offset(
    intact, bench, whole, place, bit
):
    """In headers and zeros the offset is the byte's, in data it is the member's. The reader refuses
    the member whose data were hit, and reads everything else as it was."""
    byte = place * intact.stat().st_size // 10**9
    hit = [span for span in spans(intact) if span[0] <= byte < span[3]]
    with flipped(bench, byte, bit):
        (damage,) = damages_of(bench)
        assert damage.shard == str(bench)
        if not hit:
            assert (damage.key, damage.offset) == ("", byte)
        for _, data, end, _, key in hit:
            in_data = data <= byte < end
            assert (damage.key, damage.offset) == (key, data if in_data else byte)
            assert (f"{key} (offset {damage.offset})") in str(damage)
        refused = [key for _, data, end, _, key in hit if data <= byte < end]
        shard = open_shard(bench)
        for asset_id, sample in zip(IDS, whole, strict=True):
            if any(key.startswith(f"{asset_id}.") for key in refused):
                with pytest.raises(ShardError, match=rf"{bench}: {refused[0]} \(offset {data}, "):
                    shard.read(asset_id)
            else:
                assert_same(shard.read(asset_id), sample)


@settings(max_examples=100)
@given(place=st.integers(0, 10**9 - 1), bit=st.integers(0, 7))
def test_any_flipped_bit_of_the_index_is_named_and_the_reader_refuses(intact, bench, place, bit):
    sidecar = index_path(bench)
    with flipped(sidecar, place * sidecar.stat().st_size // 10**9, bit):
        (damage,) = damages_of(bench)
        assert (damage.shard, damage.key) == (str(bench), sidecar.name)
        with pytest.raises(ShardError, match=str(sidecar)):
            open_shard(bench)


@settings(max_examples=200)
@given(place=st.integers(0, 10**9 - 1), bit=st.integers(0, 7))
@example(place=10**9 - 1, bit=2)
def test_any_flipped_bit_of_the_manifest_is_named_or_means_the_same(intact, bench, place, bit):
    """The file ends in a line feed; another white space there says the same."""
    sidecar = manifest_path(bench)
    with flipped(sidecar, place * sidecar.stat().st_size // 10**9, bit):
        found = damages_of(bench)
        if not found:
            assert sidecar.read_bytes()[:-1] == manifest_path(intact).read_bytes()[:-1]
            assert json.loads(sidecar.read_bytes()) == json.loads(manifest_path(intact).read_text())
            return
        assert [(damage.shard, damage.key) for damage in found] == [(str(bench), sidecar.name)]
        with pytest.raises(ShardError, match=str(sidecar)):
            open_shard(bench)


def test_several_damages_are_all_named(bench, intact):
    (_, first, *_), *_, (_, last, *_) = spans(intact)
    with flipped(bench, first, 0), flipped(bench, last, 3), flipped(bench, last - 500, 3):
        assert [damage.offset for damage in damages_of(bench)] == [first, last - 500, last]


@pytest.mark.parametrize("kept", [0, 511, 5000, -1, -10_000])
def test_a_truncated_tar_is_named_where_it_ends(intact, bench, kept):
    content = intact.read_bytes()
    bench.write_bytes(content[:kept])
    try:
        found = damages_of(bench)
    finally:
        bench.write_bytes(content)
    assert found[0].offset == len(content[:kept])
    with tarfile.open(bench) as tar:
        assert len(tar.getmembers()) == len(spans(bench))


def test_a_longer_tar_is_named(intact, bench):
    with bench.open("ab") as stream:
        stream.write(bytes(512))
    try:
        (damage,) = damages_of(bench)
    finally:
        bench.write_bytes(intact.read_bytes())
    assert "its manifest says" in damage.reason


@pytest.fixture
def folder(tmp_path) -> Path:
    """Two shards of two samples."""
    ids = [name for name in (f"laptop_{k:06d}" for k in range(9))][2:6]
    for name in ids:
        stage(tmp_path / "samples" / f"{name[-6:]}.tar", made_sample(name, **PIXELS))
    pack((tmp_path / "samples").glob("*.tar"), tmp_path / "shards", per_shard=2)
    return tmp_path / "shards"


def test_a_folder_names_missing_tars_missing_sidecars_and_what_is_foreign(folder):
    assert list(folder_damages(LocalStore(folder))) == []
    (folder / "train-000000.tar").unlink()
    (folder / "train-000001.index.parquet").unlink()
    (folder / "foreign.tar").write_bytes(b"no shard of ours")
    found = {Path(damage.shard).name: damage for damage in folder_damages(LocalStore(folder))}
    assert set(found) == {"train-000000.tar", "train-000001.tar", "foreign.tar"}
    assert "is missing" in found["train-000000.tar"].reason
    assert "train-000001.index.parquet is missing" in found["train-000001.tar"].reason
    assert "foreign.json is missing" in found["foreign.tar"].reason


def test_a_shard_that_is_listed_but_gone_is_named_by_verify_and_refused_by_the_reader(folder):
    for path in folder.glob("train-000001*"):
        path.unlink()
    (damage,) = folder_damages(LocalStore(folder))
    assert (Path(damage.shard).name, "lists it" in damage.reason) == ("train-000001.tar", True)
    with pytest.raises(ShardError, match=r"train-000001\.tar: dataset\.json lists it"):
        ShardDataset(folder)


@settings(max_examples=100)
@given(place=st.integers(0, 10**9 - 1), bit=st.integers(0, 7))
def test_any_flipped_bit_of_the_list_is_named_or_means_the_same(tmp_path_factory, place, bit):
    folder = tmp_path_factory.getbasetemp() / "listed"
    if not folder.exists():
        stage(folder / "000002.tar", made_sample("laptop_000002", **PIXELS))
        pack([folder / "000002.tar"], folder / "shards", left_out={"laptop_000001": "too thin"})
    path = folder / "shards" / CONTENTS
    before = json.loads(path.read_text())
    with flipped(path, place * path.stat().st_size // 10**9, bit):
        found = list(folder_damages(LocalStore(path.parent)))
        if found:
            assert [damage.key for damage in found] == [CONTENTS]
        else:
            assert json.loads(path.read_bytes()) == before
