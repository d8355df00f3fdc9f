"""Volume rendering: equal to a ray caster on boxes, to a loop on fields; finite where it bites."""

import dataclasses
from functools import cache

import numpy as np
import pytest
import torch
import trimesh
from torch import Tensor

from model.batch import Articulation
from model.config import FieldConfig
from model.field.analytic import BoxField, box_distance
from model.field.kinematics import rays_at_rest, world_from_rest
from model.field.plane_field import FieldHead, PlaneField
from model.field.rays import NO_GROWTH, Growth, box_span, half_sides
from model.field.sampling import optical_depth, placed
from model.field.volume import RayColors, render_along
from tests.unit.model.box_scenes import COLORS, PARTS, box_field, cabinet, changed, view

EYES = ((1.8, -2.2, 1.4), (-2.4, -1.6, 0.9), (0.3, -3.0, 0.2))
SHARP = 400.0
SAMPLES = 96
BETAS = 4.0
"""Rays that come this deep, in betas, into a part are opaque: 1 - exp(1 - 2 * 4) = 0.9991."""
JOINTS, BOXES = ("motion_BTP", "axis_BP3", "origin_BP3"), ("center_BP3", "size_BP3")
FAR_BETAS = 12.0
"""Rays that stay this far away see less than exp(-12) * 400 / 2 * 1.5 = 0.0019."""


def rendered(field: object, articulation: Articulation, state: int, **options: object) -> RayColors:
    origin, direction = view(24, EYES[0])
    states = torch.full(origin.shape[:2], state)
    settings: dict[str, object] = {"inverse_beta": SHARP, "samples": SAMPLES, **options}
    return render_along(field, articulation, origin, direction, states, **settings)


@cache
def cast(eye: tuple[float, float, float], state: int) -> tuple[np.ndarray, np.ndarray]:
    """First distance (P, R), inf where missed, and the angle's cosine there: embree on the moved
    boxes."""
    articulation = cabinet(slots=PARTS, dtype=torch.float64)
    poses = world_from_rest(articulation)[0, state].numpy()
    origin, direction = (value[0].numpy() for value in view(24, eye, torch.float64))
    first = np.full((PARTS, len(origin)), np.inf)
    cosine = np.zeros_like(first)
    for k in range(PARTS):
        mesh = trimesh.creation.box(extents=articulation.size_BP3[0, k].numpy())
        mesh.apply_translation(articulation.center_BP3[0, k].numpy())
        mesh.apply_transform(poses[k])
        where, rays, faces = mesh.ray.intersects_location(origin, direction, multiple_hits=False)
        first[k, rays] = np.linalg.norm(where - origin[rays], axis=1)
        cosine[k, rays] = np.abs((mesh.face_normals[faces] * direction[rays]).sum(axis=1))
    return first, cosine


def clear_rays(eye: tuple[float, float, float], state: int) -> tuple[np.ndarray, np.ndarray]:
    """(P, R) rays that certainly hit a part, and that certainly miss it: their least distance from
    the box lies beyond `BETAS` and a cell inside, or beyond `FAR_BETAS` outside."""
    articulation = cabinet(slots=PARTS, dtype=torch.float64)
    origin, direction = view(24, eye, torch.float64)
    states = torch.full(origin.shape[:2], state)
    at_rest, along = rays_at_rest(origin, direction, states, world_from_rest(articulation))
    at = torch.linspace(1.0, 5.0, 2001, dtype=torch.float64)
    offset = at_rest - articulation.center_BP3[:, :, None]
    points = offset[..., None, :] + at[:, None] * along[..., None, :]
    least = box_distance(points, articulation.size_BP3[:, :, None, None] / 2.0).amin(dim=-1)[0]
    half = half_sides(articulation.size_BP3, Growth())
    entry, leave = box_span(at_rest, along, articulation.center_BP3, half)
    # The distance is convex along a ray, so its linear interpolant lies above it, by half a cell at
    # most at the kink; and the ends of a segment are known to half a cell.
    cell = ((leave - entry).clamp(min=0.0) / SAMPLES)[0]
    return (least < -BETAS / SHARP - cell).numpy(), (least > FAR_BETAS / SHARP).numpy()


