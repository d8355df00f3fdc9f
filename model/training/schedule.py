"""What changes while training goes on: learning rate, inverse deviation, image size, switches.

Every value is a function of the step alone, so that a resumed run meets the same ones.
"""

import math
from dataclasses import dataclass
from typing import Literal

from artgen.core.errors import ModelError

Precision = Literal["float32", "bfloat16"]


@dataclass(frozen=True, kw_only=True)
class Stage:
    """From a share of the run on, supervised rays come from images of this size.

    Attributes:
        start: share of all steps at which the stage begins, in [0, 1).
        target_px: width and height of the images that rays are drawn from.
    """

    start: float
    target_px: int


@dataclass(frozen=True, kw_only=True)
class TrainConfig:
    """How weights follow from data; the paper's values where it states them.

    Attributes:
        steps: updates of the weights.
        seed: root of the initial weights and of every draw while training.
        learning_rate: the peak, reached after `warmup_steps`, left on a cosine.
        final_ratio: last rate over the peak.
        betas: AdamW's decay rates of the moments; the paper's.
        weight_decay: on weights of two or more dimensions; biases and scales are left alone.
        clip_norm: largest length of the whole gradient.
        accumulation: batches whose gradients are averaged into one update.
        ema_decay: of the moving average of the weights, the one that ships.
        precision: of the network's matrix products.
        field_precision: of the products that make distance and color of points; all other
            arithmetic of the renderer is float32.
        inverse_beta: 1 / deviation of the density at the first and at the last step, 1 / radii;
            linear in between, as the paper's.
        stages: sizes of supervised images, coarse to fine.
        samples: points per ray and part whose distance and color are computed.
        coarse: points per ray and part that first look for the surface; 0 spreads samples evenly.
        rendered: share of the run at which rays begin to be rendered; before, boxes and joints
            alone are learned, at a third of the price.
        forced: share of the run in which rays follow the true boxes and joints; afterwards the
            predicted ones.
        perceptual: shares of the run at which the perceptual term begins and is whole.
        save_every: steps between checkpoints.
        keep: checkpoints kept, the newest.
        log_every: steps between lines of the log.
        picture_every: steps between rendered images; 0 for none.
    """

    steps: int = 10_000
    seed: int = 0
    learning_rate: float = 4e-4
    final_ratio: float = 0.02
    warmup_steps: int = 500
    betas: tuple[float, float] = (0.9, 0.95)
    weight_decay: float = 0.05
    clip_norm: float = 1.0
    accumulation: int = 1
    ema_decay: float = 0.999
    precision: Precision = "bfloat16"
    field_precision: Precision = "float32"
    inverse_beta: tuple[float, float] = (10.0, 100.0)
    stages: tuple[Stage, ...] = (Stage(start=0.0, target_px=128),)
    samples: int = 32
    coarse: int = 0
    rendered: float = 0.0
    forced: float = 0.5
    perceptual: tuple[float, float] = (0.3, 0.5)
    save_every: int = 500
    keep: int = 2
    log_every: int = 20
    picture_every: int = 500

    def __post_init__(self) -> None:
        counts = (self.steps, self.accumulation, self.samples, self.save_every, self.keep)
        if (
            min(*counts, self.log_every) < 1
            or min(self.warmup_steps, self.picture_every, self.coarse) < 0
        ):
            raise ModelError(
                f"training: steps {self.steps}, accumulation {self.accumulation}, samples "
                f"{self.samples}, save_every {self.save_every}, keep {self.keep} and log_every "
                f"{self.log_every} must be at least 1, warmup_steps {self.warmup_steps}, "
                f"picture_every {self.picture_every} and coarse {self.coarse} at least 0"
            )
        if not 0.0 <= self.ema_decay < 1.0:
            raise ModelError(
                f"training: ema_decay {self.ema_decay} must lie in [0, 1); 0 follows the weights"
            )
        starts = [stage.start for stage in self.stages]
        if not starts or starts[0] != 0.0 or starts != sorted(set(starts)) or starts[-1] >= 1.0:
            raise ModelError(
                f"training: stages start at {starts}; the first must start at 0, the others later "
                "and later, all before 1"
            )


def rate_at(config: TrainConfig, step: int) -> float:
    """Learning rate of update `step` (from 0): linear warm-up, then cosine to the final ratio."""
    if step < config.warmup_steps:
        return config.learning_rate * (step + 1) / config.warmup_steps
    span = max(config.steps - config.warmup_steps, 1)
    passed = min((step - config.warmup_steps) / span, 1.0)
    share = 0.5 * (1.0 + math.cos(math.pi * passed))
    return config.learning_rate * (config.final_ratio + (1.0 - config.final_ratio) * share)


def share_at(config: TrainConfig, step: int) -> float:
    """How much of the run lies behind update `step`, in [0, 1]; 1 at the last one."""
    return min(step / max(config.steps - 1, 1), 1.0)


def inverse_beta_at(config: TrainConfig, step: int) -> float:
    """Inverse deviation of the density, 1 / radii, linear over the run."""
    first, last = config.inverse_beta
    return first + (last - first) * share_at(config, step)


def stage_at(config: TrainConfig, step: int) -> Stage:
    """The stage that update `step` belongs to."""
    passed = step / config.steps
    return [stage for stage in config.stages if stage.start <= passed][-1]


def forced_at(config: TrainConfig, step: int) -> bool:
    """Whether rays of update `step` follow the true boxes and joints."""
    return step < config.forced * config.steps


def perceptual_at(config: TrainConfig, step: int) -> float:
    """Factor on the perceptual term, linear from 0 to 1 between two shares of the run."""
    first, last = config.perceptual
    if last <= first:
        return float(share_at(config, step) >= first)
    return min(max((share_at(config, step) - first) / (last - first), 0.0), 1.0)


@dataclass(frozen=True, kw_only=True)
class Moment:
    """What the objective and the data depend on at one update.

    Attributes:
        step: updates made before.
        inverse_beta: 1 / radii.
        target_px: size of supervised images.
        samples: points per ray and part.
        coarse: points per ray and part that look for the surface first.
        rendered: whether rays are rendered.
        forced: whether rays follow the true boxes and joints.
        perceptual: factor on the perceptual term, in [0, 1].
    """

    step: int
    inverse_beta: float
    target_px: int
    samples: int
    coarse: int
    rendered: bool
    forced: bool
    perceptual: float


def moment_at(config: TrainConfig, step: int) -> Moment:
    """The schedule's values for update `step`."""
    return Moment(
        step=step,
        inverse_beta=inverse_beta_at(config, step),
        target_px=stage_at(config, step).target_px,
        samples=config.samples,
        coarse=config.coarse,
        rendered=step >= config.rendered * config.steps,
        forced=forced_at(config, step),
        perceptual=perceptual_at(config, step),
    )
