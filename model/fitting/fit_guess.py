"""Guesses at one object: hexa-planes and joints of all its parts, several guesses side by side.

Letters: G guesses (objects of one batch), T states, P parts, C channels, digits a length.
"""

import dataclasses

import numpy as np
import torch
from torch import Tensor, nn

from artgen.core.stream import Stream
from model.batch import FIXED, PRISMATIC, REVOLUTE, Articulation
from model.config import FieldConfig
from model.field.extract import part_meshes
from model.field.kinematics import unit
from model.field.plane_field import FieldHead, PlaneField


class Guess(nn.Module):
    """Parameters of G guesses.

    A joint is the vector S D of the second state: near rest, where fits begin, its slopes show the
    way to any axis, while those of a unit axis and a motion show the way along one axis alone.

    Args:
        bounds_23: box of the object, for all parts, radii.
        types: of all parts; None draws them.
        states: T, the first at rest.
        motion: |S| of the first guesses.
    """

    def __init__(
        self,
        bounds_23: Tensor,
        *,
        parts: int,
        states: int,
        guesses: int,
        plane_px: int,
        channels: int,
        field: FieldConfig,
        motion: float,
        types: tuple[int, ...] | None,
        stream: Stream,
    ) -> None:
        super().__init__()
        rng = stream.child("joints").generator()
        shape = (guesses, parts)
        kinds = rng.choice([PRISMATIC, REVOLUTE], size=shape)
        kinds[:, 0] = FIXED
        kinds = kinds if types is None else np.broadcast_to(types, shape)
        axes = rng.normal(size=(*shape, 3))
        axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
        low, high = bounds_23.double().cpu().numpy()
        self.twist_GP3 = _parameter(motion * axes)
        self.origin_GP3 = _parameter(rng.uniform(low, high, size=(*shape, 3)))
        self.share_GTP = _parameter(np.ones((guesses, max(states - 2, 0), parts)))
        planes = stream.child("planes").generator()
        drawn = planes.normal(size=(*shape, 6, channels, plane_px, plane_px))
        self.planes_GP6CHW = _parameter(0.1 * drawn)
        self.head = _seeded_head(field, channels, stream)
        self.type_GP: Tensor
        self.bounds_23: Tensor
        self.register_buffer("type_GP", torch.tensor(kinds, dtype=torch.long))
        self.register_buffer("bounds_23", bounds_23)

    def articulation(self) -> Articulation:
        """The guesses as objects of a batch; every part's box is the whole object's."""
        moves_GP = self.type_GP != FIXED
        size_GP: Tensor = torch.linalg.vector_norm(self.twist_GP3, dim=-1) * moves_GP
        second = size_GP[:, None]
        motion_GTP = torch.cat([0.0 * second, second, second * self.share_GTP], dim=1)
        center_3, size_3 = self.bounds_23.mean(dim=0), self.bounds_23[1] - self.bounds_23[0]
        guesses, parts = self.type_GP.shape
        parent_P = torch.zeros(parts, dtype=torch.long, device=size_3.device)
        parent_P[0] = -1
        return Articulation(
            valid_BP=torch.ones_like(moves_GP),
            center_BP3=center_3.expand(guesses, parts, 3),
            size_BP3=size_3.expand(guesses, parts, 3),
            type_BP=self.type_GP,
            axis_BP3=unit(self.twist_GP3) * moves_GP[..., None],
            origin_BP3=self.origin_GP3 * (self.type_GP == REVOLUTE)[..., None],
            motion_BTP=motion_GTP,
            limits_BP2=torch.stack([motion_GTP.amin(dim=1), motion_GTP.amax(dim=1)], dim=-1),
            parent_BP=parent_P.expand(guesses, -1),
        )

    def field(self) -> PlaneField:
        """The fields of all guesses."""
        return PlaneField(self.planes_GP6CHW, self.articulation().size_BP3, self.head)

    def keep(self, kept: Tensor) -> None:
        """Forget all guesses but these."""
        for name in ("twist_GP3", "origin_GP3", "share_GTP", "planes_GP6CHW"):
            setattr(self, name, nn.Parameter(getattr(self, name).detach()[kept]))
        self.type_GP = self.type_GP[kept]


def canonical(articulation: Articulation) -> Articulation:
    """The same joints stated as ours: the widest motion is positive, origins nearest the boxes'
    middles."""
    motion_BTP = articulation.motion_BTP
    widest_BP = torch.gather(motion_BTP, 1, motion_BTP.abs().argmax(dim=1, keepdim=True))[:, 0]
    sign_BP = torch.where(widest_BP < 0.0, -1.0, 1.0)
    axis_BP3 = articulation.axis_BP3 * sign_BP[..., None]
    aside_BP3 = articulation.center_BP3 - articulation.origin_BP3
    along_BP1 = (aside_BP3 * axis_BP3).sum(dim=-1, keepdim=True)
    turns_BP1 = (articulation.type_BP == REVOLUTE)[..., None]
    motion_BTP = motion_BTP * sign_BP[:, None]
    return dataclasses.replace(
        articulation,
        axis_BP3=axis_BP3,
        origin_BP3=(articulation.origin_BP3 + along_BP1 * axis_BP3) * turns_BP1,
        motion_BTP=motion_BTP,
        limits_BP2=torch.stack([motion_BTP.amin(dim=1), motion_BTP.amax(dim=1)], dim=-1),
    )


def tight(field: PlaneField, articulation: Articulation, resolution: int) -> Articulation:
    """The same joints with boxes around what the first object's field holds; parts that hold
    nothing are no longer valid."""
    center, size = articulation.center_BP3.clone(), articulation.size_BP3.clone()
    valid = articulation.valid_BP.clone()
    for mesh in part_meshes(field, articulation, resolution=resolution):
        low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
        center[0, mesh.slot] = torch.tensor((low + high) / 2.0)
        size[0, mesh.slot] = torch.tensor(high - low)
        valid[0, mesh.slot] = not mesh.from_box
    valid[0, 0] = True
    return canonical(
        dataclasses.replace(articulation, center_BP3=center, size_BP3=size, valid_BP=valid)
    )


def _parameter(values: object) -> nn.Parameter:
    return nn.Parameter(torch.tensor(values, dtype=torch.float32))


def _seeded_head(field: FieldConfig, channels: int, stream: Stream) -> FieldHead:
    """A head whose weights follow from the stream, whatever torch drew before."""
    head = FieldHead(field, channels)
    rng = stream.child("head").generator()
    with torch.no_grad():
        for layer in head.modules():
            if isinstance(layer, nn.Linear) and layer is not head.distance[-1]:
                bound = layer.in_features**-0.5
                layer.weight.copy_(torch.tensor(rng.uniform(-bound, bound, layer.weight.shape)))
                layer.bias.zero_()
    return head
