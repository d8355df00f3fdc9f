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
RAW = (1, 4, 16, 64, 128)
DENOISED = (1, 2, 4, 8, 12, 16, 24, 32, 48, 64, 128, 256)
CROSSED = (4, 16)
"""Paths at which denoisers are compared."""
DENOISERS: Sequence[tuple[DenoiseQuality, Prefilter]] = (
    ("high", "accurate"),
    ("high", "none"),
    ("balanced", "fast"),
    ("fast", "fast"),
    ("fast", "none"),
)
ADAPTIVE = (0.1, 0.03)
ADAPTIVE_CAP = 64
BOUNCES = (1, 2)
MOST_PATHS = 4.2e6
"""Of one image of the study: 64 paths a pixel at 256 px, 256 at 128 px."""


def study_series(size: int) -> list[tuple[Setting, ...]]:
    """Every setting that is measured at `size` px, in series that differ in `samples` alone."""
    chosen = [
        tuple(replace(CENTER, samples=n) for n in DENOISED),
        tuple(replace(CENTER, samples=n, denoise=False) for n in RAW),
        *(
            tuple(replace(CENTER, samples=n, denoise_quality=q, prefilter=p) for n in CROSSED)
            for q, p in DENOISERS
        ),
        *((replace(CENTER, samples=ADAPTIVE_CAP, adaptive=noise),) for noise in ADAPTIVE),
        *((replace(CENTER, bounces=most),) for most in BOUNCES),
    ]
    return [
        tuple(setting for setting in series if setting.samples * size**2 <= MOST_PATHS)
        for series in chosen
    ]
