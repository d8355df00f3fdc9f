"""artgen makes articulated objects from category rules: built, validated, rendered, packed."""

from importlib.metadata import version

__version__ = version("artgen")