@pytest.mark.parametrize("eye", EYES)
@pytest.mark.parametrize("state", [0, 1])
@pytest.mark.parametrize("coarse", [0, 48])
def test_boxes_look_as_a_ray_caster_sees_them(
    eye: tuple[float, float, float], state: int, coarse: int
) -> None:
    """Each part alone and all together: coverage, color, distance."""
    articulation = cabinet()
    origin, direction = view(24, eye)
    seen = render_along(
        *(box_field(articulation), articulation, origin, direction),
        torch.full(origin.shape[:2], state),
        inverse_beta=SHARP,
        samples=SAMPLES,
        coarse=coarse,
        quadrature="linear",
    )
    first, cosine = cast(eye, state)
    hit, miss = clear_rays(eye, state)
    assert np.array_equal(np.isfinite(first)[hit], np.ones(hit.sum(), bool))
    assert (hit | miss).mean() > 0.85
    assert hit[:3].any(axis=1).all()
    alpha = seen.part_alpha_BPR[0, :PARTS].numpy()
    assert alpha[hit].min() > 1.0 - np.exp(1.0 - 2.0 * BETAS)
    assert alpha[miss].max() < 0.0019
    assert not seen.part_alpha_BPR[0, PARTS:].any()
    # Mean of where a ray ends at a plane: beta (1 + 1 / (2 cos^2)) about it, known to a cell of at
    # most 1.3 radii / SAMPLES; and what leaks through ends at most 1.3 radii behind.
    facing = hit & (cosine > 0.3)
    leak = np.exp(1.0 - 2.0 * BETAS) * 1.3
    bound = (1.0 + 0.5 / cosine[facing] ** 2) / SHARP + 1.3 / SAMPLES + leak
    found = seen.part_distance_BPR[0, :PARTS].numpy()
    assert (np.abs(found - first)[facing] < bound).all()
    check_composite(seen, first, hit, miss)


def check_composite(seen: RayColors, first: np.ndarray, hit: np.ndarray, miss: np.ndarray) -> None:
    """The nearest part's color where it is nearest by far, nothing where all are missed."""
    ordered = np.sort(np.where(hit, first, np.inf), axis=0)
    nearest = np.where(hit, first, np.inf).argmin(axis=0)
    certain = (hit | miss).all(axis=0) & np.isfinite(ordered[0])
    # Behind by 12 betas at a slant of 0.3, and a cell: nothing of the second is before the first.
    certain[certain] = (
        np.diff(ordered[:2, certain], axis=0)[0] > FAR_BETAS / SHARP / 0.3 + 1.3 / SAMPLES
    )
    nothing = miss.all(axis=0)
    assert certain.sum() > 20
    assert seen.alpha_BR[0].numpy()[certain].min() > 1.0 - np.exp(1.0 - 2.0 * BETAS)
    # Each missed part may veil by 0.0019, and what leaks through shows another color.
    expected = np.array(COLORS)[nearest[certain]]
    np.testing.assert_allclose(seen.rgb_BR3[0].numpy()[certain], expected, rtol=0, atol=0.007)
    assert seen.alpha_BR[0].numpy()[nothing].max(initial=0.0) < PARTS * 0.0019


def merged_by_hand(
    field: BoxField, articulation: Articulation, origin: Tensor, direction: Tensor, state: int
) -> tuple[np.ndarray, np.ndarray]:
    """Composite rgb (R, 3) and alpha (R,): all samples of all parts in a list, sorted, blended."""
    at_rest, along = rays_at_rest(
        *(origin, direction, torch.full(origin.shape[:2], state)), world_from_rest(articulation)
    )
    half = half_sides(articulation.size_BP3, Growth())
    entry, leave = box_span(at_rest, along, articulation.center_BP3, half)
    rgb, alpha = np.zeros((origin.shape[1], 3)), np.zeros(origin.shape[1])
    for r in range(origin.shape[1]):
        listed = []
        for p in range(PARTS):
            if leave[0, p, r] <= entry[0, p, r]:
                continue
            cells = placed(entry[0, p, r, None], (leave - entry)[0, p, r, None], 6)
            points = at_rest[0, p, r] + cells.at_KN[0, :, None] * along[0, p, r]
            local = ((points - articulation.center_BP3[0, p]) / half[0, p])[None]
            distance, color = field.seen(local, torch.tensor([p]))
            depth = optical_depth(distance, cells, 20.0, "linear")[0]
            listed += list(
                zip(cells.at_KN[0].tolist(), depth.tolist(), color[0].numpy(), strict=True)
            )
        through = 1.0
        for _, depth, color in sorted(listed, key=lambda sample: sample[0]):
            rgb[r] += through * -np.expm1(-depth) * color
            through *= np.exp(-depth)
        alpha[r] = 1.0 - through
    return rgb, alpha


