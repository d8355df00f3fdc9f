"""The metrics of PARIS (ICCV 2023), DTA (CVPR 2024) and ArtGS (ICLR 2025), in their units.

Axis angle in degrees without sign; distance of axis lines times 10 for revolute joints, in PARIS's
form (parallel lines count as equal, `systems/criterions.py`) and in DTA's; part motion between the
first and the last observed state as a geodesic angle or a distance; squared Chamfer distances of
10,000 points times 1000 of the static part, of the moving ones and of the whole at the first
observed state. Nothing is aligned: lengths are in the unit of the layouts.
"""

import math
from dataclasses import dataclass

import numpy as np

from artgen.articulation.targets import REVOLUTE
from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from model.evaluation.joints import PARALLEL, angle_deg, line_distance
from model.evaluation.layout import Layout
from model.evaluation.matching import Matching
from model.evaluation.surfaces import chamfer_squared, posed_triangles, sampled

POINTS = 10_000
WORST_DEG = 90.0


@dataclass(frozen=True, kw_only=True)
class ParisScores:
    """Means over the joints of one object; None where there is nothing to ask.

    Attributes:
        axis_deg: angle between axes without sign.
        position: distance of revolute axis lines, times 10.
        position_paris: the same with 0 for parallel lines.
        motion_deg: angle between the motions of revolute parts from first to last state.
        motion_length: distance between those of prismatic ones.
        cd_static, cd_moving, cd_whole: squared Chamfer distances, times 1000.
    """

    axis_deg: float | None
    position: float | None
    position_paris: float | None
    motion_deg: float | None
    motion_length: float | None
    cd_static: float | None
    cd_moving: float | None
    cd_whole: float | None


def paris(predicted: Layout, true: Layout, matching: Matching) -> ParisScores:
    """Scores over the joints whose type is right, as these systems are told the type or reject
    pairs of different types."""
    pairs = [
        (p, t) for p, t in matching.pairs if true.movable[t] and predicted.types[p] == true.types[t]
    ]
    turning = [(p, t) for p, t in pairs if true.types[t] == REVOLUTE]
    sliding = [pair for pair in pairs if pair not in turning]
    angles = [_unsigned(predicted.axes[p], true.axes[t]) for p, t in pairs]
    lines = [(predicted.origins[p], predicted.axes[p], true.origins[t], true.axes[t])
             for p, t in turning]  # fmt: skip
    lines = [line for line in lines if np.isfinite(line).all()]
    chamfers = _chamfers(predicted, true, matching)
    return ParisScores(
        axis_deg=_mean(angles),
        position=_mean([10.0 * line_distance(*line) for line in lines]),
        position_paris=_mean([10.0 * parallel_is_equal(*line) for line in lines]),
        motion_deg=_mean([_turn_gap(predicted, p, true, t) for p, t in turning]),
        motion_length=_mean([_slide_gap(predicted, p, true, t) for p, t in sliding]),
        cd_static=chamfers[0],
        cd_moving=chamfers[1],
        cd_whole=chamfers[2],
    )


def parallel_is_equal(
    origin: Floats, axis: Floats, other_origin: Floats, other_axis: Floats
) -> float:
    """Distance of two lines as PARIS has it: 0 where they are parallel, however far apart."""
    if np.linalg.norm(np.cross(axis, other_axis)) < PARALLEL:
        return 0.0
    return line_distance(origin, axis, other_origin, other_axis)


def _unsigned(first: Floats, second: Floats) -> float:
    angle = angle_deg(first, second)
    return WORST_DEG if angle is None else min(angle, 180.0 - angle)


def _motion(layout: Layout, part: int) -> Floats | None:
    """(4, 4) of a part's own joint from the first to the last observed state."""
    if layout.states is None or not np.isfinite(layout.states[:, part]).all():
        return None
    first, last = layout.states[0, part], layout.states[-1, part]
    return layout.joint_motion(part, float(last - first))


def _turn_gap(predicted: Layout, mine: int, true: Layout, part: int) -> float | None:
    first, second = _motion(predicted, mine), _motion(true, part)
    if first is None or second is None:
        return None
    apart = first[:3, :3] @ second[:3, :3].T
    # sin(angle / 2) from the norm of R - I: exact for small angles, where acos of a trace is not.
    half = min(float(np.linalg.norm(apart - np.eye(3))) / math.sqrt(8.0), 1.0)
    return math.degrees(2.0 * math.asin(half))


def _slide_gap(predicted: Layout, mine: int, true: Layout, part: int) -> float | None:
    first, second = _motion(predicted, mine), _motion(true, part)
    if first is None or second is None:
        return None
    return float(np.linalg.norm(first[:3, 3] - second[:3, 3]))


def _chamfers(
    predicted: Layout, true: Layout, matching: Matching
) -> tuple[float | None, float | None, float | None]:
    poses = [
        own.poses(np.zeros(len(own)) if own.states is None else np.nan_to_num(own.states[0]))
        for own in (predicted, true)
    ]
    rng = Stream(0, "evaluation", "paris", true.name).generator()

    def chamfer(mine: list[int] | None, part: list[int] | None) -> float | None:
        first = posed_triangles(predicted, poses[0], mine)
        second = posed_triangles(true, poses[1], part)
        if not len(first) or not len(second):
            return None
        clouds = [sampled(own, POINTS, rng).points for own in (first, second)]
        return 1000.0 * chamfer_squared(*clouds)

    moving = [chamfer([p], [t]) for p, t in matching.pairs if true.movable[t]]
    return chamfer([0], [0]), _mean(moving), chamfer(None, None)


def _mean(values: list[float | None] | list[float]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.mean(known)) if known else None
