"""Networks and baselines judged on held-out objects of a library or of shards."""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch

from artgen.core.errors import ArtgenError, UsageError
from artgen.core.jsonio import content_hash, file_hash, write_bytes
from artgen.core.stream import Stream
from artgen.dataset.split import Split
from artgen.progress import progress
from model.config import Config
from model.data.config import DataConfig
from model.data.fingerprint import fingerprint
from model.data.items import Source
from model.data.library import read_library
from model.data.shards import ShardSource
from model.data.soup_source import SoupSource
from model.evaluation.baselines import NearestNeighbor, mean_layouts
from model.evaluation.held_out import CPU, HeldOut, held_out, held_out_config, spread
from model.evaluation.lpips import load_lpips
from model.evaluation.pictures import strip
from model.evaluation.predictions import layout_of
from model.evaluation.predictors import (
    ArtPredictor,
    FitPredictor,
    MeanPredictor,
    NeighborPredictor,
    Predictor,
    feature_of,
)
from model.evaluation.records import keep_record, kept_record, picture_path
from model.evaluation.reshape import rebased
from model.evaluation.score import Protocol, Record, failed, score
from model.evaluation.surfaces import has_surface
from model.fitting.object_fit import FitConfig
from model.network.encoders.registry import make_encoder
from model.training.art_file import load_art
from model.training.distributed import device_named

LEAST_PX = 16
"""Images that nobody looks at are made as small as this."""


@dataclass(frozen=True, kw_only=True)
class NetworkRun:
    """What is judged, on what.

    Attributes:
        predictions: a network file, `mean`, `fit`, `pixels`, or the name of an encoder.
        truth: a library file, or a folder of shards.
        train: the same for baselines to learn from.
        split: of the truth; None takes all. Baselines learn from `train`.
        count: objects at most.
        states, views, pixels, azimuth_deg: what baselines are shown; a network states its own.
        counts, resolution, samples, gated: as `ArtPredictor`.
        lpips: folder of its weights, or None.
        fit_steps: updates of `fit`.
        train_count: training objects of a baseline at most.
        blind: whether a network is shown nothing.
        device: where a network predicts; what is made of it is measured on the CPU.
        pose_noise_deg, pose_noise: of the poses that are stated to a network, as in `DataConfig`.
    """

    predictions: str
    truth: Path
    train: Path | None
    split: Split | None
    count: int
    states: int
    views: int
    pixels: int
    counts: bool
    resolution: int
    samples: int
    gated: bool
    lpips: Path | None = None
    fit_steps: int = 600
    train_count: int = 1000
    pose_noise_deg: float = 0.0
    pose_noise: float = 0.0
    blind: bool = False
    azimuth_deg: float = 180.0
    device: str = "cpu"

    @property
    def noisy(self) -> bool:
        """Whether stated poses are off; images of other views cannot be judged then."""
        return max(self.pose_noise_deg, self.pose_noise) > 0.0


@torch.no_grad()
def run(asked: NetworkRun, protocol: Protocol, folder: Path) -> list[Record]:
    """A record for every held-out object; those that are kept in `folder` are not made again."""
    predictor, config = made_predictor(asked)
    source = opened(asked.truth, asked.split, config.slots)
    key = run_key(asked, protocol)
    records = []
    total = min(asked.count, len(source))
    with progress("objects", total) as advance:
        for item in held_out(source, config, count=asked.count, seed=protocol.seed):
            record = kept_record(folder, item.name, key)
            if record is None:
                idle = never_asked(asked, protocol, item)
                record = judged(predictor, item, protocol, folder, idle=idle)
                keep_record(folder, record, key)
            records.append(record)
            advance(record.name)
    return records


def judged(
    predictor: Predictor,
    item: HeldOut,
    protocol: Protocol,
    folder: Path,
    *,
    idle: Sequence[str] = (),
) -> Record:
    """Predict and score one object, and keep its picture.

    Args:
        idle: beginnings of the metrics that are asked of no object.
    """
    try:
        guess = predictor(item)
        true = item.layout if guess.rest is None else rebased(item.layout, guess.rest)
        record = score(guess.layout, true, protocol, images=guess.images, gates=guess.gates)
        write_bytes(picture_path(folder, item.name), strip(guess.layout, true))
    except ArtgenError as error:
        return failed(item.layout, str(error), idle=idle)
    return record


