"""What planning costs: CPU milliseconds an image, from a few images to thousands.

python -m tests.bench.planning out/assets/dishwasher/000000
"""

import sys
import time
from collections.abc import Sequence
from pathlib import Path

from artgen.core.jsonio import canonical_json
from artgen.core.stream import Stream
from artgen.export import Bundle, read_bundle
from renders.plan import plan_render
from renders.settings import Settings

CASES = ((4, 2), (12, 4), (144, 4), (144, 32))
"""(views, states)."""


def main(argv: Sequence[str]) -> int:
    """Print a table for one bundle."""
    bundle = read_bundle(Path(argv[1]))
    sys.stdout.write(f"{bundle.asset_id}, {len(bundle.parts)} parts\n")
    sys.stdout.write(
        "| views | states | images | CPU s | CPU ms an image |\n|---|---|---|---|---|\n"
    )
    for views, states in CASES:
        images, seconds = cost(bundle, views, states)
        row = f"| {views} | {states} | {images} | {seconds:.2f} | {1e3 * seconds / images:.3f} |\n"
        sys.stdout.write(row)
    return 0


def cost(bundle: Bundle, views: int, states: int) -> tuple[int, float]:
    """Images of a plan, and CPU seconds to draw it up and to write it down for Blender."""
    started = time.process_time()
    settings = Settings(views=views, states=states, motion="trajectory")
    plan = plan_render(bundle, Stream(0), settings=settings, folder=Path("unused"))
    canonical_json(plan.job)
    return len(plan.passes.shots), time.process_time() - started


if __name__ == "__main__":
    raise SystemExit(main(sys.argv))
