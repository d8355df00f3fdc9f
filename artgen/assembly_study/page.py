"""The page of the study, written from its rows."""

import itertools
from collections import Counter
from collections.abc import Sequence

import numpy as np

from artgen.assembly.choice import Market
from artgen.assembly_study.near import TAU, twins
from artgen.assembly_study.plots import share_within, summed
from artgen.assembly_study.rows import DENSITY_BINS, STRETCH_BINS, Chunk, Row, entropy_share
from artgen.core.mesh import Floats
from artgen.studies.table import markdown_table

TEN_THOUSAND = 10_000
SIZES = (0.8, 1.1, 1.4, 1.8)
"""m; between bins of the diagonal."""
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
            *_near(chunks, accepted),
            *_coverage(accepted),
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
        ("fronts without a handle (sliding, gripped at an edge, pushed) / all filled",
         f"{sum(r.bare for r in accepted)} / {sum(r.filled for r in accepted)}", ""),
        ("objects whose fronts are pushed to open",
         f"{100.0 * np.mean([r.pushed for r in accepted]):.1f} %", "10 %"),
        ("joints that open less far than the template's / all",
         f"{sum(r.shorter for r in accepted)} / {sum(r.parts - 1 for r in accepted)}", ""),
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


def _near(chunks: Sequence[Chunk], accepted: Sequence[Row]) -> list[str]:
    """How near the nearest other object of the same template lies, in shape alone."""
    found = twins([face for chunk in chunks for face in chunk.faces])
    apart = np.array([found.nearest[row.index][0] for row in accepted])
    looks = {row.index: row.looks for row in accepted}
    near = [row.index for row, distance in zip(accepted, apart, strict=True) if distance < TAU]
    both = sum(looks[index] == looks[found.nearest[index][1]] for index in near)
    met = apart[np.isfinite(apart)]
    low, middle = np.quantile(met, (0.05, 0.5)) if len(met) else (np.inf, np.inf)
    facts = [
        ("nearest other object of the same template, 5 % / half", f"{low:.4f} / {middle:.4f}"),
        (f"nearer than {TAU:g} (near-duplicates in shape)", f"{len(near)}"),
        ("of these with the looks of their twin as well", f"{both}"),
        ("left if near-duplicates in shape are dropped, one kept", f"{found.distinct}"),
    ]
    return [
        *("## Near-duplicates", ""),
        "Fronts and handles of two objects of one template, part by part: the Chamfer distance of "
        "144 + 36 points where a grid of rays meets them, over the front's diagonal; the part that "
        "differs most counts. Bodies, woods, paints and metals do not.",
        *("", markdown_table(("what", "found"), facts), ""),
    ]


def _coverage(accepted: Sequence[Row]) -> list[str]:
    """Accepted objects by size and number of parts."""
    sizes = np.digitize([row.diagonal for row in accepted], SIZES)
    counts = Counter(zip(sizes.tolist(), (row.parts for row in accepted), strict=True))
    parts = sorted({row.parts for row in accepted})
    bounds = ["0", *(f"{size:g}" for size in SIZES)]
    named = [f"{a} to {b} m" for a, b in itertools.pairwise(bounds)] + [f"above {bounds[-1]} m"]
    cells = [
        (name, *(str(counts[place, count] or "") for count in parts))
        for place, name in enumerate(named)
    ]
    header = ("diagonal", *(f"{count} parts" for count in parts))
    filled = f"{len(counts)} of {len(named) * len(parts)} cells have objects."
    return ["## Sizes and part counts", "", markdown_table(header, cells), "", filled, ""]
