"""SINGAPO's box metrics (Liu et al., 2410.16499): as published, and in an honest variant.

Published (metrics/iou_cdist.py, giou.py, aor.py of 3dlg-hcvc/singapo): both objects are centered,
the predicted one is stretched along each axis to the true one's size, every revolute joint turns by
90 degrees, at q > 0 the shared volume is counted with 10,000 points, and the enclosing box is that
of the boxes at rest. A joint moves its part and that part's direct children. Both directions of a
many-to-one mapping are averaged.

Honest: no stretch, every joint goes to the end of its own range, shared volumes are exact, the
enclosing box is that of the moved boxes, all descendants move, the mapping is one to one, and a
part without a counterpart counts as the worst: generalized IoU -1, distance one radius.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from artgen.articulation.targets import PRISMATIC
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.transform import apply, inverted
from model.evaluation.boxes import (
    THIN,
    enclosing,
    generalized,
    giou_moved,
    giou_upright,
    iou,
    shared_moved,
    shared_sampled,
    volume,
)
from model.evaluation.layout import HANDLE, Layout
from model.evaluation.matching import Matching, singapo_mapping
from model.evaluation.metrics import LOOSE_DISTANCE
from model.evaluation.reshape import placed, stretched, without

STATES = 5
AOR_STATES = 10
SAMPLES = 10_000


@dataclass(frozen=True, kw_only=True)
class BoxScores:
    """Scores of one object.

    Attributes:
        rs_dgiou: 1 - mean generalized IoU at rest, in [0, 2].
        as_dgiou: the same, mean over states.
        rs_dcdist: mean distance of matched box centers at rest, in the unit of the layouts.
        as_dcdist: the same, mean over states.
    """

    rs_dgiou: float
    as_dgiou: float
    rs_dcdist: float
    as_dcdist: float


def compared_as_published(
    predicted: Layout, true: Layout, *, handles: bool = True
) -> tuple[Layout, Layout]:
    """Both layouts centered, the predicted one stretched to the true one's size."""
    if not handles:
        predicted, true = without_handles(predicted), without_handles(true)
    predicted, true = (placed(own, shift=-own.bounds.mean(axis=0)) for own in (predicted, true))
    mine, wanted = (own.bounds[1] - own.bounds[0] for own in (predicted, true))
    thick = mine > THIN * mine.max()  # What has no thickness cannot be stretched to one.
    return stretched(predicted, np.where(thick, wanted, 1.0) / np.where(thick, mine, 1.0)), true


def without_handles(layout: Layout) -> Layout:
    """The layout without parts labelled `handle`."""
    return without(layout, lambda label: label == HANDLE)


def published(predicted: Layout, true: Layout, *, handles: bool = True) -> BoxScores:
    """The four box metrics as SINGAPO's code computes them."""
    predicted, true = compared_as_published(predicted, true, handles=handles)
    stream = Stream(0, "evaluation", "singapo", true.name)
    one = _direction(predicted, true, stream.child("forward").generator())
    other = _direction(true, predicted, stream.child("backward").generator())
    return _scores(*((a + b) / 2.0 for a, b in zip(one, other, strict=True)))


