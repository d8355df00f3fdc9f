"""Checks of an asset from its files: structure, meshes, inertia, MuJoCo, motion, meaning."""

from pathlib import Path

from artgen.export.layout import MANIFEST
from artgen.validate.battery import LEVELS
from artgen.validate.bounds import Bounds, load_bounds, shipped_bounds
from artgen.validate.levels import Selection, run_levels
from artgen.validate.read import read_subject
from artgen.validate.report import Finding, Report, Skipped
from artgen.validate.subject import Source, Subject

__all__ = [
    "Finding",
    "Report",
    "Skipped",
    "bundle_subject",
    "load_bounds",
    "validate_asset",
    "validate_bundle",
]


def bundle_subject(folder: Path) -> Subject:
    """The bundle in `folder` as the checks see it; files are read when first asked for."""
    source = Source(format="bundle", file=folder / MANIFEST, root=folder)
    return read_subject(source, shipped_bounds())


def validate_bundle(folder: Path) -> Report:
    """The verdict on the bundle in `folder`, from its files alone; a bad bundle never raises."""
    source = Source(format="bundle", file=folder / MANIFEST, root=folder)
    return validate_asset(source, Selection(), shipped_bounds())


def validate_asset(source: Source, selection: Selection, bounds: Bounds) -> Report:
    """The verdict on one asset of any format."""
    return run_levels(read_subject(source, bounds), LEVELS, selection)
