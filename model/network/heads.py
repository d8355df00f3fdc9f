"""What a slot's vector means: box, type, axis, origin, motion, limits, parent; how many parts.

B objects, T states, P part slots, F images of N tokens, M = F * N, Q queries, D channels, X any
sizes, digits a length. Lengths in radii: the paper's r is 1.
"""

import dataclasses
import math
from dataclasses import dataclass

import torch
from torch import Tensor, nn

from model.config import ModelConfig
from model.network.attention import norm
from model.network.blocks import Reading
from model.precision import full

REFUSED = -1e9
"""Logit of what cannot be; finite, so that a row of nothing else has a softmax."""
USUAL_LIMITS = (0.01, 0.2)
"""Size of lower and upper limit, in units of motion, that an untrained network predicts."""
COUNT_READINGS = 2
"""Of the network that counts parts: the images, then one another."""
COUNT_MLP_RATIO = 1.0


def within_sphere(raw: Tensor) -> Tensor:
    """2 r sigma(x) - r, in (-1, 1): box centers, axis points and motions."""
    return torch.tanh(raw / 2.0)


def box_side(raw: Tensor) -> Tensor:
    """2 r sigma(x), in (0, 2): sides of boxes."""
    return 2.0 * torch.sigmoid(raw)


def travel(raw_X2: Tensor) -> Tensor:
    """Lower limit in (-1, 0) and upper limit in (0, 1), units of motion; rest lies between."""
    usual = raw_X2.new_tensor([math.log(size / (1.0 - size)) for size in USUAL_LIMITS])
    return torch.sigmoid(raw_X2 + usual) * raw_X2.new_tensor([-1.0, 1.0])


@dataclass(frozen=True, kw_only=True)
class RawArticulation:
    """A slot's numbers before their mappings; limits are None where they are not predicted."""

    center_BP3: Tensor
    size_BP3: Tensor
    type_BP2: Tensor
    axis_BP3: Tensor
    origin_BP3: Tensor
    motion_BTP: Tensor
    limits_BP2: Tensor | None


class ArticulationHead(nn.Module):
    """ART's vector of a slot, before its mappings; computed in full precision.

    14 numbers (center, size, two types, axis, origin), then the motion of each state unless it is
    read from state tokens, then two limits where the settings ask for them.
    """

    def __init__(self, config: ModelConfig) -> None:
        super().__init__()
        width = config.trunk.width
        vector = config.images.states if config.motion == "vector" else 0
        self.widths = [3, 3, 2, 3, 3, vector, 2 if config.limits else 0]
        self.norm = norm(width)
        self.vector = nn.Sequential(
            nn.Linear(width, width), nn.GELU(), nn.Linear(width, sum(self.widths))
        )
        self.motion: nn.Sequential | None = None
        if config.motion == "state_tokens":
            self.norm_state = norm(width)
            self.motion = nn.Sequential(nn.Linear(2 * width, width), nn.GELU(), nn.Linear(width, 1))

    def answers(self) -> list[nn.Linear]:
        """The layers whose outputs are numbers of the articulation."""
        ends = [net[-1] for net in (self.vector, self.motion) if net is not None]
        return [end for end in ends if isinstance(end, nn.Linear)]

    def forward(self, slot_BPD: Tensor, state_BPTD: Tensor | None, states: int) -> RawArticulation:
        """The numbers of every slot for the first T states."""
        slot_BPD = self.norm(slot_BPD)
        raw = self.vector(slot_BPD).split(self.widths, dim=-1)
        center, size, kind, axis, origin, motion_BPT, limits = raw
        if self.motion is not None and state_BPTD is not None:
            repeated = slot_BPD.unsqueeze(2).expand_as(state_BPTD)
            both = torch.cat([self.norm_state(state_BPTD), repeated], dim=-1)
            motion_BPT = self.motion(both).squeeze(-1)
        return RawArticulation(
            center_BP3=center,
            size_BP3=size,
            type_BP2=kind,
            axis_BP3=axis,
            origin_BP3=origin,
            motion_BTP=motion_BPT[..., :states].transpose(1, 2),
            limits_BP2=limits if self.widths[-1] else None,
        )


class TreeHead(nn.Module):
    """How well each part would hang on each other; beyond the paper."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.norm = norm(width)
        self.child, self.parent = nn.Linear(width, width), nn.Linear(width, width)

    def forward(self, slot_BPD: Tensor, valid_BP: Tensor) -> Tensor:
        """(B, P, P) logits of child (row) on parent (column); itself and empty slots refused."""
        slot_BPD = self.norm(slot_BPD)
        scores_BPP = self.child(slot_BPD) @ self.parent(slot_BPD).transpose(1, 2)
        itself = torch.eye(valid_BP.shape[1], dtype=torch.bool, device=valid_BP.device)
        scaled = scores_BPP / math.sqrt(slot_BPD.shape[-1])
        return scaled.masked_fill(itself | ~valid_BP[:, None], REFUSED)


class CountHead(nn.Module):
    """How many parts an object has, from its image tokens before the trunk; beyond the paper.

    The trunk is told the number of parts by the slots that are in use, so this head has a small
    network of its own: one query for each slot reads the images, and the queries read each other.
    """

    def __init__(self, config: ModelConfig) -> None:
        super().__init__()
        self.query_QD = nn.Parameter(torch.zeros(config.slots, config.trunk.width))
        trunk = dataclasses.replace(config.trunk, mlp_ratio=COUNT_MLP_RATIO)
        self.readings = nn.ModuleList(Reading(trunk) for _ in range(COUNT_READINGS))
        self.norm = norm(config.trunk.width)
        self.logit = nn.Linear(config.slots * config.trunk.width, config.slots)

    def forward(self, image_BFND: Tensor) -> Tensor:
        """(B, slots) logits of 1, 2, ... parts."""
        image_BMD = image_BFND.flatten(1, 2)
        query_BQD = self.query_QD.to(image_BMD.dtype).expand(image_BMD.shape[0], -1, -1)
        for index, reading in enumerate(self.readings):
            query_BQD = reading(query_BQD, query_BQD if index % 2 else image_BMD)
        logits: Tensor = self.logit(self.norm(query_BQD).flatten(1))
        return full(logits)
