"""Category rules: what may vary and within which bounds, read from TOML and sampled by named
streams."""

from artgen.rules.load import load_rule, rule_names
from artgen.rules.sample import Sampled, sample
from artgen.rules.schema import Band, CategoryRule

__all__ = ["Band", "CategoryRule", "Sampled", "load_rule", "rule_names", "sample"]
