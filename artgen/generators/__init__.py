"""Builders by category name: `artgen/generators/<category>.py` beside
`category_rules/<category>.toml`.
"""

import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from artgen.articulation.types import Draft
from artgen.core.errors import RuleError
from artgen.core.surface import SurfaceSpec


@dataclass(frozen=True)
class Builder:
    """What a category's module provides: `PARAMS`, `INVARIANTS` and `build`."""

    params_type: type
    invariants: Mapping[str, Callable[[Any], bool]]
    build: Callable[[Any, Mapping[str, SurfaceSpec]], Draft]


def load_builder(category: str) -> Builder:
    """The builder of a category that has a rule.

    Raises:
        RuleError: there is a rule file but no module beside it.
    """
    try:
        module = importlib.import_module(f"artgen.generators.{category}")
    except ModuleNotFoundError as error:
        raise RuleError(
            f"category_rules/{category}.toml has no builder; write artgen/generators/{category}.py"
        ) from error
    return Builder(module.PARAMS, module.INVARIANTS, module.build)
