"""What all runs of a study share: size, updates, batch; and how an arm becomes settings."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.core.errors import UsageError
from model.config import Config, Size
from model.training.material import Material
from model.training.recipes import RECIPES
from model.training.settings import changed
from model.training_study.cells import Cell
from model.training_study.claims import BOXES, Arm


@dataclass(frozen=True, kw_only=True)
class Course:
    """The usual run.

    Attributes:
        steps: updates in all.
        batch: objects of one update.
        scenes: in which every object is seen, kept on disk; None draws new ones each time.
        settings: what else is changed of the recipe, in every arm.
    """

    size: Size
    steps: int
    batch: int
    scenes: int | None
    settings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if min(self.steps, self.batch, self.scenes or 1) < 1:
            raise UsageError(
                f"steps {self.steps}, batch {self.batch} and scenes {self.scenes} must be at least "
                "1"
            )

    def material(self, library: Path) -> Material:
        """All objects of a library, which are for learning."""
        return Material(library=library, split=None, scenes=self.scenes)

    def config(self, recipe: str, arm: Arm, *, steps: int, seed: int) -> Config:
        """Settings of one stage."""
        return changed(
            RECIPES[recipe](self.size),
            (
                *_lengths(steps),
                *(f"data.batch={self.batch}", "train.picture_every=0", "train.log_every=20"),
                *(BOXES if arm.kind == "boxes" else ()),
                *self.settings,
                *arm.settings,
                *(f"train.seed={seed}", f"data.seed={seed}"),
            ),
        )

    def cell(
        self, arm: Arm, library: Path, *, seed: int, curve: int = 0, name: str | None = None
    ) -> Cell:
        """The run of an arm from a seed.

        Args:
            curve: at how many evenly spaced updates, the last among them, the network is kept.
            name: of the cell's arm, where it is not that of `arm`.
        """
        static = round(arm.static * self.steps)
        stages = [self.config("multiview", arm, steps=self.steps - static, seed=seed)]
        if static:
            stages.insert(0, self.config("static_pretrain", arm, steps=static, seed=seed))
        points = curve_points(stages[-1].train.steps, curve)
        if points:
            kept = (f"train.save_every={points[0]}", f"train.keep={len(points)}")
            stages[-1] = changed(stages[-1], kept)
        return Cell(
            arm=name or arm.name,
            seed=seed,
            stages=tuple(stages),
            material=self.material(library),
            curve=points,
        )


def curve_points(steps: int, count: int) -> tuple[int, ...]:
    """Updates at which a curve is drawn, the last included; none where `count` is 0.

    Raises:
        UsageError: they would not be whole.
    """
    if count == 0:
        return ()
    if count < 0 or steps % count:
        raise UsageError(f"{steps} steps do not divide into {count} stretches; choose a divisor")
    return tuple(steps // count * (k + 1) for k in range(count))


def _lengths(steps: int) -> Sequence[str]:
    """Warm-up over a tenth, and an average as long as a hundredth of the run, 100 updates at
    most."""
    decay = 1.0 - 1.0 / min(max(steps // 100, 2), 100)
    return (
        f"train.steps={steps}",
        f"train.warmup_steps={max(steps // 10, 1)}",
        f"train.ema_decay={decay}",
        "train.save_every=200",
        "train.keep=1",
    )
