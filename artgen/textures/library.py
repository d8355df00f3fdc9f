"""A folder of PNG files shared by assets and processes; equal images are one file."""

import hashlib
import json
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from filelock import FileLock

from artgen.core.jsonio import content_hash, write_bytes, write_json
from artgen.core.surface import SurfaceSpec
from artgen.textures import VERSION, TextureSet, texture_set
from artgen.textures.images import Image
from artgen.textures.png import png_bytes, read_png

DIGITS = 12
"""Hex digits of a hash in a file's name: a clash among a million images has chance 2e-3."""


@dataclass(frozen=True, kw_only=True)
class TextureFiles:
    """Where the images of a surface lie; None where a number of the surface is in force.

    Attributes:
        color: sRGB.
        orm: linear, as glTF packs it: R occlusion (1 throughout), G roughness, B metallic.
        normal: tangent space, y along +v.
        emission: sRGB.
    """

    color: Path | None = None
    orm: Path | None = None
    normal: Path | None = None
    emission: Path | None = None


class TextureLibrary:
    """Makes the images of a surface once and keeps them in `folder`.

    An image is named `<recipe>_<kind>_<hash of its pixels>.png`; surfaces that differ in numbers
    only (all plastics have one grain) share it. A small JSON file per surface lists its images.
    Several processes may use one folder: files appear whole, under a lock.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def files(self, spec: SurfaceSpec) -> TextureFiles:
        """Paths of the surface's images, made now if they are new.

        Raises:
            UsageError: the recipe is unknown.
        """
        index = self._index(spec)
        if not index.exists():
            self._add(index, spec, texture_set(spec))
        names = json.loads(index.read_text(encoding="utf-8"))
        return TextureFiles(**{kind: self.folder / name for kind, name in names.items()})

    def keep(self, spec: SurfaceSpec, images: TextureSet) -> None:
        """Take in images that no recipe makes, such as those of a `picture_surface`."""
        if not (index := self._index(spec)).exists():
            self._add(index, spec, images)

    def _index(self, spec: SurfaceSpec) -> Path:
        return self.folder / f"{spec.recipe}_{_spec_hash(spec)}.json"

    def images(self, spec: SurfaceSpec) -> TextureSet:
        """The surface's images as arrays, read back from its files."""
        files = self.files(spec)
        return TextureSet(
            color=None if files.color is None else read_png(files.color),
            roughness=None if files.orm is None else read_png(files.orm)[..., 1],
            normal=None if files.normal is None else read_png(files.normal),
            emission=None if files.emission is None else read_png(files.emission),
        )

    def _add(self, index: Path, spec: SurfaceSpec, images: TextureSet) -> None:
        packed = {
            "color": images.color,
            "orm": None if images.roughness is None else _orm(images.roughness, spec.metallic),
            "normal": images.normal,
            "emission": images.emission,
        }
        self.folder.mkdir(parents=True, exist_ok=True)
        names = {}
        with FileLock(self.folder / ".lock"):
            for kind, image in packed.items():
                if image is not None:
                    names[kind] = f"{spec.recipe}_{kind}_{_pixel_hash(image)}.png"
                    if not (path := self.folder / names[kind]).exists():
                        write_bytes(path, png_bytes(image))
            write_json(index, names)


def _orm(roughness: Image, metallic: float) -> Image:
    occlusion = np.full_like(roughness, 255)
    return np.stack([occlusion, roughness, np.full_like(roughness, round(metallic * 255))], axis=-1)


def _spec_hash(spec: SurfaceSpec) -> str:
    """Of all that a recipe may read; the name of the surface is not part of it."""
    seen = {field.name: getattr(spec, field.name) for field in fields(spec) if field.name != "name"}
    return content_hash({**seen, "version": VERSION})[:DIGITS]


def _pixel_hash(image: Image) -> str:
    shape = ",".join(map(str, image.shape))
    return hashlib.sha256(shape.encode() + b":" + image.tobytes()).hexdigest()[:DIGITS]
