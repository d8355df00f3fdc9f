"""The shape of a manifest: which key holds what kind of JSON value."""

from collections.abc import Callable, Iterator, Mapping
from typing import get_args

from artgen.articulation.types import GripKind

GRIP_KINDS = get_args(GripKind)
Kind = Callable[[object], bool]


def number(value: object) -> bool:
    """An int or float; nan passes here and is found by the check of its field."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def whole(value: object) -> bool:
    """An int."""
    return isinstance(value, int) and not isinstance(value, bool)


def text(value: object) -> bool:
    """A string that is not empty."""
    return isinstance(value, str) and value != ""


def optional(kind: Kind) -> Kind:
    """That kind, or null."""
    return lambda value: value is None or kind(value)


def listed(kind: Kind, length: int | None = None) -> Kind:
    """A list of that kind, and of that length if given."""
    return lambda value: (
        isinstance(value, list)
        and (length is None or len(value) == length)
        and all(kind(item) for item in value)
    )


def table(keys: Mapping[str, Kind]) -> Kind:
    """An object that has these keys, each of its kind."""
    return lambda value: (
        isinstance(value, dict) and all(key in value and keys[key](value[key]) for key in keys)
    )


VECTOR = listed(number, 3)
FILE = {"sha256": text, "bytes": whole}
BOX = table({"type": lambda value: value == "box", "center": VECTOR, "size": VECTOR})
HULL = table({"type": lambda value: value == "hull", "file": text})
GRIP = {
    "name": text,
    "kind": lambda value: value in GRIP_KINDS,
    "position": VECTOR,
    "outward": VECTOR,
    "pull": VECTOR,
}
PART = {
    "name": text,
    "label": text,
    "mesh": text,
    "bounds": listed(VECTOR, 2),
    "mass": number,
    "com": VECTOR,
    "inertia": listed(VECTOR, 3),
    "volume": number,
    "triangles": whole,
    "bodies": whole,
    "densities": optional(listed(number)),
    "surfaces": listed(text),
    "collision": listed(lambda value: BOX(value) or HULL(value)),
    "grips": listed(table(GRIP)),
}
JOINT = {
    "name": text,
    "type": text,
    "parent": text,
    "child": text,
    "axis": VECTOR,
    "origin": VECTOR,
    "lower": optional(number),
    "upper": optional(number),
    "friction": number,
    "damping": number,
    "effort": number,
    "velocity": number,
    "spring": optional(table({"stiffness": number, "reference": number})),
    "latch": optional(table({"force": number, "reach": number})),
    "mimic": optional(table({"joint": text, "multiplier": number, "offset": number})),
}
PRECONDITION = {"joint": text, "requires": text, "at_least": number}
SURFACE = {
    "name": text,
    "recipe": text,
    "color": VECTOR,
    "tile": listed(number, 2),
    "detail": lambda value: isinstance(value, dict),
}
MANIFEST: Mapping[str, Kind] = {
    "asset_id": text,
    "category": text,
    "bounds": listed(VECTOR, 2),
    "center": VECTOR,
    "radius": number,
    "mass": number,
}
ROWS: Mapping[str, Mapping[str, Kind]] = {
    "parts": PART,
    "joints": JOINT,
    "preconditions": PRECONDITION,
    "surfaces": SURFACE,
    "files": FILE,
}


def misshapen(manifest: Mapping[str, object]) -> Iterator[str]:
    """The address of every key that is missing or holds another kind of value."""
    yield from _misshapen_keys("", manifest, MANIFEST)
    for key, kinds in ROWS.items():
        rows = manifest.get(key)
        if isinstance(rows, list if key != "files" else dict):
            named = rows.items() if isinstance(rows, dict) else enumerate(rows or ())
            for name, row in named:
                yield from _misshapen_keys(f"{key}[{name}].", row, kinds)
        else:
            yield key
    if manifest.get("parts") == []:
        yield "parts"


def _misshapen_keys(at: str, row: object, kinds: Mapping[str, Kind]) -> Iterator[str]:
    if not isinstance(row, dict):
        yield at.rstrip(".")
        return
    yield from (f"{at}{key}" for key in kinds if key not in row or not kinds[key](row[key]))
