"""`artgen evaluate`: predictions of any system against the truth, as one JSON and one page."""

import json
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Annotated, Literal

import tyro
from rich.console import Console
from rich.table import Table

from artgen.core.errors import UsageError, did_you_mean
from artgen.core.jsonio import plain, write_bytes, write_json
from artgen.progress import progress
from artgen.run_folder import locked
from model.evaluation.adapters.formats import Place, places
from model.evaluation.metrics import HEADLINES, METRICS
from model.evaluation.records import picture_path
from model.evaluation.report import SHOWN, Report, interval, page, ranking, shown
from model.evaluation.score import Align, Protocol, Record
from model.evaluation.summary import Summary, summary
from model.evaluation.tasks import SIMULATED, Task, perceptual_of, scored

FormatName = Literal[
    "auto", "bundle", "urdf", "urdformer", "singapo", "paris", "dta", "artgs", "two_states"
]
SCHEMA = "artgen-evaluation-run/1"
BASELINES = ("mean", "pixels", "conv", "efflite0", "fit")


@dataclass(frozen=True, kw_only=True)
class Evaluate:
    """Score reconstructions of any system, a trained network or a baseline against the truth.

    A folder of PREDICTIONS is compared with a folder of true objects: each holds an object in each
    of its folders; an object's name is a bundle's asset id or the folder's name, and must be the
    same in both. Known layouts: artgen bundles, any URDF, URDFormer's URDF, SINGAPO's object.json,
    the meshes and joints of PARIS, Digital Twin Art and ArtGS, and their ground truth. PNGs in a
    folder `images` beside an object are compared with the true ones of the same name.

    A network file, or a baseline's name (mean: the mean layout; pixels, conv, efflite0: the nearest
    training object by images or by an encoder's features; fit: a field and joints fitted to the
    object's own images, as PARIS does) is judged on held-out objects of a library (artgen
    train-data) or of shards; a network also at views and in a state that it was not shown.

    Writes evaluation.json, report.html and objects/, one record an object; the same command again
    scores only what changed. What each metric means: docs/evaluation.md.

    For example:

    artgen evaluate out/reconstructions --truth out/assets

    artgen evaluate singapo_results --truth out/assets --align uniform

    artgen evaluate art.safetensors --truth library.npz

    artgen evaluate mean --train library.npz --truth library.npz --out out/evaluation_mean
    """

    predictions: Annotated[str, tyro.conf.arg(metavar="PREDICTIONS"), tyro.conf.Positional]
    """Folder of predicted objects, network file, or name of a baseline."""
    truth: Path
    """Folder of true objects, such as out/assets; for networks and baselines a library or shards.
    """
    format: FormatName = "auto"
    """Layout of the predictions; told by their files if auto. A URDF whose front is +x, as
    URDFormer's, needs to be told."""
    truth_format: FormatName = "auto"
    """Layout of the truth."""
    system: str = ""
    """Name of the system, for the report; the folder's if not given."""
    out: Path = Path("out/evaluation")
    """Receives the report."""
    align: Align = "none"
    """Where predictions are placed: as they are (cameras known), with the true box's middle, or
    also with its half diagonal (a system that has its own frame and scale)."""
    points: int = 10_000
    """Points over a surface for Chamfer distances and F-scores."""
    part_points: int = 20_000
    """Points over a whole object for Particulate's distances; its paper takes 100,000."""
    mask_pixels: int = 96
    """Side of the images for mask IoU; 0 leaves masks out."""
    handles: bool = True
    """Whether parts labeled `handle` count in SINGAPO's published metrics."""
    gates: bool = True
    """Whether bundles, URDFs and what a network predicts are loaded and driven in MuJoCo."""
    lpips: Path | None = None
    """Folder with LPIPS's weights: AlexNet's of torchvision (alexnet*.pth) and the heads of the
    package lpips (alex.pth). Without them LPIPS is null."""
    device: Literal["auto", "cpu", "cuda"] = "cpu"
    """Where a network predicts, makes surfaces and renders; auto takes a GPU where there is one."""
    workers: int = field(default_factory=lambda: os.cpu_count() or 1)
    """Processes side by side, for folders."""
    train: Path | None = None
    """Library or shards that a baseline learns from; of these the split train."""
    split: Literal["train", "val", "test", "all"] = "test"
    """Which objects of a library or of shards networks and baselines are judged on."""
    count: int = 100
    """At most so many held-out objects, spread evenly over all of them."""
    train_count: int = 1000
    """At most so many training objects of a baseline."""
    count_parts: bool = False
    """Let the network count the parts; else it is told how many, as the paper's is."""
    resolution: int = 48
    """Cells of marching cubes along a part, for a network's surfaces; 0 makes none."""
    samples: int = 48
    """Samples a ray, for a network's images; 0 renders none."""
    blind: bool = False
    """Show the network white images from one camera: what does it know without looking?"""
    pose_noise_deg: float = 0.0
    """Deviation of the turn by which poses stated to a network are off, about each axis."""
    pose_noise: float = 0.0
    """Deviation of their shift, radii. Its images are not judged under noise."""
    views: int = 4
    """Views a state that a baseline is shown; a network states its own."""
    pixels: int = 48
    """Side of the images that a baseline is shown."""
    azimuth_deg: float = 180.0
    """Largest angle between a baseline's cameras and the front; a network states its own."""
    fit_steps: int = 600
    """Updates of the baseline fit."""