@pytest.mark.parametrize("state", [0, 1])
def test_the_composite_is_the_sorted_merge(state: int) -> None:
    """Float64; at most 24 samples of depth below 20 a ray: 1e-13 leaves room for the order of sums,
    and exp(-30) for what is not seen."""
    articulation = cabinet(dtype=torch.float64)
    field = box_field(articulation)
    origin, direction = view(7, EYES[0], torch.float64)
    found = render_along(
        *(field, articulation, origin, direction, torch.full(origin.shape[:2], state)),
        inverse_beta=20.0,
        samples=6,
        quadrature="linear",
    )
    rgb, alpha = merged_by_hand(field, articulation, origin, direction, state)
    np.testing.assert_allclose(found.rgb_BR3[0], rgb, rtol=0, atol=2e-13)
    np.testing.assert_allclose(found.alpha_BR[0], alpha, rtol=0, atol=2e-13)
    assert 0.05 < alpha.mean() < 0.95


def test_one_part_alone_is_the_composite() -> None:
    articulation = cabinet()
    only = changed(articulation, valid_BP=articulation.valid_BP & (torch.arange(6) == 1))
    seen = rendered(box_field(articulation), only, 1)
    assert torch.equal(seen.rgb_BR3, seen.part_rgb_BPR3[:, 1])
    assert torch.equal(seen.alpha_BR, seen.part_alpha_BPR[:, 1])
    assert torch.equal(seen.distance_BR, seen.part_distance_BPR[:, 1])
    assert seen.alpha_BR.max() > 0.99


def test_parts_may_come_in_any_order() -> None:
    """Unlike the canonical order, compositing knows no first part; sums may round otherwise."""
    articulation = cabinet(slots=4)
    flat = changed(articulation, parent_BP=torch.tensor([[-1, 0, 0, 0]]))
    order = torch.tensor([0, 3, 1, 2])
    turned = flat.mapped(
        lambda value: value[:, :, order] if value.shape[:2] == (1, 2) else value[:, order]
    )
    field = box_field(flat)
    other = dataclasses.replace(
        field,
        articulation=turned,
        center_BPM3=field.center_BPM3[:, order],
        half_BPM3=field.half_BPM3[:, order],
        rgb_BPM3=field.rgb_BPM3[:, order],
    )
    seen, again = rendered(field, flat, 1), rendered(other, turned, 1)
    torch.testing.assert_close(again.rgb_BR3, seen.rgb_BR3, rtol=0, atol=1e-6)
    assert torch.equal(again.part_rgb_BPR3, seen.part_rgb_BPR3[:, order])


def test_objects_of_a_batch_are_each_on_their_own() -> None:
    articulation = cabinet(batch=2)
    field = box_field(articulation)
    origin, direction = view(12, EYES[0])
    origins = torch.cat([origin, -origin])
    directions = torch.cat([direction, -direction])
    states = torch.stack([torch.zeros(144), torch.ones(144)]).long()
    both = render_along(
        field, articulation, origins, directions, states, inverse_beta=SHARP, samples=16
    )
    one = cabinet()
    for b in range(2):
        alone = render_along(
            *(box_field(one), one, origins[b, None], directions[b, None], states[b, None]),
            inverse_beta=SHARP,
            samples=16,
        )
        for name in ("rgb_BR3", "part_alpha_BPR", "distance_BR"):
            torch.testing.assert_close(
                getattr(both, name)[b], getattr(alone, name)[0], rtol=0, atol=1e-6
            )


class Slab:
    """A field that is solid everywhere, so that the first sample stops every ray."""

    def __init__(self, value: Tensor) -> None:
        self.value = value

    def __call__(self, points_BPN3: Tensor) -> tuple[Tensor, Tensor]:
        distance = self.value.expand(points_BPN3.shape[:-1]) + 0.0 * points_BPN3[..., 0]
        return distance, torch.sigmoid(points_BPN3)


