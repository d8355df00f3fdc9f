"""The page of `artgen study ablations`, written from its rows; what was not run is told."""

from collections.abc import Sequence
from itertools import groupby

from artgen.studies.table import markdown_table
from model.training_study.claims import CLAIMS, NAMES, Claim
from model.training_study.course import Course
from model.training_study.rows import NOT_RUN, ClaimRow, told

HEAD = """# What makes training work: ablations

Written by `artgen study ablations`; the CSV files beside this page hold every number. Each row is
the mean difference between two ways to train, an arm less the other, on the same held-out objects
and from the same seeds, with a 95 % bootstrap interval that draws both seeds and objects. The
metrics were chosen beforehand; the first of each table decides. `reproduces` and `reversed` stand
where the interval leaves zero out and three seeds at least agree in sign. The paper's figures
are its own, measured on other objects at another scale: only directions can be compared.

Runs: size `{size}`, {steps} updates of {batch} objects, seeds {seeds}; {held_out} objects to be
judged on. {done} of {cells} are done.
"""


def page(
    rows: Sequence[ClaimRow],
    *,
    course: Course,
    seeds: Sequence[int],
    held_out: int,
    done: int,
    cells: int,
    picture: str | None,
) -> str:
    """The page.

    Args:
        picture: file name of the plot, where there is one.
    """
    parts = [
        HEAD.format(
            size=course.size,
            steps=course.steps,
            batch=course.batch,
            seeds=", ".join(str(seed) for seed in seeds),
            held_out=held_out,
            done=done,
            cells=cells,
        ),
        _overview(rows),
    ]
    if picture:
        parts.append(
            f"![Differences with intervals]({picture})\n\n*Each arm less the one it is held "
            "against; dots are single seeds. Green: better, red: worse, gray: not told apart.*"
        )
    parts += [_claim(claim, [row for row in rows if row.claim == claim.name]) for claim in CLAIMS]
    return "\n\n".join(part.strip() for part in parts) + "\n"


def _overview(rows: Sequence[ClaimRow]) -> str:
    lines = []
    for claim in CLAIMS:
        for own in claim.comparisons:
            first = next(
                row
                for row in rows
                if (row.claim, row.arm, row.metric) == (claim.name, own.arm, claim.metrics[0])
            )
            lines.append(
                (
                    claim.title,
                    f"`{own.arm}` less `{own.against}`",
                    NAMES[first.metric],
                    _interval(first),
                    first.verdict,
                )
            )
    header = ("claim", "comparison", "by", "difference", "verdict")
    return "## In short\n\n" + markdown_table(header, lines)


def _claim(claim: Claim, rows: Sequence[ClaimRow]) -> str:
    text = [f"## {claim.title}", f"The paper: {claim.said}. {claim.note}".strip()]
    for (arm, against), own in groupby(rows, key=lambda row: (row.arm, row.against)):
        listed = list(own)
        text.append(f"`{arm}` less `{against}`:")
        if all(row.verdict == NOT_RUN for row in listed):
            text[-1] += " not yet run."
            continue
        header = ("metric", "difference", "seeds of that sign", "objects", "verdict")
        text.append(
            markdown_table(
                header,
                [
                    (
                        NAMES[row.metric],
                        _interval(row),
                        f"{row.agreeing} of {row.seeds}",
                        str(row.objects),
                        row.verdict,
                    )
                    for row in listed
                    if row.mean is not None
                ],
            )
        )
    return "\n\n".join(text)


def _interval(row: ClaimRow) -> str:
    if row.lower is None or row.upper is None:
        return told(row.metric, row.mean)
    low, high = told(row.metric, row.lower), told(row.metric, row.upper)
    return f"{told(row.metric, row.mean)} ({low} .. {high})"
