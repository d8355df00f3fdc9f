"""A whole session on a tiny network: from seeds to a network file, resumed and refused."""

import dataclasses
from pathlib import Path

import pytest
import torch

import model.training.session
from artgen.core.errors import ModelError, UsageError
from artgen.core.jsonio import file_hash
from artgen.progress import silent
from model.batch import Batch
from model.data.kept import Kept
from model.data.library import packed, write_library
from model.data.loader import batches
from model.data.soup_source import SoupSource
from model.network.art import Art
from model.network.encoders.efflite import EfficientNetLite0
from model.training.art_file import ModelCard, load_art, save_art
from model.training.checkpoint import found_checkpoints, read_checkpoint
from model.training.log import read_lines
from model.training.material import Material, make_missing, opened
from model.training.objective import Objective
from model.training.perceptual import FeatureDistance
from model.training.picture import picture_of
from model.training.recipes import articulation_only
from model.training.schedule import moment_at
from model.training.settings import changed
from tests.unit.model.data.small import assert_equal
from tests.unit.model.tiny_session import TINY, laptop_material, laptops, session


@pytest.fixture(scope="module")
def source() -> SoupSource:
    return SoupSource(packed(laptops()), slots=4)


@pytest.fixture(scope="module")
def material(tmp_path_factory: pytest.TempPathFactory) -> Material:
    return laptop_material(tmp_path_factory.mktemp("library"))


@pytest.fixture(scope="module")
def batch(source: SoupSource) -> Batch:
    return next(batches(source, TINY.data))


def test_a_session_leaves_a_network_that_equals_the_average(
    tmp_path: Path, material: Material
) -> None:
    art, config, card = load_art(session(material, tmp_path))
    assert config == TINY
    assert (card.steps, card.data["seen"], card.data["items"]) == (4, 8, 2)
    average = read_checkpoint(found_checkpoints(tmp_path)[-1]).average
    for name, value in art.state_dict().items():
        assert torch.equal(value, average[f"art.{name}"])
    assert [line["step"] for line in read_lines(tmp_path / "log.jsonl")] == [1, 2, 3, 4]
    assert len(list((tmp_path / "pictures").iterdir())) == 2


def test_a_session_goes_on_to_the_same_bytes_and_refuses_other_settings(
    tmp_path: Path, material: Material
) -> None:
    session(material, tmp_path)
    found = found_checkpoints(tmp_path)[-1]
    weights = read_checkpoint(found).weights
    found.unlink()
    session(material, tmp_path)
    for name, value in read_checkpoint(found).weights.items():
        assert torch.equal(value, weights[name])
    with pytest.raises(UsageError, match=r"config\.data\.seed 0, now 1"):
        session(material, tmp_path, changed(TINY, ["data.seed=1"]))


def test_other_objects_at_the_same_place_do_not_resume(tmp_path: Path) -> None:
    """Paths alone were compared: a run went on with whatever lay there."""
    material = laptop_material(tmp_path)
    short = changed(TINY, ["train.steps=1"])
    session(material, tmp_path / "run", short)
    session(laptop_material(tmp_path), tmp_path / "run", short)
    assert material.library is not None
    write_library(material.library, packed(laptops()[::-1]))
    with pytest.raises(UsageError, match="other data or weights: library"):
        session(material, tmp_path / "run", short)


def test_other_first_weights_do_not_resume(tmp_path: Path, material: Material) -> None:
    short = changed(TINY, ["train.steps=1"])
    start = session(material, tmp_path / "first", short)
    session(material, tmp_path / "run", short, start=start)
    with pytest.raises(UsageError, match="other data or weights: start .*, now None"):
        session(material, tmp_path / "run", short)


