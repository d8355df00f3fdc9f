"""Presets of simulation, read from the measured integrators and sweeps."""

from collections.abc import Sequence
from dataclasses import dataclass

from artgen.simulation_study.measured import Measured
from artgen.studies.front import pareto_front

PROMISES = {"draft": 1e-2, "standard": 2e-3, "reference": 2e-4}
"""Largest error of any everyday motion, rad or m: what an eye, a ruler and a gauge would notice."""
EVERYDAY = ("pendulum", "friction drawer", "damped and sprung door")
"""The stiff closer is left out: it asks for a step of its own, w dt < 0.5."""


@dataclass(frozen=True, kw_only=True)
class Preset:
    """An integrator with a time step.

    Attributes:
        step: s.
        error: worst over everyday motions, rad or m.
        cpu_ms: of all everyday motions together.
    """

    name: str
    integrator: str
    step: float
    error: float
    cpu_ms: float


def combined(rows: Sequence[Measured]) -> list[Preset]:
    """Every integrator and step over all everyday motions, nameless yet."""
    settings = dict.fromkeys((row.setting, row.step) for row in rows)
    found = []
    for integrator, step in settings:
        own = [r for r in rows if (r.setting, r.step) == (integrator, step) and r.scene in EVERYDAY]
        found.append(
            Preset(
                name="",
                integrator=integrator,
                step=step,
                error=max(row.error for row in own),
                cpu_ms=sum(row.cpu_ms for row in own),
            )
        )
    return found


def presets(rows: Sequence[Measured]) -> list[Preset]:
    """For each promise the cheapest setting that holds it; all lie on the front."""
    settings = combined(rows)
    front = pareto_front([s.cpu_ms for s in settings], [s.error for s in settings])
    best = [setting for setting, on_front in zip(settings, front, strict=True) if on_front]
    return [
        _named(name, min((s for s in best if s.error <= promise), key=lambda s: s.cpu_ms))
        for name, promise in PROMISES.items()
    ]


def _named(name: str, setting: Preset) -> Preset:
    return Preset(**{**vars(setting), "name": name})
