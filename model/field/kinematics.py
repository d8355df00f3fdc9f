"""Poses of parts, and world rays taken back into the rest frame of each part.

ART, supplement, S4 to S8, radii: prismatic x' = x + 2 S D; revolute x' = O + R(D, 2 pi S) (x - O).
Beyond the paper, parts may hang on parts: poses multiply along parents, each joint stated at rest.
S7 as printed begins with "o +", which breaks the law that moving there and back changes nothing;
the inverse here is that of the rigid matrix.

Letters: B objects, T states, P parts, R rays, X any leading sizes.
"""

import math

import torch
from torch import Tensor

from model.batch import PRISMATIC, REVOLUTE, Articulation
from model.precision import full, full_precision

LEAST_NORM = 1e-4
"""Vectors shorter than this shrink to zero instead of being normalized, with slopes below 1e4."""


def unit(vectors_X3: Tensor) -> Tensor:
    """Unit vectors; those shorter than `LEAST_NORM` keep their direction and fade out linearly."""
    norm_X1: Tensor = torch.linalg.vector_norm(full(vectors_X3), dim=-1, keepdim=True)
    return full(vectors_X3) / norm_X1.clamp(min=LEAST_NORM)


def turn(axis_X3: Tensor, angle_X: Tensor) -> Tensor:
    """(X, 3, 3) rotation less identity, sin K + 2 sin^2(angle / 2) K^2; zero where the axis is."""
    x, y, z = axis_X3.unbind(-1)
    zero = torch.zeros_like(x)
    cross_X9 = torch.stack([zero, -z, y, z, zero, -x, -y, x, zero], dim=-1)
    cross_X33 = cross_X9.reshape(*angle_X.shape, 3, 3)
    sine = torch.sin(angle_X)[..., None, None]
    versine = (2.0 * torch.sin(angle_X / 2.0).square())[..., None, None]
    return sine * cross_X33 + versine * (cross_X33 @ cross_X33)


def own_motion(articulation: Articulation) -> Tensor:
    """(B, T, P, 4, 4) what each part's own joint does, object frame at rest; identity if fixed."""
    with full_precision(articulation.axis_BP3):
        motion_BTP = full(articulation.motion_BTP)
        axis_BTP3 = full(articulation.axis_BP3)[:, None].expand(*motion_BTP.shape, 3)
        revolute_BTP = (articulation.type_BP == REVOLUTE)[:, None]
        prismatic_BTP = (articulation.type_BP == PRISMATIC)[:, None]
        turn_BTP33 = turn(axis_BTP3, 2.0 * math.pi * motion_BTP * revolute_BTP)
        slide_BTP3 = 2.0 * (motion_BTP * prismatic_BTP)[..., None] * axis_BTP3
        origin_BTP31 = full(articulation.origin_BP3)[:, None, :, :, None]
        shift_BTP31 = slide_BTP3[..., None] - turn_BTP33 @ origin_BTP31
        eye_33 = torch.eye(3, dtype=motion_BTP.dtype, device=motion_BTP.device)
        return _rigid(turn_BTP33 + eye_33, shift_BTP31)


def world_from_rest(articulation: Articulation) -> Tensor:
    """(B, T, P, 4, 4) rigid poses: the product of each part's motions from the base to itself.

    Pointer doubling: after k rounds every pose holds 2^k motions, so all chains close in
    log2(P) products. Parents that run in a circle give rigid matrices without meaning.
    """
    poses = own_motion(articulation)
    _, states, slots = poses.shape[:3]
    parent_BP = articulation.parent_BP.clamp(min=0)
    with full_precision(poses):
        for _ in range(math.ceil(math.log2(max(slots, 1)))):
            index = parent_BP[:, None, :, None, None].expand(-1, states, -1, 4, 4)
            poses = torch.gather(poses, 2, index) @ poses
            parent_BP = torch.gather(parent_BP, 1, parent_BP)
    return poses


def inverse_rigid(matrices_X44: Tensor) -> Tensor:
    """Inverse of rigid matrices."""
    with full_precision(matrices_X44):
        back_X33 = matrices_X44[..., :3, :3].transpose(-1, -2)
        return _rigid(back_X33, -back_X33 @ matrices_X44[..., :3, 3:])


def moved(matrices_X44: Tensor, points_XN3: Tensor) -> Tensor:
    """(X, N, 3) points under rigid matrices."""
    with full_precision(matrices_X44):
        turned = full(points_XN3) @ matrices_X44[..., :3, :3].transpose(-1, -2)
        return turned + matrices_X44[..., None, :3, 3]


def rays_at_rest(
    origin_BR3: Tensor, direction_BR3: Tensor, state_BR: Tensor, world_from_rest_BTP44: Tensor
) -> tuple[Tensor, Tensor]:
    """World rays in the rest frame of each part: origins and directions, both (B, P, R, 3).

    Rigid motion keeps the ray parameter, so a distance along one is a distance along the other.
    """
    rest_BTP44 = inverse_rigid(world_from_rest_BTP44)
    with full_precision(rest_BTP44):
        # Matrix products over all states, then a choice: gathering a matrix for every ray costs
        # more memory, and its gradient adds thousands of rays into each matrix by atomics.
        back_BTP33 = rest_BTP44[..., :3, :3].transpose(-1, -2)
        direction_BTPR3 = full(direction_BR3)[:, None, None] @ back_BTP33
        origin_BTPR3 = moved(rest_BTP44, origin_BR3[:, None, None])
    return _of_state(origin_BTPR3, state_BR), _of_state(direction_BTPR3, state_BR)


def _of_state(values_BTPR3: Tensor, state_BR: Tensor) -> Tensor:
    parts = values_BTPR3.shape[2]
    index = state_BR[:, None, None, :, None].expand(-1, 1, parts, -1, 3)
    return torch.gather(values_BTPR3, 1, index)[:, 0]


def _rigid(rotation_X33: Tensor, shift_X31: Tensor) -> Tensor:
    last = rotation_X33.new_tensor([0.0, 0.0, 0.0, 1.0]).expand(*rotation_X33.shape[:-2], 1, 4)
    return torch.cat([torch.cat([rotation_X33, shift_X31], dim=-1), last], dim=-2)