def evaluate(argv: Sequence[str]) -> int:
    """Score predictions of any system: one JSON, one page with pictures."""
    command = tyro.cli(Evaluate, args=list(argv), prog="artgen evaluate")
    protocol = checked_protocol(command)
    judge = judged_folder if Path(command.predictions).is_dir() else judged_network
    report = judge(command, protocol)
    announce(report.summary, command.out)
    return 0


def judged_folder(command: Evaluate, protocol: Protocol) -> Report:
    """A folder of predictions."""
    folder = Path(command.predictions)
    true = places(command.truth, command.truth_format)
    predicted = places(folder, command.format)
    if not set(true) & set(predicted):
        raise UsageError(
            f"no object of {command.truth} is among {folder}: {_some(sorted(true))} against "
            f"{_some(sorted(predicted))}; name predictions as the true objects are named"
        )
    perceptual_of(command.lpips)  # Weights that are none are told before anything is scored.
    gated = command.gates and all(place.format in SIMULATED for place in predicted.values())
    asked = {
        "format": command.format,
        "truth_format": command.truth_format,
        "gated": gated,
        "lpips": command.lpips,
    }
    with run_folder(command.out, {**stated_run(command, protocol), "asked": plain(asked)}):
        tasks = [
            Task(
                name=name,
                predicted=predicted.get(name),
                true=true[name],
                protocol=protocol,
                gated=gated,
                folder=command.out / "objects",
                lpips=command.lpips,
            )
            for name in sorted(true)
        ]
        records = scored_with_progress(tasks, command.workers)
        return written(command, protocol, records, notes(predicted, true, records))


def judged_network(command: Evaluate, protocol: Protocol) -> Report:
    """A network or a baseline; torch is imported here, as most commands do without."""
    if not Path(command.predictions).is_file() and command.predictions not in BASELINES:
        raise UsageError(
            f"{command.predictions} is no folder, no network file and no baseline"
            f"{did_you_mean(command.predictions, BASELINES)}; baselines are {', '.join(BASELINES)}"
        )
    _check_numbers(command)
    asked = {
        "predictions": command.predictions,
        "truth": command.truth,
        "train": command.train,
        "split": None if command.split == "all" else command.split,
        "count": command.count,
        "states": 2,
        "views": command.views,
        "pixels": command.pixels,
        "azimuth_deg": command.azimuth_deg,
        "counts": command.count_parts,
        "resolution": command.resolution,
        "samples": command.samples,
        "gated": command.gates,
        "lpips": command.lpips,
        "fit_steps": command.fit_steps,
        "train_count": command.train_count,
        "pose_noise_deg": command.pose_noise_deg,
        "pose_noise": command.pose_noise,
        "blind": command.blind,
    }
    module = import_module("model.evaluation.network_run")
    with run_folder(command.out, {**stated_run(command, protocol), "asked": plain(asked)}):
        run = module.NetworkRun(**asked, device=command.device)
        records = module.run(run, protocol, command.out / "objects")
        told = f"Held-out objects: split {command.split}, at most {command.count}."
        return written(command, protocol, records, [told])


def _check_numbers(command: Evaluate) -> None:
    """Raise UsageError for options of networks and baselines that are out of their bounds."""
    counts = (command.count, command.train_count, command.views, command.fit_steps)
    if min(counts) < 1 or min(command.resolution, command.samples) < 0:
        raise UsageError(
            f"--count, --train-count, --views and --fit-steps are {counts}, each at least 1; "
            "--resolution and --samples are at least 0"
        )
    noise = (command.pose_noise_deg, command.pose_noise)
    if not all(0.0 <= own < math.inf for own in noise):
        raise UsageError(
            f"--pose-noise-deg and --pose-noise are {noise}; expected finite numbers of at least 0"
        )
    if not 0.0 <= command.azimuth_deg <= 180.0:
        raise UsageError(f"--azimuth-deg is {command.azimuth_deg:g}; expected 0 to 180")


