"""Volume rendering of parts: each alone along its own rays, and all together.

ART, supplement B: world rays are taken into each part's rest frame and cut with its box; densities
and colors there are accumulated part by part; and the samples of all parts, sorted along the world
ray, make the whole. Only pieces of rays inside the boxes of parts that exist are computed.

Letters: B objects, P parts, R rays, K segments (pieces of rays in boxes), N samples of a segment,
digits a length. Lengths in radii.
"""

from dataclasses import dataclass

import torch
from torch import Tensor

from model.batch import Articulation, TensorBlock
from model.field.kinematics import rays_at_rest, world_from_rest
from model.field.plane_field import Field, packed
from model.field.rays import FAR, Growth, box_span, half_sides
from model.field.sampling import Cells, optical_depth, placed
from model.field.sdf import Quadrature, fading
from model.precision import full, full_precision

LEAST_ALPHA = 1e-3
"""Coverage below which the distance of what is seen fades to 0."""


@dataclass(frozen=True, kw_only=True)
class RayColors(TensorBlock):
    """What rays see; colors premultiplied by alpha.

    Attributes:
        part_rgb_BPR3: of each part alone (amodal).
        part_alpha_BPR: its coverage.
        rgb_BR3: of all parts together.
        alpha_BR: their coverage.
        distance_BR: mean distance along the ray of what is seen, radii; 0 where nothing is.
        part_distance_BPR: the same of each part alone.
    """

    part_rgb_BPR3: Tensor
    part_alpha_BPR: Tensor
    rgb_BR3: Tensor
    alpha_BR: Tensor
    distance_BR: Tensor
    part_distance_BPR: Tensor


def render_along(
    field: Field,
    articulation: Articulation,
    origin_BR3: Tensor,
    direction_BR3: Tensor,
    state_BR: Tensor,
    *,
    inverse_beta: Tensor | float,
    samples: int,
    coarse: int = 0,
    quadrature: Quadrature = "point",
    growth: Growth = Growth(),  # noqa: B008 (frozen)
    stop_gradient: bool = True,
    generator: torch.Generator | None = None,
) -> RayColors:
    """What rays see of the articulated field.

    Args:
        field: parts on their boxes.
        origin_BR3, direction_BR3: world rays, directions of unit length.
        state_BR: state that a ray looks at.
        inverse_beta: 1 / deviation of the density, 1 / radii.
        samples: N, points of a segment whose distance and color are computed.
        coarse: points whose distance alone is computed first, so that the N gather where the
            surface is; 0 spreads the N evenly.
        quadrature: how density between samples is counted.
        growth: by how much boxes are larger than stated.
        stop_gradient: whether the boxes are taken as given; else gradients flow into their centers
            and sizes through the samples' places.
        generator: draws the place of each sample in its cell; None puts it in the middle.
    """
    with full_precision(origin_BR3):
        segments = _segments(
            articulation,
            *(full(origin_BR3), full(direction_BR3), state_BR),
            growth=growth,
            stop_gradient=stop_gradient,
        )
    source = packed(field, *articulation.valid_BP.shape)
    cells = placed(
        *(segments.entry_K, segments.length_K, samples),
        generator=generator,
        coarse=coarse,
        inverse_beta=inverse_beta,
        distances=lambda at_KN: source.distances(segments.points(at_KN), segments.slot_K),
    )
    distance_KN, rgb_KN3 = source.seen(segments.points(cells.at_KN), segments.slot_K)
    with full_precision(origin_BR3):
        depth_KN = optical_depth(full(distance_KN), cells, inverse_beta, quadrature)
        return _accumulated(segments, cells, depth_KN, full(rgb_KN3))


@dataclass(frozen=True, kw_only=True)
class _Segments:
    """Pieces of rays in boxes, in the order of (object, part, ray).

    Attributes:
        hit_BPR: whether a ray meets a part's box.
        index_K: place of the segment in the flattened (B, P, R).
        slot_K: object * P + part.
        ray_K: object * R + ray.
        origin_K3, direction_K3: of the ray, coordinates of the box; at distance t along the world
            ray lies origin + t direction.
        entry_K, length_K: where the ray enters and how far it runs inside.
    """

    hit_BPR: Tensor
    index_K: Tensor
    slot_K: Tensor
    ray_K: Tensor
    origin_K3: Tensor
    direction_K3: Tensor
    entry_K: Tensor
    length_K: Tensor

    def points(self, at_KN: Tensor) -> Tensor:
        """(K, N, 3) coordinates of the box at distances along the rays."""
        return self.origin_K3[:, None] + at_KN[..., None] * self.direction_K3[:, None]


