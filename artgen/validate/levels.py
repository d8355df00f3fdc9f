"""Checks and levels: what each relies on, what it needs the source to say, and running them."""

from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass
from time import process_time
from typing import Generic, Protocol, TypeVar

from artgen.validate.report import Finding, Note, Report, Simulated, Skipped


class Judged(Protocol):
    """What a subject must tell for the levels to run on it."""

    @property
    def name(self) -> str:
        """Name of the asset."""
        ...

    @property
    def format(self) -> str:
        """bundle, urdf, mjcf or usd."""
        ...

    def lacks(self, need: str) -> str | None:
        """Why the source cannot say what a check needs, or None where it can."""
        ...


S = TypeVar("S", bound=Judged)
Saying = Finding | Skipped | Note | Simulated
Said = Iterable[Saying]


@dataclass(frozen=True)
class Check(Generic[S]):
    """One check: a function of the subject, and what it needs.

    Attributes:
        run: yields findings, and what it could not judge.
        finds: names of the findings it may yield; `--check` takes any of them.
        needs: words that `lacks` knows, such as "manifest" or "visual meshes"; a check is skipped,
            with the reason, where the source cannot say one of them.
        profile: the least thorough profile that runs it.
        before: the profile from which on a more thorough check takes its place.
    """

    run: Callable[[S], Said]
    finds: tuple[str, ...]
    needs: tuple[str, ...] = ()
    profile: str = "standard"
    before: str = ""


@dataclass(frozen=True, kw_only=True)
class Level(Generic[S]):
    """Checks that rely on the same things; run only when every level in `needs` found nothing."""

    name: str
    needs: tuple[str, ...]
    checks: tuple[Check[S], ...]


PROFILES = ("quick", "standard", "full")
"""From quick to thorough; each runs its own checks and those of the ones before."""


@dataclass(frozen=True, kw_only=True)
class Selection:
    """Which checks to run: those of a profile, or those of the named findings or levels."""

    profile: str = "standard"
    names: tuple[str, ...] = ()

    def wants(self, level: str, check: Check[S]) -> bool:
        """Whether a check of a level is asked for."""
        if self.names:
            return any(
                name in check.finds or name in (level, level.split()[0]) for name in self.names
            )
        place = PROFILES.index(self.profile)
        replaced = bool(check.before) and PROFILES.index(check.before) <= place
        return PROFILES.index(check.profile) <= place and not replaced


def run_levels(subject: S, levels: Iterable[Level[S]], selection: Selection) -> Report:
    """Run the levels in order and collect everything they say.

    Levels that the selected ones rely on run as well.
    """
    levels = list(levels)
    wanted = needed_levels(levels, selection)
    said: list[Saying] = []
    judged: list[str] = []
    seconds: dict[str, float] = {}
    failed: set[str] = set()
    began = process_time()  # Asked once a level: on some machines it takes half a millisecond.
    for level in (level for level in levels if level.name in wanted):
        if blockers := [name for name in level.needs if name in failed]:
            reason = f"not judged: relies on {' and '.join(blockers)}, which did not pass"
            said.append(Skipped(name=level.name, reason=reason))
            failed.add(level.name)
            continue
        before = len(said)
        for check in level.checks:
            if wanted[level.name] or selection.wants(level.name, check):
                said += judged_or_skipped(subject, check, judged)
        ended = process_time()
        seconds[level.name], began = ended - began, ended
        if any(isinstance(item, Finding) for item in said[before:]):
            failed.add(level.name)
    return Report(
        asset=subject.name,
        format=subject.format,
        findings=tuple(item for item in said if isinstance(item, Finding)),
        skipped=tuple(item for item in said if isinstance(item, Skipped)),
        notes=tuple(item for item in said if isinstance(item, Note)),
        simulated=tuple(item for item in said if isinstance(item, Simulated)),
        judged=tuple(judged),
        seconds=seconds,
    )


def needed_levels(levels: Collection[Level[S]], selection: Selection) -> dict[str, bool]:
    """Levels to run; True where all of a level's checks must, as others rely on it."""
    wanted = {
        level.name: False
        for level in levels
        if any(selection.wants(level.name, check) for check in level.checks)
    }
    if selection.names:
        for level in reversed(list(levels)):
            if level.name in wanted:
                wanted |= dict.fromkeys(level.needs, True)
    return wanted


def judged_or_skipped(subject: S, check: Check[S], judged: list[str]) -> Iterator[Saying]:
    """What a check says; where the source cannot say what it needs, that alone."""
    for need in check.needs:
        if (reason := subject.lacks(need)) is not None:
            yield from (Skipped(name=name, reason=reason) for name in check.finds)
            return
    judged.extend(check.finds)
    yield from check.run(subject)