def _direction(source: Layout, target: Layout, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """(STATES,) mean generalized IoU and mean center distance over the parts of `source`."""
    mapping = singapo_mapping(source.centers, target.centers)
    overlaps, distances = np.zeros((2, STATES, len(source)))
    for row, share in enumerate(np.linspace(0.0, 1.0, STATES).tolist()):
        source_poses, target_poses = published_poses(source, share), published_poses(target, share)
        for part, other in enumerate(mapping):
            boxes = source.boxes[part], target.boxes[other]
            poses = source_poses[part], target_poses[other]
            overlaps[row, part] = _published_giou(*boxes, *poses, rng)
            distances[row, part] = _center_distance(*boxes, *poses)
    return overlaps.mean(axis=1), distances.mean(axis=1)


def published_poses(layout: Layout, share: float) -> Floats:
    """(P, 4, 4) poses at a share of the way: 90 degrees for hinges, direct children alone follow.

    A part takes its own motion first and then its parent's, both stated at rest.
    """
    far = layout.far_ends
    fixed_range = np.where(layout.endless, far, np.sign(far) * np.pi / 2.0)
    full = np.where(layout.types == PRISMATIC, far, fixed_range)
    own = [layout.joint_motion(part, float(share * q)) for part, q in enumerate(full)]
    parents = layout.parents.tolist()
    return np.stack([own[p] @ own[k] if p > 0 else own[k] for k, p in enumerate(parents)])


def _published_giou(
    first: Floats,
    second: Floats,
    first_pose: Floats,
    second_pose: Floats,
    rng: np.random.Generator,
) -> float:
    if np.array_equal(first_pose, np.eye(4)) and np.array_equal(second_pose, np.eye(4)):
        return giou_upright(first, second)
    relative = inverted(first_pose) @ second_pose
    shared = shared_sampled(first, second, relative, rng, count=SAMPLES)
    around = volume(enclosing(first, second))
    return generalized(volume(first), volume(second), shared, around)


def _center_distance(
    first: Floats, second: Floats, first_pose: Floats, second_pose: Floats
) -> float:
    gap = apply(first_pose, first.mean(axis=0)) - apply(second_pose, second.mean(axis=0))
    return float(np.linalg.norm(gap))


def honest(predicted: Layout, true: Layout, matching: Matching) -> BoxScores:
    """The four box metrics without stretch, with true ranges, exact, loose parts punished."""
    loose = len(matching.loose_predicted) + len(matching.loose_true)
    count = len(matching.pairs) + loose
    overlaps, distances = np.zeros((2, STATES))
    for row, share in enumerate(np.linspace(0.0, 1.0, STATES).tolist()):
        mine, theirs = (own.poses(own.opened(share)) for own in (predicted, true))
        pairs = [(predicted.boxes[p], true.boxes[t], mine[p], theirs[t]) for p, t in matching.pairs]
        overlaps[row] = (sum(giou_moved(*pair) for pair in pairs) - loose) / count
        far = loose * LOOSE_DISTANCE * true.radius
        distances[row] = (sum(_center_distance(*pair) for pair in pairs) + far) / count
    return _scores(overlaps, distances)


def _scores(overlaps: Floats, distances: Floats) -> BoxScores:
    return BoxScores(
        rs_dgiou=float(1.0 - overlaps[0]),
        as_dgiou=float(1.0 - overlaps.mean()),
        rs_dcdist=float(distances[0]),
        as_dcdist=float(distances.mean()),
    )


def overlap_ratio_published(layout: Layout, *, handles: bool = True) -> float | None:
    """AOR: IoU of siblings' boxes by 10,000 points, mean over pairs and 10 states; less is better.

    None where no two parts are siblings: the original gives -1 there and leaves it out of means.
    """
    if not handles:
        layout = without_handles(layout)
    rng = Stream(0, "evaluation", "aor", layout.name).generator()
    pairs = sibling_pairs(layout)
    found = []
    for share in np.linspace(0.0, 1.0, AOR_STATES).tolist():
        poses = published_poses(layout, share)
        for a, b in pairs:
            first, second = layout.boxes[a], layout.boxes[b]
            relative = inverted(poses[a]) @ poses[b]
            shared = shared_sampled(first, second, relative, rng, count=SAMPLES)
            found.append(iou(volume(first), volume(second), shared))
    return float(np.mean(found)) if found else None


def overlap_ratio(layout: Layout) -> float | None:
    """AOR with true ranges and exact volumes; None where no two parts are siblings."""
    pairs = sibling_pairs(layout)
    found = []
    for share in np.linspace(0.0, 1.0, AOR_STATES).tolist():
        poses = layout.poses(layout.opened(share))
        for a, b in pairs:
            first, second = layout.boxes[a], layout.boxes[b]
            shared = shared_moved(first, second, inverted(poses[a]) @ poses[b])
            found.append(iou(volume(first), volume(second), shared))
    return float(np.mean(found)) if found else None


def sibling_pairs(layout: Layout) -> Sequence[tuple[int, int]]:
    """Pairs of parts with the same parent."""
    return [pair for own in layout.children for pair in combinations(own, 2)]
