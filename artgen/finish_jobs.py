"""What finishing asks of Blender, as plain data: jobs, and the arrays beside them.

A job is a frozen dataclass whose `plain` form is one line of JSON; arrays travel in an npz file
that the job names. Every job carries its `kind`, which the worker dispatches on.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from artgen.core.mesh import Floats, Ints


@dataclass(frozen=True, kw_only=True)
class RoundJob:
    """Round the sharp convex edges of closed bodies.

    Attributes:
        input: npz written by `write_bodies`, with `radius` (n,) m.
        output: npz in the same layout, without `radius`; bodies in the same order.

    The report lists in `kept_sharp` the bodies that no bevel could leave closed, and that come back
    as they went in.
    """

    input: str
    output: str
    kind: str = "round"


def write_bodies(
    path: Path, bodies: Sequence[tuple[Floats, Ints]], *, radius: Sequence[float] = ()
) -> None:
    """Bodies one after another: `vertices` (sum V, 3) m, `faces` (sum F, 3), `vertex_counts` (n,),
    `face_counts` (n,), `radius` (n,) m or (0,); the indices of each body start at 0."""
    np.savez(
        path,
        vertices=np.concatenate([np.zeros((0, 3)), *(v for v, _ in bodies)]),
        faces=np.concatenate([np.zeros((0, 3), np.int32), *(f for _, f in bodies)]),
        vertex_counts=np.array([len(v) for v, _ in bodies], np.int64),
        face_counts=np.array([len(f) for _, f in bodies], np.int64),
        radius=np.array(radius, np.float64),
    )


def read_bodies(path: Path) -> tuple[list[tuple[Floats, Ints]], Floats]:
    """Bodies and radii that `write_bodies` wrote."""
    with np.load(path) as stored:
        vertices = np.split(stored["vertices"], np.cumsum(stored["vertex_counts"])[:-1])
        faces = np.split(stored["faces"], np.cumsum(stored["face_counts"])[:-1])
        count, radius = len(stored["vertex_counts"]), stored["radius"]
    return list(zip(vertices, faces, strict=True))[:count], radius
