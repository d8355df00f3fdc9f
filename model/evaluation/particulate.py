"""Particulate's metrics (Li et al., 2512.11798; `particulate/evaluation_utils.py`): parts that
stand for none are punished.

The true object is centered and scaled to the cube [-0.5, 0.5]; the predicted one is placed with it.
Parts are paired one to one by the middles of their points, in both directions, which are averaged.
A part without a counterpart counts generalized IoU -1, IoU 0, and as Chamfer distance half the
diagonal of the predicted object's box: a length among squared lengths, as in the original. The
intersection of moved boxes is exact here, where the original counts 2048 points; the enclosing box
is that of rest, as there.
"""

from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from artgen.core.stream import Stream
from artgen.core.transform import apply, inverted
from model.evaluation.boxes import (
    enclosing,
    generalized,
    giou_upright,
    iou,
    moved_bounds,
    shared_moved,
    shared_upright,
    volume,
)
from model.evaluation.layout import Layout
from model.evaluation.matching import by_nearness
from model.evaluation.reshape import placed
from model.evaluation.surfaces import chamfer_squared, posed_triangles, sampled

STATES = 5
NO_GIOU, NO_IOU = -1.0, 0.0


@dataclass(frozen=True, kw_only=True)
class Punished:
    """A score with loose parts punished, and over pairs alone."""

    punished: float
    pairs: float | None


@dataclass(frozen=True, kw_only=True)
class ParticulateScores:
    """At rest and with every joint at the far end of its own range.

    Attributes:
        giou: mean generalized IoU of parts' boxes; `states_giou` its mean over five states.
        miou: mean IoU of the upright boxes around moved parts.
        pc: mean squared Chamfer distance of parts; None without surfaces.
        oc: squared Chamfer distance of the whole object; None without surfaces.
    """

    rest_giou: Punished
    full_giou: Punished
    states_giou: Punished
    rest_miou: Punished
    full_miou: Punished
    rest_pc: Punished | None
    full_pc: Punished | None
    rest_oc: float | None
    full_oc: float | None


def particulate(predicted: Layout, true: Layout, *, points: int) -> ParticulateScores:
    """All of Particulate's scores of one object; `points` are spread over each whole object."""
    predicted, true = in_cube(predicted, true)
    stream = Stream(0, "evaluation", "particulate", true.name)
    clouds = (
        part_points(predicted, points, stream.child("predicted").generator()),
        part_points(true, points, stream.child("true").generator()),
    )
    mine, theirs = (
        own.centers if cloud is None else np.stack([p.mean(axis=0) for p in cloud])
        for own, cloud in zip((predicted, true), clouds, strict=True)
    )
    pairing = by_nearness(mine, theirs, base=False).pairs
    scene = _Scene(predicted, true, pairing, *clouds)
    gious = [scene.giou(share) for share in np.linspace(0.0, 1.0, STATES).tolist()]
    return ParticulateScores(
        rest_giou=gious[0],
        full_giou=gious[-1],
        states_giou=_mean(gious),
        rest_miou=scene.miou(0.0),
        full_miou=scene.miou(1.0),
        rest_pc=scene.part_chamfer(0.0),
        full_pc=scene.part_chamfer(1.0),
        rest_oc=scene.object_chamfer(0.0),
        full_oc=scene.object_chamfer(1.0),
    )


def in_cube(predicted: Layout, true: Layout) -> tuple[Layout, Layout]:
    """Both layouts in the frame where the true one fills [-0.5, 0.5] along its longest side."""
    bounds = true.bounds
    scale = 1.0 / max(float((bounds[1] - bounds[0]).max()), 1e-12)
    shift = -scale * bounds.mean(axis=0)
    return placed(predicted, scale=scale, shift=shift), placed(true, scale=scale, shift=shift)