def _segments(
    articulation: Articulation,
    origin_BR3: Tensor,
    direction_BR3: Tensor,
    state_BR: Tensor,
    *,
    growth: Growth,
    stop_gradient: bool,
) -> _Segments:
    poses = world_from_rest(articulation)
    origin, direction = rays_at_rest(origin_BR3, direction_BR3, state_BR, poses)
    center, half = full(articulation.center_BP3), half_sides(articulation.size_BP3, growth)
    if stop_gradient:
        center, half = center.detach(), half.detach()
    entry, leave = box_span(origin, direction, center, half)
    if stop_gradient:
        entry, leave = entry.detach(), leave.detach()
    hit_BPR = (leave > entry) & articulation.valid_BP[..., None]
    index_K = hit_BPR.flatten().nonzero().squeeze(-1)
    if len(index_K) == 0:
        # One segment without length keeps every shape and every gradient (of zero) alive.
        index_K = index_K.new_zeros(1)
    _, parts, count = hit_BPR.shape
    slot_K = index_K // count
    scale_K3 = half.flatten(0, 1)[slot_K]
    offset_K3 = origin.reshape(-1, 3)[index_K] - center.flatten(0, 1)[slot_K]
    entry_K = entry.flatten()[index_K]
    return _Segments(
        hit_BPR=hit_BPR,
        index_K=index_K,
        slot_K=slot_K,
        ray_K=slot_K // parts * count + index_K % count,
        origin_K3=offset_K3 / scale_K3,
        direction_K3=direction.reshape(-1, 3)[index_K] / scale_K3,
        entry_K=entry_K,
        length_K=torch.where(hit_BPR.flatten()[index_K], leave.flatten()[index_K] - entry_K, 0.0),
    )


def _accumulated(segments: _Segments, cells: Cells, depth_KN: Tensor, rgb_KN3: Tensor) -> RayColors:
    before_KN = _sum_before(depth_KN)
    opacity_KN = -torch.expm1(-depth_KN)
    weight_KN = fading(before_KN) * opacity_KN
    shared_KN = fading(_merged_before(segments, cells.at_KN, depth_KN, before_KN)) * opacity_KN
    sight_KN4 = torch.cat([rgb_KN3, cells.at_KN[..., None]], dim=-1)
    seen_K9 = torch.cat(
        [
            depth_KN.sum(dim=-1, keepdim=True),
            (weight_KN[:, None] @ sight_KN4)[:, 0],
            (shared_KN[:, None] @ sight_KN4)[:, 0],
        ],
        dim=-1,
    )
    empty = seen_K9.new_zeros(segments.hit_BPR.numel(), 9)
    seen_BPR9 = empty.index_copy(0, segments.index_K, seen_K9)
    seen_BPR9 = seen_BPR9.reshape(*segments.hit_BPR.shape, 9)
    part_alpha_BPR = -torch.expm1(-seen_BPR9[..., 0])
    alpha_BR = -torch.expm1(-seen_BPR9[..., 0].sum(dim=1))
    whole_BR4 = seen_BPR9[..., 5:].sum(dim=1)
    return RayColors(
        part_rgb_BPR3=seen_BPR9[..., 1:4],
        part_alpha_BPR=part_alpha_BPR,
        rgb_BR3=whole_BR4[..., :3],
        alpha_BR=alpha_BR,
        distance_BR=whole_BR4[..., 3] / alpha_BR.clamp(min=LEAST_ALPHA),
        part_distance_BPR=seen_BPR9[..., 4] / part_alpha_BPR.clamp(min=LEAST_ALPHA),
    )


def _sum_before(depth_XN: Tensor) -> Tensor:
    """Sum of all earlier ones; the shift comes first, for (sum + own) - own would round."""
    return torch.cat([torch.zeros_like(depth_XN[..., :1]), depth_XN[..., :-1]], dim=-1).cumsum(-1)


def _merged_before(
    segments: _Segments, at_KN: Tensor, depth_KN: Tensor, alone_KN: Tensor
) -> Tensor:
    """(K, N) optical depth before each sample of the samples of all parts on its world ray.

    Rays that meet one box alone keep what that part has before its samples.
    """
    hits_R = segments.hit_BPR.sum(dim=1).flatten()
    crowded_R = hits_R > 1
    chosen = crowded_R[segments.ray_K].nonzero().squeeze(-1)
    if len(chosen) == 0:
        return alone_KN
    place_K = (segments.hit_BPR.cumsum(dim=1) - 1).flatten()[segments.index_K[chosen]]
    row_K = (crowded_R.cumsum(0) - 1)[segments.ray_K[chosen]]
    spots = (row_K, place_K)
    shape = (int(crowded_R.sum()), int(hits_R.max()), depth_KN.shape[1])
    at = at_KN.detach()[chosen]
    order = at.new_full(shape, FAR).index_put(spots, at).flatten(1).argsort(dim=1, stable=True)
    depth = depth_KN.new_zeros(shape).index_put(spots, depth_KN[chosen]).flatten(1)
    before = _sum_before(torch.gather(depth, 1, order))
    back = torch.zeros_like(before).scatter(1, order, before).view(shape)
    return alone_KN.index_copy(0, chosen, back[spots])
