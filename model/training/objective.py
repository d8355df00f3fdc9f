"""What training minimizes: the network, the rendering of its answer, and the losses, in one module.

All that involves weights happens under one `forward`, as processes that share weights need it.
"""

import dataclasses

import torch
from torch import Tensor, nn

from model.batch import Articulation, Batch
from model.config import LossWeights
from model.field.plane_field import PlaneField
from model.field.volume import RayColors, render_along
from model.network.art import Art
from model.network.prediction import Prediction
from model.training.losses import ImageDistance, losses
from model.training.schedule import Moment, Precision


class Objective(nn.Module):
    """(batch, moment) -> losses by term, weighted, and their sum under "total"."""

    def __init__(
        self,
        art: Art,
        weights: LossWeights,
        *,
        precision: Precision = "float32",
        field_precision: Precision = "float32",
        perceptual: ImageDistance | None = None,
    ) -> None:
        super().__init__()
        self.art = art
        self.weights = weights
        self.precision = precision
        self.field_precision = field_precision
        self.perceptual = perceptual

    def forward(self, batch: Batch, moment: Moment) -> dict[str, Tensor]:
        """Losses of a batch; draws the places of samples along rays."""
        with autocast(batch, self.precision):
            prediction: Prediction = self.art(batch.images, batch.truth.valid_BP)
        with autocast(batch, self.field_precision):
            rendered = (
                seen_along(prediction, batch, moment, draws=True) if moment.rendered else None
            )
        return losses(
            prediction,
            batch,
            self.weights,
            rendered,
            perceptual=self.perceptual,
            perceptual_factor=moment.perceptual,
        )


def autocast(batch: Batch, precision: Precision) -> torch.autocast:
    """The context in which matrix products on the batch's device have a precision."""
    device = batch.images.rgb_BTV3HW.device.type
    return torch.autocast(device, torch.bfloat16, enabled=precision == "bfloat16")


def seen_along(
    prediction: Prediction, batch: Batch, moment: Moment, *, draws: bool = False
) -> RayColors | None:
    """What the batch's rays see of the predicted parts; None where there are no rays or planes.

    At first the parts lie and move as in truth, later as predicted, under the true types and
    parents. Boxes get no gradient through rendering.

    Args:
        draws: whether the places of samples along rays are drawn; else they are even.
    """
    if prediction.planes_BP6CHW is None or batch.rays is None:
        return None
    articulation = batch.truth if moment.forced else prediction.posed_as(batch.truth)
    rays = batch.rays
    return render_along(
        field_on(prediction, articulation),
        articulation,
        *(rays.origin_BR3, rays.direction_BR3, rays.state_BR),
        inverse_beta=moment.inverse_beta,
        samples=moment.samples,
        coarse=moment.coarse,
        generator=_generator(rays.origin_BR3.device) if draws else None,
    )


def field_on(prediction: Prediction, articulation: Articulation) -> PlaneField:
    """The predicted shapes on the boxes of an articulation."""
    boxed = dataclasses.replace(articulation, size_BP3=articulation.size_BP3.detach())
    return dataclasses.replace(prediction, articulation=boxed).field()


def _generator(device: torch.device) -> torch.Generator:
    """Of chance on the device, seeded by the default one of the CPU."""
    seed = int(torch.randint(2**62, ()))
    return torch.Generator(device=device).manual_seed(seed)
