"""The page of the study, written from its rows."""

from collections import Counter
from collections.abc import Sequence

import numpy as np

from artgen.assembly.choice import Market
from artgen.assembly_study.plots import share_within, summed
from artgen.assembly_study.rows import DENSITY_BINS, STRETCH_BINS, Chunk, Row, entropy_share
from artgen.core.mesh import Floats
from artgen.studies.table import markdown_table

TEN_THOUSAND = 10_000
SHEET = (
    *("## Beside their templates", "", "Template left, new object right.", ""),
    *("![contact sheet](assembly_sheet.webp)", ""),
)


def page(market: Market, chunks: Sequence[Chunk], *, seed: int, sheet: bool) -> str:
    """Markdown."""
    rows = [row for chunk in chunks for row in chunk.rows]
    accepted = [row for row in rows if row.accepted]
    return "\n".join(
        [
            "# What `artgen assemble` makes",
            "",
            f"Written by `artgen study assembly --count {len(rows)} --seed {seed}`. Objects are "
            "assembled and held against every invariant of one object (docs/assembly.md): exact "
            "booleans over 21 poses a joint and with all open, boxes, hinges, handles, textures, "
            "licences, splits. They are not exported here.",
            "",
            markdown_table(("what", "found", "asked"), _facts(market, rows, accepted, chunks)),
            "",
            *(_why(rows)),
            "## Texture before and after the correction",
            "",
            "![histograms](assembly_texture.png)",
            "",
            *(SHEET if sheet else ()),
        ]
    )


def _facts(
    market: Market, rows: Sequence[Row], accepted: Sequence[Row], chunks: Sequence[Chunk]
) -> list[tuple[str, str, str]]:
    uses = Counter(donor for row in accepted for donor in row.bodies.split())
    usable = len(market.usable())
    distinct = len({row.hash for row in accepted})
    seconds = np.array([row.assemble_s + row.check_s for row in rows])
    each = seconds.sum() / max(len(accepted), 1)
    tuples = len({(row.template, row.bodies) for row in accepted})
    left, fixed = (summed(chunks, f"density_{k}") for k in ("left", "fixed"))
    before, after = (summed(chunks, f"stretch_{k}") for k in ("left", "fixed"))
    return [
        ("attempts", f"{len(rows)}", ""),
        ("accepted", f"{len(accepted)} ({100.0 * len(accepted) / len(rows):.1f} %)", ">= 80 %"),
        ("distinct by tree, shapes and looks", f"{distinct}", "all"),
        ("distinct (template, donors)", f"{tuples}", ""),
        ("distinct trees", f"{len({row.tree for row in accepted})}", ""),
        ("templates used / available",
         f"{len({row.template for row in accepted})} / {len(market.template_ids)}", ""),
        ("donors used / usable", f"{len(uses)} / {usable}", ""),
        ("entropy of donor use over that of even use",
         f"{entropy_share(list(uses.values()), usable):.3f}", ">= 0.8"),
        ("the same of expected use, over many objects",
         f"{entropy_share(market.expected_use().tolist(), usable):.3f}", ">= 0.8"),
        ("texel density of a part over the object's median",
         f"{min(r.least for r in accepted):.3f} to {max(r.most for r in accepted):.3f}",
         "0.8 to 1.25"),
        ("area of fronts with density 0.8 to 1.25, as scaled / corrected",
         f"{_percent(left, DENSITY_BINS, 0.8, 1.25)} / {_percent(fixed, DENSITY_BINS, 0.8, 1.25)}",
         ""),
        ("area of fronts stretched by more than 1.1, as scaled / corrected",
         f"{_more(before, 1.1)} / {_more(after, 1.1)}", ""),
        ("CPU s an attempt to assemble / to check",
         f"{np.mean([r.assemble_s for r in rows]):.3f} / {np.mean([r.check_s for r in rows]):.3f}",
         ""),
        ("CPU minutes for 10,000 accepted, from these",
         f"{TEN_THOUSAND * each / 60.0:.0f}", ""),
    ]  # fmt: skip


def _percent(total: Floats, bins: Floats, low: float, high: float) -> str:
    return f"{100.0 * share_within(total, bins, low, high):.2f} %"


def _more(total: Floats, limit: float) -> str:
    return f"{100.0 * (1.0 - share_within(total, STRETCH_BINS, 1.0, limit)):.2f} %"


def _why(rows: Sequence[Row]) -> list[str]:
    reasons = Counter(row.reason for row in rows if not row.accepted)
    if not reasons:
        return []
    listed = [(f"{count}", reason) for reason, count in reasons.most_common(12)]
    return ["## Given up", "", markdown_table(("objects", "reason"), listed), ""]
