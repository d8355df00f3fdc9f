"""What is foreground: the alpha channel, mask files, or a segmenter that someone has installed.

A segmenter is a function of an (H, W, 3) uint8 image that returns (H, W) bool; a package offers it
by an entry point in the group `artgen.segmenters`.
"""

from collections.abc import Callable
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from artgen.core.errors import ModelError

Bytes = NDArray[np.uint8]
Mask = NDArray[np.bool_]
Segmenter = Callable[[Bytes], Mask]
GROUP = "artgen.segmenters"
SUFFIXES = (".png", ".jpg", ".webp", ".bmp")
HALF = 128


def found_segmenter(name: str) -> Segmenter:
    """The installed segmenter of that name.

    Raises:
        ModelError: there is none, or it cannot be loaded.
    """
    known = {entry.name: entry for entry in entry_points(group=GROUP)}
    if name not in known:
        have = ", ".join(sorted(known)) or "none"
        raise ModelError(
            f"--segmenter {name}: no package offers it (installed: {have}); install one with an "
            f"entry point in {GROUP}, or give masks or images with alpha"
        )
    try:
        segmenter: Segmenter = known[name].load()
    except ImportError as error:
        raise ModelError(f"--segmenter {name}: cannot be loaded ({error})") from error
    return segmenter


def read_rgba(path: Path) -> Bytes:
    """(H, W, 4) of an image file; alpha is 255 where the file has none.

    Raises:
        ModelError: it cannot be read.
    """
    try:
        with Image.open(path) as picture:
            return np.array(picture.convert("RGBA"), np.uint8)
    except OSError as error:
        raise ModelError(f"{path}: cannot be read as an image ({error})") from error


def foreground(rgba: Bytes, path: Path, *, mask: Path | None, segmenter: Segmenter | None) -> Bytes:
    """The image with its alpha set to the foreground: a mask file, else its own alpha, else what
    the segmenter says.

    Raises:
        ModelError: nothing tells the foreground, it is empty, or of another size.
    """
    if mask is not None:
        chosen = mask_of_file(mask)
    elif (rgba[..., 3] < 255).any():
        return _filled(rgba, path)
    elif segmenter is not None:
        chosen = np.asarray(segmenter(np.ascontiguousarray(rgba[..., :3]))).astype(bool)
    else:
        raise ModelError(
            f"{path}: no foreground: the image has no transparent pixel; give --masks FOLDER, "
            "images with alpha, or --segmenter NAME"
        )
    if chosen.shape != rgba.shape[:2]:
        raise ModelError(
            f"{mask or path}: the mask is {chosen.shape[1]} x {chosen.shape[0]} px, its image "
            f"{rgba.shape[1]} x {rgba.shape[0]}; make them equal"
        )
    alpha = np.where(chosen, rgba[..., 3], np.uint8(0))
    return _filled(np.concatenate([rgba[..., :3], alpha[..., None]], axis=2), path)


def _filled(rgba: Bytes, path: Path) -> Bytes:
    if not (rgba[..., 3] >= HALF).any():
        raise ModelError(
            f"{path}: no foreground: the mask is empty, no pixel is at least half opaque; check "
            "it, or drop this image"
        )
    return rgba


def mask_of_file(path: Path) -> Mask:
    """(H, W) the brighter half of an image, or the more opaque one where it has alpha."""
    rgba = read_rgba(path)
    told_by_alpha = (rgba[..., 3] < 255).any()
    value = rgba[..., 3] if told_by_alpha else rgba[..., :3].max(axis=2)
    return np.asarray(value >= HALF)


def mask_beside(folder: Path, image: str) -> Path:
    """The mask of an image in a folder of masks: the same name, with any ending.

    Raises:
        ModelError: there is none.
    """
    place = folder / image
    names = [place, *(place.with_suffix(suffix) for suffix in SUFFIXES)]
    names += [folder / name.name for name in names]
    for name in names:
        if name.is_file():
            return name
    raise ModelError(f"{folder}: no mask for {image}; expected {place.with_suffix('.png').name}")
