"""Presets of rendering and of meshing, read from the front of what was measured."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from artgen.studies.front import pareto_front
from model.field_study.rows import MeshRow, SamplesRow

RENDER_PROMISES: Mapping[str, float] = {"draft": 30.0, "standard": 40.0, "reference": 50.0}
"""dB over all sharpnesses, whole and parts: what a first stage of training, a late one, and a
judge of images ask for."""
MESH_PROMISES: Mapping[str, float] = {"draft": 0.25, "standard": 0.1, "reference": 0.03}
"""Relative error of the volume of the worst part: of the thickness of its boards."""


@dataclass(frozen=True, kw_only=True)
class RenderPreset:
    """A number of samples with what it keeps at every sharpness.

    Attributes:
        psnr_db: the least over sharpnesses, whole and parts.
        step_ms: of 1,000 rays that meet a box, with the backward pass.
    """

    name: str
    samples: int
    coarse: int
    quadrature: str
    psnr_db: float
    step_ms: float


def combined(rows: Sequence[SamplesRow]) -> list[RenderPreset]:
    """Every setting over all sharpnesses, nameless yet."""
    found: dict[tuple[int, int, str], RenderPreset] = {}
    for row in rows:
        key = (row.samples, row.coarse, row.quadrature)
        least = min(row.psnr_db, row.part_psnr_db)
        if key in found:
            least = min(least, found[key].psnr_db)
        found[key] = RenderPreset(
            name="",
            samples=row.samples,
            coarse=row.coarse,
            quadrature=row.quadrature,
            psnr_db=least,
            step_ms=row.step_ms,
        )
    return list(found.values())


def render_presets(rows: Sequence[SamplesRow]) -> list[RenderPreset]:
    """For each promise the cheapest setting on the front that keeps it; where none does, the most
    accurate one."""
    settings = combined(rows)
    front = pareto_front([s.step_ms for s in settings], [-s.psnr_db for s in settings])
    best = [setting for setting, on_front in zip(settings, front, strict=True) if on_front]
    best.sort(key=lambda setting: setting.step_ms)
    return [
        RenderPreset(**{**vars(_first(best, promise)), "name": name})
        for name, promise in RENDER_PROMISES.items()
    ]


def _first(best: Sequence[RenderPreset], promise: float) -> RenderPreset:
    return next((setting for setting in best if setting.psnr_db >= promise), best[-1])


def mesh_presets(rows: Sequence[MeshRow]) -> dict[str, MeshRow]:
    """For each promise the cheapest resolution on the front that keeps it, or the finest."""
    front = pareto_front([row.ms for row in rows], [row.volume_error for row in rows])
    best = [row for row, on_front in zip(rows, front, strict=True) if on_front]
    best.sort(key=lambda row: row.ms)
    return {
        name: next((row for row in best if row.volume_error <= promise), best[-1])
        for name, promise in MESH_PROMISES.items()
    }
