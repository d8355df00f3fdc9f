"""From photographs and an untrained network to a whole folder, by the command line."""

import json
from pathlib import Path

import pytest
import torch
from PIL import Image

from artgen import cli
from artgen.core.errors import ModelError, UsageError
from artgen.export import read_bundle
from model.config import Config
from model.network.art import Art
from model.reconstruct import cli as command
from model.reconstruct.assemble import Assembled
from model.reconstruct.cli import Reconstruct, checkpoint_of, ordered, shipped_checkpoint
from model.reconstruct.run import STAGES, Stopwatch, asset_name, made_object, reconstruct
from model.training.art_file import ModelCard, save_art
from model.training.recipes import RECIPES, articulation_only
from tests.unit.model.reconstruct.studio import STATES, photographed


def untrained(path: Path, config: Config) -> Path:
    """A network that has learned nothing, in a file."""
    torch.manual_seed(0)
    save_art(path, Art(config.model), config, ModelCard())
    return path


@pytest.fixture(scope="module")
def boxes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("weights")
    return untrained(folder / "boxes.safetensors", articulation_only(RECIPES["debug"]("nano")))


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("weights")
    return untrained(folder / "full.safetensors", RECIPES["debug"]("nano"))


@pytest.mark.blender
def test_the_folder_holds_bundle_films_and_prediction(
    photographs: Path, full: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    order = ordered(
        Reconstruct(images=photographs, checkpoint=full, parts=3, out=out, resolution=24)
    )
    stages: list[str] = []
    outcome = reconstruct(order, stages.append)
    assert tuple(stages) == STAGES
    assert sorted(path.name for path in out.iterdir()) == [
        *("articulation.gif", "bundle", "prediction.json", "reprojection.png", "turntable.gif")
    ]
    bundle = read_bundle(out / "bundle")
    assert [part.name for part in bundle.parts] == ["base", "part_1", "part_2"]
    assert (out / "bundle/report.json").is_file()
    said = json.loads((out / "prediction.json").read_text())
    assert [slot["slot"] for slot in said["slots"]] == [0, 1, 2]
    assert len(said["reprojection"]) == 8
    assert said["changes"] == list(outcome.assembled.changes)
    with Image.open(out / "turntable.gif") as film:
        assert getattr(film, "n_frames", 1) == 24
    with Image.open(out / "reprojection.png") as sheet:
        assert sheet.size == (4 * (2 * 256 + 2), 2 * 256)


def test_three_states_are_read_by_a_network_for_two(
    perfect: Assembled, boxes: Path, tmp_path: Path
) -> None:
    """It was trained on two, and its table has two: three ended the command."""
    states = (*STATES, {"part_1_joint": 0.0, "part_2_joint": 0.3})
    images = photographed(perfect, tmp_path / "three", states=states, size=64)
    order = ordered(Reconstruct(images=images, checkpoint=boxes, parts=3, out=tmp_path / "out"))
    made = made_object(order, Stopwatch(lambda stage: None))
    assert made.finding.prediction.articulation.motion_BTP.shape[1] == 3
    assert made.finding.states in ((0, 1), (0, 2))
    assert len(made.assembled.states) == 3
    (told,) = made.told
    assert told.startswith("the network reads 2 states at a time: boxes and joints")


def test_one_state_is_refused(photographs: Path, boxes: Path, tmp_path: Path) -> None:
    """A lid with a way of 0.48 came out of a laptop that nobody had moved."""
    stated = json.loads((photographs / "cameras.json").read_text())
    stated["views"] = stated["views"][:4]
    cameras = tmp_path / "one.json"
    cameras.write_text(json.dumps(stated))
    out = tmp_path / "out"
    order = ordered(
        Reconstruct(images=photographs, cameras=cameras, checkpoint=boxes, parts=3, out=out)
    )
    with pytest.raises(ModelError, match="show 1 state, this checkpoint was trained on 2"):
        reconstruct(order, lambda stage: None)
    assert not out.exists()


def test_nothing_is_overwritten(photographs: Path, boxes: Path, tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("kept")
    order = ordered(Reconstruct(images=photographs, checkpoint=boxes, parts=3, out=tmp_path))
    with pytest.raises(UsageError, match="nothing is overwritten"):
        reconstruct(order, lambda stage: None)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_a_truncated_checkpoint_is_told(photographs: Path, boxes: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.safetensors"
    cut.write_bytes(boxes.read_bytes()[:-100])
    order = ordered(Reconstruct(images=photographs, checkpoint=cut, parts=3, out=tmp_path / "out"))
    with pytest.raises(ModelError, match=r"cut\.safetensors"):
        reconstruct(order, lambda stage: None)
    assert not (tmp_path / "out").exists()


def test_more_parts_than_slots_end_with_one_line(
    photographs: Path, boxes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["reconstruct", str(photographs), "--checkpoint", str(boxes), "--parts", "99"]
    assert cli.main([*words, "--out", str(tmp_path / "out")]) == 2
    last = capsys.readouterr().err.splitlines()[-1]
    assert last.startswith("artgen: --parts 99: this checkpoint has")


def test_a_folder_without_cameras_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"holds none of cameras\.json"):
        ordered(Reconstruct(images=tmp_path, checkpoint=tmp_path / "x"))


def test_without_a_shipped_checkpoint_one_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "files", lambda package: tmp_path)
    with pytest.raises(
        ModelError, match="no such checkpoint ships with this installation, which has none"
    ):
        shipped_checkpoint()
    (tmp_path / "checkpoints").mkdir()
    (tmp_path / "checkpoints/art_nano.safetensors").write_bytes(b"")
    assert shipped_checkpoint().name == "art_nano.safetensors"


def test_networks_that_ship_go_by_their_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file of that name goes first, and a name that is none is told beside those that are."""
    assert checkpoint_of(None).stem == "art_nano"
    assert checkpoint_of(Path("art_nano_all")).name == "art_nano_all.safetensors"
    assert checkpoint_of(Path("mine.safetensors")) == Path("mine.safetensors")
    with pytest.raises(ModelError, match=r"has art_nano, art_nano_all; train one"):
        checkpoint_of(Path("art_mini"))
    monkeypatch.chdir(tmp_path)
    Path("art_nano").write_bytes(b"")
    assert checkpoint_of(Path("art_nano")) == Path("art_nano")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("My Photos (2)", "reconstruction_my_photos_2"),
        ("cabinet", "reconstruction_cabinet"),
        ("Ω", "reconstruction"),
    ],
)
def test_names_of_assets_are_plain(name: str, expected: str) -> None:
    assert asset_name(Path(name)) == expected
