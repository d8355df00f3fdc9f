"""`python -m tests.bench.hidden_colors`: colors of what no photograph shows, as a table for
docs/reconstruct.md.

Each example is reconstructed once from all of its photographs, painted without those of one view,
and drawn as that view sees it. Where nothing else is known stand the field's colors: as they are,
and shifted by what they are wrong by elsewhere. Nothing is written.
"""

import argparse
import dataclasses
from collections.abc import Sequence
from pathlib import Path
from unittest import mock

import numpy as np

from artgen.core.mesh import Floats
from model.reconstruct import photo as photo_module
from model.reconstruct.assemble import Assembled, Wishes
from model.reconstruct.cli import shipped_checkpoint
from model.reconstruct.draw import Painter
from model.reconstruct.photo import OPAQUE, Photo, PhotoColors, shifted
from model.reconstruct.run import Order, Stopwatch, made_object, photos
from model.reconstruct.skin import colored
from tests.bench.unstated_sphere import EXAMPLES, RESOLUTION


def unshifted(_: Floats, shown: Floats, seen: object) -> Floats:
    """The field's colors as they are."""
    return shown


HOW = {"as they are": unshifted, "shifted": shifted}


def agreement_db(assembled: Assembled, shown: list[Photo], hidden: Photo) -> float:
    """PSNR over the pixels that both the hidden photograph and the object fill, dB."""
    over = PhotoColors(assembled.object, shown)
    whole, images = colored(assembled.object, assembled.colors, over=over)
    painted = dataclasses.replace(assembled, object=whole, images=images)
    height, width = hidden.rgba.shape[:2]
    picture = Painter(whole, painted.color, dim=1.0).paint(
        hidden.state, hidden.intrinsics, hidden.camera_from_object, (width, height)
    )
    both = (picture[..., 3] > OPAQUE) & (hidden.rgba[..., 3] > OPAQUE)
    apart = (picture[both][:, :3].astype(float) - hidden.rgba[both][:, :3]) / 255.0
    return float(-10.0 * np.log10(np.square(apart).mean()))


def lines(folder: Path, parts: int, checkpoint: Path) -> list[str]:
    """A row of the table for every view that is left out."""
    order = Order(
        images=folder,
        cameras=folder / "cameras.json",
        checkpoint=checkpoint,
        parts=parts,
        out=folder,
        masks=None,
        segmenter="",
        resolution=RESOLUTION,
        wishes=Wishes(),
    )
    made = made_object(order, Stopwatch(lambda _: None))
    own, finding = made.assembled, made.finding
    every = photos(made.capture, finding.sphere, own.shift, own.states)
    states, views = made.capture.rgba.shape[:2]
    found = []
    for view in range(views):
        shown = [each for k, each in enumerate(every) if k % views != view]
        cells = [f"{folder.name} | {view}"]
        for way in HOW.values():
            with mock.patch.object(photo_module, "shifted", way):
                scores = [agreement_db(own, shown, every[t * views + view]) for t in range(states)]
            cells.append(f"{np.mean(scores):.1f}")
        found.append("| " + " | ".join(cells) + " |")
    return found


def main(words: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("examples", nargs="*", default=EXAMPLES, help="FOLDER:PARTS")
    parser.add_argument("--checkpoint", type=Path, default=None)
    options = parser.parse_args(words)
    table = [
        "| example | view left out | " + " | ".join(f"{way}, dB" for way in HOW) + " |",
        "|---|---|---|---|",
    ]
    for example in options.examples:
        folder, _, parts = example.rpartition(":")
        table += lines(Path(folder), int(parts), options.checkpoint or shipped_checkpoint())
    print("\n".join(table))  # noqa: T201
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
