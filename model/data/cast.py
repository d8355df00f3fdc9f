"""First hits of the rays through all pixel centers, in torch on any device.

Triangles are found row by row instead of ray by ray: a row of pixel centers meets a triangle in one
interval, whose ends follow from the triangle's edges. What neighbors share, both compute from the
same numbers in the same order, so no ray passes between them. The hit is the one that embree finds,
but for rays within rounding of an edge.

F triangles, each in front of its camera; C channels, one image of first hits each.
"""

from dataclasses import dataclass
from itertools import pairwise

import torch
from torch import Tensor

from model.batch import TensorBlock

LATER = 1e-6
"""Share of its depth by which a body comes nearer than the one before it, so that where two bodies
lie in one plane the later one is seen. Depth in float32 is good to a few 1e-7."""
ROWS = 1 << 22
"""Rows of triangles that are in memory at once; a row takes some 200 bytes, a pixel 50."""


@dataclass(frozen=True, kw_only=True)
class Hits(TensorBlock):
    """First hits.

    Attributes:
        code_CHW: int64, larger is nearer; -1 where nothing is hit. Channels that were cast together
            compare, so the nearest of several is their maximum.
    """

    code_CHW: Tensor


def triangle_of(code: Tensor) -> Tensor:
    """int64 index of the triangle that a code names; anything where nothing is hit."""
    return code & 0xFFFFFFFF


def depth_of(code: Tensor, order_F: Tensor) -> Tensor:
    """float32 depth along the camera's z axis; 0 where nothing is hit.

    Args:
        order_F: as given to `first_hits`.
    """
    hit = code >= 0
    kept = torch.where(hit, code, 0)
    nearness = (kept >> 32).to(torch.int32).view(torch.float32)
    depth = (1.0 + LATER * order_F[triangle_of(kept)]) / torch.where(hit, nearness, 1.0)
    return torch.where(hit, depth, 0.0)


def projected(points_N3: Tensor, intrinsics_N33: Tensor) -> Tensor:
    """(N, 3) points in axes of their camera (x right, y down, z forward, z > 0) as (px x, px y,
    1 / depth)."""
    nearness = 1.0 / points_N3[:, 2:]
    focal = intrinsics_N33.diagonal(dim1=1, dim2=2)[:, :2]
    place = points_N3[:, :2] * nearness * focal + intrinsics_N33[:, :2, 2]
    return torch.cat([place, nearness], dim=1)


def first_hits(
    flat_F33: Tensor,
    order_F: Tensor,
    channel_F: Tensor,
    *,
    channels: int,
    size: tuple[int, int],
) -> Hits:
    """What every ray through a pixel's center meets first.

    Args:
        flat_F33: corners as `projected` gives them, counter-clockwise seen from outside; triangles
            that look away are skipped, since bodies are closed.
        order_F: float32 rank of the triangle's body; of two in one plane the higher is seen.
        channel_F: int64 image that the triangle is drawn into.
        channels: C.
        size: (height, width) px.
    """
    code = torch.full(
        (channels * size[0] * size[1],), -1, dtype=torch.int64, device=flat_F33.device
    )
    rows_F2 = _rows(flat_F33, size)
    seen = torch.nonzero(_faces_camera(flat_F33) & (rows_F2[:, 1] > 0)).squeeze(1)
    if len(seen):
        for part in _chunks(rows_F2[seen]):
            name = seen[part]
            _draw(code, flat_F33[name], rows_F2[name], order_F[name], channel_F[name], name, size)
    return Hits(code_CHW=code.view(channels, *size))


def _faces_camera(flat_F33: Tensor) -> Tensor:
    """Counter-clockwise for an eye is clockwise where y points down: the area is negative."""
    a, b, c = flat_F33[..., :2].unbind(dim=1)
    first, second = b - a, c - a
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] < 0.0


def _rows(flat_F33: Tensor, size: tuple[int, int]) -> Tensor:
    """(F, 2) int64 first row of pixel centers that a triangle may meet, and how many; none where
    it lies between two columns."""
    low, high = flat_F33[..., :2].aminmax(dim=1)
    limit = torch.tensor([size[1], size[0]], dtype=low.dtype, device=low.device)
    first = torch.minimum(torch.ceil(low - 0.5).clamp(min=0.0), limit)
    last = torch.minimum(torch.floor(high - 0.5), limit - 1.0)
    count = (last - first + 1.0).clamp(min=0.0)
    rows = torch.where(count[:, 0] > 0.0, count[:, 1], 0.0)
    return torch.stack([first[:, 1], rows], dim=1).long()


