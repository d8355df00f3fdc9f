"""One picture of many bundles: their thumbnails, each over its name."""

import io
from collections.abc import Sequence
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont, UnidentifiedImageError

from artgen.core.jsonio import write_bytes
from artgen.export.layout import THUMBNAIL

MOST = 48
"""Bundles that are shown; of more, as many that are spread evenly over them."""
COLUMNS = 8
SIDE = 192
"""Width and height of a thumbnail, px."""
LABEL = 18
PAPER = (244, 244, 244)
INK = (60, 60, 64)


def write_thumbnails(path: Path, bundles: Sequence[tuple[str, Path]]) -> bool:
    """A PNG of the bundles that have a thumbnail, in their order; False if none has, and then
    nothing is written.

    Args:
        bundles: names and folders.
    """
    shown = bundles[:: -(-len(bundles) // MOST)] if bundles else []
    cells = [(name, cell) for name, folder in shown if (cell := _cell(folder)) is not None]
    if not cells:
        return False
    columns = min(COLUMNS, len(cells))
    rows = -(-len(cells) // columns)
    sheet = Image.new("RGB", (columns * SIDE, rows * (SIDE + LABEL)), PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(12)
    for number, (name, cell) in enumerate(cells):
        row, column = divmod(number, columns)
        place = (column * SIDE, row * (SIDE + LABEL))
        sheet.paste(cell, place, cell)
        pen.text((place[0] + 4, place[1] + SIDE + 2), name[:30], fill=INK, font=font)
    content = io.BytesIO()
    sheet.save(content, "PNG", optimize=True)
    write_bytes(path, content.getvalue())
    return True


def _cell(folder: Path) -> Image.Image | None:
    try:
        with Image.open(folder / THUMBNAIL) as picture:
            return picture.convert("RGBA").resize((SIDE, SIDE), Image.Resampling.LANCZOS)
    except (OSError, UnidentifiedImageError):
        return None  # A picture less; the bundle's own check tells what is wrong with it.
