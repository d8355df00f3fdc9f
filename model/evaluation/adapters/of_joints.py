"""Parts and joints as our types state them, to a Layout."""

from collections.abc import Mapping, Sequence

import numpy as np

from artgen.articulation.targets import FIXED, REVOLUTE, TYPE_IDS
from artgen.articulation.types import Joint
from artgen.core.mesh import Floats, TriMesh
from model.evaluation.layout import Layout


def layout_of_joints(
    name: str,
    category: str,
    parts: Sequence[tuple[str, str]],
    joints: Sequence[Joint],
    *,
    boxes: Mapping[str, Floats],
    meshes: Mapping[str, TriMesh],
) -> Layout:
    """The layout of an object in the object frame.

    Args:
        parts: (name, label) of each part, base first.
        boxes: part name to its (2, 3) box at rest.
        meshes: part name to its surface at rest, for those that have one.
    """
    index = {part: k for k, (part, _) in enumerate(parts)}
    count = len(parts)
    types, parents = np.full(count, FIXED, np.int8), np.full(count, -1, np.int64)
    axes, origins, limits = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros((count, 2))
    endless = np.zeros(count, bool)
    for joint in joints:
        k = index[joint.child]
        types[k], parents[k], axes[k] = TYPE_IDS[joint.type], index[joint.parent], joint.axis
        endless[k] = joint.limit is None
        if types[k] == REVOLUTE:
            origins[k] = joint.origin
        if joint.limit is not None:
            limits[k] = joint.limit.lower, joint.limit.upper
    return Layout(
        name=name,
        category=category,
        labels=tuple(label for _, label in parts),
        boxes=np.stack([boxes[part] for part, _ in parts]),
        types=types,
        endless=endless,
        axes=axes,
        origins=origins,
        limits=limits,
        parents=parents,
        meshes=tuple(meshes.get(part) for part, _ in parts),
    )
