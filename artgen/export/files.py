"""The files of a bundle that need no Blender: OBJ, MTL, URDF, MJCF, USD."""

from collections.abc import Mapping
from pathlib import Path

from artgen.articulation.types import ArticulatedObject
from artgen.export import layout
from artgen.export.layout import HullPiece, collision_pieces
from artgen.export.mjcf import mjcf_text
from artgen.export.obj import hull_text, mtl_text, obj_text
from artgen.export.surface_images import SurfaceImages
from artgen.export.urdf import urdf_text
from artgen.export.usd import write_usd


def write_model_files(
    obj: ArticulatedObject, folder: Path, images: Mapping[str, SurfaceImages]
) -> None:
    """Meshes and the three models that name them; `folder` exists."""
    write_meshes(obj, folder)
    _write(folder / layout.URDF, urdf_text(obj))
    _write(folder / layout.MJCF, mjcf_text(obj))
    write_usd(obj, folder / layout.USD, images)


def write_meshes(obj: ArticulatedObject, folder: Path) -> None:
    """One OBJ a part, one for all of them MTL, and one OBJ for each collision piece that is no
    box."""
    mtl = layout.material_path(obj.asset_id)
    _write(folder / mtl, mtl_text(f"../{layout.atlas_path(obj.asset_id)}"))
    for part in obj.parts:
        text = obj_text(part.mesh, mtl=Path(mtl).name)
        _write(folder / layout.mesh_path(obj.asset_id, part.name), text)
        for piece in collision_pieces(obj.asset_id, part):
            if isinstance(piece, HullPiece):
                _write(folder / piece.file, hull_text(piece.mesh))


def _write(path: Path, text: str) -> None:
    """The folder as a whole is renamed into place, so single files need no such care."""
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8", newline="\n")
