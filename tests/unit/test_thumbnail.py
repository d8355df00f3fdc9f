"""The picture of a bundle: whole, ajar, on nothing, the same every time."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from artgen.articulation.types import ArticulatedObject
from artgen.export.glb import write_glb
from artgen.thumbnail import thumbnail_job, thumbnail_png
from artgen.worker import BlenderWorker
from tests.made import CATEGORIES, finished

pytestmark = pytest.mark.blender


@pytest.fixture(scope="module")
def obj() -> ArticulatedObject:
    return finished(CATEGORIES[0], 0)


@pytest.fixture(scope="module")
def glb(
    obj: ArticulatedObject, blender: BlenderWorker, tmp_path_factory: pytest.TempPathFactory
) -> Path:
    folder = tmp_path_factory.mktemp("thumbnail")
    write_glb(obj, folder, {}, blender)
    return folder / "asset.glb"


def test_it_shows_the_whole_object_on_nothing_and_repeats(
    obj: ArticulatedObject, glb: Path, blender: BlenderWorker
) -> None:
    """Framed to 95 % of the half image: 6.4 px of the border stay free, less the filter's 1 px."""
    data = thumbnail_png(obj, glb=glb, worker=blender)
    image = np.asarray(Image.open(io.BytesIO(data)))
    assert image.shape == (256, 256, 4)
    rows, columns = np.nonzero(image[..., 3])
    reach = [rows.min(), columns.min(), 255 - rows.max(), 255 - columns.max()]
    assert min(reach) in (5, 6, 7)
    assert 0.05 < (image[..., 3] > 0).mean() < 0.9
    colors = image[image[..., 3] == 255][:, :3]
    assert 25 < colors.mean() < 235
    assert (colors == 255).all(axis=1).mean() < 0.02
    assert thumbnail_png(obj, glb=glb, worker=blender) == data


def test_something_is_open(obj: ArticulatedObject, glb: Path, tmp_path: Path) -> None:
    (poses,) = thumbnail_job(obj, glb=glb, folder=tmp_path).states
    assert any(not np.array_equal(pose, np.eye(4)) for pose in poses.values())
