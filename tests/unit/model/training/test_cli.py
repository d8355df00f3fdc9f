"""`artgen train` and `artgen ship`, as one types them."""

import json
from pathlib import Path

import pytest
import torch

from artgen.core.errors import ModelError, UsageError
from model.config import Config
from model.network.art import Art
from model.training.art_file import ModelCard, carded, load_art, save_art, stored_type
from model.training.cli import ship, train
from model.training.recipes import debug
from model.training.settings import changed
from tests.unit.model.tiny_session import laptop_material

SMALL = (
    *("model.images.image_px=16", "model.images.encoder=none", "model.trunk.width=24"),
    *("model.trunk.blocks=2", "model.trunk.heads=2", "model.planes.grid=4"),
    *("data.input_px=16", "data.render_px=24", "data.target_px=16"),
)


@pytest.fixture
def network(tmp_path: Path) -> Path:
    path = tmp_path / "art.safetensors"
    config = changed(debug("nano"), SMALL)
    torch.manual_seed(0)
    save_art(path, Art(config.model), config, ModelCard(steps=3, limits=("small",)))
    return path


def test_settings_are_printed_with_what_was_changed(capsys: pytest.CaptureFixture[str]) -> None:
    assert train(["multiview", "--settings", "--set", "train.steps=7"]) == 0
    config = Config.from_json(capsys.readouterr().out)
    assert (config.recipe, config.size, config.train.steps) == ("multiview", "nano", 7)


def test_help_teaches(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        train(["--help"])
    said = capsys.readouterr().out
    assert "resumes" in said
    assert "torchrun" in said


def test_no_object_is_refused() -> None:
    with pytest.raises(UsageError, match="--objects 0"):
        train(["debug", "--objects", "0"])


def test_a_run_says_what_it_left_and_what_to_do_with_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    library = laptop_material(tmp_path).library
    told = ("--library", str(library), "--device", "cpu", "--out", str(tmp_path / "run"))
    small = (*SMALL, "data.slots=4", "data.batch=1", "data.rays=8", "train.steps=1")
    for _ in range(2):  # A run that is done says the same again.
        assert train(["debug", *told, "--set", *small]) == 0
        said = capsys.readouterr().out
        network = tmp_path / "run/art.safetensors"
        assert f"network: {network}, after update 1" in said
        assert f"artgen evaluate {network} --truth {library}" in said
        assert f"artgen reconstruct IMAGES --checkpoint {network}" in said


def test_a_card_is_shown_and_shipped_with_metrics(
    network: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    metrics = tmp_path / "evaluation.json"
    overall = {"type_accuracy": {"mean": 0.75}, "lpips": {"mean": None}}
    metrics.write_text(json.dumps({"summary": {"overall": overall}}))
    out = tmp_path / "shipped.safetensors"
    words = [str(network), "--metrics", str(metrics), "--limits", "no glass", "--out", str(out)]
    assert ship(words) == 0
    assert json.loads(capsys.readouterr().out)["metrics"] == {"type_accuracy": 0.75}
    shipped, config, card = load_art(out)
    assert card.metrics == {"type_accuracy": 0.75}
    assert card.limits == ("small", "no glass")
    assert card.steps == 3
    first, same, _ = load_art(network)
    assert config == same
    for name, value in first.state_dict().items():
        assert torch.equal(value, shipped.state_dict()[name])
    with pytest.raises(UsageError, match="exists"):
        ship(words)


def test_what_is_no_evaluation_is_refused(tmp_path: Path) -> None:
    (tmp_path / "list.json").write_text("[]")
    for name in ("list.json", "none.json"):
        with pytest.raises(ModelError, match="cannot be read as an evaluation"):
            carded(ModelCard(), metrics=tmp_path / name)


def test_an_encoder_with_other_weights_is_refused(
    network: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Art, "encoder_identity", "dinov2 0123")
    with pytest.raises(ModelError, match="trained with the encoder '', found 'dinov2 0123'"):
        load_art(network)


def test_large_networks_ship_in_half_precision() -> None:
    """Sizes alone are looked at: meta tensors hold no numbers."""
    small, large = (torch.zeros(n, device="meta") for n in (7_000_000, 14_000_000))
    assert stored_type({"a": small}) == "float32"
    assert stored_type({"a": large}) == "float16"
