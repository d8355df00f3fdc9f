"""The pixels of one object's images, as rays with what they show.

Letters: T states, V views, M pixels, R rays of a step, digits a length.
"""

from dataclasses import dataclass

import torch
from torch import Tensor

from model.batch import Images
from model.field.rays import pixel_middles, pixel_rays
from model.precision import full

CLEAR = 0.01
"""Alpha below which a pixel shows the background."""


@dataclass(frozen=True, kw_only=True)
class Pixels:
    """Every pixel of T x V images.

    Attributes:
        origin_M3, direction_M3: world rays.
        state_M: the image's state.
        rgb_M3: premultiplied color, the background taken away.
        alpha_M: coverage.
        shown_F: the pixels that show the object.
        states: T.
    """

    origin_M3: Tensor
    direction_M3: Tensor
    state_M: Tensor
    rgb_M3: Tensor
    alpha_M: Tensor
    shown_F: Tensor
    states: int

    def drawn(self, count: int, generator: torch.Generator) -> Tensor:
        """(R,) numbers of pixels, one half of those that show the object, one half of all."""
        half = count // 2
        some = torch.randint(len(self.shown_F), (half,), generator=generator)
        others = torch.randint(len(self.alpha_M), (count - half,), generator=generator)
        return torch.cat([self.shown_F[some], others.to(self.shown_F.device)])


def pixels_of(images: Images, index: int) -> Pixels:
    """The pixels of object `index`; its background is the mean color where nothing is shown."""
    rgb_TV3HW, alpha_TVHW = full(images.rgb_BTV3HW[index]), full(images.alpha_BTVHW[index])
    states, views, height, width = alpha_TVHW.shape
    middles = pixel_middles(height, width, alpha_TVHW.device)
    origin, direction = pixel_rays(
        images.intrinsics_BTV33[index], images.camera_from_world_BTV44[index], middles
    )
    alpha_M, rgb_M3 = alpha_TVHW.flatten(), rgb_TV3HW.movedim(2, -1).reshape(-1, 3)
    clear_M1 = (alpha_M < CLEAR)[:, None]
    background_3 = (rgb_M3 * clear_M1).sum(dim=0) / clear_M1.sum().clamp(min=1)
    numbers = torch.arange(states, device=alpha_M.device)
    return Pixels(
        origin_M3=origin.reshape(-1, 3),
        direction_M3=direction.reshape(-1, 3),
        state_M=numbers.repeat_interleave(views * height * width),
        rgb_M3=rgb_M3 - (1.0 - alpha_M[:, None]) * background_3,
        alpha_M=alpha_M,
        shown_F=(alpha_M > CLEAR).nonzero().squeeze(-1),
        states=states,
    )
