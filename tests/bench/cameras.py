"""docs/images/cameras.png: where each scheme's cameras stand, and a trajectory of a dishwasher.

python -m tests.bench.cameras
"""

import math
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from artgen.articulation.states import travel
from artgen.articulation.trajectories import frame_times, tracks
from artgen.core.camera import orbit_direction
from artgen.core.stream import Stream
from renders.camera_schemes import SCHEMES, directions
from renders.settings import CameraScheme
from tests.made import drafted

PICTURE = Path(__file__).parents[2] / "docs" / "images" / "cameras.png"
VIEWS = (4, 36)
"""The first four are drawn dark: more views fill the gaps between them."""
FRAMES = 16
INK, LIGHT = "#1f3a5f", "#8fb3d9"


def main() -> int:
    """Write the picture."""
    plt.switch_backend("Agg")
    figure, axes = plt.subplots(1, 5, figsize=(13.5, 2.6), width_ratios=(1, 1, 1, 1, 1.7))
    for ax, scheme in zip(axes, SCHEMES, strict=False):
        draw_scheme(ax, scheme)
    draw_trajectory(axes[-1])
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=100)
    return 0


def draw_scheme(ax: Axes, scheme: CameraScheme) -> None:
    """Seen from above, the front below; the distance from the middle is the angle from straight
    above, in equal areas (Lambert)."""
    places = np.array(directions(scheme, Stream(1), views=VIEWS[1], ground=False))
    eyes = np.array([orbit_direction(*place) for place in places])
    radius = np.sqrt(2.0 * (1.0 - eyes[:, 2])) / math.sqrt(2.0)
    spots = np.stack([np.sin(places[:, 0]), -np.cos(places[:, 0])]) * radius
    for level, style in ((0.0, "-"), (30.0, ":"), (60.0, ":")):
        ring = math.sqrt(1.0 - math.sin(math.radians(level)))
        ax.add_patch(plt.Circle((0, 0), ring, fill=False, color="#aaaaaa", ls=style, lw=0.8))
    ax.scatter(*spots[:, VIEWS[0] :], s=14, color=LIGHT)
    ax.scatter(*spots[:, : VIEWS[0]], s=26, color=INK)
    for number in range(VIEWS[0]):
        ax.annotate(str(number), spots[:, number], (4, 3), textcoords="offset points", fontsize=8)
    ax.text(0, -1.36, "front", ha="center", fontsize=8, color="#777777")
    ax.set(title=scheme, xlim=(-1.3, 1.3), ylim=(-1.45, 1.3), aspect="equal")
    ax.axis("off")


def draw_trajectory(ax: Axes) -> None:
    """q as a share of each joint's travel; the frames are dots."""
    draft = drafted("dishwasher", 0)
    moving = tracks(draft.joints, draft.preconditions, Stream(4))
    fine, frames = np.array(frame_times(400)), np.array(frame_times(FRAMES))
    for joint in draft.joints:
        if joint.name in moving:
            upper = travel(joint)[1]
            track = moving[joint.name]
            (line,) = ax.plot(fine, [track.at(t) / upper for t in fine], label=joint.name, lw=1.2)
            shares = [track.at(t) / upper for t in frames]
            ax.scatter(frames, shares, s=8, color=line.get_color())
    ax.set(title="trajectory of a dishwasher", xlabel="time", ylabel="share of travel")
    ax.legend(fontsize=7, frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))


if __name__ == "__main__":
    raise SystemExit(main())
