"""Assembled objects beside their templates, as one picture."""

import io
import tempfile
from collections.abc import Sequence
from pathlib import Path

from PIL import Image

from artgen.articulation.types import ArticulatedObject
from artgen.assembly.assemble import Assembled, finished
from artgen.assembly.choice import Market
from artgen.assembly.piece import joined
from artgen.assembly.placing import Named, placed
from artgen.assembly.run import new_object
from artgen.assembly.source import Source
from artgen.assembly_study.rows import WHAT
from artgen.core.licence import most_restrictive
from artgen.export.glb import write_glb
from artgen.export.layout import GLB, TEXTURES
from artgen.export.write import copy_images
from artgen.pipeline import Toolbox
from artgen.progress import Show
from artgen.thumbnail import thumbnail_png

PAIRS = 6
"""A row of the sheet: so many templates, each with its new object to the right."""
SIZE = 176
"""px."""
GROUND = (236, 236, 238)


def template_object(source: Source) -> Assembled:
    """A template with all that is its own."""
    parts: list[Named] = [(source.base_name, "base", source.base)]
    parts += [(m.name, m.label, joined(m.pieces)) for m in source.members]
    named, joints = placed(parts, source.joints)
    return Assembled(
        category=source.category,
        template=source.id,
        parts=tuple(named),
        joints=tuple(joints),
        preconditions=source.preconditions,
        surfaces=source.surfaces,
        licence=most_restrictive([source.licence]),
        donors=(source.family,),
        datasets=(source.dataset,),
        sources=(),
        tried=(),
        seams={},
    )


def write_sheet(
    path: Path, market: Market, indices: Sequence[int], *, seed: int, tools: Toolbox, show: Show
) -> None:
    """Objects of a seed beside their templates."""
    rows = -(-len(indices) // PAIRS)
    sheet = Image.new("RGB", (2 * PAIRS * SIZE, rows * SIZE), GROUND)
    with show("pictures", len(indices)) as advance:
        for place, index in enumerate(indices):
            new = new_object(market, WHAT, seed, index)
            if not isinstance(new, Assembled):
                continue
            before = template_object(market.library.source(new.template))
            y, x = divmod(place, PAIRS)
            for k, obj in enumerate((before, new)):
                picture = _picture(finished(obj, asset_id="shown", provenance={}), tools)
                sheet.paste(picture, ((2 * x + k) * SIZE, y * SIZE), picture)
            advance(new.template)
    path.parent.mkdir(parents=True, exist_ok=True)
    sheet.save(path, format="WEBP", quality=86, method=6)


def _picture(obj: ArticulatedObject, tools: Toolbox) -> Image.Image:
    """The thumbnail of an object, with its alpha."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / TEXTURES).mkdir(exist_ok=True)
        images = copy_images(obj, folder, tools.textures)
        write_glb(obj, folder, images, tools.blender)
        data = thumbnail_png(obj, glb=folder / GLB, worker=tools.blender)
    with Image.open(io.BytesIO(data)) as image:
        return image.convert("RGBA").resize((SIZE, SIZE), Image.Resampling.LANCZOS)