@pytest.mark.parametrize("value", [-1e4, -25.0, 0.0, 25.0, 1e4])
@pytest.mark.parametrize("quadrature", ["point", "linear"])
def test_any_depth_is_finite(value: float, quadrature: str) -> None:
    """Fully opaque from the first sample on, or empty, at |s| / beta up to 4e6."""
    level = torch.tensor(value, requires_grad=True)
    articulation = cabinet()
    motion = articulation.motion_BTP.clone().requires_grad_()
    seen = rendered(Slab(level), changed(articulation, motion_BTP=motion), 1, quadrature=quadrature)
    total = sum(getattr(seen, field.name).sum() for field in dataclasses.fields(seen))
    assert torch.isfinite(total)
    for slope in torch.autograd.grad(total, (level, motion)):
        assert torch.isfinite(slope).all()
    if value < 0:
        # The first sample hides what is behind, up to exp(-400 * 25 cells of a 96th).
        inside = seen.part_alpha_BPR[0, 0] > 0
        assert seen.part_alpha_BPR[0, 0][inside].max() == 1.0


def test_rays_that_meet_nothing_see_nothing_and_still_have_slopes() -> None:
    """All rays empty: zeros, joined to the field by a slope of zero."""
    articulation = cabinet()
    head = FieldHead(FieldConfig(hidden=4), 2)
    planes = torch.randn(1, 6, 6, 2, 3, 3, requires_grad=True)
    origin, direction = view(4, EYES[0])
    seen = render_along(
        *(PlaneField(planes, articulation.size_BP3, head), articulation, origin, -direction),
        torch.zeros(1, 16, dtype=torch.long),
        inverse_beta=SHARP,
        samples=4,
        coarse=4,
    )
    for field in dataclasses.fields(seen):
        assert not getattr(seen, field.name).any()
    (seen.rgb_BR3.sum() + seen.part_distance_BPR.sum()).backward()
    assert planes.grad is not None
    assert not planes.grad.any()


def test_boxes_without_thickness_are_grown_or_unseen() -> None:
    """Grown by the margin they can hold matter; not grown they hold none, finitely."""
    articulation = cabinet()
    size = articulation.size_BP3.clone()
    size[0, 1, 1] = 0.0
    flat = changed(articulation, size_BP3=size)
    origin, direction = view(24, EYES[2])
    states = torch.zeros(1, 576, dtype=torch.long)
    solid = Slab(torch.tensor(-1.0))
    for growth, visible in ((Growth(), True), (NO_GROWTH, False)):
        seen = render_along(
            *(solid, flat, origin, direction, states),
            inverse_beta=SHARP,
            samples=8,
            growth=growth,
        )
        assert (seen.part_alpha_BPR[0, 1].max() > 0.99) == visible
        assert torch.isfinite(seen.rgb_BR3).all()


@pytest.mark.parametrize("growth", [Growth(), NO_GROWTH])
@pytest.mark.parametrize("flat", [None, 0, 1])
def test_slopes_are_finite_along_faces_and_in_boxes_without_thickness(
    growth: Growth, flat: int | None
) -> None:
    """Rays along y: through the middle, in the faces x and z of the base's box and in its edge, a
    hair beside them, and past it; boxes as they are, or without thickness along x or along y."""
    articulation = cabinet()
    size = articulation.size_BP3.clone()
    if flat is not None:
        size[..., flat] = 0.0
    given = {name: getattr(articulation, name) for name in JOINTS + BOXES} | {"size_BP3": size}
    given = {name: value.clone().requires_grad_() for name, value in given.items()}
    half = half_sides(size, growth)[0, 0]
    x = torch.tensor([0.0, 1.0, 0.0, 1.0, 1.0 - 1e-7, 1.0 + 1e-7, 3.0]) * half[0]
    z = torch.tensor([0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0]) * half[2]
    origin = torch.stack([x, torch.full_like(x, -3.0), z], dim=-1)[None]
    direction = torch.tensor([0.0, 1.0, 0.0]).expand_as(origin)
    seen = render_along(
        *(box_field(articulation), changed(articulation, **given), origin, direction),
        torch.zeros(1, len(x), dtype=torch.long),
        inverse_beta=SHARP,
        samples=6,
        coarse=6,
        growth=growth,
        stop_gradient=False,
    )
    total = sum(getattr(seen, field.name).sum() for field in dataclasses.fields(seen))
    assert torch.isfinite(total)
    for name, slope in zip(given, torch.autograd.grad(total, list(given.values())), strict=True):
        assert torch.isfinite(slope).all(), name
    if flat is None:
        assert seen.part_alpha_BPR[0, 0, 0] > 0.99
        assert not seen.part_alpha_BPR[0, 0, 6]


