"""EfficientNet-Lite0: its shapes are the published ones, and the package's file fits one to one."""

from pathlib import Path

import pytest
import torch
from torch import Tensor
from torch.nn import functional

from artgen.core.errors import ModelError
from model.network.encoders.efflite import DIM, EfficientNetLite0, SameConv, loaded, renamed

STRIDES = (1, 2, 1, 2, 1, 2, 1, 1, 1, 1, 1, 2, 1, 1, 1, 1)
"""Of the 16 blocks' depthwise convolutions."""


def package_weights() -> dict[str, Tensor]:
    """Random weights under the names and shapes of the package's file, in its order."""
    torch.manual_seed(0)
    ours = EfficientNetLite0().state_dict()
    names = {"expand": ("_expand_conv", "_bn0"), "depthwise": ("_depthwise_conv", "_bn1")}
    names["narrow"] = ("_project_conv", "_bn2")
    theirs: dict[str, Tensor] = {}
    for name, tensor in ours.items():
        words = name.split(".")
        batch_norm = words[-2] == "norm"
        if words[0] == "stem":
            theirs[f"{'_bn0' if batch_norm else '_conv_stem'}.{words[-1]}"] = tensor
        else:
            theirs[f"_blocks.{words[1]}.{names[words[2]][batch_norm]}.{words[-1]}"] = tensor
    theirs["_conv_head.weight"] = torch.zeros(1280, 320, 1, 1)
    theirs |= {f"_bn1.{kind}": torch.zeros(1280) for kind in ("weight", "bias")}
    theirs |= {"_fc.weight": torch.zeros(1000, 1280), "_fc.bias": torch.zeros(1000)}
    return theirs


def test_weights_under_the_packages_names_fit(tmp_path: Path) -> None:
    path = tmp_path / "lite0.pth"
    torch.save(package_weights(), path)
    network, expected = loaded(path), package_weights()
    for name, tensor in renamed(expected).items():
        assert torch.equal(network.state_dict()[name], tensor)
    assert len(renamed(expected)) == len(network.state_dict())


def test_it_has_the_published_number_of_weights() -> None:
    """4.652 M with the classifier (Tan 2020); 1.281 M of them are the classifier's and 0.412 M the
    last 1 x 1 convolution's and its normalization's, which are left out here."""
    count = sum(weights.numel() for weights in EfficientNetLite0().parameters())
    head = 320 * 1280 + 2 * 1280 + 1280 * 1000 + 1000
    assert count + head == 4_652_008


def test_maps_are_at_stride_8_and_frozen_statistics_are_used() -> None:
    network = EfficientNetLite0().eval()
    frames = torch.rand(2, 3, 64, 64)
    features = network(frames)
    assert features.shape == (2, DIM, 8, 8) == (2, 472, 8, 8)
    torch.testing.assert_close(network(frames[:1]), features[:1], rtol=1e-4, atol=1e-5)


def test_strides_are_the_published_ones() -> None:
    assert tuple(block.depthwise.stride for block in EfficientNetLite0().blocks) == STRIDES


@pytest.mark.parametrize("length", [7, 8])
@pytest.mark.parametrize(("kernel", "stride"), [(3, 1), (3, 2), (5, 2)])
def test_padding_is_split_as_tensorflow_does(length: int, kernel: int, stride: int) -> None:
    """Output ceil(n / s); the odd row of padding comes below and on the right."""
    torch.manual_seed(1)
    layer = SameConv(1, 1, kernel, stride=stride, groups=1).eval()
    layer.norm.running_var.fill_(1.0 - layer.norm.eps)  # type: ignore[union-attr]
    maps = torch.randn(1, 1, length, length)
    out = -(-length // stride)
    total = max((out - 1) * stride + kernel - length, 0)
    before, after = total // 2, total - total // 2
    padded = functional.pad(maps, (before, after, before, after))
    expected = functional.conv2d(padded, layer.conv.weight, stride=stride)
    torch.testing.assert_close(layer(maps), expected, rtol=1e-5, atol=1e-6)
    assert expected.shape[-1] == out


def test_other_weights_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "other.pth"
    torch.save({"layer.weight": torch.zeros(3)}, path)
    with pytest.raises(ModelError, match="expected the weights of an EfficientNet-Lite0"):
        loaded(path)
