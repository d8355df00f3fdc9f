"""The report adds up what assets cost and compares those with an effect to those without."""

import io
import json
from pathlib import Path

from rich.console import Console

from renders.asset import Account
from renders.report import print_report, render_report, write_report
from renders.run import Rendered
from renders.settings import SensorSettings, Settings


def account(*, glass: bool, composite: float, composites: int = 4) -> Account:
    return Account(
        composites=composites,
        alone=10,
        seconds={"plan": 0.5, "render": 8.0, "collect": 1.5},
        cpu={"import": 1.0, "composite": composite, "alone": 2.0},
        effects={
            "thin_glass": {"on": glass, "set": [], "why": "glass" if glass else "no pane"},
            "motion_blur": {"on": False, "set": False, "why": "not asked for"},
        },
    )


OUTCOMES = [
    Rendered(asset_id="a", account=account(glass=True, composite=8.0)),
    Rendered(asset_id="b", account=account(glass=False, composite=2.0)),
    Rendered(asset_id="c", account=account(glass=False, composite=4.0, composites=2)),
    Rendered(asset_id="d", message="asset.glb is cut\nwith a log"),
]
SETTINGS = Settings(sensor=SensorSettings(noise=2.0))
REPORT = render_report(OUTCOMES, SETTINGS, kept=7, wall=20.0)


def test_counts_and_seconds_add_up() -> None:
    assert REPORT["assets"] == {"rendered": 3, "kept": 7, "failed": 1}
    assert REPORT["images"] == {"composite": 10, "alone": 30}
    assert REPORT["seconds"] == {"run": 20.0, "plan": 1.5, "render": 24.0, "collect": 4.5}
    assert REPORT["cpu_seconds"] == {"import": 3.0, "composite": 14.0, "alone": 6.0}
    each = REPORT["cpu_seconds_per_image"]
    assert each == {"all": 23.0 / 40, "composite": 1.4, "alone": 0.2}
    assert REPORT["failures"] == {"d": "asset.glb is cut\nwith a log"}
    assert REPORT["sensor"] == {"noise": 2.0}


def test_an_effect_costs_what_its_assets_cost_more() -> None:
    """8 s for 4 images with glass; 2 s + 4 s for 4 + 2 images without."""
    glass, blur = (REPORT["effects"][name] for name in ("thin_glass", "motion_blur"))
    assert (glass["assets"], glass["reasons"]) == (1, ["glass"])
    assert (glass["composite_with"], glass["composite_without"]) == (2.0, 1.0)
    assert (blur["assets"], blur["reasons"]) == (0, ["not asked for"])
    assert blur["composite_with"] is None


def test_the_tables_name_the_effects_that_were_on_alone(tmp_path: Path) -> None:
    said = io.StringIO()
    print_report(REPORT, Console(file=said, width=100))
    assert "thin_glass" in said.getvalue()
    assert "sensor noise" in said.getvalue()
    assert "motion_blur" not in said.getvalue()
    write_report(tmp_path / "render_report.json", REPORT)
    assert json.loads((tmp_path / "render_report.json").read_text())["schema"].endswith("report/1")


def test_a_run_in_which_all_fails_is_reported() -> None:
    report = render_report(OUTCOMES[3:], SETTINGS, kept=0, wall=1.0)
    assert report["cpu_seconds_per_image"]["all"] == 0.0
    print_report(report, Console(file=io.StringIO()))
