"""L6: what a check left off did not matter; measured, on a sample of assets or on all."""

import hashlib
from collections.abc import Iterator

import mujoco
import numpy as np

from artgen.articulation.kinematics import resolved
from artgen.articulation.states import required_state
from artgen.core.mesh import Floats
from artgen.simulation.effects import PROMISE, Task
from artgen.simulation.paths import agreement
from artgen.validate.report import Finding, Skipped
from artgen.validate.subject import Subject

ONE_IN = 50
"""Assets of which one proves its effects in the standard profile."""
SECONDS = 1.0


def proven_sometimes(subject: Subject) -> Iterator[Finding | Skipped]:
    """One asset in fifty, chosen by its name, proves the promise of its effects."""
    digest = hashlib.sha256(subject.name.encode()).digest()
    if int.from_bytes(digest[:4], "big") % ONE_IN:
        reason = f"proven on one asset in {ONE_IN}; --profile full proves it on every one"
        yield Skipped(name="dynamics.effects", reason=reason)
        return
    yield from proven(subject)


def proven(subject: Subject) -> Iterator[Finding]:
    """With every effect on, each joint takes the same path as with those called for."""
    model = subject.simulated
    for task, force in proving_tasks(subject, model):
        found = agreement(model, task, seconds=SECONDS, force=force)
        if not found.holds:
            off = sorted(set(found.effects.told) - {e.value for e in found.effects.needed})
            yield Finding(
                check="dynamics.effects",
                part=task.name,
                value=found.difference,
                bound=f"<= {PROMISE:g} of the range",
                cause=f"{', '.join(off)} were left off, and matter",
                remedy="look for contact on the way; else report it: effects are derived wrongly",
            )


def proving_tasks(subject: Subject, model: mujoco.MjModel) -> Iterator[tuple[Task, Floats | None]]:
    """Settling, and each joint pushed out of rest with half its effort, those that it needs open
    pushed open as well; L4 has shown that nothing meets on these ways."""
    yield Task(name="settling", start=np.zeros(model.nq), clear=True), None
    for joint in subject.joints:
        if joint.mimic is not None or not np.isfinite(joint.effort):
            continue
        held = required_state(joint.name, subject.passages)
        start, force = np.zeros(model.nq), np.zeros(model.nv)
        for name, q in resolved(subject.joints, held).items():
            start[model.joint(name).id] = q
        pushed = [joint, *(j for j in subject.joints if j.name in held and j.mimic is None)]
        numbers = [int(model.joint(j.name).id) for j in pushed]
        force[numbers] = [j.effort / 2.0 if np.isfinite(j.effort) else 0.0 for j in pushed]
        name, driven = f"pushing {joint.name}", frozenset(numbers)
        yield Task(name=name, start=start, driven=driven, clear=True), force
