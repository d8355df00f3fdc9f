"""How different two images look: distance of the features of a network trained on photographs.

The construction is that of LPIPS (Zhang et al. 2018) without its learned weights, on the stages of
EfficientNet-Lite0, whose weights can be had as a package; its numbers are not LPIPS's.
"""

from importlib.util import find_spec

import torch
from torch import Tensor, nn

from model.network.encoders import efflite
from model.network.encoders.registry import EFFLITE_PACKAGE, packaged

STAGES = (0, 1, 2, 4)
"""Compared: strides 2, 4, 8 and 16."""
LEAST_LENGTH = 1e-3
"""Features shorter than this are not made longer: flat black has none, and no direction."""


class FeatureDistance(nn.Module):
    """Mean squared difference of unit feature vectors, averaged over places, summed over stages."""

    def __init__(self, network: efflite.EfficientNetLite0) -> None:
        super().__init__()
        self.network = network.requires_grad_(False).eval()

    def forward(self, ours_X3HW: Tensor, theirs_X3HW: Tensor) -> Tensor:
        """(X,) distances of sRGB images in [0, 1]; slopes go to both."""
        count = ours_X3HW.shape[0]
        apart = ours_X3HW.new_zeros(count)
        colors = (torch.cat([ours_X3HW, theirs_X3HW]) - efflite.MEAN[0]) / efflite.DEVIATION[0]
        for features in self.network.maps(colors, STAGES):
            length = torch.linalg.vector_norm(features, dim=1, keepdim=True)
            units = features / length.clamp(min=LEAST_LENGTH)
            apart = apart + (units[:count] - units[count:]).square().sum(dim=1).mean(dim=(1, 2))
        return apart

    def train(self, mode: bool = True) -> "FeatureDistance":
        """Stay in evaluation mode."""
        return super().train(False)


def packaged_distance() -> FeatureDistance | None:
    """The distance with the installed package's weights; None where there is none."""
    if find_spec(EFFLITE_PACKAGE) is None:
        return None
    return FeatureDistance(efflite.loaded(packaged()))
