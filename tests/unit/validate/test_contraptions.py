"""What turns for ever, hangs in a chain, follows another joint or falls on its rim is no defect."""

import dataclasses
import math
from pathlib import Path

import pytest

from artgen.articulation.types import ArticulatedObject, Limit, Spring
from artgen.export.layout import MANIFEST, MJCF, URDF
from artgen.validate import validate_asset
from artgen.validate.bounds import shipped_bounds
from artgen.validate.levels import Selection
from artgen.validate.report import Report
from artgen.validate.subject import Source
from tests.unit.validate.cabinet import write_quick_bundle
from tests.unit.validate.contraptions import SOUND, bucket, lamp, pedal_bin
from tests.unit.validate.test_foreign import verdict


def full_verdict(folder: Path) -> Report:
    source = Source(format="bundle", file=folder / MANIFEST, root=folder)
    return validate_asset(source, Selection(profile="full"), shipped_bounds())


@pytest.mark.parametrize("name", SOUND)
def test_a_sound_contraption_is_valid(name: str, tmp_path: Path) -> None:
    folder = write_quick_bundle(SOUND[name](), tmp_path / "bundle")
    assert [str(f) for f in full_verdict(folder).findings] == []


@pytest.mark.parametrize("name", sorted(set(SOUND) - {"kettle"}))
@pytest.mark.parametrize("file", [URDF, MJCF])
def test_it_is_valid_as_a_strangers_file(name: str, file: str, tmp_path: Path) -> None:
    folder = write_quick_bundle(SOUND[name](), tmp_path / "bundle")
    assert [str(f) for f in verdict(folder / file).findings] == []


def changed(obj: ArticulatedObject, joint: str, **fields: object) -> ArticulatedObject:
    joints = tuple(
        dataclasses.replace(j, **fields) if j.name == joint else j  # type: ignore[arg-type]
        for j in obj.joints
    )
    return dataclasses.replace(obj, joints=joints)


DEFECTS = {
    "a bail that does not rest on its rim": (
        "dynamics.settle", "bail_pivot",
        changed(bucket(), "bail_pivot", spring=Spring(stiffness=1.0, reference=1.0)),
    ),
    "an arm too heavy for its friction": (
        "dynamics.settle", "elbow", changed(lamp(), "elbow", friction=0.02),
    ),
    "a pedal that cannot lift its lid": (
        "dynamics.open", "pedal", changed(pedal_bin(), "pedal_pivot", effort=9.0),
    ),
    "a bail that passes through its bucket": (
        "motion.overlap", "bail, base",
        changed(bucket(), "bail_pivot", limit=Limit(lower=0.0, upper=math.pi + 0.3)),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", DEFECTS)
def test_a_spoilt_contraption_is_found_out(name: str, tmp_path: Path) -> None:
    check, part, obj = DEFECTS[name]
    report = full_verdict(write_quick_bundle(obj, tmp_path / "bundle"))
    assert (check, part) in {(f.check, f.part) for f in report.findings}, report.findings
