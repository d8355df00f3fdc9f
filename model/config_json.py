"""Frozen dataclasses out of JSON, strictly: an unknown, missing or mistyped key is an error."""

import dataclasses
import json
import types
import typing
from collections.abc import Mapping
from typing import Any, TypeVar

from artgen.core.errors import ModelError, did_you_mean

Settings = TypeVar("Settings")

ABSENT = "absent"
LATER: Mapping[str, str] = {ABSENT: "default"}
"""Metadata of a setting that earlier files lack: they mean its default, which must stay."""


def decoded(kind: type[Settings], text: str) -> Settings:
    """The dataclass `kind` whose canonical JSON is `text`.

    Every key must be there, but for those that came `LATER`: settings that a file leaves out would
    silently follow the defaults of another version.

    Raises:
        ModelError: the text is no JSON, or a key is unknown, missing or of another type.
    """
    try:
        value = json.loads(text)
    except json.JSONDecodeError as error:
        raise ModelError(f"settings: {error}; expected the JSON of a {kind.__name__}") from error
    built: Settings = _value(kind, value, kind.__name__)
    return built


def _value(kind: Any, value: Any, where: str) -> Any:
    if dataclasses.is_dataclass(kind):
        return _settings(kind, value, where)
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin in (typing.Union, types.UnionType):
        return _optional(inner, value, where)
    if origin is tuple and isinstance(value, list):
        return _tuple(inner, value, where)
    if origin is typing.Literal and value in inner:
        return value
    if kind is float and isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    if kind in (int, str, bool) and type(value) is kind:
        return value
    raise ModelError(f"settings: {where} is {value!r}, expected {_spelled(kind)}")


def _settings(kind: Any, value: Any, where: str) -> Any:
    if not isinstance(value, dict):
        raise ModelError(f"settings: {where} is {value!r}, expected the fields of {kind.__name__}")
    hints = typing.get_type_hints(kind)
    fields = dataclasses.fields(kind)
    names = [field.name for field in fields]
    for key in value:
        if key not in names:
            raise ModelError(
                f"settings: {where} has no {key!r}{did_you_mean(key, names)}; it has "
                f"{', '.join(names)}"
            )
    needed = [field.name for field in fields if ABSENT not in field.metadata]
    if missing := [name for name in needed if name not in value]:
        raise ModelError(
            f"settings: {where} lacks {', '.join(missing)}; the file is of another version"
        )
    return kind(**{key: _value(hints[key], own, f"{where}.{key}") for key, own in value.items()})


def _optional(kinds: tuple[Any, ...], value: Any, where: str) -> Any:
    if value is None and type(None) in kinds:
        return None
    (kind,) = (kind for kind in kinds if kind is not type(None))
    return _value(kind, value, where)


def _tuple(kinds: tuple[Any, ...], value: list[Any], where: str) -> tuple[Any, ...]:
    if kinds[-1] is Ellipsis:
        kinds = (kinds[0],) * len(value)
    if len(kinds) != len(value):
        raise ModelError(f"settings: {where} has {len(value)} entries, expected {len(kinds)}")
    return tuple(
        _value(kind, item, f"{where}[{k}]")
        for k, (kind, item) in enumerate(zip(kinds, value, strict=True))
    )


def _spelled(kind: Any) -> str:
    if typing.get_origin(kind) is typing.Literal:
        return "one of " + ", ".join(repr(word) for word in typing.get_args(kind))
    return f"a value of type {getattr(kind, '__name__', kind)}"
