"""Networks and baselines through the command, on a library of six objects."""

import dataclasses
import json
from pathlib import Path

import pytest
import torch

from artgen.core.errors import ModelError, UsageError
from artgen.core.stream import Stream
from artgen.dataset.members import EncodedSample
from artgen.dataset.shard import write_shard
from model.batch import Articulation
from model.data.library import write_library
from model.data.scene import drawn_scene
from model.data.soup_source import SoupSource
from model.data.truth import articulation as articulation_of
from model.evaluation.cli import evaluate
from model.evaluation.held_out import HeldOut, flips, held_out
from model.evaluation.network_run import (
    NetworkRun,
    judged,
    never_asked,
    run_key,
    shown_to,
    training_items,
)
from model.evaluation.predictors import Guess, counted_from_first, with_more_states
from model.evaluation.score import Protocol
from model.network.art import Art
from model.training.art_file import ModelCard, save_art
from model.training.recipes import RECIPES
from tests.unit.model.data.small import CONFIG, library, soup
from tests.unit.model.evaluation.test_predictions import articulation

OPTIONS = ["--points", "200", "--part-points", "200", "--mask-pixels", "16", "--split", "all"]

ASKED = {
    "predictions": "art.safetensors",
    "truth": Path("library.npz"),
    "train": None,
    "split": None,
    "count": 1,
    "states": 2,
    "views": 2,
    "pixels": 48,
    "counts": False,
    "resolution": 0,
    "samples": 0,
    "gated": False,
}


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder: Path = tmp_path_factory.mktemp("networks")
    write_library(folder / "library.npz", library())
    return folder


def run(place: Path, what: str, out: str, *more: str) -> dict[str, dict[str, float]]:
    arguments = [what, "--truth", str(place / "library.npz"), "--out", str(place / out)]
    assert evaluate([*arguments, *OPTIONS, *more]) == 0
    found = json.loads((place / out / "evaluation.json").read_text(encoding="utf-8"))
    overall: dict[str, dict[str, float]] = found["summary"]["overall"]
    return overall


def test_a_network_is_judged_at_views_and_in_a_state_it_has_not_seen(place: Path) -> None:
    torch.manual_seed(0)
    config = RECIPES["debug"]("nano")
    save_art(place / "art.safetensors", Art(config.model).eval(), config, ModelCard())
    options = ("--count", "1", "--resolution", "8", "--samples", "4", "--no-gates")
    found = run(place, str(place / "art.safetensors"), "art", *options)
    assert found["images.psnr"]["values"] == 4  # Two states by two views.
    assert found["images.new_state.psnr"]["values"] == 2
    assert found["surfaces.rest.chamfer_l1"]["mean"] > 0.0
    assert found["parts.count_right"]["mean"] == 1.0  # It is told.
    assert found["gates.passed"]["mean"] is None


def test_the_mean_layout_has_boxes_and_no_surfaces(place: Path) -> None:
    more = ("--train", str(place / "library.npz"), "--count", "2", "--views", "1")
    found = run(place, "mean", "mean", *more)
    assert 0.0 <= found["singapo.honest.order.rs_dgiou"]["mean"] < 2.0
    assert found["surfaces.rest.chamfer_l1"]["mean"] is None


def test_a_baseline_without_training_objects_is_told(place: Path) -> None:
    with pytest.raises(UsageError, match="--train"):
        run(place, "pixels", "none")
    assert not (place / "none" / "run.json").exists()
    with pytest.raises(UsageError, match="did you mean 'pixels'"):
        run(place, "pixel", "none")


@pytest.mark.parametrize(
    "options",
    [
        ("--pose-noise", "nan"),
        ("--pose-noise-deg", "inf"),
        ("--azimuth-deg", "-1"),
        ("--azimuth-deg", "nan"),
    ],
)
def test_numbers_that_are_none_are_told(place: Path, options: tuple[str, str]) -> None:
    with pytest.raises(UsageError, match="expected (finite|0 to 180)"):
        run(place, "mean", "wrong", *options)
    assert not (place / "wrong").exists()


