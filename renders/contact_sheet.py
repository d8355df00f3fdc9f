"""One picture of a run: every asset closed and open, with its name."""

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from artgen.core.jsonio import write_bytes
from artgen.dataset import open_shard
from artgen.imaging import Bytes, png_file

PAPER = 244
INK = (60, 60, 64)
LABEL_PX = 18
GAP_PX = 10
COLUMNS = 4
"""Assets a row; each takes two images."""


def write_contact_sheet(path: Path, samples: Iterable[Path]) -> None:
    """A PNG of the staged samples, in their order: first and last state of the first view."""
    cells = [_cell(sample) for sample in samples]
    write_bytes(path, png_file(grid(cells, columns=COLUMNS)))


def _cell(sample_path: Path) -> Bytes:
    """(h, w, 3) two images on paper over the asset's name."""
    shard = open_shard(sample_path)
    asset_id = shard.manifest.ids[0]
    sample = shard.read(asset_id, views=[0])
    pictures = [on_paper(sample.rgba[t, 0]) for t in (0, sample.rgba.shape[0] - 1)]
    return labeled(asset_id, pictures)


def labeled(text: str, pictures: Sequence[Bytes]) -> Bytes:
    """(h, w, 3) pictures of one height side by side over a line of text."""
    return np.concatenate([np.concatenate(pictures, axis=1), _label(text, pictures)], axis=0)


def on_paper(rgba: Bytes) -> Bytes:
    """(H, W, 3) an image with straight alpha over light gray."""
    alpha = rgba[..., 3:] / 255.0
    return np.rint(rgba[..., :3] * alpha + PAPER * (1.0 - alpha)).astype(np.uint8)


def _label(text: str, pictures: Sequence[Bytes]) -> Bytes:
    width = sum(picture.shape[1] for picture in pictures)
    strip = Image.new("RGB", (width, LABEL_PX), (PAPER, PAPER, PAPER))
    ImageDraw.Draw(strip).text((4, 2), text, fill=INK, font=ImageFont.load_default(12))
    return np.asarray(strip)


def grid(cells: Sequence[Bytes], *, columns: int) -> Bytes:
    """Cells of one size in rows of `columns` at most, with gaps of paper."""
    height, width = (max(cell.shape[axis] for cell in cells) for axis in (0, 1))
    columns = min(columns, len(cells))
    rows = -(-len(cells) // columns)
    sheet = np.full(
        (GAP_PX + rows * (height + GAP_PX), GAP_PX + columns * (width + GAP_PX), 3), PAPER, np.uint8
    )
    for number, cell in enumerate(cells):
        row, column = divmod(number, columns)
        top, left = GAP_PX + row * (height + GAP_PX), GAP_PX + column * (width + GAP_PX)
        sheet[top : top + cell.shape[0], left : left + cell.shape[1]] = cell
    return sheet
