"""Numbers that papers state, to lay beside ours; `docs/evaluation.md` tells where each is from.

They were measured on other objects and partly by protocols that the papers leave open, so they say
where a field stands, not who is better.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A system in a published table; metric in the table's own words to its number."""

    system: str
    numbers: Mapping[str, float]


@dataclass(frozen=True)
class Table:
    """A published table.

    Attributes:
        told: what was measured, where, and what is not known of it.
        ours: the table's words to the metrics of ours that come nearest.
    """

    title: str
    told: str
    rows: Sequence[Row]
    ours: Mapping[str, str]


def _row(system: str, names: Sequence[str], numbers: Sequence[float]) -> Row:
    return Row(system, dict(zip(names, numbers, strict=True)))


_LAYOUT = ("dgIoU", "dcDist", "CD")
_VIEWS = ("PSNR", "LPIPS", "CD", "F-score")
_ABLATION = ("PSNR", "dgIoU", "dcDist")
_NEAREST: Mapping[str, str] = {
    "dgIoU": "singapo.published.rs_dgiou",
    "dcDist": "singapo.published.rs_dcdist",
    "CD": "surfaces.rest.chamfer_squared",
    "PSNR": "images.psnr",
    "LPIPS": "images.lpips",
    "F-score": "surfaces.rest.f_0.02",
}
_UNKNOWN = (
    "Not stated: whether dgIoU and dcDist are at rest or over states, Chamfer's points and square, "
    "the F-score's threshold, the views and the resolution of PSNR."
)

TABLES: Sequence[Table] = (
    Table(
        title="One image, 631 storage furniture objects of PartNet-Mobility",
        told="As the ART paper (arXiv 2512.14671) has it. " + _UNKNOWN,
        rows=(
            _row("URDFormer", _LAYOUT, (1.0710, 0.1622, 0.0536)),
            _row("SINGAPO", _LAYOUT, (0.8306, 0.0947, 0.0059)),
            _row("ART", _LAYOUT, (0.4717, 0.0538, 0.0019)),
        ),
        ours=_NEAREST,
    ),
    Table(
        title="4 views of 2 states, PartNet-Mobility",
        told="As the ART paper has it. " + _UNKNOWN,
        rows=(
            _row("PARIS", _VIEWS, (22.851, 0.183, 0.023, 0.486)),
            _row("Digital Twin Art (with depth)", _VIEWS, (21.587, 0.165, 0.008, 0.821)),
            _row("ArtGS", _VIEWS, (22.352, 0.176, 0.016, 0.520)),
            _row("ART", _VIEWS, (27.059, 0.049, 0.009, 0.762)),
        ),
        ours=_NEAREST,
    ),
    Table(
        title="ART's ablations, more than 130 held-out sequences",
        told="As the ART paper has it; rows after the second are without static pre-training, too.",
        rows=(
            _row("full", _ABLATION, (28.678, 0.629, 0.062)),
            _row("without static pre-training", _ABLATION, (27.495, 0.665, 0.082)),
            _row("monocular", _ABLATION, (25.961, 0.731, 0.086)),
            _row("without rest state", _ABLATION, (23.587, 0.878, 0.113)),
            _row("without loss on parts", _ABLATION, (24.465, 0.681, 0.075)),
            _row("without order of parts", _ABLATION, (22.588, 1.118, 0.208)),
        ),
        ours=_NEAREST,
    ),
)
