"""Whole training sessions of a tiny network on two laptops."""

from pathlib import Path

from artgen.progress import silent
from model.config import Config
from model.data.library import packed, write_library
from model.data.soup import Soup, seed_soup
from model.training.material import Material
from model.training.recipes import debug
from model.training.session import run_session
from model.training.settings import changed

TINY = changed(
    debug("nano"),
    [
        *("model.images.image_px=16", "model.images.encoder=none", "model.trunk.width=24"),
        *("model.trunk.blocks=2", "model.trunk.heads=2", "model.planes.grid=4"),
        *("data.input_px=16", "data.render_px=24", "data.target_px=16", "data.batch=2"),
        *("data.rays=16", "data.slots=4", "train.steps=4", "train.save_every=2"),
        *("train.picture_every=2", 'train.stages=[{"start":0.0,"target_px":16}]'),
    ],
)


def laptops() -> list[Soup]:
    """Two objects of two parts each."""
    return [seed_soup("laptop", 0, k) for k in range(2)]


def laptop_material(folder: Path) -> Material:
    """The two laptops as a library in a folder."""
    path = folder / "laptops.npz"
    write_library(path, packed(laptops()))
    return Material(library=path, split=None)


def session(
    material: Material, folder: Path, config: Config = TINY, *, start: Path | None = None
) -> Path:
    """One session on the CPU, begun or resumed; the path of the network file."""
    return run_session(
        config, material, folder, environment={}, start=start, device="cpu", show=silent
    )
