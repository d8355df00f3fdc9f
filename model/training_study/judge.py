"""How the networks of a study are judged: the same held-out objects, the same options."""

from dataclasses import dataclass
from pathlib import Path

from artgen.dataset.split import Split
from model.evaluation.network_run import NetworkRun
from model.training_study.scores import Score, kept_score, scored

ALL = 1_000_000
"""Training objects of a baseline at most."""


@dataclass(frozen=True, kw_only=True)
class Judge:
    """Who judges.

    Attributes:
        truth: library, or folder of shards, of objects that nobody learned from.
        count: of them at most.
        split: of the truth; None takes all.
        pose_noise_deg, pose_noise: by which stated poses are off.
        resolution, samples, mask_pixels: of surfaces, images and parts' masks, for networks that
            make shapes.
    """

    truth: Path
    count: int
    split: Split | None = None
    pose_noise_deg: float = 0.0
    pose_noise: float = 0.0
    resolution: int = 24
    samples: int = 24
    mask_pixels: int = 48

    def score(self, who: str, folder: Path, *, shapes: bool, train: Path | None = None) -> Score:
        """What a network file, or a baseline that learns from `train`, is worth."""
        return scored(self._asked(who, shapes, train), folder, mask_pixels=self._pixels(shapes))

    def kept(
        self, who: str, folder: Path, *, shapes: bool, train: Path | None = None
    ) -> Score | None:
        """The same, where it was judged before."""
        if train is None and not Path(who).exists():
            return None
        asked = self._asked(who, shapes, train)
        return kept_score(asked, folder, mask_pixels=self._pixels(shapes))

    def _asked(self, who: str, shapes: bool, train: Path | None) -> NetworkRun:
        return NetworkRun(
            predictions=who,
            truth=self.truth,
            train=train,
            split=self.split,
            count=self.count,
            states=2,
            views=2,
            pixels=48,
            counts=False,
            resolution=self.resolution if shapes else 0,
            samples=self.samples if shapes else 0,
            gated=False,
            train_count=ALL,
            pose_noise_deg=self.pose_noise_deg,
            pose_noise=self.pose_noise,
        )

    def _pixels(self, shapes: bool) -> int:
        return self.mask_pixels if shapes else 0
