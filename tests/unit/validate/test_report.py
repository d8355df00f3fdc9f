"""Reports: levels that cannot run say so, findings survive JSON, the command prints and exits."""

import json
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.core.jsonio import canonical_json
from artgen.validate import validate_bundle
from artgen.validate.bounds import shipped_bounds
from artgen.validate.cli import validate
from artgen.validate.levels import Check, Level, Selection, run_levels
from artgen.validate.report import Finding, Skipped, report_from_json
from tests.unit.validate.cabinet import ASSET, cupboard, write_quick_bundle
from tests.unit.validate.test_file_defects import SIGNED, UNSIGNED
from tests.unit.validate.test_foreign import FOREIGN, MODELED
from tests.unit.validate.test_object_defects import DEFECTS

ELSEWHERE = {
    *("files.survives", "motion.pinocchio", "motion.passage", "dynamics.hold", "dynamics.free"),
    *("semantics.interior", "semantics.reach", "dynamics.effects", "semantics.apart"),
    *("semantics.role", "semantics.grip", "structure.grip"),
}
"""Planted by tests of their own, or a note."""
ROOT = Path(__file__).parents[3]


@dataclass(frozen=True)
class Toy:
    """A subject that has a name and says nothing of manifests."""

    name: str = "s"
    format: str = "urdf"

    def lacks(self, need: str) -> str | None:
        return f"a urdf has no {need}" if need == "manifest" else None


def finding(check: str) -> Finding:
    return Finding(check=check, part="lid", value=2.0, bound="<= 1 m", cause="long", remedy="cut")


def bad(subject: Toy) -> Iterator[Finding]:
    yield finding(f"{subject.name}.bad")


def good(subject: Toy) -> Iterator[Finding | Skipped]:
    yield Skipped(name=f"{subject.name}.good", reason="no rule")


BAD, GOOD = Check(bad, ("s.bad",), (), "quick"), Check(good, ("s.good",), (), "full")


def level(name: str, *needs: str, checks: tuple[Check[Toy], ...]) -> Level[Toy]:
    return Level(name=name, needs=needs, checks=checks)


def test_a_level_runs_only_on_what_it_needs() -> None:
    levels = (
        level("a", checks=(BAD, GOOD, BAD)),
        level("b", "a", checks=(BAD,)),
        level("c", "b", checks=(BAD,)),
        level("d", checks=(GOOD,)),
    )
    report = run_levels(Toy(), levels, Selection(profile="full"))
    assert [f.check for f in report.findings] == ["s.bad", "s.bad"]
    assert [s.name for s in report.skipped] == ["s.good", "b", "c", "s.good"]
    assert "relies on a" in report.skipped[1].reason
    assert not report.ok


def test_a_profile_runs_its_own_checks_and_those_of_quicker_ones() -> None:
    levels = (level("a", checks=(BAD, GOOD)), level("d", checks=(GOOD,)))
    assert run_levels(Toy(), levels, Selection(profile="standard")).judged == ("s.bad",)
    full = run_levels(Toy(), levels, Selection(profile="full"))
    assert full.judged == ("s.bad", "s.good", "s.good")


def test_a_named_check_runs_alone_with_all_that_its_level_relies_on() -> None:
    levels = (
        level("L0 a", checks=(GOOD, GOOD)),
        level("L1 b", "L0 a", checks=(GOOD, BAD, GOOD)),
        level("L1 c", checks=(GOOD,)),
    )
    report = run_levels(Toy(), levels, Selection(names=("s.bad",)))
    assert report.judged == ("s.good", "s.good", "s.bad")
    assert run_levels(Toy(), levels, Selection(names=("L1",))).judged.count("s.good") == 5


def test_a_check_whose_need_is_not_met_is_skipped_with_the_reason() -> None:
    """Never passed in silence: it is not among those judged."""
    needy = Check(bad, ("s.bad", "s.worse"), ("manifest",), "quick")
    report = run_levels(Toy(), (level("a", checks=(needy,)),), Selection())
    assert [(s.name, s.reason) for s in report.skipped] == [
        ("s.bad", "a urdf has no manifest"),
        ("s.worse", "a urdf has no manifest"),
    ]
    assert report.judged == ()
    assert report.ok


