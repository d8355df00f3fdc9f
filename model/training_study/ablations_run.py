"""The runs of `artgen study ablations`, and the tables, plot and page from what is done."""

from collections.abc import Sequence
from pathlib import Path

from artgen.core.jsonio import write_bytes
from artgen.core.stream import Stream
from artgen.progress import progress
from artgen.studies.table import write_table
from model.precision import flushed_denormals
from model.training_study.ablations import NAME, Ablations, arms
from model.training_study.ablations_page import page
from model.training_study.cells import Cell
from model.training_study.claims import ARMS, CENTER, CLAIMS, DCDIST, DGIOU, PSNR, TYPE
from model.training_study.course import Course
from model.training_study.figures import plot_differences
from model.training_study.judge import Judge
from model.training_study.objects import HELD_OUT, training_path, write_objects
from model.training_study.pairs import Difference, difference
from model.training_study.prices import price_table, priced
from model.training_study.rows import Known, claim_rows, score_rows
from model.training_study.runs import known, run_cells, share_of
from model.training_study.tell import tell

DRAWN = (DGIOU, DCDIST, CENTER, TYPE, PSNR)
"""Metrics of the plot."""
CELLS = "cells"


def run(command: Ablations) -> Path:
    """The page, after all runs that are ours."""
    course = course_of(command)
    everything = cells_of(command, course)
    objects = command.out / "objects"
    judge = Judge(truth=objects / HELD_OUT, count=command.held_out)
    if not command.dry:
        slots = everything[0].stages[0].data.slots
        write_objects(
            *(command.library, objects),
            counts=(command.objects,),
            held_out=command.held_out,
            slots=slots,
        )
        ours = share_of(everything, command.share)
        with flushed_denormals():
            run_cells(
                *(ours, command.out / CELLS, judge),
                device=command.device,
                show=progress,
                tell=tell,
            )
    return write_results(command, course, everything, judge)


def price(command: Ablations) -> str:
    """A table of what every arm costs here."""
    cells = cells_of(command, course_of(command))
    found = []
    with flushed_denormals():
        prices = priced(cells, command.library, objects=command.objects, device=command.device)
        for own in prices:
            tell(f"{own.arm}: {own.last:.2f} s an update")
            found.append(own)
    return price_table(found, command.seeds)


def course_of(command: Ablations) -> Course:
    """What all runs share."""
    return Course(
        size=command.size,
        steps=command.steps,
        batch=command.batch,
        scenes=command.scenes,
        settings=command.set,
    )


def cells_of(command: Ablations, course: Course) -> list[Cell]:
    """All runs, seed by seed, so that an interrupted study has whole seeds."""
    library = training_path(command.out / "objects", command.objects)
    return [
        course.cell(ARMS[name], library, seed=seed)
        for seed in range(command.seeds)
        for name in arms(command.claims)
    ]


def write_results(command: Ablations, course: Course, cells: Sequence[Cell], judge: Judge) -> Path:
    """Tables, plot and page of what is done."""
    found = known(cells, command.out / CELLS, judge)
    done = sum(len(by_seed) for by_seed in found.values())
    rows = claim_rows(found)
    picture = None
    write_table(command.out / f"{NAME}_claims.csv", rows)
    if done:
        write_table(command.out / f"{NAME}.csv", score_rows(found))
    if drawn := differences(found):
        picture = f"{NAME}.png"
        plot_differences(command.out / picture, drawn, DRAWN)
    text = page(
        rows,
        course=course,
        seeds=range(command.seeds),
        held_out=command.held_out,
        done=done,
        cells=len(cells),
        picture=picture,
    )
    path = command.out / f"{NAME}.md"
    write_bytes(path, text.encode())
    return path


def differences(found: Known) -> dict[str, list[Difference]]:
    """Comparison to its differences by the metrics of the plot; those that were run."""
    drawn: dict[str, list[Difference]] = {}
    for claim in CLAIMS:
        for own in claim.comparisons:
            for metric in DRAWN:
                stream = Stream(0, "training study", own.arm, own.against, metric)
                arm, other = found.get(own.arm, {}), found.get(own.against, {})
                if row := difference(metric, arm, other, stream):
                    drawn.setdefault(f"{own.arm} - {own.against}", []).append(row)
    return drawn