def part_points(layout: Layout, count: int, rng: np.random.Generator) -> list[Floats] | None:
    """Points of each part at rest, `count` in all and at least one each; None without surfaces."""
    if not layout.meshes or any(mesh is None for mesh in layout.meshes):
        return None
    own = [posed_triangles(layout, np.tile(np.eye(4), (len(layout), 1, 1)), [k])
           for k in range(len(layout))]  # fmt: skip
    areas = np.array([_area(triangles) for triangles in own])
    if not areas.any():  # Lines and points, as a failed reconstruction may leave: evenly.
        areas = np.ones(len(own))
    shares = np.maximum(np.round(count * areas / areas.sum()), 1).astype(int)
    return [sampled(t, int(n), rng).points for t, n in zip(own, shares, strict=True)]


def _area(triangles: Floats) -> float:
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return float(np.linalg.norm(cross, axis=1).sum() / 2.0)


@dataclass(frozen=True, eq=False)
class _Scene:
    """A pair of layouts in the cube, their pairing and their points at rest."""

    predicted: Layout
    true: Layout
    pairs: tuple[tuple[int, int], ...]
    predicted_points: list[Floats] | None
    true_points: list[Floats] | None

    def _poses(self, share: float) -> tuple[Floats, Floats]:
        mine, theirs = (own.poses(own.opened(share)) for own in (self.predicted, self.true))
        return mine, theirs

    def _punished(self, values: list[float], loose: float) -> Punished:
        """Mean over the parts of either object, averaged over both."""
        ways = [
            (sum(values) + loose * (len(own) - len(values))) / len(own)
            for own in (self.predicted, self.true)
        ]
        return Punished(
            punished=float(np.mean(ways)), pairs=float(np.mean(values)) if values else None
        )

    def giou(self, share: float) -> Punished:
        """Generalized IoU of boxes that moved with their parts."""
        mine, theirs = self._poses(share)
        values = []
        for p, t in self.pairs:
            first, second = self.predicted.boxes[p], self.true.boxes[t]
            if share == 0.0:
                values.append(giou_upright(first, second))
                continue
            shared = shared_moved(first, second, inverted(mine[p]) @ theirs[t])
            around = volume(enclosing(first, second))
            values.append(generalized(volume(first), volume(second), shared, around))
        return self._punished(values, NO_GIOU)

    def miou(self, share: float) -> Punished:
        """IoU of the upright boxes around moved parts."""
        mine, theirs = self._poses(share)
        values = []
        for p, t in self.pairs:
            first = self._around(self.predicted, self.predicted_points, p, mine[p])
            second = self._around(self.true, self.true_points, t, theirs[t])
            values.append(iou(volume(first), volume(second), shared_upright(first, second)))
        return self._punished(values, NO_IOU)

    def _around(
        self, layout: Layout, points: list[Floats] | None, part: int, pose: Floats
    ) -> Floats:
        """Around a part's points; around its box where either object has no points."""
        if points is None or self.predicted_points is None or self.true_points is None:
            return moved_bounds(layout.boxes[part], pose)
        moved = apply(pose, points[part])
        return np.stack([moved.min(axis=0), moved.max(axis=0)])

    def part_chamfer(self, share: float) -> Punished | None:
        """Squared Chamfer distance of paired parts."""
        if self.predicted_points is None or self.true_points is None:
            return None
        mine, theirs = self._poses(share)
        values = [
            chamfer_squared(
                apply(mine[p], self.predicted_points[p]), apply(theirs[t], self.true_points[t])
            )
            for p, t in self.pairs
        ]
        return self._punished(values, self.predicted.radius)

    def object_chamfer(self, share: float) -> float | None:
        """Squared Chamfer distance of everything."""
        if self.predicted_points is None or self.true_points is None:
            return None
        mine, theirs = self._poses(share)
        return chamfer_squared(
            np.concatenate([apply(m, p) for m, p in zip(mine, self.predicted_points, strict=True)]),
            np.concatenate([apply(m, p) for m, p in zip(theirs, self.true_points, strict=True)]),
        )


def _mean(scores: list[Punished]) -> Punished:
    pairs = [score.pairs for score in scores if score.pairs is not None]
    return Punished(
        punished=float(np.mean([score.punished for score in scores])),
        pairs=float(np.mean(pairs)) if pairs else None,
    )
