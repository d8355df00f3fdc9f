"""Gates that a reconstruction must pass to be of use in MuJoCo, by the checks of artgen validate.

Each gate runs the check itself, so that an open mesh does not keep a simulation from being tried.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from artgen.core.errors import ArtgenError
from artgen.validate import driven, dynamics, models, motion, structure
from artgen.validate.bounds import shipped_bounds
from artgen.validate.levels import Said
from artgen.validate.read import read_subject
from artgen.validate.report import Finding, Skipped
from artgen.validate.subject import Source, Subject


@dataclass(frozen=True, kw_only=True)
class Gates:
    """What held; None where the file does not say enough to ask.

    Attributes:
        loads: MuJoCo compiles the file, and its joints make a tree with limits.
        stable: two seconds under gravity bring no warning and no number that is none.
        settles: in those two seconds no joint leaves rest by more than soft constraints give.
        opens: within its effort every joint goes through its whole range, and back.
        clear: no collision pieces of different parts meet at rest or on the way.
        deepest: how far such pieces reach into each other at most, m; 0 where they are clear.
        joints: how many joints were driven; None where it does not load.
        reasons: gate to what was found against it, or to why it was not asked.
    """

    loads: bool
    stable: bool | None
    settles: bool | None
    opens: bool | None
    clear: bool | None
    deepest: float | None = None
    joints: int | None = None
    reasons: dict[str, str]

    @property
    def passed(self) -> bool:
        """Whether nothing that could be asked speaks against it."""
        return all(held is not False for held in (self.loads, self.stable, self.opens, self.clear))


def gates(source: Source) -> Gates:
    """The gates of a bundle, URDF, MJCF or USD; a bad file fails them and never raises."""
    return subject_gates(read_subject(source, shipped_bounds()))


def subject_gates(subject: Subject) -> Gates:
    """The gates of an asset, however it is read."""
    reasons: dict[str, str] = {}
    loads = _held(subject, "loads", (structure.tree, structure.limits, models.compiles), reasons)
    if not loads:
        return Gates(loads=False, stable=None, settles=None, opens=None, clear=None,
                     reasons=reasons)  # fmt: skip
    found = _said(subject, (dynamics.settles,))
    findings = [item for item in found if isinstance(item, Finding)]
    unstable = [item for item in findings if item.part == "simulation"]
    drifting = [item for item in findings if item.part != "simulation"]
    for name, items in (("stable", unstable), ("settles", drifting)):
        if items:
            reasons[name] = str(items[0])
    clear, deepest = _clear(subject, reasons)
    return Gates(
        loads=True,
        stable=not unstable,
        settles=not drifting,
        opens=_held(subject, "opens", (driven.opens, driven.closes), reasons),
        clear=clear,
        deepest=deepest,
        joints=len(subject.joints),
        reasons=reasons,
    )


def held_against(found: Gates, moving: int) -> Gates:
    """The gates of an object whose truth has `moving` joints: what has none left opens nowhere."""
    if not (found.loads and moving and found.joints == 0):
        return found
    why = f"nothing is left that moves, of {moving} joints"
    return replace(found, opens=False, reasons={**found.reasons, "opens": why})


def _clear(subject: Subject, reasons: dict[str, str]) -> tuple[bool | None, float | None]:
    """Whether collision pieces keep apart, and how far they meet at most."""
    if (lacking := subject.lacks("collision")) is not None:
        reasons["clear"] = lacking
        return None, None
    findings = [f for f in _said(subject, (motion.collisions,)) if isinstance(f, Finding)]
    if findings:
        reasons["clear"] = str(findings[0])
    depths = [f.value for f in findings if isinstance(f.value, float)]
    deepest = max(depths, default=0.0) if len(depths) == len(findings) else None
    return not findings, deepest


Run = Callable[[Subject], Said]
FAULTS = (
    ArtgenError,
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    OSError,
    ArithmeticError,
    SyntaxError,
    RecursionError,
)
"""What a check raises on a file that lacks something, or holds something else."""


def _said(subject: Subject, checks: Iterable[Run]) -> list[object]:
    """Everything the checks say; what they raise on a bad file becomes a finding."""
    found: list[object] = []
    for check in checks:
        try:
            found += check(subject)
        except FAULTS as error:
            found.append(
                Finding(
                    check="evaluation.gate",
                    part=subject.source.file.name,
                    value=" ".join(str(error).split()),
                    bound="a file that can be simulated",
                    cause="it cannot be read as one",
                    remedy="run artgen validate on it",
                )
            )
    return found


def _held(
    subject: Subject, gate: str, checks: Iterable[Run], reasons: dict[str, str]
) -> bool | None:
    """Whether the checks found nothing; None where they skipped something and found nothing."""
    found = _said(subject, checks)
    findings = [item for item in found if isinstance(item, Finding)]
    skipped = [item for item in found if isinstance(item, Skipped)]
    if findings:
        reasons[gate] = str(findings[0])
        return False
    if skipped:
        reasons[gate] = skipped[0].reason
        return None
    return True