def test_two_parts_in_one_place_hide_each_other_evenly() -> None:
    """Every sample coincides with one of the other: together as opaque as twice the depth."""
    articulation = cabinet(slots=4)
    size = articulation.size_BP3[:, :1].expand(-1, 4, -1)
    center = articulation.center_BP3[:, :1].expand(-1, 4, -1)
    twins = changed(
        articulation,
        size_BP3=size,
        center_BP3=center,
        valid_BP=torch.tensor([[True, True, False, False]]),
    )
    origin, direction = view(12, EYES[0])
    seen = render_along(
        *(box_field(twins), twins, origin, direction, torch.zeros(1, 144, dtype=torch.long)),
        inverse_beta=5.0,
        samples=8,
    )
    one = seen.part_alpha_BPR[0, 0]
    torch.testing.assert_close(seen.alpha_BR[0], 1 - (1 - one) ** 2, rtol=0, atol=1e-6)


def test_gradients_stop_at_boxes_or_pass() -> None:
    articulation = cabinet()
    size = articulation.size_BP3.clone().requires_grad_()
    center = articulation.center_BP3.clone().requires_grad_()
    motion = articulation.motion_BTP.clone().requires_grad_()
    given = changed(articulation, size_BP3=size, center_BP3=center, motion_BTP=motion)
    field = box_field(articulation)
    for stop in (True, False):
        seen = rendered(field, given, 1, inverse_beta=30.0, samples=8, stop_gradient=stop)
        slopes = torch.autograd.grad(
            seen.part_alpha_BPR[:, 1].sum(), (size, center, motion), allow_unused=True
        )
        assert slopes[2] is not None
        assert slopes[2][0, 1, 1] != 0.0
        for slope in slopes[:2]:
            assert (slope is None) if stop else (slope is not None and slope[0, 1].any())


def test_random_places_change_little_and_only_by_the_generator() -> None:
    articulation = cabinet()
    field = box_field(articulation)
    runs = [
        rendered(field, articulation, 1, generator=torch.Generator().manual_seed(seed))
        for seed in (1, 1, 2)
    ]
    assert torch.equal(runs[0].rgb_BR3, runs[1].rgb_BR3)
    assert not torch.equal(runs[0].rgb_BR3, runs[2].rgb_BR3)
    assert (runs[0].alpha_BR - runs[2].alpha_BR).abs().mean() < 0.01


@pytest.mark.parametrize("names", [(), JOINTS, (*JOINTS, *BOXES)])
def test_gradients(names: tuple[str, ...]) -> None:
    """Of all that is rendered, with respect to planes, sharpness, joints and boxes.

    Both sides of a plane blend, for finite differences know no jumps. With the boxes taken as given
    the samples' places are, too, and finite differences would move them: so that switch is off
    where poses change.
    """
    articulation = cabinet(slots=4, dtype=torch.float64)
    torch.manual_seed(0)
    head = FieldHead(FieldConfig(hidden=3, layers=1, octant_blend=2.0), 2).double()
    for parameter in head.parameters():
        torch.nn.init.normal_(parameter, std=0.3)
        parameter.requires_grad_(False)
    origin, direction = view(3, EYES[0], torch.float64)
    states = torch.arange(9)[None] % 2

    def seen(planes: Tensor, sharpness: Tensor, *joints: Tensor) -> tuple[Tensor, ...]:
        given = changed(articulation, **dict(zip(names, joints, strict=True)))
        colors = render_along(
            *(PlaneField(planes, articulation.size_BP3, head), given, origin, direction, states),
            inverse_beta=sharpness,
            samples=3,
            quadrature="linear" if names else "point",
            stop_gradient=not names,
        )
        return tuple(getattr(colors, field.name) for field in dataclasses.fields(colors))

    planes = torch.randn(1, 4, 6, 2, 2, 2, dtype=torch.float64, requires_grad=True)
    sharpness = torch.tensor(8.0, dtype=torch.float64, requires_grad=True)
    others = [getattr(articulation, name).clone().requires_grad_() for name in names]
    assert torch.autograd.gradcheck(seen, (planes, sharpness, *others), fast_mode=True)
