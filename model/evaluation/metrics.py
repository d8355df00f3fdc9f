"""The table of all metrics: what each is called, its unit, which way is better, what failure costs.

Names are paths: protocol, variant where there is one, metric. `docs/evaluation.md` defines each.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

LOOSE_DISTANCE = 1.0
"""Radii that a part without a counterpart counts in the honest dcDist."""

Better = Literal["less", "more", ""]


@dataclass(frozen=True)
class Metric:
    """One metric.

    Attributes:
        unit: of its values.
        better: which way; empty where neither is.
        worst: what an object without a prediction counts: the end of the scale, or what the metric
            says of a part without a counterpart; None where there is neither, and such objects are
            left out and counted.
    """

    unit: str
    better: Better
    worst: float | None = None


_BOX = {
    "rs_dgiou": Metric("1 - gIoU", "less", 2.0),
    "as_dgiou": Metric("1 - gIoU", "less", 2.0),
    "rs_dcdist": Metric("radii", "less"),
    "as_dcdist": Metric("radii", "less"),
}
_HONEST_BOX = _BOX | {
    "rs_dcdist": Metric("radii", "less", LOOSE_DISTANCE),
    "as_dcdist": Metric("radii", "less", LOOSE_DISTANCE),
}
_JOINT = {
    "found": Metric("share", "more", 0.0),
    "type_right": Metric("share", "more", 0.0),
    "axis_deg": Metric("deg, 0 to 180", "less"),
    "axis_unsigned_deg": Metric("deg, 0 to 90", "less"),
    "flipped": Metric("share", "less"),
    "line": Metric("radii", "less"),
    "pivot": Metric("radii", "less"),
    "lever": Metric("radii", "less"),
    "state_deg": Metric("deg", "less"),
    "state_radii": Metric("radii", "less"),
    "state_share": Metric("share of the range", "less"),
    "limit_iou": Metric("IoU", "more"),
    "parent_right": Metric("share", "more", 0.0),
}
_PARTICULATE = {
    "rest_giou": Metric("gIoU", "more", -1.0),
    "full_giou": Metric("gIoU", "more", -1.0),
    "states_giou": Metric("gIoU", "more", -1.0),
    "rest_miou": Metric("IoU", "more", 0.0),
    "full_miou": Metric("IoU", "more", 0.0),
    "rest_pc": Metric("squared, object = 1", "less"),
    "full_pc": Metric("squared, object = 1", "less"),
}
_SURFACE = {
    "chamfer_l1": Metric("longest side = 1", "less"),
    "chamfer_squared": Metric("longest side = 1, squared", "less"),
    "accuracy": Metric("longest side = 1", "less"),
    "completeness": Metric("longest side = 1", "less"),
    "f_0.01": Metric("F-score", "more", 0.0),
    "f_0.02": Metric("F-score", "more", 0.0),
    "f_0.05": Metric("F-score", "more", 0.0),
    "normals": Metric("|cosine|", "more", 0.0),
}
_PARIS = {
    "axis_deg": Metric("deg, 0 to 90", "less"),
    "position": Metric("10 x length", "less"),
    "position_paris": Metric("10 x length", "less"),
    "motion_deg": Metric("deg", "less"),
    "motion_length": Metric("length", "less"),
    "cd_static": Metric("1000 x length squared", "less"),
    "cd_moving": Metric("1000 x length squared", "less"),
    "cd_whole": Metric("1000 x length squared", "less"),
}
_MASKS = {
    "base": Metric("IoU", "more", 0.0),
    "moving": Metric("IoU", "more", 0.0),
    "composite": Metric("IoU", "more", 0.0),
}
_IMAGES = {
    "psnr": Metric("dB", "more"),
    "psnr_foreground": Metric("dB", "more"),
    "ssim": Metric("", "more"),
    "lpips": Metric("", "less"),
    "mask_iou": Metric("IoU", "more", 0.0),
}
_GATES = {
    name: Metric("share", "more", 0.0)
    for name in ("loads", "stable", "settles", "opens", "clear", "passed", "kept")
} | {"deepest": Metric("m", "less")}

MATCHINGS = ("order", "nearest")
"""By order, and by Hungarian matching of box centers; their gap measures confused slots."""


def _under(prefix: str, metrics: Mapping[str, Metric]) -> dict[str, Metric]:
    return {f"{prefix}.{name}": metric for name, metric in metrics.items()}


def _matched(prefix: str, metrics: Mapping[str, Metric]) -> dict[str, Metric]:
    return {
        key: metric
        for matching in MATCHINGS
        for key, metric in _under(f"{prefix}.{matching}", metrics).items()
    }


METRICS: Mapping[str, Metric] = {
    "parts.count_right": Metric("share", "more", 0.0),
    "parts.count_error": Metric("parts", "less"),
    **_under("singapo.published", _BOX),
    "singapo.published.rs_dcd": Metric("radii squared", "less"),
    "singapo.published.as_dcd": Metric("radii squared", "less"),
    "singapo.published.aor": Metric("IoU", "less"),
    "singapo.published.aor_true": Metric("IoU", ""),
    **_matched("singapo.honest", _HONEST_BOX),
    "singapo.honest.aor": Metric("IoU", "less"),
    "singapo.honest.aor_true": Metric("IoU", ""),
    **_under("particulate", _PARTICULATE),
    "particulate.rest_oc": Metric("squared, object = 1", "less"),
    "particulate.full_oc": Metric("squared, object = 1", "less"),
    **_under("particulate.pairs", _PARTICULATE),
    **_matched("joints", _JOINT),
    **_matched("states", {"center": Metric("radii", "less")}),
    **_under("surfaces.rest", _SURFACE),
    **_under("surfaces.open", _SURFACE),
    **_under("surfaces.floor", {"chamfer_l1": _SURFACE["chamfer_l1"],
                                "chamfer_squared": _SURFACE["chamfer_squared"]}),
    **_under("paris", _PARIS),
    **_matched("masks", _MASKS),
    **_under("images", _IMAGES),
    **_under("images.new_state", _IMAGES),
    **_under("gates", _GATES),
}  # fmt: skip

HEADLINES = (
    "singapo.published.rs_dgiou",
    "singapo.honest.order.rs_dgiou",
    "singapo.honest.nearest.rs_dgiou",
    "singapo.honest.nearest.rs_dcdist",
    "particulate.rest_giou",
    "joints.nearest.type_right",
    "joints.nearest.axis_deg",
    "joints.nearest.line",
    "surfaces.rest.chamfer_l1",
    "surfaces.rest.f_0.02",
    "masks.nearest.composite",
    "masks.nearest.moving",
    "images.psnr",
    "gates.passed",
    "gates.kept",
)
"""What tables by category and by part count show."""
