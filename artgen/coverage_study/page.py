"""The page of `artgen study coverage`, written from its rows."""

from collections.abc import Sequence

from artgen.coverage_study.neighbours import STEP, TWIN, Neighbour
from artgen.coverage_study.rows import Coverage
from artgen.coverage_study.views import DIRECTIONS, PIXELS
from artgen.studies.table import markdown_table

TWINS_SHOWN = 20

PAGE = """\
# What the rules make

Made by `artgen study coverage --count {count} --seed {seed}`: {count} seeds of each of
{categories} categories, drawn and built, not finished or rendered.

{table}

- **numbers, choices**: parameters drawn from a range, and from a list or a chance. Surfaces are
  drawn besides and are not counted.
- **tries**: samples drawn for one that meets every invariant of the rule.
- **topologies**: distinct kinematic trees (roles of parts, kinds of joints, couplings), names left
  out.
- **structures**: distinct lists of what each part is made of: bodies by material.
- **nearest neighbor**: the share of pixels in which an object differs from the most similar of the
  others, least and median over the category. Pixels are those of {maps} depth maps of {pixels} x
  {pixels} (front, two three-quarter views and top, at rest and open) that show one of the two;
  depths differ from {step:.1%} of a map's side. All pairs are compared, in meters: no scale is
  divided out.
- **twins**: objects that differ from another in {twin:.0%} of the pixels at most. Their materials,
  decals and small details may differ.

`coverage_parameters.csv` has a line per parameter (what the rule says, what came out, options that
no object has), `coverage_neighbours.csv` a line per object.

## Near-duplicates by shape

{twins}

## Histograms

{pictures}
"""


def page(rows: Sequence[Coverage], nearest: Sequence[Neighbour], *, seed: int) -> str:
    """The whole page as Markdown."""
    header = (
        *("category", "numbers", "choices", "tries", "topologies", "structures", "parts", "joints"),
        *("longest chain", "nearest neighbor: least, median", "twins"),
    )
    table = markdown_table(header, [_line(row) for row in rows])
    return PAGE.format(
        count=rows[0].objects,
        seed=seed,
        categories=len(rows),
        table=table,
        maps=2 * len(DIRECTIONS),
        pixels=PIXELS,
        step=STEP,
        twin=TWIN,
        twins=_twins(nearest),
        pictures="\n\n".join(
            f"**{row.category}**\n\n![{row.category}](coverage/{row.category}.png)" for row in rows
        ),
    )


def _line(row: Coverage) -> list[str]:
    parts = f"{row.least_parts} to {row.most_parts}"
    return [
        *(row.category, str(row.numbers), str(row.choices), f"{row.tries:.1f}"),
        *(str(row.topologies), str(row.structures), parts, row.kinds, str(row.depth)),
        *(f"{row.nearest:.1%}, {row.median:.0%}", str(row.twins)),
    ]


def _twins(nearest: Sequence[Neighbour]) -> str:
    """The closest pairs, each once."""
    pairs: dict[tuple[str, int, int], float] = {}
    for n in (n for n in nearest if n.twin):
        pairs[n.category, min(n.index, n.other), max(n.index, n.other)] = n.differing
    if not pairs:
        return "None."
    closest = sorted(pairs, key=lambda pair: pairs[pair])[:TWINS_SHOWN]
    header = ("category", "seed", "and", "pixels that differ")
    lines = [[pair[0], str(pair[1]), str(pair[2]), f"{pairs[pair]:.2%}"] for pair in closest]
    return f"{len(pairs)} pairs; the closest:\n\n{markdown_table(header, lines)}"
