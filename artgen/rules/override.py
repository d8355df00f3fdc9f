"""Parameters set from outside: `cabinet.rows=3` narrows what a rule draws, checked like a rule."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from artgen.core.errors import RuleError, did_you_mean
from artgen.core.jsonio import content_hash
from artgen.rules.distributions import (
    Chance,
    Choice,
    Distribution,
    Integer,
    LogUniform,
    Normal,
    Uniform,
    Value,
)
from artgen.rules.load import drawn_from
from artgen.rules.schema import CategoryRule

Entry = TypeVar("Entry")
FORM = "CATEGORY.KEY=VALUE, such as cabinet.rows=3 or 'cabinet.width={ uniform = [0.6, 0.7] }'"


@dataclass(frozen=True)
class Override:
    """One parameter or surface of a category, and the text of what it is set to."""

    category: str
    key: str
    text: str

    def __str__(self) -> str:
        return f"{self.category}.{self.key}={self.text}"


def parse_override(word: str) -> Override:
    """`CATEGORY.KEY=VALUE` or `CATEGORY.surfaces.ROLE=PALETTE_ENTRY`.

    Raises:
        RuleError: the word has another form.
    """
    name, equals, text = word.partition("=")
    category, dot, key = name.strip().partition(".")
    if not (equals and dot and category and key and text.strip()):
        raise RuleError(f"--set {word}: expected {FORM}")
    return Override(category, key, text.strip())


def overridden(rule: CategoryRule, overrides: Sequence[Override]) -> CategoryRule:
    """The rule with what `overrides` say of its category in place of its own draws.

    A plain value must be one that the rule could draw; a table like `{ uniform = [a, b] }` stands
    for itself. All other parameters keep their values, as each is drawn from its own address.

    Raises:
        RuleError: the key is unknown, or the value is of another type or out of bounds.
    """
    mine = [override for override in overrides if override.category == rule.name]
    for override in mine:
        kind, dot, role = override.key.partition(".")
        if dot and kind == "surfaces":
            choice = _known(override, role, rule.surfaces)
            only = _fixed(override, choice)
            rule = replace(rule, surfaces={**rule.surfaces, role: only})
        else:
            draw = _known(override, override.key, rule.draws)
            narrowed = replace(draw, distribution=_narrowed(override, draw.distribution))
            rule = replace(rule, draws={**rule.draws, override.key: narrowed})
    if mine:
        rule = replace(rule, digest=content_hash([rule.digest, [str(o) for o in mine]]))
    return rule


def _known(override: Override, key: str, entries: Mapping[str, Entry]) -> Entry:
    if key not in entries:
        raise RuleError(
            f"--set {override}: {override.category} has no {key!r}"
            f"{did_you_mean(key, list(entries))}; known: {', '.join(entries)}"
        )
    return entries[key]


def _narrowed(override: Override, drawn: Distribution) -> Distribution:
    value = _value(override)
    if isinstance(value, dict):
        return drawn_from(f"--set {override}", override.key, value).distribution
    return _fixed(override, drawn)


def _fixed(override: Override, drawn: Distribution) -> Choice:
    """The value alone, if the distribution could draw it."""
    value = _value(override)
    if (fault := excludes(drawn, value)) is not None:
        raise RuleError(
            f"--set {override}: {value!r} {fault}; choose one that the rule allows, or give a "
            "table like { uniform = [a, b] }"
        )
    if isinstance(drawn, Uniform | LogUniform | Normal):
        value = float(value)
    return Choice((value,), (1.0,))


def _value(override: Override) -> Any:
    """The text as TOML reads it; a bare word is a string."""
    try:
        return tomllib.loads(f"value = {override.text}")["value"]
    except tomllib.TOMLDecodeError:
        if any(sign in override.text for sign in '{}[]="'):
            raise RuleError(f"--set {override}: is not TOML; expected {FORM}") from None
        return override.text


def excludes(drawn: Distribution, value: Value) -> str | None:
    """Why a distribution can never draw `value`; None if it can."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    match drawn:
        case Choice(options=options):
            listed = any(value == option and type(value) is type(option) for option in options)
            return None if listed else f"is none of {', '.join(map(repr, options))}"
        case Chance():
            return None if isinstance(value, bool) else "is neither true nor false"
        case Integer(lower=lower, upper=upper):
            whole = number and not isinstance(value, float)
            return _outside(whole, value, lower, upper, "whole number")
        case Normal(mean=mean, deviation=deviation):
            lower, upper = mean - 2.0 * deviation, mean + 2.0 * deviation
            return _outside(number, value, lower, upper, "number")
        case Uniform(lower=lower, upper=upper) | LogUniform(lower=lower, upper=upper):
            return _outside(number, value, lower, upper, "number")
    raise TypeError(f"no rule says what {type(drawn).__name__} excludes")


def _outside(fits: bool, value: Any, lower: float, upper: float, kind: str) -> str | None:
    if fits and lower <= value <= upper:
        return None
    return f"is no {kind} in [{lower:g}, {upper:g}]"
