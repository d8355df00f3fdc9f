"""Planting every kind of defect into good assets, and asking who notices."""

import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from artgen.defect_study import rivals
from artgen.defect_study.defect import Defect
from artgen.defect_study.in_meshes import MESH_DEFECTS
from artgen.defect_study.in_mjcf import MJCF_DEFECTS
from artgen.defect_study.in_urdf import URDF_DEFECTS
from artgen.defect_study.in_usd import USD_DEFECTS
from artgen.export.layout import MANIFEST, MJCF, REPORT, URDF, USD
from artgen.validate import load_bounds, validate_asset
from artgen.validate.levels import Selection
from artgen.validate.report import Report
from artgen.validate.subject import Source

DEFECTS: tuple[Defect, ...] = (*URDF_DEFECTS, *MESH_DEFECTS, *MJCF_DEFECTS, *USD_DEFECTS)
FILES: Mapping[str, str] = {"urdf": URDF, "mjcf": MJCF, "usd": USD}


@dataclass(frozen=True, kw_only=True)
class Planted:
    """One defect in one asset.

    Attributes:
        check: the first check that named it; empty where none did.
        crash: the exception that broke the validator, which counts as missed; empty where none.
    """

    defect: str
    format: str
    asset: str
    check: str
    crash: str = ""


@dataclass(frozen=True, kw_only=True)
class Noticed:
    """Whether another checker refused a spoilt file."""

    checker: str
    defect: str
    noticed: bool


def foreign_copy(bundle: Path, folder: Path) -> None:
    """The bundle as a stranger would hand it over: without manifest and report."""
    shutil.rmtree(folder, ignore_errors=True)
    ours = shutil.ignore_patterns(MANIFEST, REPORT)
    shutil.copytree(bundle, folder, ignore=ours)


def planted(defect: Defect, bundle: Path, folder: Path) -> bool:
    """Make a spoilt copy; False where the asset has no place for the defect."""
    foreign_copy(bundle, folder)
    try:
        defect.plant(folder)
    except LookupError:
        return False
    return True


def judged(folder: Path, format_: str) -> Report:
    """Our verdict on a foreign asset."""
    source = Source(format=format_, file=folder / FILES[format_], root=folder)
    return validate_asset(source, Selection(profile="full"), load_bounds(None))


def caught(defect: Defect, bundles: Sequence[Path], scratch: Path) -> Iterator[Planted]:
    """Our verdict on one kind of defect, in every asset that has a place for it."""
    for number, bundle in enumerate(bundles):
        folder = scratch / f"{defect.name}_{number}"  # usd-core keeps files open by their path
        if planted(defect, bundle, folder):
            check, crash = "", ""
            try:
                report = judged(folder, defect.format)
                check = report.findings[0].check if report.findings else ""
            except Exception as error:
                crash = f"{type(error).__name__}: {error}"
            yield Planted(
                defect=defect.name,
                format=defect.format,
                asset=f"{bundle.parent.name}_{bundle.name}",
                check=check,
                crash=crash,
            )
        shutil.rmtree(folder, ignore_errors=True)


def false_alarms(bundles: Sequence[Path], scratch: Path) -> Iterator[tuple[str, str, Report]]:
    """(asset, format, report) of every format of every good asset."""
    for number, bundle in enumerate(bundles):
        folder = scratch / f"good_{number}"
        foreign_copy(bundle, folder)
        for format_ in FILES:
            yield f"{bundle.parent.name}_{bundle.name}", format_, judged(folder, format_)
        shutil.rmtree(folder, ignore_errors=True)


def noticed_by_rivals(
    defects: Sequence[Defect], bundles: Sequence[Path], scratch: Path
) -> dict[str, dict[str, bool] | None]:
    """Checker to defect to whether it refused the file; None for one that is not installed.

    Each kind is planted into the first asset that has a place for it. A checker that refuses the
    good asset too is no judge of it, and counts as not having noticed.
    """
    files: dict[str, tuple[Path, Path]] = {}
    for defect in defects:
        for bundle in bundles:
            bad = scratch / "rivals" / defect.name
            if planted(defect, bundle, bad):
                good = scratch / "rivals" / f"good_{bundle.parent.name}_{bundle.name}"
                if not good.exists():
                    foreign_copy(bundle, good)
                files[defect.name] = bad / URDF, good / URDF
                break
    listed = sorted({path for pair in files.values() for path in pair})
    table: dict[str, dict[str, bool] | None] = {}
    for rival in rivals.NAMES:
        said = rivals.verdicts(rival, listed)
        table[rival] = None
        if said is not None:
            table[rival] = {
                name: bool(said[bad]) and not said[good] for name, (bad, good) in files.items()
            }
    return table