def test_notes_alone_leave_a_report_valid() -> None:
    assert run_levels(Toy(), (level("d", checks=(GOOD,)),), Selection(profile="full")).ok


def test_a_report_read_back_is_the_report() -> None:
    levels = (level("a", checks=(BAD, GOOD)), level("b", "a", checks=(BAD,)))
    report = run_levels(Toy(), levels, Selection(profile="full"))
    assert report_from_json(json.loads(canonical_json(report.as_json()))) == report


def test_a_finding_of_nan_can_be_written() -> None:
    report = run_levels(Toy(), (level("a", checks=(Check(nan, ("c",)),)),), Selection())
    assert json.loads(canonical_json(report.as_json()))["findings"][0]["value"] == "nan"


def nan(subject: Toy) -> Iterator[Finding]:
    yield Finding(check="c", part="p", value=float("nan"), bound="b", cause="c", remedy="r")


def test_a_finding_reads_as_one_line() -> None:
    assert str(finding("mesh.size")) == "mesh.size: lid: 2 (expected <= 1 m); long; cut"


@pytest.fixture(scope="module")
def bundles(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a sound and a spoilt bundle."""
    root = tmp_path_factory.mktemp("bundles")
    write_quick_bundle(cupboard(), root / "cupboard" / "000004")
    shutil.copytree(root / "cupboard" / "000004", root / "cupboard" / "000005")
    (root / "cupboard" / "000005" / "asset.glb").unlink()
    return root


def test_the_command_names_every_bundle_and_exits_1(
    bundles: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert validate([str(bundles)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:2] == ["valid", ASSET]
    assert "files.file: asset.glb: missing" in "\n".join(lines)
    assert lines[-1] == "1 of 2 assets are valid"
    assert "" not in lines


def test_a_path_without_bundles_is_a_usage_error(tmp_path: Path) -> None:
    for argv in ([str(tmp_path)], [str(tmp_path / "nowhere")], []):
        with pytest.raises(UsageError):
            validate(argv)


def test_an_unknown_check_is_a_usage_error_that_lists_the_known(bundles: Path) -> None:
    with pytest.raises(UsageError, match=r"no check or level.*mesh\.closed"):
        validate([str(bundles), "--check", "mesh.shut"])


def test_equal_bundles_give_equal_reports(bundles: Path) -> None:
    spoilt = bundles / "cupboard" / "000005"
    one, two = (canonical_json(validate_bundle(spoilt).as_json()) for _ in range(2))
    assert one == two
    assert str(bundles) not in one  # no path of this machine.


def test_the_document_shows_every_bound_with_its_value_and_reason() -> None:
    text = (ROOT / "docs" / "validation.md").read_text()
    bounds = shipped_bounds()
    for field in fields(bounds):
        bound = getattr(bounds, field.name)
        unit = f" {bound.unit}" if bound.unit else ""
        row = f"| `{field.name}` | {bound.value:g}{unit} | {bound.reason} |"
        assert row in text, f"docs/validation.md lacks the row\n{row}"


def test_every_check_is_documented_and_has_a_planted_defect() -> None:
    """Names are read from the sources; those made from a field's name are written out here."""
    sources = "".join(path.read_text() for path in (ROOT / "artgen" / "validate").glob("*.py"))
    levels = "files|structure|mesh|inertia|compile|motion|semantics|dynamics"
    names = set(re.findall(rf'"((?:{levels})\.[a-z]+)"', sources)) - {"semantics.band"}
    names |= {f"structure.{name}" for name in ("effort", "velocity", "friction", "damping")}
    tables = (SIGNED, UNSIGNED, DEFECTS, FOREIGN, MODELED)
    planted = {check for table in tables for check, _, _ in table.values()} | ELSEWHERE
    assert names - planted == set()
    text = (ROOT / "docs" / "validation.md").read_text()
    assert {name for name in names if f"`{name}`" not in text} == set()
