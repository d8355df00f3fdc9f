"""From fields to meshes: marching cubes in the box of each part, closed and colored.

Letters: B objects, P parts, N points, V vertices, F faces, X Y Z samples along the axes.
"""

from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skimage.measure import marching_cubes
from torch import Tensor

from artgen.core.mesh import Floats, Ints
from model.batch import Articulation
from model.field.plane_field import Field, PackedField, packed
from model.field.rays import Growth, half_sides
from model.precision import full

LEAST_CELLS = 8
"""Cells across the shortest side of a box, so that slabs keep their shape."""
NUDGE = 1e-3
"""Share of a cell by which samples on the surface count as off it: a vertex on a corner of the grid
would belong to several edges and make triangles without area."""
OUTSIDE = 0.25
"""Share of a cell: distance at least given to samples on the border of the box, so that meshes
close inside it."""
CHUNK = 1 << 18
"""Points of a part that are asked for at once."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ColoredMesh:
    """The closed surface of one part, triangles counter-clockwise seen from outside.

    Attributes:
        slot: whose.
        vertices: (V, 3) m from the middle of the object's sphere, axes of the object at rest.
        faces: (F, 3) int32.
        rgb: (V, 3) sRGB in [0, 1].
        from_box: whether the field held no surface and this is the part's box.
    """

    slot: int
    vertices: Floats
    faces: Ints
    rgb: NDArray[np.float32]
    from_box: bool


@torch.no_grad()
def part_meshes(
    field: Field,
    articulation: Articulation,
    *,
    resolution: int,
    index: int = 0,
    radius: float = 1.0,
    least_share: float = 0.01,
    growth: Growth = Growth(),  # noqa: B008 (frozen)
) -> list[ColoredMesh]:
    """The meshes of object `index`, one for each valid slot, in order of slots.

    Args:
        resolution: cells along the longest side of a part's grown box; shorter sides have fewer in
            proportion, but `LEAST_CELLS` at least.
        radius: m in one radius.
        least_share: pieces of less than this share of the largest piece's volume are left out.
        growth: by how much boxes are larger than stated.
    """
    source = packed(field, *articulation.valid_BP.shape)
    half_P3 = half_sides(articulation.size_BP3, growth)[index]
    slots = articulation.valid_BP.shape[1]
    meshes = []
    for slot in articulation.valid_BP[index].nonzero().squeeze(-1).tolist():
        grid = _Grid(half_P3[slot], resolution)
        place = index * slots + slot
        found = _surface(_asked(source, grid.points(), place), grid, least_share)
        at, faces = grid.box() if found is None else found
        if found is None:
            at = at * (articulation.size_BP3[index, slot] / 2.0 / half_P3[slot]).cpu().numpy()
        local = torch.as_tensor(at, dtype=half_P3.dtype, device=half_P3.device)
        where = full(articulation.center_BP3[index, slot]) + local * half_P3[slot]
        meshes.append(
            ColoredMesh(
                slot=slot,
                vertices=radius * where.double().cpu().numpy(),
                faces=faces,
                rgb=_colors(source, local, place).cpu().numpy(),
                from_box=found is None,
            )
        )
    return meshes


@torch.no_grad()
def colors_at(
    field: Field,
    articulation: Articulation,
    slot: int,
    points_N3: Tensor,
    *,
    index: int = 0,
    growth: Growth = Growth(),  # noqa: B008 (frozen)
) -> Tensor:
    """(N, 3) sRGB in [0, 1] of a part at points in radii, object frame at rest."""
    half_3 = half_sides(articulation.size_BP3, growth)[index, slot]
    local_N3 = (full(points_N3) - full(articulation.center_BP3[index, slot])) / half_3
    source = packed(field, *articulation.valid_BP.shape)
    return _colors(source, local_N3, index * articulation.valid_BP.shape[1] + slot)


class _Grid:
    """Samples of a box at the corners of its cells, borders included.

    Args:
        half_3: half sides of the box, radii.
        resolution: cells along the longest.
    """

    def __init__(self, half_3: Tensor, resolution: int) -> None:
        sides = half_3.double().cpu().numpy()
        cells = np.ceil(resolution * sides / sides.max() - 1e-6).astype(int)
        self.cells = np.maximum(cells, min(LEAST_CELLS, resolution))
        self.step = 2.0 * sides / self.cells
        self._like = half_3

    def points(self) -> Tensor:
        """(X * Y * Z, 3) coordinates [-1, 1] of the box, z fastest."""
        axes = [
            torch.linspace(-1.0, 1.0, count + 1, dtype=self._like.dtype, device=self._like.device)
            for count in self.cells.tolist()
        ]
        return torch.stack(torch.meshgrid(*axes, indexing="ij"), dim=-1).reshape(-1, 3)

    def box(self) -> tuple[Floats, Ints]:
        """Corners (8, 3) at -1 and 1, and twelve triangles."""
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
        return corners, BOX_FACES


BOX_FACES: Ints = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]], np.int32
)  # fmt: skip
"""Of corners numbered by the bits x y z."""


def _asked(source: PackedField, points_N3: Tensor, place: int) -> NDArray[np.float32]:
    """(N,) signed distances."""
    slot = torch.tensor([place], device=points_N3.device)
    pieces = [source.distances(piece[None], slot)[0] for piece in torch.split(points_N3, CHUNK)]
    return torch.cat(pieces).float().cpu().numpy()


def _colors(source: PackedField, local_N3: Tensor, place: int) -> Tensor:
    slot = torch.tensor([place], device=local_N3.device)
    inside = local_N3.clamp(-1.0, 1.0)
    return torch.cat([source.seen(piece[None], slot)[1][0] for piece in torch.split(inside, CHUNK)])


def _surface(
    distances: NDArray[np.float32], grid: _Grid, least_share: float
) -> tuple[Floats, Ints] | None:
    """Vertices (V, 3) in coordinates [-1, 1] and faces; None where nothing is inside."""
    values = distances.reshape(grid.cells + 1).copy()
    step = float(grid.step.min())
    border = np.ones(values.shape, bool)
    border[1:-1, 1:-1, 1:-1] = False
    values[border] = np.maximum(values[border], OUTSIDE * step)
    near = np.abs(values) < NUDGE * step
    values[near] = np.where(values[near] < 0.0, -NUDGE * step, NUDGE * step)
    if values.min() >= 0.0:
        return None
    at, faces, _, _ = marching_cubes(values, 0.0, gradient_direction="descent")
    vertices: Floats = 2.0 * at.astype(float) / grid.cells - 1.0
    return _without_crumbs(vertices, faces.astype(np.int32), least_share)


def _without_crumbs(vertices: Floats, faces: Ints, least_share: float) -> tuple[Floats, Ints]:
    """Connected surfaces whose volume, empty or full, is no crumb of the largest's."""
    count = len(vertices)
    edges = np.concatenate([faces[:, :2], faces[:, 1:]])
    links = coo_matrix((np.ones(len(edges), bool), tuple(edges.T)), shape=(count, count))
    pieces, label = connected_components(links, directed=False)
    a, b, c = vertices[faces].transpose(1, 0, 2)
    sixfold = np.einsum("ij,ij->i", a, np.cross(b, c))
    volume = np.abs(np.bincount(label[faces[:, 0]], weights=sixfold, minlength=pieces))
    kept = volume >= least_share * volume.max()
    faces = faces[kept[label[faces[:, 0]]]]
    used = np.unique(faces)
    renumbered = np.zeros(count, np.int32)
    renumbered[used] = np.arange(len(used))
    return vertices[used], renumbered[faces]
