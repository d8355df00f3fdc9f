"""Images are grouped by state; whatever does not fit together is told with its file."""

import json
import shutil
from collections.abc import Callable
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from artgen.core.errors import ModelError
from model.reconstruct import masks
from model.reconstruct.capture import Capture, read_capture
from model.reconstruct.masks import Bytes, Mask, found_segmenter
from model.reconstruct.rig import read_rig


@pytest.fixture
def folder(photographs: Path, tmp_path: Path) -> Path:
    """A copy to be spoiled."""
    return Path(shutil.copytree(photographs, tmp_path / "copy"))


def captured(folder: Path, **options: object) -> Capture:
    rig = read_rig(folder / "cameras.json", folder)
    return read_capture(folder, rig, **options)  # type: ignore[arg-type]


def repainted(path: Path, change: Callable[[Bytes], Bytes]) -> None:
    with Image.open(path) as picture:
        pixels = np.array(picture)
    Image.fromarray(change(pixels)).save(path)


def test_states_and_views_keep_the_order_of_the_file(capture: Capture) -> None:
    assert capture.states == (0, 1)
    assert [[path.name for path in row] for row in capture.files] == [
        [f"view_{k}.png" for k in range(4)]
    ] * 2
    assert capture.rgba.shape == (2, 4, 96, 96, 4)


def test_some_views_of_each_state_can_be_taken(capture: Capture) -> None:
    found = capture.only([0, 3])
    assert [path.name for path in found.files[1]] == ["view_0.png", "view_3.png"]
    assert np.array_equal(found.rgba, capture.rgba[:, [0, 3]])
    assert capture.only(range(4)).files == capture.files


def test_an_image_of_another_size_is_told(folder: Path) -> None:
    repainted(folder / "state_1/view_2.png", lambda pixels: pixels[:-3])
    with pytest.raises(ModelError, match=r"view_2.png is 96 x 93 px, .*view_0.png is 96 x 96"):
        captured(folder)


def test_an_image_without_alpha_has_no_foreground(folder: Path) -> None:
    repainted(folder / "state_0/view_1.png", lambda pixels: pixels[..., :3])
    with pytest.raises(ModelError, match=r"view_1.png: no foreground: .* give --masks"):
        captured(folder)


def test_an_empty_mask_is_told(folder: Path) -> None:
    repainted(folder / "state_0/view_1.png", lambda pixels: pixels * np.uint8(0))
    with pytest.raises(ModelError, match=r"view_1.png: no foreground: the mask is empty"):
        captured(folder)


def test_a_foreground_that_is_nearly_transparent_is_told(folder: Path) -> None:
    """The hull looks at what is half opaque, and had nothing to look at."""
    faint = np.array([1, 1, 1, 0], np.uint8), np.array([0, 0, 0, 100], np.uint8)
    repainted(folder / "state_0/view_1.png", lambda pixels: pixels * faint[0] + faint[1])
    with pytest.raises(ModelError, match=r"view_1.png: no foreground: .* at least half opaque"):
        captured(folder)


def test_unequal_numbers_of_views_are_told(folder: Path) -> None:
    path = folder / "cameras.json"
    stated = json.loads(path.read_text())
    stated["views"].pop()
    path.write_text(json.dumps(stated))
    with pytest.raises(ModelError, match=r"unequal numbers of views .state 0: 4, state 1: 3."):
        captured(folder)


def test_a_missing_image_is_told(folder: Path) -> None:
    (folder / "state_1/view_0.png").unlink()
    with pytest.raises(ModelError, match="view_0.png: cannot be read as an image"):
        captured(folder)


def test_intrinsics_of_another_resolution_are_told(folder: Path) -> None:
    path = folder / "cameras.json"
    stated = json.loads(path.read_text())
    stated["views"][0]["intrinsics"][0][2] = 480.0
    path.write_text(json.dumps(stated))
    with pytest.raises(ModelError, match="principal point .* lies far outside of 96 x 96 px"):
        captured(folder)


def test_masks_in_files_stand_for_alpha(folder: Path, capture: Capture, tmp_path: Path) -> None:
    """Opaque photographs with black and white masks give the same foreground."""
    for path in sorted(folder.glob("state_*/*.png")):
        with Image.open(path) as picture:
            pixels = np.array(picture)
        mask = tmp_path / "masks" / path.relative_to(folder)
        mask.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(pixels[..., 3]).save(mask)
        Image.fromarray(pixels[..., :3]).save(path)
    found = captured(folder, masks=tmp_path / "masks")
    assert np.array_equal(found.rgba[..., 3], capture.rgba[..., 3])
    (tmp_path / "masks/state_0/view_3.png").unlink()
    with pytest.raises(ModelError, match=r"no mask for state_0/view_3.png"):
        captured(folder, masks=tmp_path / "masks")


def bright(image: Bytes) -> Mask:
    return np.asarray(image.max(axis=2) > 0)


def test_a_segmenter_stands_for_alpha(folder: Path, capture: Capture) -> None:
    """The painter's ground is black where it is transparent."""
    for path in folder.glob("state_*/*.png"):
        repainted(path, lambda pixels: pixels[..., :3])
    found = captured(folder, segmenter=bright)
    assert np.array_equal(found.rgba[..., 3], capture.rgba[..., 3])


def test_segmenters_are_found_by_entry_point(monkeypatch: pytest.MonkeyPatch) -> None:
    entry = EntryPoint(name="bright", value=f"{__name__}:bright", group=masks.GROUP)
    broken = EntryPoint(name="broken", value="nowhere_at_all:x", group=masks.GROUP)
    monkeypatch.setattr(masks, "entry_points", lambda group: [entry, broken])
    assert found_segmenter("bright").__name__ == "bright"
    with pytest.raises(ModelError, match=r"dark: no package offers it .installed: bright, broken"):
        found_segmenter("dark")
    with pytest.raises(ModelError, match="broken: cannot be loaded"):
        found_segmenter("broken")
