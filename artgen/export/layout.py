"""Where the files of a bundle lie, and the frames its links use."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import ArticulatedObject, Part
from artgen.core.mesh import Floats, TriMesh
from artgen.geometry.convex import as_box

GLB = "asset.glb"
URDF = "asset.urdf"
MJCF = "asset.xml"
USD = "asset.usdc"
MANIFEST = "manifest.json"
THUMBNAIL = "thumbnail.png"
REPORT = "report.json"
"""Verdict of the validation, written later than the manifest and not listed in it."""
TEXTURES = "textures"


def mesh_path(asset_id: str, part: str) -> str:
    """The part's OBJ; base names are unique across assets, as loaders alias equal ones."""
    return f"meshes/{asset_id}_{part}.obj"


def material_path(asset_id: str) -> str:
    """The MTL that every OBJ of the asset names."""
    return f"meshes/{asset_id}.mtl"


def collision_path(asset_id: str, part: str, index: int) -> str:
    """The OBJ of a convex piece that is not a box."""
    return f"collision/{asset_id}_{part}_{index}.obj"


def atlas_path(asset_id: str) -> str:
    """The baked color of the whole asset on the second UV set."""
    return f"{TEXTURES}/{asset_id}_atlas.png"


def occlusion_path(asset_id: str) -> str:
    """The ambient occlusion on the atlas, where it was asked for."""
    return f"{TEXTURES}/{asset_id}_occlusion.png"


@dataclass(frozen=True, kw_only=True)
class BoxPiece:
    """A collision cuboid along the axes; m, object frame at rest."""

    index: int
    center: Floats
    size: Floats


@dataclass(frozen=True, kw_only=True)
class HullPiece:
    """A convex collision mesh and the file that holds it; object frame at rest."""

    index: int
    mesh: TriMesh
    file: str


def collision_pieces(asset_id: str, part: Part) -> Iterator[BoxPiece | HullPiece]:
    """The part's collision as formats state it: boxes as numbers, other hulls as files."""
    for index, mesh in enumerate(part.collision):
        if (box := as_box(mesh)) is not None:
            yield BoxPiece(index=index, center=box[0], size=box[1])
        else:
            file = collision_path(asset_id, part.name, index)
            yield HullPiece(index=index, mesh=mesh, file=file)


def pivots(obj: ArticulatedObject) -> dict[str, Floats]:
    """Part name to the origin of its link frame: its joint's origin, or zero for the base.

    Link frames stay parallel to the object frame at rest, so no format needs a rotation.
    """
    origins = {joint.child: np.array(joint.origin) for joint in obj.joints}
    return {part.name: origins.get(part.name, np.zeros(3)) for part in obj.parts}
