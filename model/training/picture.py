"""What the network makes of a batch, beside what it was shown: one picture for the log.

B objects, T states, V views, P part slots, H W pixels, digits a length.
"""

import numpy as np
import torch
from numpy.typing import NDArray

from model.batch import Articulation, Batch, Images
from model.field.rays import pixel_middles, pixel_rays
from model.field.volume import RayColors, render_along
from model.network.art import Art
from model.network.prediction import Prediction
from model.training.objective import field_on
from model.training.schedule import Moment

OBJECTS = 4
"""Rows of the picture at most."""
GRAY = 0.8
"""Behind what is rendered, linear in display values."""


def picture_of(art: Art, batch: Batch, moment: Moment) -> NDArray[np.uint8]:
    """(H, W, 3) sRGB; a row an object: its first view in every state as shown, then as rendered."""
    images = batch.images.mapped(lambda tensor: tensor[:OBJECTS, :, :1])
    truth = batch.truth.mapped(lambda tensor: tensor[:OBJECTS])
    with torch.no_grad():
        every_view = batch.images.mapped(lambda tensor: tensor[:OBJECTS])
        prediction = art(every_view, truth.valid_BP)
        articulation = truth if moment.forced else prediction.articulation
        found = seen_by(prediction, articulation, images, moment)
    size = images.rgb_BTV3HW.shape[-1]
    rgb_BT3HW = found.rgb_BR3 + GRAY * (1.0 - found.alpha_BR[..., None])
    rgb_BT3HW = torch.unflatten(rgb_BT3HW, 1, (-1, size, size)).movedim(-1, 2)
    both = torch.cat([images.rgb_BTV3HW[:, :, 0], rgb_BT3HW], dim=1).clamp(0.0, 1.0)
    rows = torch.cat(torch.cat(list(both.unbind(1)), dim=-1).unbind(0), dim=-2)
    shown: NDArray[np.uint8] = (255.0 * rows.movedim(0, -1)).round().byte().cpu().numpy()
    return shown


def seen_by(
    prediction: Prediction, articulation: Articulation, images: Images, moment: Moment
) -> RayColors:
    """What every pixel of the images' cameras sees of the predicted parts.

    Rays run over states, views, rows and columns.
    """
    height, width = images.rgb_BTV3HW.shape[-2:]
    pixels = pixel_middles(height, width, images.rgb_BTV3HW.device)
    origin, direction = pixel_rays(images.intrinsics_BTV33, images.camera_from_world_BTV44, pixels)
    states, views = images.rgb_BTV3HW.shape[1:3]
    state_R = torch.arange(states, device=pixels.device).repeat_interleave(views * len(pixels))
    return render_along(
        field_on(prediction, articulation),
        articulation,
        origin.flatten(1, 3),
        direction.flatten(1, 3),
        state_R.expand(len(origin), -1),
        inverse_beta=moment.inverse_beta,
        samples=moment.samples,
        coarse=moment.coarse,
    )
