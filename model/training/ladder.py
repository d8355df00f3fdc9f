"""The overfit ladder: one object learned by heart, rung by rung, before anything larger is tried.

Masks alone first, with the true boxes and joints; then boxes and joints as well; then colors. Each
rung goes on from the weights of the one below and is measured on rays that were not trained on.
"""

import dataclasses
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from PIL import Image
from torch import Tensor

from artgen.core.errors import ModelError
from artgen.core.jsonio import plain, replace_atomically
from artgen.core.stream import Stream
from artgen.progress import Show, silent
from artgen.studies.table import write_table
from model.batch import FIXED, REVOLUTE, Batch, Rays
from model.config import Config, LossWeights
from model.data.library import packed
from model.data.loader import batches
from model.data.soup import seed_soup
from model.data.soup_source import SoupSource
from model.network.art import Art
from model.network.prediction import Prediction
from model.training.objective import Objective, seen_along
from model.training.picture import picture_of
from model.training.run_state import Run, begun, resume
from model.training.schedule import Moment, moment_at
from model.training.train import train

SAVE_EVERY = 50
"""Steps."""
COLORS = LossWeights(part_rgb=10.0)
"""Everything."""
JOINTS = dataclasses.replace(COLORS, part_rgb=0.0)
"""Boxes, joints and masks."""
MASKS = dataclasses.replace(
    dataclasses.replace(JOINTS, center=0.0, size=0.0, type=0.0, axis=0.0, origin=0.0),
    motion=0.0,
    limits=0.0,
    parent=0.0,
    count=0.0,
)
"""Masks alone."""


@dataclass(frozen=True, kw_only=True)
class Rung:
    """One step of the ladder.

    Attributes:
        weights: of the losses.
        forced: whether rays follow the true boxes and joints.
        steps: updates.
    """

    name: str
    weights: LossWeights
    forced: bool
    steps: int


def rungs(steps: int) -> tuple[Rung, ...]:
    """Masks, joints, and colors, which take longer."""
    return (
        Rung(name="masks", weights=MASKS, forced=True, steps=steps),
        Rung(name="joints", weights=JOINTS, forced=False, steps=steps),
        Rung(name="colors", weights=COLORS, forced=False, steps=4 * steps),
    )


@dataclass(frozen=True, kw_only=True)
class Climbed:
    """How well one object is known after a rung, on rays that were not trained on.

    Attributes:
        mask_iou: intersection over union of coverage above one half, each part alone, mean over
            parts.
        psnr_db: of the whole object's premultiplied color.
        center: mean distance of box centers, radii.
        size: mean absolute difference of box sides, radii.
        axis_deg: largest angle between axes.
        origin: largest distance of axis points, turning parts, radii.
        motion: largest difference of motions.
    """

    rung: str
    steps: int
    seconds: float
    mask_iou: float
    psnr_db: float
    center: float
    size: float
    axis_deg: float
    origin: float
    motion: float


@dataclass(frozen=True, kw_only=True)
class Specimen:
    """The object to learn, as `artgen generate` makes it."""

    category: str
    seed: int
    index: int


def write_ladder(
    specimen: Specimen, config: Config, *, steps: int, rays: int, folder: Path, show: Show = silent
) -> Iterator[Climbed]:
    """Climb with an object; leaves ladder.csv and ladder.png in the folder, too."""
    soup = seed_soup(specimen.category, specimen.seed, specimen.index)
    batch = next(batches(SoupSource(packed([soup])), config.data))
    rows, pictures = [], []
    for row, picture in climb(config, batch, steps=steps, rays=rays, folder=folder, show=show):
        rows.append(row)
        pictures.append(picture)
        yield row
    write_table(folder / "ladder.csv", rows)
    image = Image.fromarray(np.concatenate(pictures))
    large = image.resize((4 * image.width, 4 * image.height), Image.Resampling.NEAREST)
    replace_atomically(folder / "ladder.png", lambda partial: large.save(partial, format="PNG"))


def climb(
    config: Config, batch: Batch, *, steps: int, rays: int, folder: Path, show: Show = silent
) -> Iterator[tuple[Climbed, NDArray[np.uint8]]]:
    """Learn one object by heart; after every rung, what was learned, and a picture of it.

    Args:
        batch: the object, with a multiple of the rays that one update needs; the last fifth of
            them is kept for measuring.
        rays: of one update.
        folder: receives the log and checkpoints of each rung; an interrupted climb resumes in it.
    """
    torch.manual_seed(config.train.seed)
    art = Art(config.model)
    held, kept = divided(batch, config.train.seed)
    for rung in rungs(steps):
        settings = dataclasses.replace(
            config.train,
            steps=rung.steps,
            rendered=0.0,
            forced=float(rung.forced),
            save_every=SAVE_EVERY,
        )
        run = begun(Objective(art, rung.weights), settings, items=1, settings=plain(settings))
        resume(run, folder / rung.name)
        train(run, Redrawn(held, rays).supply, folder=folder / rung.name, show=show)
        moment = moment_at(settings, settings.steps - 1)
        yield measured(run, art, kept, rung), picture_of(art, batch, moment)