def test_a_prediction_that_fails_is_asked_what_the_others_are(tmp_path: Path) -> None:
    """Neither gates nor images of a baseline; masks where they have pixels."""
    config = dataclasses.replace(CONFIG, rest="closed")
    (item,) = held_out(SoupSource(library()), config, count=1)

    def lost(_: HeldOut) -> Guess:
        raise ModelError("the loss is not a number")

    def elsewhere(own: HeldOut) -> Guess:
        return Guess(own.layout, {}, rest=7)

    protocol = Protocol(points=100, part_points=100, mask_pixels=8)
    mean = NetworkRun(**{**ASKED, "predictions": "mean", "gated": True, "samples": 4})
    idle = never_asked(mean, protocol, item)
    assert idle == ("gates.", "images.", "surfaces.")
    for predictor, told in ((lost, "not a number"), (elsewhere, "no state 7")):
        record = judged(predictor, item, protocol, tmp_path, idle=idle)
        assert record.failure is not None
        assert told in record.failure
        assert record.metrics["masks.nearest.composite"] == [0.0]
        assert not any(name.startswith(idle) for name in record.metrics)

    network = tmp_path / "art.safetensors"
    network.write_bytes(b"")
    asked = NetworkRun(
        **{**ASKED, "predictions": str(network), "gated": True, "samples": 4, "resolution": 8}
    )
    assert never_asked(asked, protocol, item) == ()
    blank = dataclasses.replace(protocol, mask_pixels=0)
    assert never_asked(asked, blank, item) == ("masks.",)
    noisy = dataclasses.replace(asked, pose_noise=0.1, gated=False, resolution=0)
    assert never_asked(noisy, protocol, item) == ("gates.", "images.", "surfaces.")


def test_noise_of_poses_is_what_is_asked_for() -> None:
    """Not that of the training; images of other views are left out under noise."""
    config = RECIPES["debug"]("nano")
    trained = dataclasses.replace(config, data=dataclasses.replace(config.data, pose_noise=0.1))
    clean = NetworkRun(**ASKED)
    assert shown_to(trained, clean).pose_noise == 0.0
    assert not clean.noisy
    noisy = NetworkRun(**ASKED, pose_noise_deg=2.0)
    assert shown_to(trained, noisy).pose_noise_deg == 2.0
    assert noisy.noisy


def test_a_new_state_is_reached_by_the_true_motion() -> None:
    """Where the predicted axis points the other way, the motion does, too."""
    true = articulation()
    longer = torch.cat([true.motion_BTP, torch.tensor([[[0.0, 0.0, 0.3, 0.4]]])], dim=1)
    flipped = Articulation(**{**vars(true), "axis_BP3": -true.axis_BP3})
    moved = with_more_states(flipped, Articulation(**{**vars(true), "motion_BTP": longer}))
    assert moved.motion_BTP[0, 2].tolist() == pytest.approx([0.0, 0.0, -0.3, -0.4], abs=1e-7)
    assert flips(true, true).tolist() == [[1.0, 1.0, 1.0, 1.0]]


def test_the_truth_as_counted_from_the_first_state() -> None:
    """As the training data states it for `rest='first'`; float32 axes of unit length."""
    config = dataclasses.replace(CONFIG, rest="closed")
    scenes = [
        drawn_scene(soup("cabinet"), dataclasses.replace(config, rest=rest), Stream(4))
        for rest in ("closed", "first")
    ]
    closed, first = (articulation_of([scene.truth], torch.device("cpu")) for scene in scenes)
    counted = counted_from_first(closed)
    torch.testing.assert_close(counted.axis_BP3, first.axis_BP3, rtol=0.0, atol=1e-6)
    torch.testing.assert_close(counted.motion_BTP, first.motion_BTP, rtol=0.0, atol=1e-6)


def test_a_network_that_counts_from_the_first_state_is_judged_there(place: Path) -> None:
    torch.manual_seed(0)
    config = RECIPES["debug"]("nano")
    config = dataclasses.replace(config, data=dataclasses.replace(config.data, rest="first"))
    path = place / "first.safetensors"
    save_art(path, Art(config.model).eval(), config, ModelCard())
    options = ("--count", "1", "--resolution", "0", "--samples", "4", "--no-gates")
    found = run(place, str(path), "first", *options)
    assert found["images.new_state.psnr"]["values"] == 2
    assert found["states.nearest.center"]["values"] == 1


def test_baselines_learn_from_objects_of_all_categories() -> None:
    """The first three objects are cabinets; three that are spread over all are not."""
    source = SoupSource(library(), slots=6)
    items = training_items(source, dataclasses.replace(CONFIG, batch=1), 3)
    assert {layout.category for layout, _ in items} > {"cabinet"}


def test_records_depend_on_what_shards_hold(tmp_path: Path) -> None:
    """Records of an older packing were kept: of a folder, the path alone was looked at."""

    def key(pixel: bytes) -> str:
        sample = EncodedSample(asset_id="laptop_000000", members=(("s0.v0.rgba.png", pixel),))
        write_shard(tmp_path / "test-000000.tar", [sample])
        asked = NetworkRun(**{**ASKED, "truth": tmp_path, "split": "test"})
        return run_key(asked, Protocol())

    assert key(b"a") == key(b"a")
    assert key(b"a") != key(b"b")
