"""Errors of joints: type, axis, line, lever arm, state, limits; one row for every true joint."""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.targets import FIXED, REVOLUTE
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from model.evaluation.layout import Layout
from model.evaluation.matching import Matching

PARALLEL = 1e-6
"""Sine of the angle between two lines below which they count as parallel."""


@dataclass(frozen=True, kw_only=True)
class JointErrors:
    """What is wrong with the prediction of one true joint; None where it cannot be asked.

    Attributes:
        part: label of the true part.
        found: whether a predicted part stands for it.
        type_right: whether that part's joint has the true type; false where nothing was found.
        axis_deg: angle between the directions, which both open, in [0, 180].
        axis_unsigned_deg: angle between the lines' directions, in [0, 90].
        flipped: whether the angle is beyond 90 degrees: the joint would open the wrong way.
        line: distance of the two infinite axis lines, radii; revolute alone.
        pivot: distance from the predicted line to the point of the true axis nearest to the part,
            radii; revolute alone. Lines that nearly meet far away do not pass for near ones here.
        lever: how far apart both joints take the middle of the true part, each half way to its own
            far end, radii.
        state_deg: mean error of observed angles after flips are undone.
        state_radii: the same of slides.
        state_share: mean error of observed states over the true range.
        limit_iou: shared part of the two ranges after flips are undone.
        parent_right: whether the true parent's counterpart is the predicted parent.
    """

    part: str
    found: bool
    type_right: bool
    axis_deg: float | None = None
    axis_unsigned_deg: float | None = None
    flipped: bool | None = None
    line: float | None = None
    pivot: float | None = None
    lever: float | None = None
    state_deg: float | None = None
    state_radii: float | None = None
    state_share: float | None = None
    limit_iou: float | None = None
    parent_right: bool | None = None


def joint_errors(predicted: Layout, true: Layout, matching: Matching) -> tuple[JointErrors, ...]:
    """A row for every movable part of the truth, in its order."""
    of_true = matching.of_true
    rows = []
    for part in np.flatnonzero(true.movable).tolist():
        mine = of_true.get(part)
        if mine is None:
            rows.append(JointErrors(part=true.labels[part], found=False, type_right=False))
        else:
            rows.append(_row(predicted, mine, true, part, of_true))
    return tuple(rows)


def _row(
    predicted: Layout, mine: int, true: Layout, part: int, of_true: dict[int, int]
) -> JointErrors:
    same = bool(predicted.types[mine] == true.types[part])
    moves = predicted.types[mine] != FIXED
    angle = angle_deg(predicted.axes[mine], true.axes[part]) if moves else None
    flipped = None if angle is None else angle > 90.0
    sign = -1.0 if flipped else 1.0
    turning = same and true.types[part] == REVOLUTE
    lines = (predicted.origins[mine], predicted.axes[mine], true.origins[part], true.axes[part])
    known = turning and angle is not None
    state = _state_error(predicted, mine, true, part, sign) if same else None
    reach = _reach(true, part)
    above = of_true.get(int(true.parents[part]))
    return JointErrors(
        part=true.labels[part],
        found=True,
        type_right=same,
        axis_deg=angle,
        axis_unsigned_deg=None if angle is None else min(angle, 180.0 - angle),
        flipped=flipped,
        line=_finite(line_distance(*lines) / true.radius) if known else None,
        pivot=_finite(_pivot(*lines, true.centers[part]) / true.radius) if known else None,
        lever=lever_error(predicted, mine, true, part) / true.radius,
        state_deg=math.degrees(state) if state is not None and turning else None,
        state_radii=state / true.radius if state is not None and not turning else None,
        state_share=None if state is None or reach is None else state / reach,
        limit_iou=_limit_iou(predicted, mine, true, part, sign) if same else None,
        parent_right=None if above is None else bool(predicted.parents[mine] == above),
    )


def _finite(value: float) -> float | None:
    """None where an origin was not given."""
    return value if math.isfinite(value) else None


def _reach(true: Layout, part: int) -> float | None:
    """Width of a true range; a full turn if endless, None where it is unknown or a point."""
    if true.endless[part]:
        return 2.0 * math.pi
    width = float(np.ptp(true.limits[part]))
    return width if width > 0.0 else None


def angle_deg(first: Floats, second: Floats) -> float | None:
    """Between two directions, by the half angle's tangent: exact near 0 and 180; None if unknown.

    Kahan's form 2 atan2(|a - b|, |a + b|) keeps all digits where acos of a product loses half.
    """
    lengths = np.linalg.norm([first, second], axis=1)
    if not np.isfinite(lengths).all() or lengths.min() <= 0.0:
        return None
    a, b = first / lengths[0], second / lengths[1]
    return math.degrees(
        2.0 * math.atan2(float(np.linalg.norm(a - b)), float(np.linalg.norm(a + b)))
    )


def line_distance(origin: Floats, axis: Floats, other_origin: Floats, other_axis: Floats) -> float:
    """Of two infinite lines with unit directions; of parallel ones their offset."""
    gap, normal = other_origin - origin, np.cross(axis, other_axis)
    length = float(np.linalg.norm(normal))
    if length < PARALLEL:
        return float(np.linalg.norm(np.cross(gap, axis)))
    return abs(float(gap @ normal)) / length


def _pivot(
    origin: Floats, axis: Floats, true_origin: Floats, true_axis: Floats, center: Floats
) -> float:
    foot = true_origin + ((center - true_origin) @ true_axis) * true_axis
    return float(np.linalg.norm(np.cross(foot - origin, axis)))


def lever_error(predicted: Layout, mine: int, true: Layout, part: int) -> float:
    """Distance between where both joints take the middle of the true part, in lengths."""
    center = true.centers[part]
    ends = [
        apply(layout.joint_motion(k, layout.opened(0.5)[k]), center)
        for layout, k in ((predicted, mine), (true, part))
    ]
    return float(np.linalg.norm(ends[0] - ends[1]))


def _state_error(
    predicted: Layout, mine: int, true: Layout, part: int, sign: float
) -> float | None:
    """Mean over the observed states, rad or lengths; None where either is not known."""
    if predicted.states is None or true.states is None:
        return None
    if len(predicted.states) != len(true.states):
        return None
    gaps = np.abs(sign * predicted.states[:, mine] - true.states[:, part])
    if true.types[part] == REVOLUTE and true.endless[part]:
        gaps = np.abs(np.remainder(gaps + math.pi, 2.0 * math.pi) - math.pi)
    return float(gaps.mean()) if np.isfinite(gaps).all() else None


def _limit_iou(predicted: Layout, mine: int, true: Layout, part: int, sign: float) -> float | None:
    """Length that both ranges share over the length of both together."""
    if predicted.endless[mine] or true.endless[part]:
        return float(predicted.endless[mine] == true.endless[part])
    lower, upper = sorted((sign * predicted.limits[mine]).tolist())
    low, high = true.limits[part].tolist()
    if not np.isfinite([lower, upper, low, high]).all():
        return None
    if (lower, upper) == (low, high):
        return 1.0
    shared = max(min(upper, high) - max(lower, low), 0.0)
    union = (upper - lower) + (high - low) - shared
    return shared / union if union > 0.0 else 0.0
