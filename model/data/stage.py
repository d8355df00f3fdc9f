"""Scenes on a device: all their triangles together, posed, seen by cameras, hit by rays, shaded.

B scenes, N cameras a scene, T states, V vertices and F triangles of all scenes together.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.nn import functional

from model.batch import TensorBlock
from model.data.cameras import Cameras
from model.data.cast import Hits, depth_of, first_hits, projected, triangle_of
from model.data.look import Lighting, lighting, shaded
from model.data.scene import Scene


@dataclass(frozen=True, kw_only=True)
class Stage(TensorBlock):
    """Posed triangles.

    Attributes:
        points_VT3: float32 vertices in each state, world, radii.
        faces_F3: int64 into all vertices.
        normal_FT3: unit, outward, world.
        part_F: int64.
        order_F: float32 rank of the body.
        item_F: int64 scene of each triangle.
        item_V: int64 scene of each vertex.
        looks_F6: as `Soup.looks`.
        lights: of every scene.
    """

    points_VT3: Tensor
    faces_F3: Tensor
    normal_FT3: Tensor
    part_F: Tensor
    order_F: Tensor
    item_F: Tensor
    item_V: Tensor
    looks_F6: Tensor
    lights: Lighting


def staged(scenes: Sequence[Scene], device: torch.device) -> Stage:
    """The scenes on a device."""

    def moved(arrays: list[NDArray[np.generic]]) -> Tensor:
        return torch.from_numpy(np.concatenate(arrays)).to(device)

    counts = [len(scene.vertices) for scene in scenes]
    starts = np.cumsum([0, *counts[:-1]])
    faces = moved([s.faces.astype(np.int64) + at for s, at in zip(scenes, starts, strict=True)])
    part_F = moved([scene.part.astype(np.int64) for scene in scenes])
    item_V = moved([np.full(count, b) for b, count in enumerate(counts)])
    item_F = item_V[faces[:, 0]]
    part_V = torch.zeros_like(item_V).scatter_(0, faces.flatten(), part_F.repeat_interleave(3))
    poses_BTP44 = torch.from_numpy(np.stack([scene.poses for scene in scenes])).to(device)
    poses_VT44 = poses_BTP44[item_V, :, part_V]
    rest_V3 = moved([scene.vertices for scene in scenes])
    points = torch.einsum("vtij,vj->vti", poses_VT44[..., :3, :3], rest_V3) + poses_VT44[..., :3, 3]
    a, b, c = (points[faces[:, k]] for k in range(3))
    return Stage(
        points_VT3=points,
        faces_F3=faces,
        normal_FT3=functional.normalize(torch.linalg.cross(b - a, c - a), dim=-1, eps=1e-20),
        part_F=part_F,
        order_F=moved([scene.body.astype(np.float32) for scene in scenes]),
        item_F=item_F,
        item_V=item_V,
        looks_F6=moved([scene.looks for scene in scenes]),
        lights=lighting([scene.look for scene in scenes], device),
    )


def flat_points(stage: Stage, cameras: Cameras) -> Tensor:
    """(V, N, 3) every vertex in every camera of its scene: px x, px y, 1 / depth."""
    count = cameras.state_BN.shape[1]
    state_VN = _of_items(cameras.state_BN, stage.item_V)
    points_VN3 = stage.points_VT3.gather(1, state_VN[..., None].expand(-1, -1, 3))
    pose_VN44 = _of_items(cameras.camera_from_world_BN44, stage.item_V)
    local = pose_VN44[..., :3, 3]
    for k in range(3):  # Plain sums are quicker than many small matrix products.
        local = local + pose_VN44[..., :3, k] * points_VN3[..., k, None]
    intrinsics = _of_items(cameras.intrinsics_BN33, stage.item_V).flatten(0, 1)
    return projected(local.flatten(0, 1), intrinsics).view(-1, count, 3)


def _of_items(rows_B: Tensor, item: Tensor) -> Tensor:
    """`rows_B[item]`, without a copy of one item's rows."""
    if len(rows_B) == 1:
        return rows_B.expand(len(item), *rows_B.shape[1:])
    return rows_B[item]


def cast(stage: Stage, cameras: Cameras, *, size: int, parts: int | None = None) -> Hits:
    """First hits of every pixel of every camera.

    Args:
        size: width and height of the images, px.
        parts: P; each part is then seen alone, in a channel of its own.

    Returns:
        (B N, H, W), or (B N P, H, W).
    """
    items, count = cameras.state_BN.shape
    flat_FN33 = flat_points(stage, cameras)[stage.faces_F3].transpose(1, 2)
    camera_N = torch.arange(count, device=flat_FN33.device)
    channel_FN = stage.item_F[:, None] * count + camera_N
    if parts is not None:
        channel_FN = channel_FN * parts + stage.part_F[:, None]
    return first_hits(
        flat_FN33.flatten(0, 1),
        stage.order_F.repeat_interleave(count),
        channel_FN.flatten(),
        channels=items * count * (parts or 1),
        size=(size, size),
    )


def frame_windows(stage: Stage, cameras: Cameras) -> Tensor:
    """(B, N, 3) float64 left, top, side: the square about the object's outline, px."""
    flat_VN2 = flat_points(stage, cameras)[..., :2]
    items, count = cameras.state_BN.shape
    index = stage.item_V[:, None, None].expand_as(flat_VN2)
    space = flat_VN2.new_zeros(items, count, 2)
    low = space.scatter_reduce(0, index, flat_VN2, reduce="amin", include_self=False).double()
    high = space.scatter_reduce(0, index, flat_VN2, reduce="amax", include_self=False).double()
    side = (high - low).amax(dim=-1, keepdim=True)
    return torch.cat([(low + high - side) / 2, side], dim=-1)


def colors(
    stage: Stage,
    cameras: Cameras,
    code: Tensor,
    item: Tensor,
    camera: Tensor,
    pixel: Tensor,
    width: int,
) -> Tensor:
    """(M, 3) sRGB of M hits: codes, and whose camera and pixel each is seen in."""
    triangle = triangle_of(code) // cameras.state_BN.shape[1]
    sight = functional.normalize(cameras.sights(item, camera, pixel, width), dim=-1)
    normal = stage.normal_FT3[triangle, cameras.state_BN[item, camera]]
    return shaded(stage.looks_F6[triangle], normal, sight, stage.lights, item)


def photographs(stage: Stage, cameras: Cameras, *, size: int) -> Tensor:
    """(B, N, H, W, 4) uint8 sRGB with straight alpha, as a renderer's files hold them."""
    code = cast(stage, cameras, size=size).code_CHW
    items, count = cameras.state_BN.shape
    hit = torch.nonzero(code.flatten() >= 0)[:, 0]
    image, pixel = hit // (size * size), hit % (size * size)
    color = colors(stage, cameras, code.flatten()[hit], image // count, image % count, pixel, size)
    rgba = torch.zeros(code.numel(), 4, dtype=torch.uint8, device=code.device)
    rgba[hit, :3] = (255.0 * color + 0.5).to(torch.uint8)
    rgba[hit, 3] = 255
    return rgba.view(items, count, size, size, 4)


def depths(stage: Stage, cameras: Cameras, code: Tensor) -> Tensor:
    """Depth of hits along their camera's z axis, radii; 0 where nothing is hit."""
    return depth_of(code, stage.order_F.repeat_interleave(cameras.state_BN.shape[1]))
