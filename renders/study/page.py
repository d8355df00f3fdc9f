"""The page of `artgen study render`, written from its rows."""

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import fields

from artgen.studies.table import markdown_table
from renders.accuracy import Measured
from renders.study.rows import Row
from renders.study.settings import (
    ADAPTIVE_CAP,
    BOUNCES,
    CENTER,
    CROSSED,
    DENOISED,
    MOST_PATHS,
    RAW,
    Setting,
)
from renders.study.shipped import LEVELS, Worst, front, preset_size, worst_of_scenes

WIDTH = 100
HEAD = """# What accuracy of images costs

Written by `artgen study render`, in one run; `render.csv` beside this page holds every number.

Three scenes: a cabinet of matte oak and a dishwasher of brushed steel, as our rules draw them with
seed 2026 in surfaces that the study chooses; and a cooler with a glass door, built for the study
alone. Of each, four images from one camera in the light of a drawn studio: everything, with the
joints shut and ajar; the base alone; the largest moving part alone.

- **PSNR** is of sRGB over white, as `artgen.imaging.display` writes it; **fg** counts the pixels
  that the object covers. **FLIP** is the mean of NVIDIA's library at 67 px a degree.
- The **reference** is the mean of renders without denoiser from seeds that no measured image has.
  Its own noise, from the distance of its two halves, is taken off the squared errors; no error
  below that noise is stated. FLIP is as measured, the reference's noise included.
- **CPU s** is of one image, warm: sync, path tracing, denoising, the EXR, with persistent data,
  without starting Blender and importing the GLB. Presets are chosen by it. **Wall s** is with two
  threads; it is as much above half of the CPU seconds as the machine had other work.
"""
MEASURED = """- Not every product was measured, but a star around {center} denoised paths with a
fast prefilter: {denoised} paths denoised so; {raw} without denoiser; every other denoiser at
{crossed}; adaptive sampling with at most {cap}; at most {bounces} bounces; all of it at {sizes} px,
as far as an image has at most {most:.1f} million paths."""
PRESETS = """## Presets

Read at {size} px: the cheapest setting on the front whose worst scene keeps
{levels}; `reference` is the most accurate setting that was measured. `--accuracy 35dB`
takes the cheapest setting below that promises as much at the size asked for; between two sizes the
worse of both counts, beyond them the nearest. A part alone gets the fewest measured paths that
bring it to the PSNR of the composite. The front is that of PSNR: it is what a loss on pixels sees.
"""
FRONT = """## Front at {size} px

Worst error and mean cost over the three scenes; no measured setting is both cheaper and more
accurate.

![PSNR against CPU seconds](render_psnr_{size}.png)
![FLIP against CPU seconds](render_flip_{size}.png)
"""


DENOISERS = """## Every setting at {size} px
"""


def page(rows: Sequence[Row], shipped: Sequence[Measured]) -> str:
    """Markdown."""
    table = worst_of_scenes(rows)
    sizes = sorted({size for _, size in table})
    size = preset_size(sizes)
    sections = [
        HEAD + _measured(sizes),
        _references(rows),
        PRESETS.format(
            size=size, levels=", ".join(f"{db:g} dB (`{name}`)" for name, db in LEVELS.items())
        ),
        _presets(shipped),
    ]
    for each in sizes:
        sections += [FRONT.format(size=each), _front(table["composite", each])]
    sections += [DENOISERS.format(size=size), _all(table["composite", size])]
    return "\n".join(sections) + "\n"


def _measured(sizes: Sequence[int]) -> str:
    told = MEASURED.format(
        center=CENTER.samples,
        denoised=_listed(DENOISED),
        raw=_listed(RAW),
        crossed=_listed(CROSSED),
        cap=ADAPTIVE_CAP,
        bounces=_listed(BOUNCES),
        sizes=_listed(sizes),
        most=MOST_PATHS / 1e6,
    )
    return textwrap.fill(told, WIDTH, subsequent_indent="  ") + "\n"


def _listed(values: Sequence[int]) -> str:
    return ", ".join(str(value) for value in values)


def _references(rows: Sequence[Row]) -> str:
    """How fine each reference is."""
    known = {(row.scene, row.size_px, row.kind): row.reference_psnr_db for row in rows}
    lines = [
        (scene.replace("_", " "), str(size), f"{known[scene, size, 'composite']:.1f}",
         f"{known[scene, size, 'part']:.1f}")
        for scene, size in dict.fromkeys((scene, size) for scene, size, _ in known)
    ]  # fmt: skip
    header = ("scene", "px", "reference against truth, dB", "of parts alone, dB")
    return "\n" + markdown_table(header, lines) + "\n"


def _presets(shipped: Sequence[Measured]) -> str:
    lines = [
        (
            f"`{row.preset}`",
            str(row.size_px),
            f"{row.samples} / {row.part_samples}",
            _setting(row).series,
            f"{row.psnr_db:.1f}",
            f"{row.foreground_psnr_db:.1f}",
            f"{row.part_psnr_db:.1f}",
            f"{row.flip:.3f}",
            f"{row.cpu_s:.2f}",
            f"{row.part_cpu_s:.2f}",
        )
        for row in sorted(shipped, key=lambda row: (row.samples, row.size_px))
        if row.preset
    ]
    header = (
        *("preset", "px", "paths, whole / part", "how", "PSNR dB", "fg dB", "part dB", "FLIP"),
        *("CPU s", "CPU s a part"),
    )
    return markdown_table(header, lines) + "\n"


def _front(measured: Mapping[Setting, Worst]) -> str:
    return _table({setting: measured[setting] for setting in front(measured)})


def _all(measured: Mapping[Setting, Worst]) -> str:
    return _table(dict(sorted(measured.items(), key=lambda item: item[1].cpu_s)))


def _table(measured: Mapping[Setting, Worst]) -> str:
    lines = [
        (
            str(setting.samples),
            setting.series,
            f"{worst.psnr_db:.1f}",
            f"{worst.foreground_psnr_db:.1f}",
            f"{worst.flip:.3f}",
            f"{worst.cpu_s:.2f}",
            f"{worst.wall_s:.2f}",
        )
        for setting, worst in measured.items()
    ]
    return (
        markdown_table(("paths", "how", "PSNR dB", "fg dB", "FLIP", "CPU s", "wall s"), lines)
        + "\n"
    )


def _setting(row: Measured) -> Setting:
    return Setting(**{field.name: getattr(row, field.name) for field in fields(Setting)})
