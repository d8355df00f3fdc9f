"""Rows of a study as CSV: one dataclass a table, its fields the columns."""

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, Literal, TypeVar, get_origin, get_type_hints

from artgen.core.errors import UsageError
from artgen.core.jsonio import write_bytes

Row = TypeVar("Row")


def write_table(path: Path, rows: Iterable[Any]) -> None:
    """Write dataclass rows of one type; floats with 6 significant digits, None as nothing.

    The file appears whole or not at all.
    """
    listed = list(rows)
    buffer = io.StringIO()
    writer = csv.DictWriter(
        buffer, [field.name for field in fields(listed[0])], lineterminator="\n"
    )
    writer.writeheader()
    for row in listed:
        writer.writerow({name: _text(value) for name, value in asdict(row).items()})
    path.parent.mkdir(parents=True, exist_ok=True)
    write_bytes(path, buffer.getvalue().encode())


def read_table(path: Path, kind: type[Row]) -> list[Row]:
    """The rows that `write_table` wrote, of str, literals, int, float, bool and their `| None`.

    Raises:
        UsageError: the file is missing, or its columns are not the fields of `kind`.
    """
    try:
        with path.open(newline="", encoding="utf-8") as stream:
            found = list(csv.DictReader(stream))
    except FileNotFoundError as error:
        raise UsageError(f"{path}: is missing; run the study that writes it") from error
    hints = get_type_hints(kind)
    names = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    if found and list(found[0]) != names:
        raise UsageError(
            f"{path}: has the columns {', '.join(found[0])}, expected {', '.join(names)}; run the "
            "study again"
        )
    return [kind(**{name: _value(row[name], hints[name]) for name in names}) for row in found]


def markdown_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table for a page."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _text(value: object) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _value(text: str, hint: Any) -> Any:
    if get_origin(hint) is Literal:
        return text
    kinds = [kind for kind in getattr(hint, "__args__", (hint,)) if kind is not type(None)]
    if text == "" and str not in kinds:
        return None
    if bool in kinds:
        return text == "True"
    return kinds[0](text)