def never_asked(asked: NetworkRun, protocol: Protocol, item: HeldOut) -> tuple[str, ...]:
    """Beginnings of the metrics that a run asks of no prediction."""
    network = Path(asked.predictions).is_file()
    more_views = item.everything.images.rgb_BTV3HW.shape[2] > item.shown.images.rgb_BTV3HW.shape[2]
    formed = (network and asked.resolution > 0) or asked.predictions == "fit"
    held = {
        "masks.": protocol.mask_pixels > 0,
        "gates.": network and asked.gated,
        "images.": network and asked.samples > 0 and not asked.noisy and more_views,
        "surfaces.": formed and has_surface(item.layout),
    }
    return tuple(beginning for beginning, is_asked in held.items() if not is_asked)


def run_key(asked: NetworkRun, protocol: Protocol) -> str:
    """What records depend on."""
    network = Path(asked.predictions)
    hashes = [file_hash(network)] if network.is_file() else []
    if asked.truth.exists():
        hashes.append(fingerprint(asked.truth, asked.split))
    if asked.train is not None and asked.train.exists():
        hashes.append(fingerprint(asked.train, "train"))
    table = dataclasses.asdict(asked)
    del table["device"]  # Alike but for rounding.
    return content_hash([table, protocol, hashes])


def opened(place: Path, split: Split | None, slots: int) -> Source[Any]:
    """The objects of a library file, or of a folder of shards.

    Raises:
        UsageError: there is neither.
    """
    if place.is_file():
        return SoupSource(read_library(place), split=split, slots=slots)
    if place.is_dir():
        return ShardSource(place, split=split, slots=slots)
    what = "is neither" if place.exists() else "does not exist; expected"
    raise UsageError(
        f"{place} {what} a library of objects (of artgen train-data, or library.npz of a training "
        f"run) {'nor' if place.exists() else 'or'} a folder of shards"
    )


def made_predictor(asked: NetworkRun) -> tuple[Predictor, DataConfig]:
    """Who predicts, and the data that is shown."""
    path = Path(asked.predictions)
    if path.is_file():
        art, config, _ = load_art(path)
        own = ArtPredictor(
            art=art.to(device_named(asked.device)),
            config=config,
            counts=asked.counts,
            resolution=asked.resolution,
            samples=0 if asked.noisy else asked.samples,
            gated=asked.gated,
            perceptual=None if asked.lpips is None else load_lpips(asked.lpips),
            blind=asked.blind,
        )
        return own, shown_to(config, asked)
    if asked.predictions == "fit":
        steps = dataclasses.replace(FitConfig(), steps=asked.fit_steps)
        return FitPredictor(steps), baseline_data(asked)
    if asked.train is None:
        raise UsageError(
            f"{asked.predictions} learns from training objects: name a library or shards by --train"
        )
    blind = asked.predictions == "mean"
    data = baseline_data(dataclasses.replace(asked, views=1, pixels=LEAST_PX) if blind else asked)
    source = opened(asked.train, "train", data.slots)
    if blind:
        items = training_items(source, data, asked.train_count)
        return MeanPredictor(mean_layouts([layout for layout, _ in items])), data
    encoder = (
        None if asked.predictions == "pixels" else make_encoder(asked.predictions, frozen=True)
    )
    pairs = [(layout, feature_of(batch, encoder)) for layout, batch in
             training_items(source, data, asked.train_count)]  # fmt: skip
    features = torch.tensor([feature.tolist() for _, feature in pairs]).double().numpy()
    neighbor = NearestNeighbor(features, [layout for layout, _ in pairs])
    return NeighborPredictor(neighbor, encoder), data


def baseline_data(asked: NetworkRun) -> DataConfig:
    """What a baseline is shown."""
    return DataConfig(
        states=asked.states,
        views=asked.views,
        input_px=asked.pixels,
        render_px=asked.pixels + asked.pixels // 4,
        target_px=asked.pixels,
        azimuth_deg=asked.azimuth_deg,
    )


def shown_to(config: Config, asked: NetworkRun) -> DataConfig:
    """The data that a network was trained on, with the noise that is asked for."""
    return dataclasses.replace(
        config.data, batch=1, pose_noise_deg=asked.pose_noise_deg, pose_noise=asked.pose_noise
    )


def training_items(
    source: Source[Any], config: DataConfig, count: int
) -> Sequence[tuple[Any, Any]]:
    """Layouts and batches of at most `count` training objects, spread evenly, one scene each."""
    return list(_training_items(source, config, count))


def _training_items(
    source: Source[Any], config: DataConfig, count: int
) -> Iterator[tuple[Any, Any]]:
    narrow = held_out_config(config, extra=False)
    positions = spread(count, len(source))
    with progress("training objects", len(positions)) as advance:
        for position in positions:
            stream = Stream(0, "evaluation", "training", position)
            batch = source.batch([source.plan(position, narrow, stream)], narrow, CPU)
            name, category = batch.asset_ids[0], batch.categories[0]
            yield layout_of(batch.truth, 0, name=name, category=category), batch
            advance(name)
