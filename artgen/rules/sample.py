"""CategoryRule and stream to Params; named invariants, bounded retries."""

import dataclasses
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from artgen.core.errors import RuleError, did_you_mean
from artgen.core.stream import Stream
from artgen.core.surface import SurfaceSpec
from artgen.rules.load import rules_folder
from artgen.rules.schema import CategoryRule
from artgen.rules.surfaces import load_palette, surface_spec

Invariants = Mapping[str, Callable[[Any], bool]]


@dataclass(frozen=True)
class Sampled:
    """One draw: the builder's Params, its surfaces by role, and how many tries it took."""

    params: Any
    surfaces: Mapping[str, SurfaceSpec]
    tries: int


def sample(
    rule: CategoryRule,
    stream: Stream,
    *,
    params_type: type,
    invariants: Invariants,
    folder: Path | None = None,
) -> Sampled:
    """Draw until every invariant holds; the value of a key depends on the stream, the key and the
    try.

    Raises:
        RuleError: keys differ from the fields of `params_type`, or no try met all invariants.
    """
    check_keys(rule, params_type, invariants)
    failures: Counter[str] = Counter()
    for attempt in range(rule.tries):
        params = params_type(**draw_values(rule, stream.child("sample", attempt)))
        broken = [name for name in rule.invariants if not invariants[name](params)]
        if not broken:
            return Sampled(params, draw_surfaces(rule, stream, folder), attempt + 1)
        failures.update(broken)
    counts = ", ".join(f"{name} failed {count} times" for name, count in failures.most_common())
    raise RuleError(
        f"{rule.file}: no valid sample in {rule.tries} tries at {'/'.join(stream.path)}: {counts}; "
        "widen the ranges that this invariant ties together"
    )


def draw_values(rule: CategoryRule, stream: Stream) -> dict[str, Any]:
    """One value a key; keys with a length give tuples."""
    values: dict[str, Any] = {}
    for key, draw in rule.draws.items():
        rng = stream.child(key).generator()
        if draw.length is None:
            values[key] = draw.distribution.draw(rng)
        else:
            values[key] = tuple(draw.distribution.draw(rng) for _ in range(draw.length))
    return values


def draw_surfaces(
    rule: CategoryRule, stream: Stream, folder: Path | None = None
) -> dict[str, SurfaceSpec]:
    """Role to a palette entry of the rule's choice."""
    palette = load_palette(folder or rules_folder())
    return {
        role: surface_spec(
            role, palette[str(choice.draw(stream.child("surfaces", role).generator()))]
        )
        for role, choice in rule.surfaces.items()
    }


def check_keys(rule: CategoryRule, params_type: type, invariants: Invariants) -> None:
    """Raise RuleError unless [sample] has exactly the builder's fields and its invariants exist."""
    fields = [field.name for field in dataclasses.fields(params_type)]
    for key in rule.draws:
        if key not in fields:
            raise RuleError(
                f"{rule.file}: [sample.{key}] is not a parameter of {rule.name}"
                f"{did_you_mean(key, fields)}; expected {', '.join(fields)}"
            )
    if missing := [name for name in fields if name not in rule.draws]:
        raise RuleError(f"{rule.file}: [sample] lacks {', '.join(missing)}; add one line for each")
    for name in rule.invariants:
        if name not in invariants:
            raise RuleError(
                f"{rule.file}: [[invariant]] {name!r} is not defined by the builder"
                f"{did_you_mean(name, list(invariants))}; "
                f"defined: {', '.join(invariants) or 'none'}"
            )
