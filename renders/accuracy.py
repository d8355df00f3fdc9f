"""What an accuracy costs: from a preset's name, from decibels or from paths to settings of the path
tracer, each with the error that it promises.

`accuracy.csv` beside this module is written by `artgen study render`; docs/studies/render.md tells
how it is read.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path

from artgen.core.errors import UsageError
from artgen.render_job import DenoiseQuality, Prefilter
from artgen.studies.table import read_table

SHIPPED = Path(__file__).with_name("accuracy.csv")
PRESETS = ("draft", "standard", "high", "reference")


@dataclass(frozen=True, kw_only=True)
class Measured:
    """One line of the table: a setting at a size, worst error and mean cost over three scenes.

    Attributes:
        preset: name of the preset that this setting is, or nothing.
        size_px: width and height of the image.
        samples, part_samples: paths a pixel of a composite, and of a part alone.
        denoise, prefilter, denoise_quality, adaptive, bounces: as in `RenderJob`.
        front: no measured setting is both cheaper and more accurate at this size.
        psnr_db, foreground_psnr_db, part_psnr_db: sRGB over white against a converged reference, of
            whole composites, of their covered pixels, of whole images of parts alone.
        flip: mean of the worst scene.
        cpu_s, wall_s, part_cpu_s, part_wall_s: an image, warm.
    """

    preset: str
    size_px: int
    samples: int
    part_samples: int
    denoise: bool
    prefilter: Prefilter
    denoise_quality: DenoiseQuality
    adaptive: float
    bounces: int | None
    front: bool
    psnr_db: float
    foreground_psnr_db: float
    part_psnr_db: float
    flip: float
    cpu_s: float
    wall_s: float
    part_cpu_s: float
    part_wall_s: float


@dataclass(frozen=True, kw_only=True)
class Promise:
    """What a quality holds and costs, by the worst of the study's scenes.

    Attributes:
        size_px: the measured size that speaks for the asked one.
        psnr_db, foreground_psnr_db, part_psnr_db, flip, cpu_s, part_cpu_s: as in `Measured`.
    """

    size_px: int
    psnr_db: float
    foreground_psnr_db: float
    part_psnr_db: float
    flip: float
    cpu_s: float
    part_cpu_s: float


@dataclass(frozen=True, kw_only=True)
class Quality:
    """Settings of the path tracer that decide error and time.

    Attributes:
        accuracy: what was asked for.
        samples: paths a pixel of a composite image.
        part_samples: paths a pixel of a part alone.
        denoise, prefilter, denoise_quality, adaptive, bounces: as in `RenderJob`.
        promise: None where paths were asked for that nobody measured.
    """

    accuracy: str
    samples: int
    part_samples: int
    denoise: bool = True
    prefilter: Prefilter = "fast"
    denoise_quality: DenoiseQuality = "high"
    adaptive: float = 0.0
    bounces: int | None = None
    promise: Promise | None = None

    def described(self) -> dict[str, object]:
        """Field to value, the promise too; for sample metadata and reports."""
        stated = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**stated, "promise": None if self.promise is None else vars(self.promise).copy()}


def quality(accuracy: str, size: int) -> Quality:
    """The settings of a preset; or the cheapest that holds `35dB` at this size; or of `16spp`, so
    many paths a pixel, denoised.

    Decibels are PSNR of whole composites, sRGB over white. A size between two measured ones takes
    the worse of both; a size beyond them the nearest.

    Raises:
        UsageError: none of these, or more decibels than any measured setting holds.
    """
    table = shipped()
    if accuracy in PRESETS:
        return _quality(accuracy, _at_size([row for row in table if row.preset == accuracy], size))
    if found := re.fullmatch(r"(\d+(?:\.\d+)?)\s*dB", accuracy):
        return _quality(accuracy, cheapest(table, float(found[1]), size))
    if (found := re.fullmatch(r"(\d+)spp", accuracy)) and (samples := int(found[1])) > 0:
        return Quality(accuracy=accuracy, samples=samples, part_samples=max(1, samples // 2))
    raise UsageError(
        f"--accuracy {accuracy} is unknown; ask for {', '.join(PRESETS)}, for decibels such as "
        "35dB, or for paths a pixel such as 16spp"
    )


@cache
def shipped() -> tuple[Measured, ...]:
    """The table that the study wrote."""
    return tuple(read_table(SHIPPED, Measured))


def cheapest(table: Iterable[Measured], decibels: float, size: int) -> Measured:
    """The setting of least CPU time that promises `decibels` at `size`.

    Raises:
        UsageError: none does; told with the best there is.
    """
    groups: dict[tuple[object, ...], list[Measured]] = {}
    for row in table:
        groups.setdefault(_setting(row), []).append(row)
    offers = [_at_size(group, size) for group in groups.values()]
    holding = [offer for offer in offers if offer.psnr_db >= decibels]
    if not holding:
        best = max(offers, key=lambda offer: offer.psnr_db)
        raise UsageError(
            f"--accuracy {decibels:g}dB is out of reach at {size} px: the best that was measured "
            f"is {best.psnr_db:.1f} dB, for {best.cpu_s:.1f} CPU s an image; ask for that or less, "
            "or for many paths such as 4096spp"
        )
    return min(holding, key=lambda offer: (offer.cpu_s, -offer.psnr_db))


def _at_size(rows: list[Measured], size: int) -> Measured:
    """Of one setting's lines, the one that speaks for a size: the worse neighbor."""
    below = [row for row in rows if row.size_px <= size]
    above = [row for row in rows if row.size_px >= size]
    neighbors = [
        *([max(below, key=lambda row: row.size_px)] if below else []),
        *([min(above, key=lambda row: row.size_px)] if above else []),
    ]
    return min(neighbors, key=lambda row: row.psnr_db)


def _quality(accuracy: str, row: Measured) -> Quality:
    settings = {name: getattr(row, name) for name in SETTING}
    promised = {field.name: getattr(row, field.name) for field in fields(Promise)}
    return Quality(accuracy=accuracy, **settings, promise=Promise(**promised))


SETTING = (
    *("samples", "part_samples", "denoise", "prefilter", "denoise_quality", "adaptive", "bounces"),
)
"""Columns that say how to render."""


def _setting(row: Measured) -> tuple[object, ...]:
    return tuple(getattr(row, name) for name in SETTING)