def written(
    command: Evaluate, protocol: Protocol, records: Sequence[Record], said: Sequence[str]
) -> Report:
    """The report, as it stands in `--out`."""
    report = Report(
        system=command.system or Path(command.predictions).name,
        truth=str(command.truth),
        protocol=protocol,
        records=records,
        summary=summary(records),
        notes=said,
        pictures=pictures(command.out / "objects", records),
    )
    write_json(command.out / "evaluation.json", report.as_json())
    write_bytes(command.out / "report.html", page(report).encode())
    return report


def checked_protocol(command: Evaluate) -> Protocol:
    """The protocol that the options state."""
    if min(command.points, command.part_points) < 100 or command.mask_pixels < 0:
        raise UsageError(
            f"--points {command.points}, --part-points {command.part_points} and --mask-pixels "
            f"{command.mask_pixels}: expected at least 100, 100 and 0"
        )
    return Protocol(
        align=command.align,
        points=command.points,
        part_points=command.part_points,
        mask_pixels=command.mask_pixels,
        handles=command.handles,
    )


def stated_run(command: Evaluate, protocol: Protocol) -> Mapping[str, object]:
    """What a folder of results belongs to."""
    return {
        "schema": SCHEMA,
        "predictions": command.predictions,
        "truth": str(command.truth),
        "protocol": plain(protocol),
    }


@contextmanager
def run_folder(folder: Path, stated: Mapping[str, object]) -> Iterator[None]:
    """The folder of results, locked; a folder of another evaluation is refused.

    Raises:
        UsageError: it is a file, in use, holds foreign files or results of something else.
    """
    if folder.exists() and not folder.is_dir():
        raise UsageError(f"{folder} is a file; --out needs a folder")
    folder.mkdir(parents=True, exist_ok=True)
    record = folder / "run.json"
    with locked(folder):
        others = sorted(path.name for path in folder.iterdir() if path.name != ".lock")
        if record.is_file():
            if _stated(record) != dict(stated):
                raise UsageError(
                    f"{folder} holds the evaluation of other predictions, truth or options; choose "
                    "another --out"
                )
        elif others:
            raise UsageError(f"{folder} holds {_some(others)} already; choose another --out")
        write_json(record, stated)
        try:
            yield
        finally:
            if {path.name for path in folder.iterdir()} <= {".lock", record.name}:
                record.unlink()  # Nothing was found, so the folder is anyone's.


def _stated(record: Path) -> object:
    """What a folder says it belongs to; None where that is damaged."""
    try:
        return json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return None


def scored_with_progress(tasks: Sequence[Task], workers: int) -> list[Record]:
    """Records in the order of the tasks."""
    records = {}
    with progress("objects", len(tasks)) as advance:
        for record in scored(tasks, workers=workers):
            records[record.name] = record
            advance(record.name)
    return [records[task.name] for task in tasks]


def notes(
    predicted: Mapping[str, Place], true: Mapping[str, Place], records: Sequence[Record]
) -> list[str]:
    """What the reader must know of what was compared."""
    found = []
    if damaged := [record.name for record in records if not record.parts]:
        found.append(
            f"{len(damaged)} true objects cannot be read and count nowhere: {_some(damaged)}."
        )
    if extra := sorted(set(predicted) - set(true)):
        found.append(f"{len(extra)} predictions have no truth and were left out: {_some(extra)}.")
    return found


def pictures(folder: Path, records: Sequence[Record]) -> dict[str, bytes]:
    """The pictures that the page shows."""
    ranked = ranking(records)
    wanted = {record.name for record in (*ranked[:SHOWN], *ranked[-SHOWN:])}
    found = {}
    for name in wanted:
        path = picture_path(folder, name)
        if path.is_file():
            found[name] = path.read_bytes()
    return found


def announce(found: Summary, out: Path) -> None:
    """The headlines, and where everything lies."""
    console = Console()
    title = f"{found.objects} objects, {len(found.failures)} without a prediction"
    table = Table(title=title)
    for heading in ("metric", "mean", "95 %", "unit"):
        table.add_column(heading, no_wrap=heading != "unit")
    for name in HEADLINES:
        own = found.overall[name]
        if own.mean is not None:
            table.add_row(name, shown(own.mean), interval(own), METRICS[name].unit)
    console.print(table)
    console.print(f"page: {out / 'report.html'}", highlight=False)
    console.print(f"data: {out / 'evaluation.json'}", highlight=False)


def _some(names: Sequence[str]) -> str:
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
