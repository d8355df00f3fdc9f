"""Tiny networks, random images of random cameras, and random truths to hold predictions to."""

import dataclasses

import numpy as np
import torch
from torch import Tensor

from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation, Batch, Images, Rays
from model.config import FieldConfig, ImageTokens, ModelConfig, PlaneConfig, Trunk
from model.network.art import Art

IMAGE_PX, SLOTS, STATES, VIEWS = 8, 4, 2, 3

TINY = ModelConfig(
    images=ImageTokens(image_px=IMAGE_PX, patch_px=4, states=STATES, state_dim=5),
    trunk=Trunk(width=16, blocks=4, heads=2, mlp_ratio=2.0),
    planes=PlaneConfig(grid=2, scale=2, channels=4),
    field=FieldConfig(hidden=8, layers=1),
    slots=SLOTS,
)
"""The paper's reading of everything, small."""
BEYOND = dataclasses.replace(TINY, motion="state_tokens", limits=True, tree=True, count=True)
"""With all heads."""


def made(config: ModelConfig, seed: int = 0, dtype: torch.dtype = torch.float64) -> Art:
    """A network with reproducible weights, larger than the initial ones so that laws have bite."""
    torch.manual_seed(seed)
    art = Art(config)
    with torch.no_grad():
        for weights in art.trunk.parameters():
            weights.add_(0.2 * torch.randn_like(weights))
    return art.to(dtype)


def cameras(stream: Stream, leading: tuple[int, ...]) -> Tensor:
    """Rigid camera_from_world, three radii away."""
    rng = stream.generator()
    turned = np.linalg.qr(rng.normal(size=(*leading, 3, 3)))[0]
    turned *= np.sign(np.linalg.det(turned))[..., None, None]
    pose = np.zeros((*leading, 4, 4))
    pose[..., :3, :3] = turned
    pose[..., 2, 3], pose[..., 3, 3] = 3.0, 1.0
    return torch.tensor(pose)


def drawn_images(
    seed: int,
    *,
    objects: int = 2,
    states: int = STATES,
    views: int = VIEWS,
    dtype: torch.dtype = torch.float64,
) -> Images:
    """Noise seen by random cameras."""
    stream = Stream(seed, "images")
    shape = (objects, states, views)
    rng = stream.child("pixels").generator()
    intrinsics = torch.tensor([[9.0, 0.0, 4.2], [0.0, 8.5, 3.9], [0.0, 0.0, 1.0]])
    return Images(
        rgb_BTV3HW=torch.tensor(rng.uniform(size=(*shape, 3, IMAGE_PX, IMAGE_PX)), dtype=dtype),
        alpha_BTVHW=torch.tensor(rng.uniform(size=(*shape, IMAGE_PX, IMAGE_PX)), dtype=dtype),
        intrinsics_BTV33=intrinsics.to(dtype).expand(*shape, 3, 3),
        camera_from_world_BTV44=cameras(stream.child("cameras"), shape).to(dtype),
    )


def held(counts: tuple[int, ...], slots: int = SLOTS) -> Tensor:
    """(B, slots) bool: the first so many slots of each object."""
    return torch.arange(slots) < torch.tensor(counts)[:, None]


def drawn_truth(
    seed: int,
    counts: tuple[int, ...] = (3, 4),
    *,
    slots: int = SLOTS,
    dtype: torch.dtype = torch.float64,
) -> Articulation:
    """Random parts; the last hangs on the one before, the others on the base."""
    rng = Stream(seed, "truth").generator()
    valid = held(counts, slots)
    shape = tuple(valid.shape)
    moves = valid & (torch.arange(slots) > 0)
    kind = torch.tensor(rng.choice([REVOLUTE, PRISMATIC], size=shape))
    kind = torch.where(moves, kind, FIXED)
    axis = torch.nn.functional.normalize(torch.tensor(rng.normal(size=(*shape, 3))), dim=-1)
    last = torch.arange(slots) == torch.tensor(counts)[:, None] - 1
    parent = torch.where(last & moves, torch.tensor(counts)[:, None] - 2, 0)

    def number(low: float, high: float, *size: int) -> Tensor:
        return torch.tensor(rng.uniform(low, high, size=(*shape, *size)))

    truth = Articulation(
        valid_BP=valid,
        center_BP3=number(-0.4, 0.4, 3) * valid[..., None],
        size_BP3=number(0.2, 0.6, 3) * valid[..., None],
        type_BP=kind,
        axis_BP3=axis * moves[..., None],
        origin_BP3=number(-0.4, 0.4, 3) * (kind == REVOLUTE)[..., None],
        motion_BTP=(number(0.0, 0.25, STATES) * moves[..., None]).transpose(1, 2),
        limits_BP2=number(0.0, 0.25, 2) * torch.tensor([-0.2, 1.0]) * moves[..., None],
        parent_BP=torch.where(moves, parent, -1),
    )
    return truth.mapped(lambda tensor: tensor.to(dtype) if tensor.is_floating_point() else tensor)


def drawn_rays(
    seed: int, truth: Articulation, count: int, *, dtype: torch.dtype = torch.float64
) -> Rays:
    """Rays through the object with random targets, empty where a slot is."""
    rng = Stream(seed, "rays").generator()
    objects, slots = truth.valid_BP.shape

    def uniform(*size: int) -> Tensor:
        return torch.tensor(rng.uniform(size=size), dtype=dtype)

    eye = torch.nn.functional.normalize(torch.tensor(rng.normal(size=(objects, count, 3))), dim=-1)
    aim = torch.tensor(rng.uniform(-0.4, 0.4, size=(objects, count, 3)))
    part_alpha = uniform(objects, slots, count) * truth.valid_BP[..., None]
    alpha = uniform(objects, count)
    return Rays(
        origin_BR3=(3.0 * eye).to(dtype),
        direction_BR3=torch.nn.functional.normalize(aim - 3.0 * eye, dim=-1).to(dtype),
        state_BR=torch.tensor(rng.integers(STATES, size=(objects, count))),
        part_rgb_BPR3=part_alpha[..., None] * uniform(objects, slots, count, 3),
        part_alpha_BPR=part_alpha,
        rgb_BR3=alpha[..., None] * uniform(objects, count, 3),
        alpha_BR=alpha,
        distance_BR=2.0 + uniform(objects, count),
    )


def drawn_batch(seed: int, *, rays: int = 0, dtype: torch.dtype = torch.float64) -> Batch:
    """Two objects of three and four parts."""
    truth = drawn_truth(seed, dtype=dtype)
    return Batch(
        images=drawn_images(seed, dtype=dtype),
        truth=truth,
        radius_B=torch.ones(2, dtype=dtype),
        rays=drawn_rays(seed, truth, rays, dtype=dtype) if rays else None,
    )
