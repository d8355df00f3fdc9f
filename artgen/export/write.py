"""write_bundle: every file of one asset into one folder."""

import shutil
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path

import numpy as np

from artgen.articulation.types import ArticulatedObject
from artgen.core.jsonio import write_bytes, write_json
from artgen.core.surface import SurfaceSpec
from artgen.export import layout
from artgen.export.files import write_model_files
from artgen.export.glb import write_glb
from artgen.export.manifest import manifest
from artgen.export.surface_images import SurfaceImages
from artgen.textures.atlas import bake_color
from artgen.textures.images import TextureSet
from artgen.textures.library import TextureLibrary
from artgen.textures.png import png_bytes
from artgen.thumbnail import thumbnail_png
from artgen.worker import BlenderWorker

ATLAS_SIZE = 512
"""Texels along the baked image's side: 2 to 4 mm a texel on furniture, about 0.3 MB as PNG."""


def write_bundle(
    obj: ArticulatedObject,
    folder: Path,
    *,
    library: TextureLibrary,
    worker: BlenderWorker,
    thumbnail: bytes | None = None,
    occlusion: bool = False,
) -> None:
    """Fill `folder`, which exists, with the asset in every format; the manifest comes last.

    Args:
        obj: a finished object.
        folder: where to; callers make it appear whole by `fill_folder_atomically`.
        library: makes and keeps the images of surfaces.
        worker: writes the GLB.
        thumbnail: PNG file content; rendered when not given.
        occlusion: bake ambient occlusion onto the atlas, for the GLB.

    Raises:
        ExportError: the object has no texture coordinates or holds a number that is not finite.
        WorkerError: Blender failed.
        RenderError: the thumbnail cannot be read back.
    """
    images = copy_images(obj, folder, library)
    write_bytes(folder / layout.atlas_path(obj.asset_id), baked_atlas(obj, library))
    write_model_files(obj, folder, images)
    write_glb(obj, folder, images, worker, occlusion=occlusion)
    if thumbnail is None:
        thumbnail = thumbnail_png(obj, glb=folder / layout.GLB, worker=worker)
    write_bytes(folder / layout.THUMBNAIL, thumbnail)
    write_json(folder / layout.MANIFEST, manifest(obj, folder))


def used_surfaces(obj: ArticulatedObject) -> list[SurfaceSpec]:
    """Surfaces that some triangle shows, in the object's order."""
    used = np.unique(np.concatenate([np.asarray(part.mesh.slot) for part in obj.parts]))
    return [obj.surfaces[slot] for slot in used]


def copy_images(
    obj: ArticulatedObject, folder: Path, library: TextureLibrary
) -> Mapping[str, SurfaceImages]:
    """Surface name to its images, copied from the library into the bundle under their names."""
    (folder / layout.TEXTURES).mkdir(exist_ok=True)
    images = {}
    for surface in used_surfaces(obj):
        files = library.files(surface)
        named = {field.name: getattr(files, field.name) for field in fields(SurfaceImages)}
        for path in named.values():
            if path is not None:
                shutil.copyfile(path, folder / layout.TEXTURES / path.name)
        images[surface.name] = SurfaceImages(
            **{kind: path and f"{layout.TEXTURES}/{path.name}" for kind, path in named.items()}
        )
    return images


def baked_atlas(obj: ArticulatedObject, library: TextureLibrary) -> bytes:
    """The color of the whole asset on its atlas, as a PNG file's content."""
    shown = {surface.name for surface in used_surfaces(obj)}
    looks = [
        library.images(surface) if surface.name in shown else TextureSet()
        for surface in obj.surfaces
    ]
    meshes = [part.mesh for part in obj.parts]
    return png_bytes(bake_color(meshes, obj.surfaces, looks, size=ATLAS_SIZE))
