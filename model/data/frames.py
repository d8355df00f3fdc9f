"""Raw images of T states and V views to what the network sees: cropped, over a background."""

from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from model.batch import Images
from model.data.crop import square_views
from model.data.views import Views


def framed_images(
    rgba_BTVHW4: Tensor,
    views: Sequence[Views],
    backgrounds: Sequence[NDArray[np.float32]],
    *,
    size: int,
) -> Images:
    """The network's images of B items.

    Args:
        rgba_BTVHW4: uint8 sRGB with straight alpha.
        views: of every item, before the crop.
        backgrounds: (3,) sRGB of every item.

    Raises:
        ModelError: an image shows no foreground.
    """
    shape, device = rgba_BTVHW4.shape[:3], rgba_BTVHW4.device
    intrinsics = torch.from_numpy(np.stack([view.intrinsics for view in views])).to(device)
    square, cropped = square_views(rgba_BTVHW4.flatten(0, 2), intrinsics.flatten(0, 2), size=size)
    square = square.view(*shape, size, size, 4)
    poses = np.stack([view.camera_from_world for view in views]).astype(np.float32)
    behind = torch.from_numpy(np.stack(backgrounds)).to(device)[:, None, None, None, None]
    rgb = square[..., :3] + (1.0 - square[..., 3:]) * behind
    return Images(
        rgb_BTV3HW=rgb.permute(0, 1, 2, 5, 3, 4).contiguous(),
        alpha_BTVHW=square[..., 3].contiguous(),
        intrinsics_BTV33=cropped.view(*shape, 3, 3).float(),
        camera_from_world_BTV44=torch.from_numpy(poses).to(device),
    )
