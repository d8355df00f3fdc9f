"""DINOv2's transformer: both layouts of names give one network, and it is the formula."""

import math
from pathlib import Path

import pytest
import torch
from safetensors.torch import save_file
from torch import Tensor

from artgen.core.errors import ModelError
from artgen.core.jsonio import file_hash
from model.network.encoders import make_encoder
from model.network.encoders.vit import HEAD, VisionTransformer, hub_names, loaded

WIDTH, DEPTH, PATCH, GRID = 128, 2, 4, 3


def network(registers: int = 0) -> VisionTransformer:
    torch.manual_seed(0)
    made = VisionTransformer(
        width=WIDTH, depth=DEPTH, patch=PATCH, places=GRID**2, registers=registers
    )
    for weights in made.parameters():
        torch.nn.init.normal_(weights, std=0.1)
    return made


def transformers_names(weights: dict[str, Tensor]) -> dict[str, Tensor]:
    """Torch.hub's names as transformers' Dinov2Model writes them."""
    named: dict[str, Tensor] = {"embeddings.mask_token": torch.zeros(1, WIDTH)}
    for name, tensor in weights.items():
        words = name.split(".")
        if name == "pos_embed":
            named["embeddings.position_embeddings"] = tensor
        elif words[0] in ("cls_token", "register_tokens"):
            named[f"embeddings.{name}"] = tensor
        elif words[0] == "patch_embed":
            named[f"embeddings.patch_embeddings.projection.{words[-1]}"] = tensor
        elif words[0] == "norm":
            named[f"layernorm.{words[1]}"] = tensor
        else:
            _block(named, words, tensor)
    return {name: tensor.contiguous() for name, tensor in named.items()}


def _block(named: dict[str, Tensor], words: list[str], tensor: Tensor) -> None:
    layer, rest = f"encoder.layer.{words[1]}", words[2:]
    if rest[:2] == ["attn", "qkv"]:
        for word, part in zip(("query", "key", "value"), tensor.chunk(3), strict=True):
            named[f"{layer}.attention.attention.{word}.{rest[-1]}"] = part
    elif rest[:2] == ["attn", "proj"]:
        named[f"{layer}.attention.output.dense.{rest[-1]}"] = tensor
    elif rest[0] in ("ls1", "ls2"):
        named[f"{layer}.layer_scale{rest[0][-1]}.lambda1"] = tensor
    else:
        named[f"{layer}.{'.'.join(rest)}"] = tensor


@pytest.mark.parametrize("registers", [0, 4])
def test_both_layouts_load_to_the_same_network(tmp_path: Path, registers: int) -> None:
    made = network(registers)
    weights = made.state_dict()
    if not registers:
        del weights["register_tokens"]
    hub, hugging = tmp_path / "dinov2_vits14.pth", tmp_path / "model.safetensors"
    torch.save({**weights, "mask_token": torch.zeros(1, WIDTH)}, hub)
    save_file(transformers_names(weights), hugging)
    frames = torch.rand(2, 3, 12, 12)
    for path in (hub, hugging):
        assert torch.equal(loaded(path)(frames), made(frames))


