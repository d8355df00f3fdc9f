"""`python -m tests.bench.fitted_states LIBRARY`: what fitting states to silhouettes is worth, as a
table for docs/reconstruct.md.

Held-out objects are seen by four cameras in two states; the network is shown two of the views, and
states are fitted to the silhouettes of all four, as `artgen reconstruct` does; nothing is written.
"""

import argparse
import dataclasses
import math
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import torch
from torch import Tensor
from torch.nn.functional import avg_pool2d

from artgen.core.stream import Stream
from model.batch import PRISMATIC, Articulation, Images
from model.config import Config
from model.evaluation.held_out import CPU, first_images, held_out_config, spread
from model.evaluation.network_run import opened
from model.infer import predict
from model.network.art import Art
from model.reconstruct.agreement import agreeing
from model.reconstruct.cli import shipped_checkpoint
from model.reconstruct.guess import JointGuess, ObjectGuess
from model.reconstruct.outlines import silhouettes
from model.reconstruct.refine import refined
from model.reconstruct.search import JUDGED_PX
from model.reconstruct.surfaces import field_guess
from model.training.art_file import load_art

VIEWS = 4
FINE_PX = 192
RESOLUTION = 32


def shrunk(images: Images, px: int) -> Images:
    """The images at `px` px, by means over blocks of pixels."""
    factor = images.rgb_BTV3HW.shape[-1] // px

    def smaller(pixels: Tensor) -> Tensor:
        flat = pixels.reshape(-1, 1, *pixels.shape[-2:])
        return avg_pool2d(flat, factor).reshape(*pixels.shape[:-2], px, px)

    matrices = images.intrinsics_BTV33.clone()
    matrices[..., :2, :] /= factor
    return dataclasses.replace(
        images,
        rgb_BTV3HW=smaller(images.rgb_BTV3HW),
        alpha_BTVHW=smaller(images.alpha_BTVHW),
        intrinsics_BTV33=matrices,
    )


def state_errors(guess: ObjectGuess, truth: Articulation) -> list[float]:
    """Of joints of the right type: radii, angles times half the diagonal of the true box."""
    found = []
    for joint in guess.joints:
        slides = int(truth.type_BP[0, joint.slot]) == PRISMATIC
        if slides == (joint.type == "prismatic"):
            found.append(_state_error(joint, truth, slides=slides))
    return found


def _state_error(joint: JointGuess, truth: Articulation, *, slides: bool) -> float:
    unit = 2.0 if slides else 2.0 * math.pi
    arm = 1.0 if slides else float(truth.size_BP3[0, joint.slot].norm()) / 2.0
    true = unit * truth.motion_BTP[0, :, joint.slot].double().numpy()
    return arm * float(np.abs(joint.observed - true).mean())


def rows(
    library: Path, art: Art, config: Config, count: int
) -> Iterator[tuple[float, float, float]]:
    """Mean state error of an object as predicted and as fitted, and the CPU seconds of fitting."""
    source = opened(library, "test", config.data.slots)
    fine = dataclasses.replace(
        held_out_config(config.data, extra=False),
        views=VIEWS,
        input_px=FINE_PX,
        render_px=FINE_PX + FINE_PX // 4,
        target_px=FINE_PX,
    )
    for position in spread(count, len(source)):
        stream = Stream(0, "evaluation", "held_out", position)
        batch = source.batch([source.plan(position, fine, stream)], fine, CPU)
        shown = first_images(
            shrunk(batch.images, config.data.input_px),
            states=config.data.states,
            views=config.data.views,
        )
        parts = int(batch.truth.valid_BP.sum())
        prediction = predict(art, config, shown, parts=parts)
        guess = field_guess(
            prediction.field(), prediction.articulation, 0, resolution=RESOLUTION, radius=1.0
        )
        seen = silhouettes(shrunk(batch.images, JUDGED_PX), 1.0)
        guess = agreeing(guess, seen)
        start = time.process_time()
        fitted = refined(guess, seen)
        seconds = time.process_time() - start
        before, after = (state_errors(own, batch.truth) for own in (guess, fitted))
        if before:
            yield float(np.mean(before)), float(np.mean(after)), seconds


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("library", type=Path, help="of `artgen train-data`; its split test")
    parser.add_argument("--count", type=int, default=36, help="objects, spread over the library")
    parser.add_argument("--checkpoint", type=Path, default=None)
    options = parser.parse_args(argv)
    torch.set_num_threads(1)
    art, config, _ = load_art(options.checkpoint or shipped_checkpoint())
    found = np.array(list(rows(options.library, art, config, options.count)))
    better = int((found[:, 1] < found[:, 0]).sum())
    before, after, seconds = found.mean(axis=0)
    print("| objects | state as predicted, radii | fitted | better in | CPU s |")  # noqa: T201
    print("|---|---|---|---|---|")  # noqa: T201
    print(f"| {len(found)} | {before:.3f} | {after:.3f} | {better} | {seconds:.2f} |")  # noqa: T201
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
