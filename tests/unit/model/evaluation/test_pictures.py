"""Pictures: four tiles, equal ones for equal layouts, colors of parts."""

import io

import numpy as np
from PIL import Image

from model.evaluation.pictures import SIZE, strip
from tests.unit.model.evaluation.layouts import cabinet, with_box_meshes


def test_truth_and_prediction_side_by_side() -> None:
    image = Image.open(io.BytesIO(strip(cabinet(), with_box_meshes(cabinet()))))
    assert image.size == (4 * SIZE, SIZE)
    pixels = np.asarray(image.convert("RGB"), int)
    tiles = [pixels[:, k * SIZE : (k + 1) * SIZE] for k in range(4)]
    # Boxes as boxes and as meshes look alike; rest and open do not.
    assert (np.abs(tiles[0] - tiles[2]).max(axis=2) > 8).mean() < 0.01
    assert (np.abs(tiles[0] - tiles[1]).max(axis=2) > 8).mean() > 0.02
    assert (pixels == 255).all(axis=2).mean() > 0.2


def test_an_unknown_axis_is_not_drawn() -> None:
    axes = np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (np.nan, np.nan, np.nan)])
    assert len(strip(cabinet(axes=axes), cabinet())) > 500
