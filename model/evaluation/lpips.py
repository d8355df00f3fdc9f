"""LPIPS (Zhang et al., CVPR 2018) of AlexNet, for those who have its weights as files.

The trunk is that of torchvision's AlexNet (`alexnet-owt-*.pth`), the heads those of the package
lpips (`alex.pth`); neither ships with this project. Without them there is no LPIPS: a stand-in by
other features is another number.
"""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from artgen.core.errors import ModelError
from artgen.core.mesh import Floats

SHIFT, SCALE = (-0.030, -0.088, -0.188), (0.458, 0.448, 0.450)
"""Of colors in [-1, 1]."""
CONVOLUTIONS = ((0, 4, 2), (3, 1, 2), (6, 1, 1), (8, 1, 1), (10, 1, 1))
"""Number of a layer in torchvision's `features`, its stride and its margin."""
POOLED = (False, True, True, False, False)
"""Whether the largest of 3 x 3 px, every second one, comes before a layer."""
LEAST_PX = 64
TINY = 1e-10
EXPECTED = "expected torchvision's AlexNet and the heads of the package lpips"
TRUNKS, HEADS = ("alexnet*.pth",), ("alex.pth", "lpips_alex.pth")


class Lpips:
    """Distance of two images by AlexNet's features and LPIPS's heads."""

    def __init__(self, trunk: Mapping[str, Tensor], heads: Mapping[str, Tensor]) -> None:
        """Take the weights.

        Raises:
            ModelError: a layer is missing, or of another shape.
        """
        try:
            self._layers = [
                (trunk[f"features.{n}.weight"], trunk[f"features.{n}.bias"], stride, margin)
                for n, stride, margin in CONVOLUTIONS
            ]
            self._heads = [heads[f"lin{k}.model.1.weight"] for k in range(len(CONVOLUTIONS))]
            self(np.zeros((LEAST_PX, LEAST_PX, 3)), np.ones((LEAST_PX, LEAST_PX, 3)))
        except KeyError as error:
            raise ModelError(f"LPIPS: the weights lack {error}; {EXPECTED}") from error
        except (TypeError, AttributeError, RuntimeError) as error:
            raise ModelError(f"LPIPS: weights of something else ({error}); {EXPECTED}") from error

    @torch.inference_mode()
    def __call__(self, predicted: Floats, true: Floats) -> float | None:
        """Of two (H, W, 3) images in [0, 1]; None where they are too small for the network."""
        if min(true.shape[:2]) < LEAST_PX:
            return None
        both = torch.from_numpy(np.stack([predicted, true])).float().permute(0, 3, 1, 2)
        total = 0.0
        for maps, head in zip(self._maps(2.0 * both - 1.0), self._heads, strict=True):
            length = maps.square().sum(dim=1, keepdim=True).sqrt()
            unit = maps / (length + TINY)
            apart = functional.conv2d((unit[:1] - unit[1:]).square(), head)
            total += float(apart.mean())
        return total

    def _maps(self, images: Tensor) -> list[Tensor]:
        """Features after each of the five rectified convolutions."""
        shift, scale = (images.new_tensor(own)[:, None, None] for own in (SHIFT, SCALE))
        maps, found = (images - shift) / scale, []
        for (weight, bias, stride, margin), pooled in zip(self._layers, POOLED, strict=True):
            if pooled:
                maps = functional.max_pool2d(maps, 3, 2)
            maps = functional.conv2d(maps, weight, bias, stride, margin).relu()
            found.append(maps)
        return found


def load_lpips(folder: Path) -> Lpips:
    """LPIPS with the weights in a folder.

    Raises:
        ModelError: a file is missing or holds other weights.
    """
    return Lpips(_weights(folder, TRUNKS), _weights(folder, HEADS))


def _weights(folder: Path, names: tuple[str, ...]) -> Mapping[str, Tensor]:
    for name in names:
        for path in sorted(folder.glob(name)):
            try:
                found = torch.load(path, map_location="cpu", weights_only=True)
            except Exception as error:  # torch raises what its readers raise.
                raise ModelError(f"{path} holds no weights: {error}") from error
            if not isinstance(found, Mapping):
                raise ModelError(f"{path} holds no weights but {type(found).__name__}; {EXPECTED}")
            return found
    raise ModelError(f"{folder} has no {' or '.join(names)}; LPIPS needs trunk and heads")
