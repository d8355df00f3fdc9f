"""A library of a few objects and a network of a few weights, for whole studies in a second."""

from pathlib import Path

from model.data.library import packed, write_library
from tests.unit.model.data.small import soup

TRAIN = (("laptop", 0), ("laptop", 2), ("cabinet", 1), ("cabinet", 6))
TEST = (("laptop", 1), ("laptop", 9), ("cabinet", 3))
"""Objects by the split that their ids decide."""
SMALL = (
    *("model.images.image_px=16", "model.images.encoder=none", "model.trunk.width=24"),
    *("model.trunk.blocks=2", "model.trunk.heads=2", "model.trunk.pattern=XS"),
    *("data.input_px=16", "data.render_px=20", "data.target_px=16", "train.coarse=4"),
    *('train.stages=[{"start":0.0,"target_px":16}]', "train.samples=4"),
)
FEW_RAYS = ("model.planes.grid=4", "data.rays=16")
"""For runs that make shapes."""


def small_library(folder: Path) -> Path:
    """Seven objects of two categories, four to learn from."""
    path = folder / "library.npz"
    write_library(path, packed([soup(name, index) for name, index in (*TRAIN, *TEST)]))
    return path
