"""The report of a run: one JSON with all that was done, and a table that people read."""

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from artgen.core.jsonio import plain, write_bytes, write_json
from artgen.ingest.options import GivenRest
from artgen.ingest.task import Outcome
from artgen.run_folder import RunFolder

SCHEMA = "artgen-ingest/1"
WIDE = 110
"""Letters that the table shows of the findings on a bundle; its own report has them all."""


def write_report(
    folder: RunFolder, outcomes: Sequence[Outcome], rests: Sequence[GivenRest] = ()
) -> None:
    """`ingest_report.json` and `ingest_report.txt` at the top of the run's folder."""
    write_json(folder.root / "ingest_report.json", report(outcomes, rests))
    write_bytes(folder.root / "ingest_report.txt", table(outcomes, rests).encode())


def report(outcomes: Sequence[Outcome], rests: Sequence[GivenRest] = ()) -> dict[str, Any]:
    """Counts, and every object with what was mended, dropped and doubted."""
    counts = Counter(outcome.status for outcome in outcomes)
    confidence: Counter[str] = Counter(
        joint["confidence"]
        for outcome in outcomes
        for joint in outcome.said.get("joints_read", {}).values()
    )
    return {
        "schema": SCHEMA,
        "objects": len(outcomes),
        "counts": {word: counts[word] for word in ("valid", "flawed", "refused")},
        "rest_confidence": dict(sorted(confidence.items())),
        "for_art": sum(o.status != "refused" and not o.said.get("art") for o in outcomes),
        "rests_unused": list(unused_rests(outcomes, rests)),
        "entries": [plain(outcome) for outcome in outcomes],
    }


def unused_rests(outcomes: Sequence[Outcome], rests: Sequence[GivenRest]) -> Iterator[str]:
    """A line for each closed pose of the user's that no joint of the run took; of a refused object
    nobody can say."""
    for rest in rests:
        own = [outcome for outcome in outcomes if rest.id in _ids(outcome)]
        joints = [j for one in own for j in one.said.get("joints_read", {}).values()]
        taken = any(j.get("number") == rest.number and j["confidence"] == "given" for j in joints)
        if not own:
            yield f"{rest.id}: no object of this run is called so"
        elif not taken and all(one.said for one in own):
            yield f"{rest.id}, {rest.number}: no joint with stops is numbered so"


def _ids(outcome: Outcome) -> set[str]:
    """What an object may be called in the user's table; of one that could not be read, its path."""
    if outcome.said:
        return {outcome.said["source"]["id"]}
    path = Path(outcome.source).absolute()
    return {path.name, path.stem}


def table(outcomes: Sequence[Outcome], rests: Sequence[GivenRest] = ()) -> str:
    """One line an object: verdict, name, category, parts and joints, and the first thing to know;
    then the sums, and entries of the user's table of rests that fit nothing."""
    lines = [f"{'verdict':<8} {'object':<28} {'category':<20} {'parts':>5} {'joints':>6}  note"]
    for outcome in outcomes:
        lines.append(
            f"{outcome.status:<8} {outcome.asset_id:<28} {outcome.category:<20} "
            f"{outcome.parts:>5} {outcome.joints:>6}  {note(outcome)}".rstrip()
        )
    counts = Counter(outcome.status for outcome in outcomes)
    said = ", ".join(f"{counts[word]} {word}" for word in ("valid", "flawed", "refused"))
    lines.append(f"{len(outcomes)} objects: {said}")
    lines += [f"--rest entry not used  {line}" for line in unused_rests(outcomes, rests)]
    return "\n".join(lines) + "\n"


def note(outcome: Outcome) -> str:
    """What the table says of an object: of one that is refused all there is to know, as there is no
    bundle that says more; how one is flawed; else what was done to it."""
    if outcome.status == "refused":
        return f"{outcome.source}: {outcome.message}"
    if outcome.message:
        return _short(outcome.message)
    counts = {key: len(outcome.said.get(key, ())) for key in ("mended", "dropped", "doubts")}
    return ", ".join(f"{count} {key}" for key, count in counts.items() if count)


def _short(text: str) -> str:
    return text if len(text) <= WIDE else f"{text[: WIDE - 3]}... (all of it: report.json)"