def divided(batch: Batch, seed: int) -> tuple[Batch, Batch]:
    """The batch with four fifths of its rays, drawn, and with the others."""
    count = _rays(batch)
    order = torch.from_numpy(Stream(seed, "ladder", "rays").generator().permutation(count))
    cut = 4 * count // 5
    return with_rays(batch, order[:cut]), with_rays(batch, order[cut:])


def _rays(batch: Batch) -> int:
    return 0 if batch.rays is None else batch.rays.alpha_BR.shape[1]


def with_rays(batch: Batch, chosen: Tensor) -> Batch:
    """The batch with some of its rays."""
    rays = batch.rays
    if rays is None:
        return batch
    distance = rays.distance_BR
    picked = Rays(
        origin_BR3=rays.origin_BR3[:, chosen],
        direction_BR3=rays.direction_BR3[:, chosen],
        state_BR=rays.state_BR[:, chosen],
        part_rgb_BPR3=rays.part_rgb_BPR3[:, :, chosen],
        part_alpha_BPR=rays.part_alpha_BPR[:, :, chosen],
        rgb_BR3=rays.rgb_BR3[:, chosen],
        alpha_BR=rays.alpha_BR[:, chosen],
        distance_BR=None if distance is None else distance[:, chosen],
    )
    return dataclasses.replace(batch, rays=picked)


@dataclass(frozen=True)
class Redrawn:
    """One batch over and over, each time with other rays of its own."""

    batch: Batch
    count: int

    def supply(self, moment: Moment, cursor: int) -> Iterator[Batch]:
        """As `model.training.train.Supply`."""
        while True:
            draw = Stream(0, "ladder", "update", cursor).generator()
            chosen = draw.integers(_rays(self.batch), size=self.count)
            yield with_rays(self.batch, torch.from_numpy(chosen))
            cursor += 1


def measured(run: Run, art: Art, batch: Batch, rung: Rung) -> Climbed:
    """What the weights know of the batch at the end of the schedule."""
    moment = moment_at(run.config, run.config.steps - 1)
    with torch.no_grad():
        prediction: Prediction = art(batch.images, batch.truth.valid_BP)
        seen = seen_along(prediction, batch, moment)
    if seen is None or batch.rays is None:
        raise ModelError("the ladder renders; its network needs planes and its batch rays")
    said, true, held = prediction.articulation, batch.truth, batch.truth.valid_BP
    moves, turns = held & (true.type_BP != FIXED), true.type_BP == REVOLUTE
    cosine = (prediction.axis_BP3 * true.axis_BP3).sum(-1)[moves].clamp(-1.0, 1.0)
    motion = (said.motion_BTP - true.motion_BTP).abs().amax(dim=1)
    return Climbed(
        rung=rung.name,
        steps=rung.steps,
        seconds=run.seconds,
        mask_iou=float(mask_iou(seen.part_alpha_BPR, batch.rays.part_alpha_BPR)[held].mean()),
        psnr_db=psnr_db(seen.rgb_BR3, batch.rays.rgb_BR3),
        center=float((said.center_BP3 - true.center_BP3).norm(dim=-1)[held].mean()),
        size=float((said.size_BP3 - true.size_BP3).abs()[held].mean()),
        axis_deg=math.degrees(_largest(torch.acos(cosine))),
        origin=_largest((prediction.origin_BP3 - true.origin_BP3).norm(dim=-1)[turns]),
        motion=_largest(motion[moves]),
    )


def mask_iou(ours_BPR: Tensor, theirs_BPR: Tensor) -> Tensor:
    """(B, P) intersection over union of coverage above one half; 1 where both are empty."""
    ours, theirs = ours_BPR > 0.5, theirs_BPR > 0.5
    both, either = (ours & theirs).sum(dim=-1), (ours | theirs).sum(dim=-1)
    return torch.where(either > 0, both / either.clamp(min=1), 1.0)


def psnr_db(ours: Tensor, theirs: Tensor) -> float:
    """Of colors in [0, 1], dB."""
    return -10.0 * math.log10(max(float((ours - theirs).square().mean()), 1e-12))


def _largest(values: Tensor) -> float:
    return float(values.max()) if values.numel() else 0.0
