"""What the study varies: a star around 16 denoised paths a pixel, and the products that matter."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from artgen.render_job import DenoiseQuality, Prefilter


@dataclass(frozen=True, kw_only=True)
class Setting:
    """Settings of the path tracer, named as `RenderJob` and `Shot` name them."""

    samples: int
    denoise: bool = True
    prefilter: Prefilter = "fast"
    denoise_quality: DenoiseQuality = "high"
    adaptive: float = 0.0
    bounces: int | None = None

    @property
    def series(self) -> str:
        """What it has in common with settings of other numbers of paths."""
        if not self.denoise:
            name = "raw"
        else:
            name = f"denoised {self.denoise_quality}, prefilter {self.prefilter}"
        if self.adaptive:
            name += f", adaptive {self.adaptive:g}"
        return name if self.bounces is None else f"{name}, bounces {self.bounces}"

    @property
    def label(self) -> str:
        """For a point of a plot and a line of a page."""
        return f"{self.samples}: {self.series}"


CENTER = Setting(samples=16)
RAW = (1, 4, 16, 64, 128, 256)
DENOISED = (1, 2, 4, 8, 12, 16, 24, 32, 48, 64, 96, 128, 256)
CROSSED = (4, 16, 64)
"""Paths at which denoisers are compared."""
DENOISERS: Sequence[tuple[DenoiseQuality, Prefilter]] = (
    ("high", "accurate"),
    ("high", "none"),
    ("balanced", "fast"),
    ("fast", "fast"),
    ("fast", "none"),
)
ADAPTIVE = (0.1, 0.05, 0.02)
ADAPTIVE_CAP = 64
BOUNCES = (1, 2)
MOST_PATHS = 8.4e6
"""Of one image of the study: 128 paths a pixel at 256 px, 512 at 128 px."""


def study_settings(size: int) -> tuple[Setting, ...]:
    """Every setting that is measured at `size` px, cheap ones first."""
    chosen = [
        *(replace(CENTER, samples=n, denoise=False) for n in RAW),
        *(replace(CENTER, samples=n) for n in DENOISED),
        *(
            replace(CENTER, samples=n, denoise_quality=quality, prefilter=prefilter)
            for n in CROSSED
            for quality, prefilter in DENOISERS
        ),
        *(replace(CENTER, samples=ADAPTIVE_CAP, adaptive=noise) for noise in ADAPTIVE),
        *(replace(CENTER, samples=n, bounces=most) for n in CROSSED for most in BOUNCES),
    ]
    affordable = [setting for setting in chosen if setting.samples * size**2 <= MOST_PATHS]
    return tuple(sorted(affordable, key=lambda setting: setting.samples))
