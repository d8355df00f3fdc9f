"""True objects as predictions of known quality: their boxes, joints and shapes, disturbed.

B objects, P parts, X Y Z samples along the axes of a part's box, K segments, N points.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree
from torch import Tensor
from torch.nn import functional

from artgen.core.mesh import Floats, TriMesh
from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation
from model.field.kinematics import unit
from model.field.rays import Growth, half_sides
from model.reconstruct.contact import points_inside

SAMPLES = 56
"""Samples along the longest side of a box."""
FEWEST = 12
SPACING = 0.006
"""Radii between points on true surfaces that distances are taken to."""
FAR = 0.12
"""Radii; distances are not told apart beyond."""
LUMPS = 1.5
"""Deviation of the filter that makes noise smooth, samples."""
LEAST_SIZE = 0.02
"""Radii; sides of a disturbed box."""


@dataclass(frozen=True, kw_only=True)
class GridField:
    """Signed distances on a grid in each part's box, between samples linear; one color a part.

    Attributes:
        grids: slot to (X, Y, Z) radii.
        rgb_S3: sRGB in [0, 1].
    """

    grids: Sequence[Tensor]
    rgb_S3: Tensor

    def __call__(self, points_BPN3: Tensor) -> tuple[Tensor, Tensor]:
        """As `Field`, of one object."""
        slots = torch.arange(len(self.grids))
        distance, rgb = self.seen(points_BPN3[0], slots)
        return distance[None], rgb[None]

    def distances(self, points_KN3: Tensor, slot_K: Tensor) -> Tensor:
        """As `PackedField`."""
        found = [
            functional.grid_sample(
                self.grids[slot][None, None],
                points_N3.flip(-1)[None, None, None],
                align_corners=True,
                padding_mode="border",
            )[0, 0, 0, 0]
            for points_N3, slot in zip(points_KN3, slot_K.tolist(), strict=True)
        ]
        return torch.stack(found)

    def seen(self, points_KN3: Tensor, slot_K: Tensor) -> tuple[Tensor, Tensor]:
        """As `PackedField`."""
        rgb_KN3 = self.rgb_S3[slot_K][:, None].expand(-1, points_KN3.shape[1], -1)
        return self.distances(points_KN3, slot_K), rgb_KN3


def known_field(
    meshes: Sequence[TriMesh], truth: Articulation, *, noise: float, stream: Stream
) -> GridField:
    """True shapes in the coordinates of their true boxes, with lumps of `noise` radii."""
    half_P3 = half_sides(truth.size_BP3, Growth())[0].double().numpy()
    center_P3 = truth.center_BP3[0].double().numpy()
    grids = []
    for slot, mesh in enumerate(meshes):
        own = stream.child("part", slot)
        distances = signed_distances(mesh, center_P3[slot], half_P3[slot], own)
        lumps = gaussian_filter(own.child("lumps").generator().normal(size=distances.shape), LUMPS)
        lumps *= noise / max(float(lumps.std()), 1e-9)
        grids.append(torch.tensor(distances + lumps, dtype=torch.float32))
    shades = stream.child("colors").generator().uniform(0.2, 0.9, (len(meshes), 3))
    return GridField(grids=grids, rgb_S3=torch.tensor(shades, dtype=torch.float32))


def signed_distances(mesh: TriMesh, center: Floats, half: Floats, stream: Stream) -> Floats:
    """(X, Y, Z) distance of the samples of a box from the nearest of many points on a mesh."""
    counts = np.maximum(np.ceil(SAMPLES * half / half.max()).astype(int), FEWEST)
    axes = [
        np.linspace(c - h, c + h, n) for c, h, n in zip(center, half, counts.tolist(), strict=True)
    ]
    inside = points_inside(mesh, axes)
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    tree = cKDTree(surface_points(mesh, stream))
    away, _ = tree.query(grid.reshape(-1, 3), distance_upper_bound=FAR)
    away = np.minimum(away, FAR)
    return np.where(inside, -1.0, 1.0) * away.reshape(inside.shape)


def surface_points(mesh: TriMesh, stream: Stream) -> Floats:
    """Points on all triangles, as dense as `SPACING`."""
    rng = stream.child("surface").generator()
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
    counts = np.ceil(area / SPACING**2).astype(int)
    of: NDArray[np.int64] = np.repeat(np.arange(len(area)), counts)
    u, v = rng.uniform(size=(2, len(of), 1))
    u, v = np.where(u + v > 1.0, 1.0 - u, u), np.where(u + v > 1.0, 1.0 - v, v)
    return np.asarray(a[of] + u * (b - a)[of] + v * (c - a)[of])


def disturbed(truth: Articulation, *, noise: float, stream: Stream) -> Articulation:
    """One object's articulation with errors: `noise` radii in boxes and axis points, as much in the
    components of unit axes, twice that share in motions and limits; and each joint has another
    type, and another parent, with a chance of `noise`."""
    rng = stream.generator()

    def shaken(values: Tensor, scale: float = 1.0) -> Tensor:
        drawn = rng.normal(size=tuple(values.shape)) * noise * scale
        return values + torch.tensor(drawn, dtype=values.dtype)

    moves_BP = truth.type_BP != FIXED
    swapped = torch.tensor(rng.uniform(size=tuple(moves_BP.shape)) < noise) & moves_BP
    other_BP = torch.where(truth.type_BP == REVOLUTE, PRISMATIC, REVOLUTE)
    lost = torch.tensor(rng.uniform(size=tuple(moves_BP.shape)) < noise) & moves_BP
    parent_BP = torch.where(lost, 1 % int(truth.valid_BP.sum()), truth.parent_BP)
    own = torch.arange(moves_BP.shape[1])
    return dataclasses.replace(
        truth,
        center_BP3=shaken(truth.center_BP3),
        size_BP3=shaken(truth.size_BP3).clamp(min=LEAST_SIZE),
        type_BP=torch.where(swapped, other_BP, truth.type_BP),
        axis_BP3=unit(shaken(truth.axis_BP3)) * moves_BP[..., None],
        origin_BP3=shaken(truth.origin_BP3),
        motion_BTP=truth.motion_BTP * shaken(torch.ones_like(truth.motion_BTP), 2.0),
        limits_BP2=truth.limits_BP2 * shaken(torch.ones_like(truth.limits_BP2), 2.0),
        parent_BP=torch.where(parent_BP == own, truth.parent_BP, parent_BP),
    )
