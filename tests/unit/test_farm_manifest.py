"""Lines of a manifest: what one states, when its images are whole, and what is wrong if not."""

import json
from pathlib import Path

import pytest

from artgen.core.errors import RenderError, UsageError
from artgen.farm_manifest import (
    DONE,
    Item,
    count_items,
    damage,
    file_digest,
    image_record,
    read_items,
)

JOB = {"shots": [{"file": "000000.exr"}, {"file": "000001.exr"}]}
ITEM = Item.stated("chest_1", JOB, {})


@pytest.fixture
def rendered(tmp_path: Path) -> Path:
    folder = tmp_path / ITEM.name
    folder.mkdir()
    for name in ITEM.files:
        (folder / name).write_bytes(name.encode())
    images = {name: image_record(folder / name) for name in ITEM.files}
    (folder / DONE).write_text(json.dumps({"item": ITEM.digest, "images": images}))
    return folder


def test_a_manifest_reads_back_to_its_items(tmp_path: Path) -> None:
    manifest = tmp_path / "manifest.jsonl"
    others = [Item.stated(f"chest_{k}", JOB, {"a.glb": "0"}) for k in range(3)]
    manifest.write_text("".join(f"{item.line}\n" for item in others))
    assert count_items(manifest) == 3
    assert list(read_items(manifest, {0, 2})) == [(0, others[0]), (2, others[2])]


def test_lines_of_other_contents_have_other_digests() -> None:
    lines = [
        ITEM,
        Item.stated("chest_2", JOB, {}),
        Item.stated("chest_1", {**JOB, "seed": 1}, {}),
        Item.stated("chest_1", JOB, {"a.glb": "0"}),
    ]
    assert len({item.digest for item in lines}) == len(lines)


def test_whole_images_are_whole(rendered: Path) -> None:
    assert damage(rendered, ITEM) is None


@pytest.mark.parametrize("name", [DONE, *ITEM.files])
def test_any_flipped_byte_is_found(rendered: Path, name: str) -> None:
    """Of done.json too: a byte of a digest, a name or a size is wrong, or it is no JSON."""
    whole = (rendered / name).read_bytes()
    for place in range(len(whole)):
        flipped = bytearray(whole)
        flipped[place] ^= 0x01
        (rendered / name).write_bytes(flipped)
        if name != DONE or _means_other(bytes(flipped), whole):
            assert damage(rendered, ITEM) is not None, place


def _means_other(flipped: bytes, whole: bytes) -> bool:
    try:
        return bool(json.loads(flipped) != json.loads(whole))
    except ValueError:
        return True


@pytest.mark.parametrize("name", [DONE, *ITEM.files])
def test_any_missing_file_is_found(rendered: Path, name: str) -> None:
    (rendered / name).unlink()
    assert damage(rendered, ITEM) is not None


def test_images_of_another_plan_are_not_these(rendered: Path) -> None:
    other = Item.stated("chest_1", {**JOB, "seed": 1}, {})
    assert damage(rendered, other) == f"{rendered}: was rendered for another plan"


@pytest.mark.parametrize(
    "line",
    [
        "",
        "{",
        "[]",
        "{}",
        '{"schema": "other/1"}',
        ITEM.line.replace("chest_1", "../chest"),
        ITEM.line.replace("chest_1", ".chest"),
        ITEM.line.replace('"chest_1"', "1"),
        ITEM.line[:-20],
    ],
)
def test_a_line_that_is_no_item_is_told_by_number(tmp_path: Path, line: str) -> None:
    manifest = tmp_path / "manifest.jsonl"
    manifest.write_text(f"{ITEM.line}\n{line}\n")
    assert [number for number, _ in read_items(manifest, {0})] == [0]
    with pytest.raises(UsageError, match=r"line 1 \(from 0\) is no item"):
        list(read_items(manifest, {1}))


def test_a_manifest_that_is_none_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot be read"):
        count_items(tmp_path / "manifest.jsonl")
    (tmp_path / "manifest.jsonl").touch()
    with pytest.raises(UsageError, match="is empty"):
        count_items(tmp_path / "manifest.jsonl")


def test_files_that_did_not_travel_well_are_told(tmp_path: Path) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(b"glb")
    item = Item.stated("chest_1", JOB, {"a.glb": file_digest(path)})
    path.write_bytes(b"gl")
    with pytest.raises(RenderError, match="copy it again"):
        item.render_job(tmp_path, tmp_path)
    path.unlink()
    with pytest.raises(RenderError, match="is missing; copy the whole folder"):
        item.render_job(tmp_path, tmp_path)
