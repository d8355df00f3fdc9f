"""Small objects, settings and batches that the tests of training data share."""

import dataclasses
from functools import cache
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from PIL import Image

from artgen.articulation.types import ArticulatedObject
from artgen.core.jsonio import write_json
from artgen.export import layout
from artgen.export.files import write_meshes
from artgen.export.manifest import manifest
from model.batch import TensorBlock
from model.data.config import DataConfig
from model.data.library import Library, packed
from model.data.soup import Soup, seed_soup

COARSE = 0.01
"""Radii; fewer triangles than a library has, so that tests are quick."""
CONFIG = DataConfig(
    seed=5,
    batch=4,
    slots=6,
    views=2,
    input_px=24,
    render_px=32,
    target_px=40,
    rays=96,
)


@cache
def soup(category: str, index: int = 0) -> Soup:
    """An object at a seed of the tests' own."""
    return seed_soup(category, 23, index, tolerance=COARSE)


@cache
def library() -> Library:
    """Three cabinets, a laptop, a box and an office chair, which has more parts than slots."""
    soups = [soup("cabinet", k) for k in range(3)]
    return packed([*soups, soup("laptop"), soup("cardboard_box"), soup("office_chair")])


def written_bundle(
    obj: ArticulatedObject, folder: Path, atlas: NDArray[np.uint8] | None = None
) -> Path:
    """A bundle as far as training reads it: meshes, manifest and the image of its colors."""
    folder.mkdir(parents=True, exist_ok=True)
    write_meshes(obj, folder)
    (folder / layout.TEXTURES).mkdir(exist_ok=True)
    image = np.full((4, 4, 3), 128, np.uint8) if atlas is None else atlas
    Image.fromarray(image).save(folder / layout.atlas_path(obj.asset_id))
    write_json(folder / layout.MANIFEST, manifest(obj, folder))
    return folder


def assert_equal(a: TensorBlock, b: TensorBlock) -> None:
    """Two blocks hold the same bits."""
    for field in dataclasses.fields(a):  # type: ignore[arg-type]
        one, other = getattr(a, field.name), getattr(b, field.name)
        if isinstance(one, torch.Tensor):
            assert torch.equal(one, other), field.name
        elif isinstance(one, TensorBlock):
            assert_equal(one, other)
        else:
            assert one == other, field.name
