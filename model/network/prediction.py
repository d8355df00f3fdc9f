"""What the network says about B objects: their articulation, its doubts, and their hexa-planes.

B objects, T states, P part slots, C channels, H W rows and columns of a plane, digits a length.
"""

import dataclasses
from dataclasses import dataclass

import torch
from torch import Tensor

from artgen.core.errors import ModelError
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation, TensorBlock
from model.field.plane_field import FieldHead, PlaneField

TYPE_OF_LOGIT = (PRISMATIC, REVOLUTE)
"""Joint type that each of the two logits stands for; the paper names them in this order."""


@dataclass(frozen=True, kw_only=True)
class Prediction(TensorBlock):
    """ART's X = {planes, (B, C, D, O, S)} of every slot and, beyond the paper, limits and parents.

    Attributes:
        articulation: as decided: types by the larger logit, parents likewise (0 where the network
            has no such head), axes and origins zero where the type has none, all zero in empty
            slots.
        axis_BP3: unit axis of every slot, whatever its type; what losses look at.
        origin_BP3: axis point of every slot, whatever its type.
        type_logits_BP2: prismatic, revolute (`TYPE_OF_LOGIT`).
        parent_logits_BPP: of child (row) hanging on parent (column); None without that head.
        count_logits_BQ: of 1, 2, ... parts, up to the number of slots; None without that head.
        planes_BP6CHW: upsampled, in order xy+ xy- yz+ yz- xz+ xz-; None without planes.
        head: the two small networks that read the planes; None without planes.
        limited: whether the limits are predicted; else they are zero.
    """

    articulation: Articulation
    axis_BP3: Tensor
    origin_BP3: Tensor
    type_logits_BP2: Tensor
    parent_logits_BPP: Tensor | None = None
    count_logits_BQ: Tensor | None = None
    planes_BP6CHW: Tensor | None = None
    head: FieldHead | None = None
    limited: bool = False

    def field(self) -> PlaneField:
        """The shapes and colors of all slots, to be rendered or meshed.

        Raises:
            ModelError: the network predicts articulation alone.
        """
        if self.planes_BP6CHW is None or self.head is None:
            raise ModelError(
                "this network predicts articulation alone and has no shapes to render; train one "
                "with planes"
            )
        return PlaneField(self.planes_BP6CHW, self.articulation.size_BP3, self.head)

    def count(self) -> Tensor | None:
        """(B,) the likeliest number of parts, base included; None without that head."""
        return None if self.count_logits_BQ is None else self.count_logits_BQ.argmax(dim=1) + 1

    def posed_as(self, truth: Articulation) -> Articulation:
        """The predicted boxes, axes, origins and motions under the true types and parents.

        Deciding a type has no gradient; training renders through this instead.
        """
        return dataclasses.replace(
            with_types(self.articulation, self.axis_BP3, self.origin_BP3, truth.type_BP),
            parent_BP=truth.parent_BP,
        )


def with_types(
    articulation: Articulation, axis_BP3: Tensor, origin_BP3: Tensor, type_BP: Tensor
) -> Articulation:
    """The same articulation under other joint types: fixed parts get no axis, only revolute ones
    an origin, and fixed parts neither motion nor limits."""
    moves_BP = type_BP != FIXED
    turns_BP1 = (type_BP == REVOLUTE)[..., None]
    return dataclasses.replace(
        articulation,
        type_BP=type_BP,
        axis_BP3=torch.where(moves_BP[..., None], axis_BP3, 0.0),
        origin_BP3=torch.where(turns_BP1, origin_BP3, 0.0),
        motion_BTP=torch.where(moves_BP[:, None], articulation.motion_BTP, 0.0),
        limits_BP2=torch.where(moves_BP[..., None], articulation.limits_BP2, 0.0),
    )
