"""Category rules: what may vary and within which bounds, read from TOML and sampled by named
streams."""

from artgen.rules.load import load_rule, rule_names
from artgen.rules.override import Override, overridden, parse_override
from artgen.rules.sample import Sampled, sample
from artgen.rules.schema import Band, CategoryRule

__all__ = [
    "Band",
    "CategoryRule",
    "Override",
    "Sampled",
    "load_rule",
    "overridden",
    "parse_override",
    "rule_names",
    "sample",
]
