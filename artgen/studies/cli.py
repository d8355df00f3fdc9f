"""`artgen study`: finds studies by entry point, as commands are found."""

from collections.abc import Sequence
from importlib.metadata import EntryPoint, entry_points

from artgen.core.errors import UsageError

INTRODUCTION = """\
artgen study: what accuracy costs in time, measured in one run.

usage: artgen study NAME [OPTIONS]        (artgen study NAME --help explains each option)

Studies:
{studies}

Each writes a table (CSV), plots, and where presets are read from it, the page that says how.
Plots and image metrics need: pip install 'artgen[study]'
"""


def found_studies() -> dict[str, EntryPoint]:
    """Studies by name, from every installed distribution."""
    return {entry.name: entry for entry in entry_points(group="artgen.studies")}


def study(argv: Sequence[str]) -> int:
    """Measure error against seconds: tables, plots, presets."""
    studies = found_studies()
    if not argv or argv[0] in ("-h", "--help"):
        print(INTRODUCTION.format(studies=_listed(studies)))  # noqa: T201
        return 0 if argv else 2
    if argv[0] not in studies:
        raise UsageError(f"no study {argv[0]!r}; known: {', '.join(sorted(studies))}")
    return int(studies[argv[0]].load()(argv[1:]))


def _listed(studies: dict[str, EntryPoint]) -> str:
    lines = []
    for name, entry in sorted(studies.items()):
        first_line = (entry.load().__doc__ or "").strip().splitlines()[0]
        lines.append(f"  {name:<12} {first_line}")
    return "\n".join(lines)
