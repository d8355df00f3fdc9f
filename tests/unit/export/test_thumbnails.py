"""A sheet shows every bundle that has a picture, in order, and spreads over many."""

from pathlib import Path

import numpy as np
from PIL import Image

from artgen.export.layout import THUMBNAIL
from artgen.export.thumbnails import COLUMNS, LABEL, MOST, PAPER, SIDE, write_thumbnails


def bundles(root: Path, count: int) -> list[tuple[str, Path]]:
    """Bundle k is k levels of red, with a transparent border."""
    made = []
    for k in range(count):
        folder = root / f"{k:03d}"
        folder.mkdir()
        rgba = np.zeros((64, 64, 4), np.uint8)
        rgba[8:56, 8:56] = (k, 0, 0, 255)
        Image.fromarray(rgba).save(folder / THUMBNAIL)
        made.append((f"object_{k}", folder))
    return made


def reds(path: Path) -> list[int]:
    """Of the middles of all cells that show something, row by row."""
    sheet = np.asarray(Image.open(path))
    middles = sheet[SIDE // 2 :: SIDE + LABEL, SIDE // 2 :: SIDE]
    return [int(own[0]) for row in middles for own in row if tuple(own) != PAPER]


def test_all_are_shown_in_order_on_paper(tmp_path: Path) -> None:
    many, path = bundles(tmp_path, COLUMNS + 2), tmp_path / "sheet.png"
    assert write_thumbnails(path, many)
    assert reds(path) == list(range(COLUMNS + 2))
    with Image.open(path) as sheet:
        assert sheet.size == (COLUMNS * SIDE, 2 * (SIDE + LABEL))
        assert sheet.getpixel((1, 1)) == PAPER
    before = path.read_bytes()
    assert write_thumbnails(path, many)
    assert path.read_bytes() == before


def test_of_many_some_from_first_to_last_are_shown(tmp_path: Path) -> None:
    path = tmp_path / "sheet.png"
    assert write_thumbnails(path, bundles(tmp_path, 2 * MOST + 5))
    shown = reds(path)
    assert shown == list(range(0, 2 * MOST + 5, 3))
    assert len(shown) <= MOST


def test_what_has_no_picture_is_left_out(tmp_path: Path) -> None:
    many, path = bundles(tmp_path, 3), tmp_path / "sheet.png"
    (many[1][1] / THUMBNAIL).write_bytes(b"no picture")
    assert write_thumbnails(path, many)
    assert reds(path) == [0, 2]
    assert not write_thumbnails(tmp_path / "none.png", [("lost", tmp_path / "lost")])
    assert not write_thumbnails(tmp_path / "none.png", [])
    assert not (tmp_path / "none.png").exists()
