"""LPIPS against a second implementation in numpy, with small random weights."""

from pathlib import Path

import numpy as np
import pytest
import torch

from artgen.core.errors import ModelError
from model.evaluation.lpips import LEAST_PX, Lpips, load_lpips

CHANNELS = ((3, 4, 11), (4, 5, 5), (5, 6, 3), (6, 4, 3), (4, 4, 3))
"""In, out and width of each layer; AlexNet's widths, few channels."""


def weights() -> tuple[dict[str, torch.Tensor], dict[str, torch.Tensor]]:
    torch.manual_seed(0)
    trunk, heads = {}, {}
    for k, ((before, after, wide), n) in enumerate(zip(CHANNELS, (0, 3, 6, 8, 10), strict=True)):
        trunk[f"features.{n}.weight"] = torch.randn(after, before, wide, wide) / wide
        trunk[f"features.{n}.bias"] = 0.1 * torch.randn(after)
        heads[f"lin{k}.model.1.weight"] = torch.rand(1, after, 1, 1)
    return trunk, heads


def images() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.Generator(np.random.PCG64(3))
    return rng.random((LEAST_PX, LEAST_PX, 3)), rng.random((LEAST_PX, LEAST_PX, 3))


def plain(first: np.ndarray, second: np.ndarray) -> float:
    """Patches and sums, float64."""
    trunk, heads = ({k: v.double().numpy() for k, v in own.items()} for own in weights())

    def patches(image: np.ndarray, wide: int, stride: int) -> np.ndarray:
        view = np.lib.stride_tricks.sliding_window_view(image, (wide, wide), axis=(1, 2))
        return view[:, ::stride, ::stride]

    def maps(image: np.ndarray) -> list[np.ndarray]:
        x = 2.0 * image.transpose(2, 0, 1) - 1.0
        x = (x - np.reshape((-0.030, -0.088, -0.188), (3, 1, 1))) / np.reshape(
            (0.458, 0.448, 0.450), (3, 1, 1)
        )
        found = []
        for n, stride, margin, pooled in (
            (0, 4, 2, 0),
            (3, 1, 2, 1),
            (6, 1, 1, 1),
            (8, 1, 1, 0),
            (10, 1, 1, 0),
        ):
            if pooled:
                x = patches(x, 3, 2).max(axis=(3, 4))
            weight, bias = trunk[f"features.{n}.weight"], trunk[f"features.{n}.bias"]
            x = np.pad(x, ((0, 0), (margin, margin), (margin, margin)))
            x = np.einsum("chwij,ocij->ohw", patches(x, weight.shape[2], stride), weight)
            x = np.maximum(x + bias[:, None, None], 0.0)
            found.append(x)
        return found

    total = 0.0
    for k, (a, b) in enumerate(zip(maps(first), maps(second), strict=True)):
        a, b = (own / (np.sqrt((own**2).sum(axis=0)) + 1e-10) for own in (a, b))
        head = heads[f"lin{k}.model.1.weight"][0, :, 0, 0]
        total += float(np.einsum("c,chw->hw", head, (a - b) ** 2).mean())
    return total


def test_it_is_what_a_plain_implementation_says() -> None:
    first, second = images()
    # float32 against float64: some thousand products in each layer, 1e-6 each way.
    assert Lpips(*weights())(first, second) == pytest.approx(plain(first, second), rel=1e-4)


def test_equal_images_are_not_apart() -> None:
    first, _ = images()
    assert Lpips(*weights())(first, first) == 0.0


def test_weights_come_from_files(tmp_path: Path) -> None:
    trunk, heads = weights()
    torch.save(trunk, tmp_path / "alexnet-owt-7be5be79.pth")
    with pytest.raises(ModelError, match=r"has no alex\.pth"):
        load_lpips(tmp_path)
    torch.save(heads, tmp_path / "alex.pth")
    first, second = images()
    assert load_lpips(tmp_path)(first, second) == Lpips(trunk, heads)(first, second)
    torch.save(trunk, tmp_path / "alex.pth")
    with pytest.raises(ModelError, match=r"lack 'lin0\.model\.1\.weight'"):
        load_lpips(tmp_path)
    other = {key: value[:, :2] for key, value in heads.items()}
    for wrong, told in ((other, "weights of something else"), (torch.zeros(3), "but Tensor"),
                        (dict.fromkeys(heads), "weights of something else")):  # fmt: skip
        torch.save(wrong, tmp_path / "alex.pth")
        with pytest.raises(ModelError, match=told):
            load_lpips(tmp_path)
    (tmp_path / "alex.pth").write_bytes(b"no weights")
    with pytest.raises(ModelError, match="holds no weights"):
        load_lpips(tmp_path)


def test_small_images_have_none() -> None:
    small = np.zeros((32, 64, 3))
    assert Lpips(*weights())(small, small) is None
