"""What an accuracy costs: from a preset's name or from decibels to settings of the path tracer."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from artgen.core.errors import UsageError
from artgen.render_job import DenoiseQuality, Prefilter


@dataclass(frozen=True, kw_only=True)
class Quality:
    """Settings of the path tracer that decide error and time.

    Attributes:
        samples: paths a pixel of a composite image.
        part_samples: paths a pixel of a part alone.
        denoise, prefilter, denoise_quality, adaptive, bounces: as in `RenderJob`.
    """

    samples: int
    part_samples: int
    denoise: bool = True
    prefilter: Prefilter = "fast"
    denoise_quality: DenoiseQuality = "high"
    adaptive: float = 0.0
    bounces: int | None = None


PRESETS: Mapping[str, Quality] = {
    "draft": Quality(samples=4, part_samples=2),
    "standard": Quality(samples=32, part_samples=16),
    "high": Quality(samples=128, part_samples=64),
    "reference": Quality(samples=1024, part_samples=1024, denoise=False),
}


def quality(accuracy: str) -> Quality:
    """The settings of a preset, or of `16spp`: so many paths a pixel, denoised.

    Raises:
        UsageError: neither.
    """
    if accuracy in PRESETS:
        return PRESETS[accuracy]
    if (found := re.fullmatch(r"(\d+)spp", accuracy)) and (samples := int(found[1])) > 0:
        return Quality(samples=samples, part_samples=max(1, samples // 2))
    raise UsageError(
        f"--accuracy {accuracy} is unknown; ask for {', '.join(PRESETS)}, or for paths a pixel "
        "such as 16spp"
    )