def test_first_weights_that_cannot_be_read_cost_no_waiting(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Found: `--start nowhere` was told after all objects had been made, minutes later."""

    def make(*_: object, **__: object) -> None:
        raise AssertionError("objects are made")

    monkeypatch.setattr("model.training.session.make_missing", make)
    made = Material(categories=("laptop",), objects=2)
    with pytest.raises(ModelError, match="nowhere"):
        session(made, tmp_path / "run", start=tmp_path / "nowhere")


def test_the_card_says_what_a_run_began_with(tmp_path: Path, material: Material) -> None:
    first = session(material, tmp_path / "first", changed(TINY, ["train.steps=1"]))
    two = changed(TINY, ["train.steps=2"])
    cards = [
        load_art(path)[2] for path in (first, session(material, tmp_path / "run", two, start=first))
    ]
    assert cards[0].data["begun_with"] is None
    begun = cards[1].data["begun_with"]
    assert isinstance(begun, dict)
    assert begun["sha256"] == file_hash(first)
    assert (begun["steps"], begun["data"]) == (1, cards[0].data)
    assert cards[1].steps == 2


PERCEPTUAL = changed(
    TINY,
    [
        *("data.patch_px=4", "weights.part_perceptual=0.5", "train.perceptual=[0.0,0.0]"),
        *("train.steps=1", "train.picture_every=0"),
    ],
)


def test_a_run_goes_on_with_the_perceptual_term_that_it_began_with(
    tmp_path: Path, material: Material, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether the term was there depended on an installed package, and nothing recorded it."""
    measure = FeatureDistance(EfficientNetLite0())
    with monkeypatch.context() as patched:
        patched.setattr(model.training.session, "packaged_distance", lambda: measure)
        session(material, tmp_path, PERCEPTUAL)
    assert read_lines(tmp_path / "log.jsonl")[0]["part_perceptual"] > 0.0
    monkeypatch.setattr(model.training.session, "packaged_distance", lambda: None)
    with pytest.raises(UsageError, match="perceptual True, now False"):
        session(material, tmp_path, PERCEPTUAL)


def test_a_term_that_is_left_out_is_told_once(
    tmp_path: Path,
    material: Material,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    monkeypatch.setattr(model.training.session, "packaged_distance", lambda: None)
    session(material, tmp_path, PERCEPTUAL)
    (told,) = [line for line in caplog.messages if "above 0" in line]
    assert "part_perceptual (its network is absent" in told
    assert "part_perceptual" not in read_lines(tmp_path / "log.jsonl")[0]


def test_a_session_begins_with_given_weights(tmp_path: Path, material: Material) -> None:
    """One step at rate 0 leaves the weights as they were."""
    torch.manual_seed(7)
    art = Art(TINY.model)
    save_art(tmp_path / "start.safetensors", art, TINY, ModelCard())
    still = changed(TINY, ["train.steps=1", "train.learning_rate=0"])
    found, _, _ = load_art(
        session(material, tmp_path / "run", still, start=tmp_path / "start.safetensors")
    )
    for name, value in found.state_dict().items():
        assert torch.equal(value, art.state_dict()[name])


def test_the_objective_learns_joints_before_it_renders(batch: Batch) -> None:
    torch.manual_seed(0)
    objective = Objective(Art(TINY.model), TINY.weights)
    moment = moment_at(TINY.train, 0)
    early = objective(batch, dataclasses.replace(moment, rendered=False))
    late = objective(batch, moment)
    assert "part_mask" in late
    assert early.keys() == late.keys() - {"part_mask", "part_rgb"}
    for name in early.keys() - {"total"}:
        assert torch.equal(early[name], late[name])
    terms = [value for name, value in late.items() if name != "total"]
    assert torch.equal(late["total"], torch.stack(terms).sum())


def test_boxes_get_no_gradient_through_rendering(batch: Batch) -> None:
    """Masks alone move neither centers nor sizes, though rays follow the predicted boxes."""
    torch.manual_seed(0)
    art = Art(TINY.model)
    masks = {field.name for field in dataclasses.fields(TINY.weights) if field.type is float}
    weights = changed(TINY, [f"weights.{name}=0" for name in masks - {"part_mask"}]).weights
    moment = dataclasses.replace(moment_at(TINY.train, 0), forced=False)
    seen = []
    art.register_forward_hook(lambda module, given, made: seen.append(made.articulation))
    loss = Objective(art, weights)(batch, moment)["total"]
    (articulation,) = seen
    parts = (articulation.center_BP3, articulation.size_BP3, articulation.motion_BTP)
    center, size, motion = torch.autograd.grad(loss, parts, allow_unused=True)
    assert center is None or not bool(center.any())
    assert size is None or not bool(size.any())
    assert motion is not None


def test_pictures_show_each_object_in_a_row(batch: Batch) -> None:
    torch.manual_seed(0)
    image = picture_of(Art(TINY.model), batch, moment_at(TINY.train, 0))
    assert image.shape == (2 * 16, 4 * 16, 3)
    first = (255.0 * batch.images.rgb_BTV3HW[0, 0, 0].movedim(0, -1)).round().byte().numpy()
    assert (image[:16, :16] == first).all()


def test_articulation_alone_trains_without_rays(source: SoupSource) -> None:
    config = articulation_only(TINY)
    batch = next(batches(source, config.data))
    losses = Objective(Art(config.model), config.weights)(batch, moment_at(config.train, 0))
    assert "part_mask" not in losses
    assert bool(torch.isfinite(losses["total"]))


def test_kept_scenes_come_again_to_the_bit(source: SoupSource, tmp_path: Path) -> None:
    """Four scenes of two objects: the second epoch shows what the first did, in another order."""
    kept = Kept(source, 2, tmp_path)
    supply = batches(kept, dataclasses.replace(TINY.data, batch=4))
    first, second, third = next(supply), next(supply), next(supply)

    def rows(batch: Batch) -> set[bytes]:
        return {image.numpy().tobytes() for image in batch.images.rgb_BTV3HW}

    assert len(kept) == 4
    assert len(rows(first)) == 4
    assert rows(first) == rows(second) == rows(third)
    for folder in (tmp_path, tmp_path / "anew"):  # Another process reads them, or casts the same.
        again = next(batches(Kept(source, 2, folder), dataclasses.replace(TINY.data, batch=4), 4))
        assert_equal(again, second)


def test_objects_are_made_once_and_kept(tmp_path: Path) -> None:
    material = Material(categories=("laptop",), objects=2, split=None)
    make_missing(material, tmp_path, TINY.data, show=silent)
    written = (tmp_path / "library.npz").read_bytes()
    make_missing(material, tmp_path, TINY.data, show=silent)
    assert (tmp_path / "library.npz").read_bytes() == written
    assert len(opened(material, tmp_path, TINY.data)) == 2
