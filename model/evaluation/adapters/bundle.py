"""Our bundles, as truth or as prediction."""

from pathlib import Path

from artgen.core.errors import ModelError
from artgen.core.mesh import TriMesh
from artgen.export import read_bundle
from artgen.export.bundle import Bundle, BundlePart
from model.evaluation.adapters.of_joints import layout_of_joints
from model.evaluation.layout import Layout


def layout_of_bundle(folder: Path) -> Layout:
    """The layout of the bundle in `folder`, m, parts in canonical order.

    Raises:
        ArtgenError: it is no bundle, or a mesh of it is missing or damaged.
    """
    bundle = read_bundle(folder)
    meshes = {part.name: _mesh(bundle, part) for part in bundle.parts}
    return layout_of_joints(
        bundle.asset_id,
        bundle.category,
        [(part.name, part.label) for part in bundle.parts],
        bundle.joints,
        boxes={part.name: part.bounds for part in bundle.parts},
        meshes=meshes,
    )


def _mesh(bundle: Bundle, part: BundlePart) -> TriMesh:
    try:
        return bundle.load_mesh(part.name)
    except (OSError, LookupError, ValueError, TypeError) as error:
        raise ModelError(
            f"{bundle.folder}: the mesh {part.mesh!r:.80} of {part.name} cannot be read ({error}); "
            "export or generate the asset anew"
        ) from error
