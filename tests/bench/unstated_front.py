"""`python -m tests.bench.unstated_front`: what reconstruction loses where the camera file does not
say which side of the object is its front, as a table for docs/reconstruct.md.

The world of each example is turned about z by several angles; the front is looked for as
`artgen reconstruct` does for COLMAP's files. Beside it, the first camera taken for the front.
"""

import argparse
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from model.reconstruct.capture import read_capture
from model.reconstruct.choice import chosen_views
from model.reconstruct.cli import shipped_checkpoint
from model.reconstruct.front import faced, turned
from model.reconstruct.hull import check_cameras
from model.reconstruct.rig import read_rig
from model.reconstruct.search import Question, best, found, question
from model.reconstruct.sight import sphere_of
from model.training.art_file import load_art
from tests.bench.unstated_sphere import EXAMPLES

TURNS_DEG = (20.0, 97.0, 174.0, 251.0, 328.0)


@dataclass(frozen=True, kw_only=True)
class Row:
    """One example in one turned world; agreement is the mean IoU of boxes and silhouettes.

    Attributes:
        off_deg: of the front that was found.
        agreement: from there; `stated` from the true front, `first` from the first camera's side.
    """

    example: str
    turn_deg: float
    off_deg: float
    agreement: float
    stated: float
    first: float


def rows(folder: Path, parts: int, checkpoint: Path) -> Iterator[Row]:
    """A row for each turn of one example."""
    art, config, _ = load_art(checkpoint)
    rig = read_rig(folder / "cameras.json", folder)
    capture = read_capture(folder, rig)
    true = question(art, config, capture, sphere_of(rig, check_cameras(capture)), parts=parts)
    first = np.linalg.inv(capture.camera_from_world[0, 0])[:2, 3]
    side = -math.pi / 2.0 - math.atan2(first[1], first[0])
    for degrees in TURNS_DEG:
        asked, front = faced(turned(true, math.radians(degrees)))
        off = math.remainder(front.turn + math.radians(degrees), 2.0 * math.pi)
        yield Row(
            example=folder.name,
            turn_deg=degrees,
            off_deg=abs(math.degrees(off)),
            agreement=agreement_of(asked),
            stated=agreement_of(true),
            first=agreement_of(turned(true, side)),
        )


def agreement_of(asked: Question) -> float:
    """Of the best answer about all sets of views."""
    choice = chosen_views(asked.capture, asked.about, asked.config.data)
    sets = (choice.views, *choice.others)
    return best([found(asked, asked.about, views) for views in sets]).agreement


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("examples", nargs="*", default=EXAMPLES, help="FOLDER:PARTS")
    parser.add_argument("--checkpoint", type=Path, default=None)
    options = parser.parse_args(argv)
    print("| example | turned, deg | front off, deg | boxes | from the true front | first camera |")  # noqa: T201
    print("|---|---|---|---|---|---|")  # noqa: T201
    for example in options.examples:
        folder, _, parts = example.rpartition(":")
        for own in rows(Path(folder), int(parts), options.checkpoint or shipped_checkpoint()):
            numbers = (own.agreement, own.stated, own.first)
            line = " | ".join(f"{value:.3f}" for value in numbers)
            print(f"| {own.example} | {own.turn_deg:.0f} | {own.off_deg:.1f} | {line} |")  # noqa: T201
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