def _chunks(rows_F2: Tensor) -> list[slice]:
    """Runs of triangles with at most `ROWS` rows."""
    ends = rows_F2[:, 1].cumsum(0)
    total = int(ends[-1])
    cuts = torch.arange(ROWS, max(total, ROWS), ROWS, device=ends.device)
    places = [0, *torch.searchsorted(ends, cuts).tolist(), len(ends)]
    return [slice(a, b) for a, b in pairwise(places) if b > a]


def _draw(
    code: Tensor,
    flat_F33: Tensor,
    rows_F2: Tensor,
    order_F: Tensor,
    channel_F: Tensor,
    name_F: Tensor,
    size: tuple[int, int],
) -> None:
    """Put the nearest of these triangles into `code`, which is changed in place."""
    height, width = size
    owner_S, step_S = _spread(rows_F2[:, 1])
    y_S = (rows_F2[owner_S, 0] + step_S).float() + 0.5
    left_S, count_S = _intervals(_edges(flat_F33)[owner_S], y_S, width)
    near_S, slope_S, least_S, most_S = _nearness(flat_F33, owner_S, y_S, left_S)
    bias_S = 1.0 + LATER * order_F[owner_S]
    start_S = (channel_F[owner_S] * height + rows_F2[owner_S, 0] + step_S) * width + left_S
    span_N, along_N = _spread(count_S)
    near_N = near_S[span_N] + slope_S[span_N] * along_N
    near_N = torch.minimum(torch.maximum(near_N, least_S[span_N]), most_S[span_N]) * bias_S[span_N]
    found_N = (near_N.view(torch.int32).long() << 32) | name_F[owner_S][span_N]
    code.scatter_reduce_(0, start_S[span_N] + along_N, found_N, reduce="amax")


def _spread(count_F: Tensor) -> tuple[Tensor, Tensor]:
    """Each index repeated as often as its count says, and the number of the repetition."""
    index = torch.repeat_interleave(count_F)
    starts = count_F.cumsum(0) - count_F
    return index, torch.arange(len(index), device=count_F.device) - starts[index]


def _edges(flat_F33: Tensor) -> Tensor:
    """(F, 4, 3) x at the upper end, upper y, lower y and slope of the three edges.

    An edge is walked from its upper end, whichever triangle asks. Level ones meet no row; the other
    two have their ends.
    """
    ends = flat_F33[..., :2]
    a, b = ends, ends.roll(-1, dims=1)
    swap = (a[..., 1:] > b[..., 1:]) | ((a[..., 1:] == b[..., 1:]) & (a[..., :1] > b[..., :1]))
    a, b = torch.where(swap, b, a), torch.where(swap, a, b)
    (x, top), (far, bottom) = a.unbind(dim=2), b.unbind(dim=2)
    rise = bottom - top
    slope = (far - x) / torch.where(rise > 0.0, rise, 1.0)
    return torch.stack([x, top, torch.where(rise > 0.0, bottom, -torch.inf), slope], dim=1)


def _intervals(edges_S43: Tensor, y_S: Tensor, width: int) -> tuple[Tensor, Tensor]:
    """First pixel center within a triangle on a row, and how many follow it there, itself
    included."""
    x, top, bottom, slope = edges_S43.unbind(dim=1)
    y = y_S[:, None]
    crossing = x + (y - top) * slope
    meets = (top <= y) & (y <= bottom)
    low = torch.where(meets, crossing, torch.inf).amin(dim=1)
    high = torch.where(meets, crossing, -torch.inf).amax(dim=1)
    first = torch.ceil(low - 0.5).clamp(0, width)
    last = torch.floor(high - 0.5).clamp(-1, width - 1)
    return first.long(), (last - first + 1).clamp(min=0).long()


def _nearness(
    flat_F33: Tensor, owner_S: Tensor, y_S: Tensor, left_S: Tensor
) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """1 / depth at a row's first pixel, its change a pixel, and its extremes over the triangle.

    It is linear over the image. Slivers have wild slopes, so it is kept within what the corners
    have.
    """
    a, b, c = flat_F33.unbind(dim=1)
    u, v = b - a, c - a
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    right = (u[:, 2] * v[:, 1] - v[:, 2] * u[:, 1]) / area
    down = (v[:, 2] * u[:, 0] - u[:, 2] * v[:, 0]) / area
    least, most = flat_F33[..., 2].aminmax(dim=1)
    x = left_S + 0.5 - a[owner_S, 0]
    near = a[owner_S, 2] + right[owner_S] * x + down[owner_S] * (y_S - a[owner_S, 1])
    return near, right[owner_S], least[owner_S], most[owner_S]
