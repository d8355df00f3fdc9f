"""What is rendered: the meshes of a bundle, checked, and the hulls that framing needs of them."""

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from artgen.core.errors import ArtgenError, RenderError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.transform import apply
from artgen.export import Bundle

SIZES = (1e-3, 1e3)
"""m, diagonal of an object's box in all its states. Blender's cameras see from 1e-5 m to 1e6 m, and
images are the same from 4e-4 m to 1e3 m; a wrong unit (mm, inches) is the usual cause of others."""
FAR = 100.0
"""An object's own size, times this, is the farthest from the origin that float32 renders well."""
LEAST_PART = 1e-6
"""Longest side of a part, as a share of the object's diagonal; smaller ones are specks."""


def loaded_meshes(bundle: Bundle) -> tuple[TriMesh, ...]:
    """The meshes of the parts in the bundle's order, at rest.

    Raises:
        RenderError: a mesh is missing, unreadable, not finite, or has no size.
    """
    return tuple(_loaded(bundle, part.name) for part in bundle.parts)


def _loaded(bundle: Bundle, part: str) -> TriMesh:
    path = bundle.folder / bundle.part(part).mesh
    try:
        mesh = bundle.load_mesh(part)
    except (OSError, ValueError, IndexError, ArtgenError) as error:
        cause = " ".join(str(error).split())
        raise RenderError(f"{path} cannot be read ({cause}); write the bundle anew") from error
    return mesh


def moved_corners(
    names: Sequence[str], corners: Sequence[Floats], poses: Sequence[Mapping[str, Floats]]
) -> Floats:
    """(N, 3) of all parts in all states, m; a pose that recurs is counted once."""
    moved = {
        (name, pose[name].tobytes()): apply(pose[name], points)
        for pose in poses
        for name, points in zip(names, corners, strict=True)
    }
    return hull_corners(np.concatenate(list(moved.values())))


def hull_corners(points: Floats) -> Floats:
    """The (N, 3) points that no others hold between them; all of them if they lie in a plane.

    A pinhole maps segments in front of it to segments, so the corners frame as all points do.
    """
    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except (QhullError, ValueError):
        return points


def check_size(bundle: Bundle, meshes: Sequence[TriMesh], points: Floats) -> None:
    """Refuse what cannot be rendered right.

    Args:
        points: (N, 3) corners in all states, m.

    Raises:
        RenderError: the object is too large, too small, or too far off; or a part is a speck.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.linalg.norm(high - low))
    if not SIZES[0] <= size <= SIZES[1]:
        raise RenderError(
            f"{bundle.asset_id}: is {size:.3g} m across in all its states, expected "
            f"{SIZES[0]:g} to {SIZES[1]:g} m; is its unit the meter?"
        )
    away = float(np.linalg.norm((low + high) / 2.0))
    if not away <= FAR * size:
        raise RenderError(
            f"{bundle.asset_id}: is {size:.3g} m across but {away:.3g} m from the origin, expected "
            f"at most {FAR:g} times its size; move it to the origin"
        )
    for part, mesh in zip(bundle.parts, meshes, strict=True):
        longest = float(np.ptp(mesh.bounds, axis=0).max())
        if longest <= LEAST_PART * size:
            raise RenderError(
                f"{bundle.asset_id}: {part.name} is {longest:.3g} m long in an object of "
                f"{size:.3g} m, so no pixel can show it; remove the part or mend its mesh"
            )
