"""`python -m tests.bench.unstated_sphere`: what reconstruction loses where the camera file does not
state the object's sphere, as a table for docs/reconstruct.md.

Each example is read with the sphere of its camera file, with the one around its visual hull, and
with that one fitted, as `artgen reconstruct` does; nothing is written.
"""

import argparse
import dataclasses
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch

from model.config import Config
from model.network.art import Art
from model.reconstruct.agreement import agreeing, agreement
from model.reconstruct.capture import read_capture
from model.reconstruct.choice import chosen_views
from model.reconstruct.cli import shipped_checkpoint
from model.reconstruct.hull import check_cameras
from model.reconstruct.record import WORDS
from model.reconstruct.refine import refined
from model.reconstruct.rig import read_rig
from model.reconstruct.search import Finding, best, found, question, searched
from model.reconstruct.sight import Sphere, sphere_of
from model.reconstruct.surfaces import field_guess
from model.training.art_file import load_art

EXAMPLES = ("examples/laptop:2", "examples/cabinet:4")
RESOLUTION = 32


@dataclass(frozen=True, kw_only=True)
class Row:
    """One example from one sphere.

    Attributes:
        size: radius as a multiple of the stated one.
        off: of the middle, in stated radii.
        raw: mean IoU of predicted boxes and silhouettes; `mended` after they were fitted.
        types: of the joints.
        seconds: CPU, of asking the network.
    """

    example: str
    sphere: str
    size: float
    off: float
    raw: float
    mended: float
    types: str
    seconds: float


def rows(folder: Path, parts: int, art: Art, config: Config) -> Iterator[Row]:
    """The three spheres of one example."""
    rig = read_rig(folder / "cameras.json", folder)
    capture = read_capture(folder, rig)
    hull = check_cameras(capture)
    stated = sphere_of(rig, hull)
    around = sphere_of(dataclasses.replace(rig, center=None, radius=None), hull)
    for name, sphere in (("stated", stated), ("hull", around), ("hull, fitted", around)):
        start = time.process_time()
        asked = question(art, config, capture, sphere, parts=parts)
        choice = chosen_views(capture, sphere, config.data)
        if name == "hull":
            sets = (choice.views, *choice.others)
            finding = best([found(asked, sphere, views) for views in sets])
        else:
            finding = searched(asked, choice)
        yield row(folder.name, name, finding, stated, time.process_time() - start)


def row(example: str, name: str, finding: Finding, stated: Sphere, seconds: float) -> Row:
    """A finding beside the sphere that is true."""
    prediction, sphere = finding.prediction, finding.sphere
    field = None if prediction.planes_BP6CHW is None else prediction.field()
    guess = field_guess(
        field, prediction.articulation, 0, resolution=RESOLUTION, radius=sphere.radius_m
    )
    if field is not None:
        guess = agreeing(guess, finding.seen)
    valid = prediction.articulation.valid_BP[0]
    kinds = prediction.articulation.type_BP[0][valid].tolist()
    return Row(
        example=example,
        sphere=name,
        size=sphere.radius / stated.radius,
        off=float(np.linalg.norm(sphere.center - stated.center)) / stated.radius,
        raw=finding.agreement,
        mended=agreement(refined(guess, finding.seen), finding.seen),
        types=" ".join(WORDS[kind] for kind in kinds[1:]),
        seconds=seconds,
    )


HEAD = "| example | sphere | radius / stated | middle off, radii | boxes | mended | joints | s |"


def table(found_rows: Sequence[Row]) -> str:
    """As the docs show it."""
    lines = [HEAD, "|---|---|---|---|---|---|---|---|"]
    lines += [
        f"| {own.example} | {own.sphere} | {own.size:.2f} | {own.off:.3f} | {own.raw:.3f} "
        f"| {own.mended:.3f} | {own.types} | {own.seconds:.1f} |"
        for own in found_rows
    ]
    return "\n".join(lines)


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("examples", nargs="*", default=EXAMPLES, help="FOLDER:PARTS")
    parser.add_argument("--checkpoint", type=Path, default=None)
    options = parser.parse_args(argv)
    torch.set_num_threads(1)
    art, config, _ = load_art(options.checkpoint or shipped_checkpoint())
    measured: list[Row] = []
    for example in options.examples:
        folder, _, parts = example.rpartition(":")
        measured += rows(Path(folder), int(parts), art, config)
    print(table(measured))  # noqa: T201
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