def test_the_forward_pass_is_the_formula() -> None:
    """Attention by loops over heads, everything else written out."""
    made, frames = network(1).double(), torch.rand(1, 3, 12, 12, dtype=torch.float64)
    w = made.state_dict()

    def normed(x: Tensor, name: str) -> Tensor:
        middle = x - x.mean(dim=-1, keepdim=True)
        deviation = (middle.square().mean(dim=-1, keepdim=True) + 1e-6).sqrt()
        return middle / deviation * w[f"{name}.weight"] + w[f"{name}.bias"]

    tiles = frames[0].unfold(1, PATCH, PATCH).unfold(2, PATCH, PATCH)
    flat = tiles.permute(1, 2, 0, 3, 4).reshape(GRID**2, -1)
    places = flat @ w["patch_embed.proj.weight"].flatten(1).T + w["patch_embed.proj.bias"]
    first = w["cls_token"][0] + w["pos_embed"][0, :1]
    x = torch.cat([first, w["register_tokens"][0], places + w["pos_embed"][0, 1:]])
    for k in range(DEPTH):
        b = f"blocks.{k}"
        triple = normed(x, f"{b}.norm1") @ w[f"{b}.attn.qkv.weight"].T + w[f"{b}.attn.qkv.bias"]
        query, key, value = triple.chunk(3, dim=-1)
        read = torch.zeros_like(x)
        for h in range(WIDTH // HEAD):
            part = slice(h * HEAD, (h + 1) * HEAD)
            scores = query[:, part] @ key[:, part].T / math.sqrt(HEAD)
            read[:, part] = scores.softmax(dim=-1) @ value[:, part]
        read = read @ w[f"{b}.attn.proj.weight"].T + w[f"{b}.attn.proj.bias"]
        x = x + w[f"{b}.ls1.gamma"] * read
        hidden = normed(x, f"{b}.norm2") @ w[f"{b}.mlp.fc1.weight"].T + w[f"{b}.mlp.fc1.bias"]
        hidden = hidden * 0.5 * (1.0 + torch.erf(hidden / math.sqrt(2.0)))
        x = x + w[f"{b}.ls2.gamma"] * (hidden @ w[f"{b}.mlp.fc2.weight"].T + w[f"{b}.mlp.fc2.bias"])
    expected = normed(x, "norm")[2:].T.reshape(1, WIDTH, GRID, GRID)
    # Sums of some hundred numbers of size 1 in float64, two blocks deep.
    torch.testing.assert_close(made(frames), expected, rtol=0, atol=1e-12)


def test_images_of_any_size_get_whole_patches() -> None:
    made = network()
    assert made(torch.rand(1, 3, 12, 12)).shape == (1, WIDTH, 3, 3)
    assert made(torch.rand(1, 3, 22, 22)).shape == (1, WIDTH, 6, 6)
    assert made(torch.rand(1, 3, 2, 2)).shape == (1, WIDTH, 1, 1)


def test_a_folder_is_an_encoder(tmp_path: Path) -> None:
    path = tmp_path / "model.safetensors"
    weights = network().state_dict()
    del weights["register_tokens"]
    save_file(transformers_names(weights), path)
    encoder = make_encoder(f"dinov2:{tmp_path}", frozen=True)
    assert encoder is not None
    assert (encoder.dim, encoder.learned) == (WIDTH, False)
    assert encoder.identity == f"dinov2 {file_hash(path)}"
    assert encoder(torch.rand(1, 3, 16, 16)).shape == (1, WIDTH, 4, 4)


def test_folders_without_one_file_of_weights_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="0 files of weights, expected one"):
        make_encoder(f"dinov2:{tmp_path}", frozen=True)
    for name in ("a.pth", "b.pth"):
        (tmp_path / name).write_bytes(b"")
    with pytest.raises(ModelError, match="2 files of weights"):
        make_encoder(f"dinov2:{tmp_path}", frozen=True)


def test_weights_of_something_else_are_refused(tmp_path: Path) -> None:
    torch.save({"layer.weight": torch.zeros(3)}, tmp_path / "other.pth")
    with pytest.raises(ModelError, match="expected the weights of a DINOv2"):
        make_encoder(f"dinov2:{tmp_path}", frozen=True)
    gated = network().state_dict()
    gated["blocks.0.mlp.w12.weight"] = gated.pop("blocks.0.mlp.fc1.weight")
    torch.save(gated, tmp_path / "other.pth")
    with pytest.raises(ModelError, match="DINOv2 of size S, B or L"):
        make_encoder(f"dinov2:{tmp_path}", frozen=True)


def test_names_of_torch_hub_stay() -> None:
    weights = network().state_dict()
    assert set(hub_names(weights)) == set(weights)
