"""Cameras as tensors, and the rays through the pixels of their images."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from model.batch import TensorBlock
from model.data.views import Views


@dataclass(frozen=True, kw_only=True)
class Cameras(TensorBlock):
    """N cameras a scene.

    Attributes:
        intrinsics_BN33: float32 px.
        camera_from_world_BN44: float32, radii.
        state_BN: int64 state that each looks at.
    """

    intrinsics_BN33: Tensor
    camera_from_world_BN44: Tensor
    state_BN: Tensor

    @property
    def center_BN3(self) -> Tensor:
        """Where the cameras stand, radii."""
        turn = self.camera_from_world_BN44[..., :3, :3]
        shift = self.camera_from_world_BN44[..., :3, 3:]
        return -(turn.transpose(2, 3) @ shift)[..., 0]

    def sights(self, item: Tensor, camera: Tensor, pixel: Tensor, width: int) -> Tensor:
        """(..., 3) world vectors through pixel centers, as long as one radius of depth."""
        matrix = self.intrinsics_BN33[item, camera]
        x = (pixel % width + 0.5 - matrix[..., 0, 2]) / matrix[..., 0, 0]
        y = (pixel // width + 0.5 - matrix[..., 1, 2]) / matrix[..., 1, 1]
        right, down, forward = self.camera_from_world_BN44[item, camera, :3, :3].unbind(dim=-2)
        return x[..., None] * right + y[..., None] * down + forward


def state_cameras(views: Sequence[Views], device: torch.device) -> Cameras:
    """The T x V cameras of each of B items, state by state."""
    intrinsics = np.stack([view.intrinsics for view in views]).astype(np.float32)
    poses = np.stack([view.camera_from_world for view in views]).astype(np.float32)
    items, states, count = intrinsics.shape[:3]
    state = torch.arange(states, device=device).repeat_interleave(count)
    return Cameras(
        intrinsics_BN33=torch.from_numpy(intrinsics).to(device).flatten(1, 2),
        camera_from_world_BN44=torch.from_numpy(poses).to(device).flatten(1, 2),
        state_BN=state.expand(items, -1),
    )
