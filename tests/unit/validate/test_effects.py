"""Reports say what was simulated and why; a promise that is broken is found."""

from pathlib import Path

import pytest

from artgen.simulation import paths
from artgen.simulation.effects import Call, Effect, Effects, needed_effects
from artgen.validate import load_bounds, validate_asset
from artgen.validate.levels import Selection
from artgen.validate.report import Report, report_from_json
from artgen.validate.subject import Source
from tests.unit.validate.cabinet import cupboard, write_quick_bundle

SIMULATING = {
    "dynamics.settle", "dynamics.open", "dynamics.close", "dynamics.stop", "dynamics.energy",
}  # fmt: skip


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_quick_bundle(cupboard(), tmp_path_factory.mktemp("bundles") / "cupboard")


def verdict(bundle: Path, profile: str) -> Report:
    source = Source(format="bundle", file=bundle / "manifest.json", root=bundle)
    return validate_asset(source, Selection(profile=profile), load_bounds(None))


def test_every_simulating_check_states_every_effect_with_its_reason(bundle: Path) -> None:
    report = verdict(bundle, "standard")
    assert {item.check for item in report.simulated} == SIMULATING
    for item in report.simulated:
        assert set(item.effects) == {effect.value for effect in Effect}
        assert all(text.startswith(("on: ", "off: ")) for text in item.effects.values())
    assert report_from_json(report.as_json()) == report


def test_the_full_profile_proves_the_promise(bundle: Path) -> None:
    report = verdict(bundle, "full")
    assert "dynamics.effects" in report.judged
    assert not [finding for finding in report.findings if finding.check == "dynamics.effects"]


def test_the_standard_profile_says_whom_it_proves(bundle: Path) -> None:
    skipped = [item for item in verdict(bundle, "standard").skipped]
    assert [s.name for s in skipped if s.name == "dynamics.effects"] == ["dynamics.effects"]


def test_an_effect_that_is_left_off_and_matters_is_found(
    bundle: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def forgetful(model: object, task: object) -> Effects:
        calls = needed_effects(model, task).calls  # type: ignore[arg-type]
        return Effects(
            tuple(
                Call(call.effect, False, "forgotten") if call.effect is Effect.DAMPING else call
                for call in calls
            )
        )

    monkeypatch.setattr(paths, "needed_effects", forgetful)
    findings = verdict(bundle, "full").findings
    assert {finding.check for finding in findings} == {"dynamics.effects"}
    assert "damping" in findings[0].cause
