"""Our bundles, as truth or as prediction."""

from pathlib import Path

from artgen.export import read_bundle
from model.evaluation.adapters.of_joints import layout_of_joints
from model.evaluation.layout import Layout


def layout_of_bundle(folder: Path) -> Layout:
    """The layout of the bundle in `folder`, m, parts in canonical order.

    Raises:
        ExportError: it is no bundle, or a mesh of it is missing or damaged.
    """
    bundle = read_bundle(folder)
    meshes = {part.name: bundle.load_mesh(part.name) for part in bundle.parts}
    return layout_of_joints(
        bundle.asset_id,
        bundle.category,
        [(part.name, part.label) for part in bundle.parts],
        bundle.joints,
        boxes={part.name: part.bounds for part in bundle.parts},
        meshes=meshes,
    )
