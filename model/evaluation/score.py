"""One object scored by every protocol: a record of plain numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Literal

import numpy as np

from artgen.core.stream import Stream
from model.evaluation.gates import Gates, held_against
from model.evaluation.images import ImageScores
from model.evaluation.joints import JointErrors, joint_errors
from model.evaluation.layout import Layout
from model.evaluation.matching import Matching, by_nearness, by_order
from model.evaluation.metrics import METRICS
from model.evaluation.observed import state_centers
from model.evaluation.paris import paris
from model.evaluation.particulate import ParticulateScores, Punished, in_cube, particulate
from model.evaluation.reshape import placed
from model.evaluation.silhouettes import mask_scores
from model.evaluation.singapo import (
    honest,
    overlap_ratio,
    overlap_ratio_published,
    published,
)
from model.evaluation.singapo_surfaces import published_chamfers
from model.evaluation.surfaces import (
    THRESHOLDS,
    SurfaceScores,
    compared,
    has_surface,
    posed_triangles,
    sampled,
)

Align = Literal["none", "center", "uniform"]
Values = dict[str, list[float]]


@dataclass(frozen=True, kw_only=True)
class Protocol:
    """What scores depend on beside the layouts; every report states it.

    Attributes:
        align: how predictions are placed before all but `singapo.published` and `paris`: as they
            are, with the true box's middle, or also with its half diagonal.
        points: spread over a whole surface for `surfaces`.
        part_points: spread over a whole object for `particulate`; its paper takes 100,000.
        mask_pixels: side of the images for `masks`; 0 leaves them out.
        handles: whether parts labelled `handle` count in `singapo.published`.
        seed: of the points; each object has its own address.
    """

    align: Align = "none"
    points: int = 10_000
    part_points: int = 20_000
    mask_pixels: int = 96
    handles: bool = True
    seed: int = 0


@dataclass(frozen=True, kw_only=True)
class Record:
    """The scores of one object.

    Attributes:
        parts: of the true object, base included; 0 where that cannot be read.
        failure: why there is no prediction; None where there is one.
        metrics: name of `METRICS` to its values: one, or one a joint or image.
        joints: rows of the true joints by the nearest matching.
        reasons: gate, or image, to what speaks against it.
    """

    name: str
    category: str
    parts: int
    predicted_parts: int | None = None
    failure: str | None = None
    metrics: Mapping[str, Sequence[float]] = field(default_factory=dict)
    joints: tuple[JointErrors, ...] = ()
    reasons: Mapping[str, str] = field(default_factory=dict)


def failed(true: Layout, why: str, *, idle: Sequence[str] = ()) -> Record:
    """The record of an object without a prediction: the worst of every bounded metric.

    Args:
        idle: beginnings of the metrics that are asked of no object, such as `gates.`.
    """
    count = int(true.movable.sum())
    worst: Values = {}
    for name, metric in METRICS.items():
        if metric.worst is not None and not name.startswith(tuple(idle)):
            rows = count if name.startswith("joints.") else 1
            worst[name] = [metric.worst] * rows
    return Record(
        name=true.name, category=true.category, parts=len(true), failure=why, metrics=worst
    )


def unread(name: str, why: str) -> Record:
    """The record of an object whose truth cannot be read: it counts nowhere."""
    return Record(name=name, category="", parts=0, failure=f"the true object is damaged: {why}")


def score(
    predicted: Layout,
    true: Layout,
    protocol: Protocol,
    *,
    gates: Gates | None = None,
    images: Mapping[str, Sequence[ImageScores]] | None = None,
) -> Record:
    """Every metric of one object that can be asked.

    Args:
        images: `images` or `images.new_state` to the scores of such images.
    """
    found: Values = {
        "parts.count_right": [float(len(predicted) == len(true))],
        "parts.count_error": [float(abs(len(predicted) - len(true)))],
    }
    put(found, "paris", asdict(paris(predicted, true, nearest(predicted, true))))
    put(found, "singapo.published", _published(*in_radii(predicted, true), protocol))
    predicted, true = in_radii(aligned(predicted, true, protocol.align), true)
    matchings = {"order": by_order(len(predicted), len(true)), "nearest": nearest(predicted, true)}
    found |= matched_values(predicted, true, matchings, mask_pixels=protocol.mask_pixels)
    overlaps = {"aor": overlap_ratio(predicted), "aor_true": overlap_ratio(true)}
    put(found, "singapo.honest", overlaps)
    _put_particulate(found, particulate(predicted, true, points=protocol.part_points))
    _put_surfaces(found, predicted, true, protocol)
    for prefix, own in (images or {}).items():
        for image in own:
            put(found, prefix, asdict(image))
    if gates is not None:
        moving = int(true.movable.sum())
        gates = held_against(gates, moving)
        held = {key: own for key, own in asdict(gates).items() if key not in ("reasons", "joints")}
        kept = min((gates.joints or 0) / moving, 1.0) if moving else None
        put(found, "gates", {**held, "passed": gates.passed, "kept": kept})
    return Record(
        name=true.name,
        category=true.category,
        parts=len(true),
        predicted_parts=len(predicted),
        metrics=found,
        joints=joint_errors(predicted, true, matchings["nearest"]),
        reasons={} if gates is None else gates.reasons,
    )


def matched_values(
    predicted: Layout, true: Layout, matchings: Mapping[str, Matching], *, mask_pixels: int
) -> Values:
    """Boxes, joints, observed states and, where their images have pixels, masks of parts, under
    each of some matchings; both layouts in radii."""
    found: Values = {}
    for name, matching in matchings.items():
        put(found, f"singapo.honest.{name}", asdict(honest(predicted, true, matching)))
        _put_joints(found, f"joints.{name}", joint_errors(predicted, true, matching))
        put(found, f"states.{name}", {"center": state_centers(predicted, true, matching)})
    if mask_pixels:
        seen = mask_scores(predicted, true, matchings, pixels=mask_pixels)
        for name, masks in seen.items():
            put(found, f"masks.{name}", asdict(masks))
    return found


def aligned(predicted: Layout, true: Layout, align: Align) -> Layout:
    """The prediction placed as the protocol says."""
    if align == "none":
        return predicted
    scale = true.radius / predicted.radius if align == "uniform" and predicted.radius > 0.0 else 1.0
    shift = true.bounds.mean(axis=0) - scale * predicted.bounds.mean(axis=0)
    return placed(predicted, scale=scale, shift=shift)


def in_radii(predicted: Layout, true: Layout) -> tuple[Layout, Layout]:
    """Both in units of half the diagonal of the true box, its middle at zero."""
    scale = 1.0 / true.radius if true.radius > 0.0 else 1.0
    shift = -scale * true.bounds.mean(axis=0)
    return placed(predicted, scale=scale, shift=shift), placed(true, scale=scale, shift=shift)


def nearest(predicted: Layout, true: Layout) -> Matching:
    """Pairs of parts by the middles of their boxes, the bases paired beforehand."""
    return by_nearness(predicted.centers, true.centers)


def _published(predicted: Layout, true: Layout, protocol: Protocol) -> dict[str, float | None]:
    handles = protocol.handles
    rest, states = published_chamfers(predicted, true, handles=handles)
    return {
        **asdict(published(predicted, true, handles=handles)),
        "rs_dcd": rest,
        "as_dcd": states,
        "aor": overlap_ratio_published(predicted, handles=handles),
        "aor_true": overlap_ratio_published(true, handles=handles),
    }


def put(found: Values, prefix: str, scores: Mapping[str, float | bool | None]) -> None:
    """Append what is known."""
    for name, value in scores.items():
        if value is not None and np.isfinite(value):
            found.setdefault(f"{prefix}.{name}", []).append(float(value))


def _put_joints(found: Values, prefix: str, rows: Sequence[JointErrors]) -> None:
    names = [own.name for own in fields(JointErrors) if own.name != "part"]
    for row in rows:
        put(found, prefix, {name: getattr(row, name) for name in names})


def _put_particulate(found: Values, scores: ParticulateScores) -> None:
    for own in fields(ParticulateScores):
        value = getattr(scores, own.name)
        if isinstance(value, Punished):
            put(found, "particulate", {own.name: value.punished})
            put(found, "particulate.pairs", {own.name: value.pairs})
        else:
            put(found, "particulate", {own.name: value})


def _put_surfaces(found: Values, predicted: Layout, true: Layout, protocol: Protocol) -> None:
    if not has_surface(predicted) or not has_surface(true):
        return
    predicted, true = in_cube(predicted, true)
    stream = Stream(protocol.seed, "evaluation", "surfaces", true.name)
    for name, share in (("rest", 0.0), ("open", 1.0)):
        mine, theirs = (
            posed_triangles(own, own.poses(own.opened(share))) for own in (predicted, true)
        )
        clouds = [
            sampled(triangles, protocol.points, stream.child(name, side).generator())
            for side, triangles in (("predicted", mine), ("true", theirs))
        ]
        put(found, f"surfaces.{name}", _flat(compared(clouds[0], clouds[1])))
        if name == "rest":
            again = sampled(theirs, protocol.points, stream.child("floor").generator())
            floor = _flat(compared(again, clouds[1]))
            wanted = ("chamfer_l1", "chamfer_squared")
            put(found, "surfaces.floor", {key: floor[key] for key in wanted})


def _flat(scores: SurfaceScores) -> dict[str, float]:
    values = asdict(replace(scores, f_scores=()))
    del values["f_scores"]
    return {
        **values,
        **{f"f_{t:g}": f for t, f in zip(THRESHOLDS, scores.f_scores, strict=True)},
    }
