"""The Articulated Reconstruction Transformer: posed images of some states in, a Prediction out.

B objects, T states, P part slots, F images of N tokens, K tokens of a slot, D channels, E of a
state's vector, Q numbers of parts.
"""

import dataclasses
import math
from collections.abc import Iterator

import torch
from torch import Tensor, nn

from artgen.core.errors import ModelError
from model.batch import FIXED, Articulation, Images
from model.config import ModelConfig
from model.field.kinematics import unit
from model.field.plane_field import FieldHead
from model.network.attention import Attention, Mlp
from model.network.blocks import TrunkBlocks
from model.network.encoders.protocol import Pretrained
from model.network.heads import (
    ArticulationHead,
    CountHead,
    TreeHead,
    box_side,
    travel,
    within_sphere,
)
from model.network.plane_head import PlaneHead
from model.network.prediction import TYPE_OF_LOGIT, Prediction, with_types
from model.network.tokens import ImageTokenizer, SlotTokens
from model.network.tree import parents
from model.precision import full, full_precision

FIRST_ANSWER = 0.1
"""Deviation of what an untrained head says, before the mappings."""


class Art(nn.Module):
    """The network; `field_head` belongs to it and is used by whoever renders its prediction."""

    def __init__(self, config: ModelConfig) -> None:
        super().__init__()
        self.config = config
        width = config.trunk.width
        self.images = ImageTokenizer(config.images, width)
        self.slots = SlotTokens(config)
        self.trunk = TrunkBlocks(config.trunk)
        self.articulation = ArticulationHead(config)
        self.tree = TreeHead(width) if config.tree else None
        self.count = CountHead(config) if config.count else None
        planes = config.planes
        self.planes = None if planes is None else PlaneHead(config, planes)
        self.field_head = None if planes is None else FieldHead(config.field, planes.channels)
        initialize(self)

    @property
    def encoder_identity(self) -> str:
        """Name and sha256 of the weights that its encoder came with; empty where it had none.

        Such weights stay out of the network's own files, which must name them.
        """
        return "" if self.images.encoder is None else self.images.encoder.identity

    def forward(self, images: Images, valid_BP: Tensor) -> Prediction:
        """What the first P slots hold.

        Args:
            images: of the size the network was made for, of at most as many states.
            valid_BP: bool, which slots hold a part; slot 0 always does. Empty slots are read by
                nobody, so what is predicted does not depend on P beyond the last part.

        Raises:
            ModelError: images or slots are not what the network was made for.
        """
        if valid_BP.shape[1] > self.config.slots:
            raise ModelError(
                f"{valid_BP.shape[1]} parts; this network has {self.config.slots} slots, base "
                "included; ask for fewer"
            )
        # What blocks add to is kept in float32: bfloat16 would round away most of what they add.
        image_BFND = full(self.images(images))
        objects, states = images.rgb_BTV3HW.shape[:2]
        state_TE = self.images.state.weight[:states]
        part_BPKD = full(self.slots(objects, valid_BP.shape[1], state_TE))
        _, read_BPKD = self.trunk(image_BFND, part_BPKD, valid_BP)
        slot_BPD, by_state, places = self.slots.split(read_BPKD)
        with full_precision(slot_BPD):
            prediction = self._read(full(slot_BPD), by_state, states, valid_BP)
        return dataclasses.replace(
            prediction,
            count_logits_BQ=None if self.count is None else self.count(image_BFND),
            planes_BP6CHW=None if self.planes is None else self.planes(slot_BPD, places),
            head=self.field_head,
        )

    def _read(
        self, slot_BPD: Tensor, by_state: Tensor | None, states: int, valid_BP: Tensor
    ) -> Prediction:
        """Everything about the slots but their planes, in full precision."""
        raw = self.articulation(slot_BPD, by_state, states)
        parent_logits = None if self.tree is None else self.tree(slot_BPD, valid_BP)
        axis_BP3, origin_BP3 = unit(raw.axis_BP3), within_sphere(raw.origin_BP3)
        limits_BP2 = torch.zeros_like(raw.type_BP2) if raw.limits_BP2 is None else raw.limits_BP2
        held = valid_BP[..., None]
        decided = Articulation(
            valid_BP=valid_BP,
            center_BP3=torch.where(held, within_sphere(raw.center_BP3), 0.0),
            size_BP3=torch.where(held, box_side(raw.size_BP3), 0.0),
            type_BP=torch.zeros_like(valid_BP, dtype=torch.int64),
            axis_BP3=axis_BP3,
            origin_BP3=origin_BP3,
            motion_BTP=within_sphere(raw.motion_BTP),
            limits_BP2=limits_BP2 if raw.limits_BP2 is None else travel(limits_BP2),
            parent_BP=hung_on(parent_logits, valid_BP),
        )
        return Prediction(
            articulation=with_types(
                decided, axis_BP3, origin_BP3, decided_types(raw.type_BP2, valid_BP)
            ),
            axis_BP3=axis_BP3,
            origin_BP3=origin_BP3,
            type_logits_BP2=raw.type_BP2,
            parent_logits_BPP=parent_logits,
            limited=raw.limits_BP2 is not None,
        )


def decided_types(type_logits_BP2: Tensor, valid_BP: Tensor) -> Tensor:
    """(B, P) int64 joint types by the larger logit; FIXED for the base and for empty slots."""
    kinds = torch.tensor(TYPE_OF_LOGIT, device=type_logits_BP2.device)
    moves_BP = valid_BP.clone()
    moves_BP[:, 0] = False
    return torch.where(moves_BP, kinds[type_logits_BP2.argmax(dim=-1)], FIXED)


def hung_on(parent_logits_BPP: Tensor | None, valid_BP: Tensor) -> Tensor:
    """(B, P) int64 parents; the base for every part where none are predicted."""
    if parent_logits_BPP is not None:
        return parents(parent_logits_BPP.detach(), valid_BP)
    on_base = torch.where(valid_BP, 0, -1)
    on_base[:, 0] = -1
    return on_base


def initialize(art: Art) -> None:
    """Initial weights: matrices that keep the size of what they are given, zero biases, residual
    branches that begin smaller the deeper the trunk, answers that begin near their middle, and each
    kind of content with an equal share of a token. The field's networks have their own."""
    for module in _own(art):
        if isinstance(module, nn.Linear):
            drawn(module, 1.0)
        elif isinstance(module, nn.Embedding):
            nn.init.normal_(module.weight)
    for module in art.trunk.modules():
        if isinstance(module, Attention | Mlp):
            drawn(module.out, 1.0 / math.sqrt(2.0 * art.config.trunk.blocks))
    for answer in art.articulation.answers():
        drawn(answer, FIRST_ANSWER)
    art.images.balance()
    for tokens in (art.slots.token_PKD, art.slots.number_PD):
        nn.init.normal_(tokens)
    if art.count is not None:
        nn.init.normal_(art.count.query_QD)


def _own(module: nn.Module) -> Iterator[nn.Module]:
    """All inner modules but those that come with weights of their own."""
    for inner in module.children():
        if not isinstance(inner, Pretrained | FieldHead):
            yield inner
            yield from _own(inner)


def drawn(linear: nn.Linear, gain: float) -> None:
    """Weights by which inputs of size 1 become outputs of size `gain`; biases zero."""
    nn.init.trunc_normal_(linear.weight, std=gain / math.sqrt(linear.in_features))
    if linear.bias is not None:
        nn.init.zeros_(linear.bias)
