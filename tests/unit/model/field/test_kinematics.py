"""Laws of poses: products along parents, rays there and back, finite slopes everywhere."""

import math

import numpy as np
import pytest
import torch

from artgen.articulation.kinematics import forward_kinematics
from artgen.articulation.types import Joint, Limit
from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation
from model.field.kinematics import (
    LEAST_NORM,
    inverse_rigid,
    moved,
    rays_at_rest,
    turn,
    unit,
    world_from_rest,
)
from tests.unit.model.box_scenes import cabinet, changed, view

EPS64, EPS32 = torch.finfo(torch.float64).eps, torch.finfo(torch.float32).eps


def random_tree(seed: int, parts: int) -> tuple[Articulation, list[Joint], list[dict[str, float]]]:
    """A tree of any shape with joints of both types, as tensors and as joints of the house."""
    rng = Stream(seed, "tree").generator()
    axes = rng.normal(size=(parts, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    origins = rng.uniform(-1, 1, size=(parts, 3))
    kinds = rng.choice([REVOLUTE, PRISMATIC], size=parts)
    kinds[0], axes[0], origins[0] = FIXED, 0.0, 0.0
    parents = np.array([-1, *(int(rng.integers(0, k)) for k in range(1, parts))])
    motion = rng.uniform(-0.5, 0.5, size=(2, parts))
    joints = [
        Joint(
            name=f"j{k}",
            type="revolute" if kinds[k] == REVOLUTE else "prismatic",
            parent=f"p{parents[k]}",
            child=f"p{k}",
            axis=tuple(axes[k]),
            origin=tuple(origins[k]),
            limit=Limit(lower=-10.0, upper=10.0),
            friction=0.0,
            damping=0.0,
            effort=1.0,
        )
        for k in range(1, parts)
    ]
    scale = np.where(kinds == REVOLUTE, 2 * math.pi, 2.0)
    states = [{f"j{k}": scale[k] * motion[t, k] for k in range(1, parts)} for t in range(2)]
    blank = cabinet(slots=parts, dtype=torch.float64) if parts >= 4 else None
    assert blank is not None
    tree = changed(
        blank,
        type_BP=torch.tensor(kinds)[None],
        axis_BP3=torch.tensor(axes)[None],
        origin_BP3=torch.tensor(origins)[None],
        motion_BTP=torch.tensor(motion)[None],
        parent_BP=torch.tensor(parents)[None],
    )
    return tree, joints, states


@pytest.mark.parametrize("seed", range(6))
def test_poses_equal_the_kinematics_of_the_house(seed: int) -> None:
    """Each product of 4 x 4 adds some 4 roundings of entries up to 1 + reach; chains of 8 with a
    reach of 16 give 8 * 4 * 17 eps at the very most."""
    tree, joints, states = random_tree(seed, 8)
    poses = world_from_rest(tree)[0].numpy()
    for t, state in enumerate(states):
        expected = forward_kinematics("p0", joints, state)
        for k in range(8):
            np.testing.assert_allclose(poses[t, k], expected[f"p{k}"], rtol=0, atol=544 * EPS64)


def test_a_chain_of_all_parts_closes() -> None:
    """Pointer doubling needs three rounds for eight links; one less would lose the far ones."""
    tree, _, _ = random_tree(0, 8)
    slide = changed(
        tree,
        type_BP=torch.tensor([[FIXED] + [PRISMATIC] * 7]),
        axis_BP3=torch.tensor([0.0, 0.0, 1.0], dtype=torch.float64).expand(1, 8, 3),
        motion_BTP=torch.full((1, 1, 8), 0.5, dtype=torch.float64),
        parent_BP=torch.arange(-1, 7)[None],
    )
    height = world_from_rest(slide)[0, 0, :, 2, 3]
    assert height.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]


@pytest.mark.parametrize("seed", range(3))
def test_a_ray_at_rest_is_the_world_ray_moved_back(seed: int) -> None:
    """Points at equal distances along both are one point, moved by the pose."""
    tree, _, _ = random_tree(seed, 8)
    origin, direction = view(3, (2.0, -2.0, 1.0), torch.float64)
    state = torch.arange(9)[None] % 2
    poses = world_from_rest(tree)
    at_rest, along = rays_at_rest(origin, direction, state, poses)
    for t, distance in ((0, 0.7), (1, 3.0)):
        own = state[0] == t
        there = moved(poses[:, t], (at_rest + distance * along)[:, :, own])
        here = (origin + distance * direction)[:, None, own]
        # Poses reach 16 radii; a dozen roundings of that size.
        torch.testing.assert_close(there, here.expand_as(there), rtol=0, atol=200 * EPS64)


def test_s7_as_printed_does_not_lead_back() -> None:
    """The supplement's o + R(-q) (o - O) + O is not where a moved point came from."""
    articulation = cabinet(dtype=torch.float64)
    pose = world_from_rest(articulation)[0, 1, 2]
    point = torch.tensor([[0.3, -0.4, -0.2]], dtype=torch.float64)
    there = moved(pose, point)
    back, origin = pose[:3, :3].T, articulation.origin_BP3[0, 2]
    printed = there + (there - origin) @ back.T + origin
    meant = (there - origin) @ back.T + origin
    torch.testing.assert_close(meant, point, rtol=0, atol=8 * EPS64)
    assert (printed - point).abs().max() > 0.1


def test_inverse_is_inverse() -> None:
    tree, _, _ = random_tree(1, 8)
    poses = world_from_rest(tree)
    identity = torch.eye(4, dtype=torch.float64).expand_as(poses)
    torch.testing.assert_close(inverse_rigid(poses) @ poses, identity, rtol=0, atol=200 * EPS64)


def test_a_half_turn_either_way_is_the_same() -> None:
    """sin(pi) rounds to 1e-16 (float64), so both matrices agree to a few eps."""
    axis = unit(torch.tensor([[1.0, -2.0, 0.5]], dtype=torch.float64))
    angle = torch.tensor([math.pi], dtype=torch.float64)
    torch.testing.assert_close(turn(axis, angle), turn(axis, -angle), rtol=0, atol=4 * EPS64)


def test_small_turns_keep_their_digits() -> None:
    """1 - cos loses all digits at 1e-4 rad in float32; 2 sin^2 of the half angle keeps them."""
    axis = unit(torch.tensor([[0.3, -0.5, 0.8]], dtype=torch.float64))
    angle = torch.tensor([1e-4], dtype=torch.float64)
    exact = turn(axis, angle)[0, 0, 0]
    found = turn(axis.float(), angle.float())[0, 0, 0].double()
    # Relative rounding of some ten float32 operations.
    assert abs(found / exact - 1.0) < 10 * EPS32
    naive = 1.0 - torch.cos(angle.float())
    assert abs(naive.double() / (1.0 - torch.cos(angle)) - 1.0).item() > 1e-3


def test_axes_near_zero_have_bounded_slopes() -> None:
    for length in (0.0, 1e-30, 1e-8, 1e-4, 1.0):
        raw = torch.tensor([[length, 0.0, 0.0]], requires_grad=True)
        unit(raw).sum().backward()
        assert raw.grad is not None
        assert raw.grad.abs().max() <= 1.0 / LEAST_NORM * (1.0 + EPS32)
    found = unit(torch.tensor([[0.0, 3.0, 4.0]]))
    torch.testing.assert_close(found, torch.tensor([[0.0, 0.6, 0.8]]), rtol=EPS32, atol=0)


def test_fixed_and_empty_slots_stay_whatever_their_numbers_say() -> None:
    articulation = cabinet()
    noisy = changed(
        articulation,
        motion_BTP=torch.ones_like(articulation.motion_BTP),
        axis_BP3=torch.ones_like(articulation.axis_BP3),
    )
    poses = world_from_rest(noisy)
    still = (articulation.type_BP == FIXED)[0]
    assert torch.equal(poses[0, :, still], torch.eye(4).expand(2, int(still.sum()), 4, 4))


def test_autocast_takes_no_digits() -> None:
    articulation = cabinet()
    origin, direction = view(3, (2.0, -2.0, 1.0))
    state = torch.ones(1, 9, dtype=torch.long)
    plain = rays_at_rest(origin, direction, state, world_from_rest(articulation))
    with torch.autocast("cpu", dtype=torch.bfloat16):
        inside = rays_at_rest(origin, direction, state, world_from_rest(articulation))
    for a, b in zip(plain, inside, strict=True):
        assert torch.equal(a, b)


@pytest.mark.parametrize("motion", [0.0, 0.13, 0.5, -0.5])
def test_gradients_of_poses_and_rays(motion: float) -> None:
    """Including rest and half turns either way."""
    articulation = cabinet(slots=4, dtype=torch.float64)
    origin, direction = view(2, (2.0, -2.0, 1.0), torch.float64)
    state = torch.tensor([[0, 1, 1, 0]])

    def rays(axis: torch.Tensor, point: torch.Tensor, q: torch.Tensor) -> torch.Tensor:
        given = changed(articulation, axis_BP3=axis, origin_BP3=point, motion_BTP=q)
        return torch.cat(rays_at_rest(origin, direction, state, world_from_rest(given)), dim=-1)

    inputs = (
        articulation.axis_BP3.clone().requires_grad_(),
        articulation.origin_BP3.clone().requires_grad_(),
        torch.full_like(articulation.motion_BTP, motion).requires_grad_(),
    )
    assert torch.autograd.gradcheck(rays, inputs)
    raw = torch.tensor([[0.3, -0.2, 0.9], [1e-5, 2e-5, 0.0]], dtype=torch.float64)
    assert torch.autograd.gradcheck(unit, (raw.requires_grad_(),), eps=1e-8)
