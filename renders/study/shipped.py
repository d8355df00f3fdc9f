"""The table that ships: settings on the front, what they promise, and which of them are presets."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import mean

import numpy as np

from artgen.studies.front import pareto_front
from renders.accuracy import Measured
from renders.study.rows import Row
from renders.study.settings import Setting

PRESET_SIZE = 128
"""px at which presets are read; the same settings are more accurate in larger images."""
LEVELS: Mapping[str, float] = {"draft": 30.0, "standard": 36.0, "high": 40.0}
"""Preset to the least PSNR, dB, of the worst scene; `reference` is the most accurate setting."""


@dataclass(frozen=True, kw_only=True)
class Worst:
    """One setting on one kind of image at one size, over all scenes: worst errors, mean costs."""

    psnr_db: float
    foreground_psnr_db: float
    flip: float
    cpu_s: float
    wall_s: float


Table = dict[tuple[str, int], dict[Setting, Worst]]
"""(kind, size) to setting to what holds for every scene."""


def worst_of_scenes(rows: Iterable[Row]) -> Table:
    """Rows of one setting, kind and size put together."""
    groups: dict[tuple[str, int], dict[Setting, list[Row]]] = {}
    for row in rows:
        by_setting = groups.setdefault((row.kind, row.size_px), {})
        by_setting.setdefault(row.setting, []).append(row)
    return {
        key: {setting: _worst(own) for setting, own in by_setting.items()}
        for key, by_setting in groups.items()
    }


def _worst(rows: Sequence[Row]) -> Worst:
    return Worst(
        psnr_db=min(row.psnr_db for row in rows),
        foreground_psnr_db=min(row.foreground_psnr_db for row in rows),
        flip=max(row.flip for row in rows),
        cpu_s=mean(row.cpu_s for row in rows),
        wall_s=mean(row.wall_s for row in rows),
    )


def front(measured: Mapping[Setting, Worst]) -> list[Setting]:
    """Settings that no other beats in both CPU time and PSNR, cheap ones first."""
    settings = list(measured)
    best = pareto_front(
        [measured[setting].cpu_s for setting in settings],
        [-measured[setting].psnr_db for setting in settings],
    )
    chosen = [settings[k] for k in np.flatnonzero(best)]
    return sorted(chosen, key=lambda setting: measured[setting].cpu_s)


def presets(measured: Mapping[Setting, Worst]) -> dict[str, Setting]:
    """The cheapest setting on the front that reaches each level, and the most accurate one; a level
    that nothing reaches takes that one too."""
    best = front(measured)
    named = {
        name: next((one for one in best if measured[one].psnr_db >= level), best[-1])
        for name, level in LEVELS.items()
    }
    return {**named, "reference": best[-1]}


def shipped_rows(rows: Sequence[Row]) -> list[Measured]:
    """A line for every setting that is on the front of some size, and for every measured size.

    A part alone gets the fewest measured paths, with the same denoiser, that bring its PSNR to that
    of the composite.
    """
    table = worst_of_scenes(rows)
    sizes = sorted({size for _, size in table})
    named = presets(table["composite", preset_size(sizes)])
    fronts = {size: front(table["composite", size]) for size in sizes}
    shipped = []
    for setting in dict.fromkeys(setting for size in sizes for setting in fronts[size]):
        part = part_setting(setting, table, sizes)
        names = [name for name, chosen in named.items() if chosen == setting] or [""]
        for name in names:
            shipped += [
                _line(name, setting, part, size, table, on_front=setting in fronts[size])
                for size in sizes
                if setting in table["composite", size]
            ]
    return sorted(shipped, key=lambda line: (line.size_px, line.cpu_s, line.preset))


def preset_size(sizes: Sequence[int]) -> int:
    """PRESET_SIZE, or the largest size of a study that leaves it out."""
    return PRESET_SIZE if PRESET_SIZE in sizes else max(sizes)


def part_setting(setting: Setting, table: Table, sizes: Sequence[int]) -> Setting:
    """The setting of parts alone that goes with a setting of composites, at every size."""
    sizes = [size for size in sizes if setting in table["composite", size]]
    for samples in sorted({other.samples for other in table["part", sizes[-1]]}):
        candidate = replace(setting, samples=samples)
        if samples <= setting.samples and all(
            candidate in table["part", size]
            and table["part", size][candidate].psnr_db >= table["composite", size][setting].psnr_db
            for size in sizes
        ):
            return candidate
    return setting


def _line(
    name: str, setting: Setting, part: Setting, size: int, table: Table, *, on_front: bool
) -> Measured:
    whole, alone = table["composite", size][setting], table["part", size][part]
    return Measured(
        preset=name,
        size_px=size,
        samples=setting.samples,
        part_samples=part.samples,
        denoise=setting.denoise,
        prefilter=setting.prefilter,
        denoise_quality=setting.denoise_quality,
        adaptive=setting.adaptive,
        bounces=setting.bounces,
        front=on_front,
        psnr_db=whole.psnr_db,
        foreground_psnr_db=whole.foreground_psnr_db,
        part_psnr_db=alone.psnr_db,
        flip=whole.flip,
        cpu_s=whole.cpu_s,
        wall_s=whole.wall_s,
        part_cpu_s=alone.cpu_s,
        part_wall_s=alone.wall_s,
    )
