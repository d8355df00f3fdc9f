"""The runs of `artgen study scaling`, and the tables, plots and page from what is done."""

from collections.abc import Sequence
from pathlib import Path

from artgen.core.jsonio import write_bytes
from artgen.progress import progress
from artgen.studies.table import write_table
from model.precision import flushed_denormals
from model.training_study.cells import Cell
from model.training_study.claims import ARMS, AXIS, CENTER, DCDIST, DGIOU, NAMES, PSNR, TYPE
from model.training_study.course import Course
from model.training_study.figures import CurvePoint, plot_curves
from model.training_study.judge import Judge
from model.training_study.objects import HELD_OUT, training_path, write_objects
from model.training_study.runs import known, known_points, run_cells, share_of
from model.training_study.scaling import NAME, Scaling
from model.training_study.scaling_page import CurveRow, page
from model.training_study.scores import Score
from model.training_study.tell import tell

CELLS = "cells"
DRAWN = (DGIOU, DCDIST, CENTER, TYPE, AXIS, PSNR)
"""Metrics of the plots."""


def run(command: Scaling) -> Path:
    """The page, after all runs that are ours."""
    course = Course(
        size=command.size,
        steps=command.steps,
        batch=command.batch,
        scenes=command.scenes,
        settings=command.set,
    )
    cells = cells_of(command, course)
    objects = command.out / "objects"
    judge = Judge(truth=objects / HELD_OUT, count=command.held_out)
    if not command.dry:
        write_objects(
            *(command.library, objects),
            counts=command.counts,
            held_out=command.held_out,
            slots=cells[0].stages[0].data.slots,
        )
        for count in command.counts:
            _mean_layout(command, judge, count)
        with flushed_denormals():
            run_cells(
                *(share_of(cells, command.share), command.out / CELLS, judge),
                device=command.device,
                show=progress,
                tell=tell,
            )
    return write_results(command, cells, judge)


def cells_of(command: Scaling, course: Course) -> list[Cell]:
    """All runs, seed by seed; those on the most objects keep the points of their curve."""
    return [
        course.cell(
            ARMS[command.kind],
            training_path(command.out / "objects", count),
            seed=seed,
            curve=command.points if count == command.counts[-1] else 0,
            name=f"objects_{count:05d}",
        )
        for seed in range(command.seeds)
        for count in command.counts
    ]


def _mean_layout(command: Scaling, judge: Judge, count: int) -> Score:
    library = training_path(command.out / "objects", count)
    folder = command.out / "mean_layout" / f"objects_{count:05d}"
    return judge.score("mean", folder, shapes=False, train=library)


def write_results(command: Scaling, cells: Sequence[Cell], judge: Judge) -> Path:
    """Table, plots and page of what is done."""
    rows = [
        *_object_rows(command, cells, judge),
        *_update_rows(command, cells, judge),
        *_mean_rows(command, judge),
    ]
    pictures = []
    if rows:
        write_table(command.out / f"{NAME}.csv", rows)
    for axis, x in (("objects", "objects to learn from"), ("updates", "updates")):
        if points := _drawn(rows, axis):
            pictures.append(f"{NAME}_{axis}.png")
            plot_curves(command.out / pictures[-1], points, title=f"quality by {axis}", x=x)
    path = command.out / f"{NAME}.md"
    write_bytes(path, page(rows, command, cells=len(cells), pictures=pictures).encode())
    return path


def _object_rows(command: Scaling, cells: Sequence[Cell], judge: Judge) -> list[CurveRow]:
    found = known(cells, command.out / CELLS, judge)
    return [
        row
        for arm, by_seed in found.items()
        for seed, score in by_seed.items()
        for row in _rows("objects", "network", int(arm.removeprefix("objects_")), seed, score)
    ]


def _update_rows(command: Scaling, cells: Sequence[Cell], judge: Judge) -> list[CurveRow]:
    return [
        row
        for cell in cells
        for step, score in known_points(cell, command.out / CELLS, judge).items()
        for row in _rows("updates", "network", step, cell.seed, score)
    ]


def _mean_rows(command: Scaling, judge: Judge) -> list[CurveRow]:
    rows = []
    for count in command.counts:
        library = training_path(command.out / "objects", count)
        folder = command.out / "mean_layout" / f"objects_{count:05d}"
        if library.exists() and (score := judge.kept("mean", folder, shapes=False, train=library)):
            rows += _rows("objects", "mean layout", count, 0, score)
    return rows


def _rows(axis: str, series: str, x: int, seed: int, score: Score) -> list[CurveRow]:
    return [
        CurveRow(
            axis=axis,
            series=series,
            x=x,
            seed=seed,
            metric=metric,
            mean=score.mean(metric),
            objects=len(score.metrics[metric]),
        )
        for metric in NAMES
        if metric in score.metrics
    ]


def _drawn(rows: Sequence[CurveRow], axis: str) -> dict[str, list[CurvePoint]]:
    points: dict[str, list[CurvePoint]] = {}
    for metric in DRAWN:
        own = [row for row in rows if (row.axis, row.metric) == (axis, metric)]
        for series, x in dict.fromkeys((row.series, row.x) for row in own):
            values = tuple(row.mean for row in own if (row.series, row.x) == (series, x))
            point = CurvePoint(series=series, x=float(x), values=values)
            points.setdefault(metric, []).append(point)
    return points
