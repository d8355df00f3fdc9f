"""Where an object may be, from masks alone: the box of its visual hull.

Letters: V views, N points, H W pixels, digits a length.
"""

import torch
import torch.nn.functional as F
from torch import Tensor

from artgen.core.errors import ModelError
from model.batch import Images
from model.precision import full

SIDE = 40
"""Points along each side of the cube that is searched."""
COVERED = 0.5
"""Alpha from which a pixel counts as the object's."""


def hull_bounds(images: Images, *, index: int = 0, state: int = 0) -> Tensor:
    """(2, 3) corners of the box of all points in the unit cube that every view of a state sees in
    the foreground, a step of the search wider; radii.

    Raises:
        ModelError: no point is seen so; masks or cameras are wrong.
    """
    line = torch.linspace(-1.0, 1.0, SIDE, device=images.alpha_BTVHW.device)
    points = torch.stack(torch.meshgrid(line, line, line, indexing="ij"), dim=-1).reshape(-1, 3)
    alpha_VHW = full(images.alpha_BTVHW[index, state])
    inside = seen_by_all(
        points,
        alpha_VHW,
        images.intrinsics_BTV33[index, state],
        images.camera_from_world_BTV44[index, state],
    )
    if not inside.any():
        raise ModelError(
            f"state {state}: no point of the unit sphere lies in the foreground of all "
            f"{len(alpha_VHW)} views; check masks, and that cameras are in radii with OpenCV axes"
        )
    hull, step = points[inside], 2.0 / (SIDE - 1)
    return torch.stack([hull.amin(dim=0) - step, hull.amax(dim=0) + step])


def seen_by_all(
    points_N3: Tensor, alpha_VHW: Tensor, intrinsics_V33: Tensor, camera_from_world_V44: Tensor
) -> Tensor:
    """(N,) whether points lie in the foreground of every camera; images hold the whole object."""
    height, width = alpha_VHW.shape[1:]
    local_VN3 = (
        points_N3 @ camera_from_world_V44[:, :3, :3].mT + camera_from_world_V44[:, None, :3, 3]
    )
    image_VN3 = local_VN3 @ intrinsics_V33.mT
    depth_VN1 = image_VN3[..., 2:].clamp(min=1e-6)
    size = image_VN3.new_tensor([width, height])
    grid_VN2 = 2.0 * image_VN3[..., :2] / depth_VN1 / size - 1.0
    found = F.grid_sample(alpha_VHW[:, None], grid_VN2[:, None], align_corners=False)[:, 0, 0]
    return ((image_VN3[..., 2] > 0.0) & (found >= COVERED)).all(dim=0)
