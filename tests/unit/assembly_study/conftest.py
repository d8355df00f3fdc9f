"""Objects of the assembly's own tests."""

from tests.unit.assembly.conftest import case_with, cases, library, made_sources, market

__all__ = ["case_with", "cases", "library", "made_sources", "market"]
