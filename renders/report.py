"""What a run of renders did and cost: render_report.json, and a short table."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from artgen.core.jsonio import plain, write_json
from renders.asset import Account
from renders.run import Rendered
from renders.settings import SensorSettings, Settings


def render_report(
    outcomes: Sequence[Rendered], settings: Settings, *, kept: int, wall: float
) -> dict[str, Any]:
    """The report of a run.

    An effect's cost is told by comparison: CPU seconds of a composite image of the assets that call
    for it, and of those that do not. Within one asset effects cannot be told apart;
    `artgen study effects` does that by switching them.

    Args:
        outcomes: of what this run rendered, or could not.
        kept: samples that were there already.
        wall: seconds of the whole run.
    """
    accounts = [outcome.account for outcome in outcomes if outcome.account is not None]
    composites = sum(account.composites for account in accounts)
    alone = sum(account.alone for account in accounts)
    cpu = _summed([account.cpu for account in accounts])
    images = composites + alone
    return {
        "schema": "artgen-render-report/1",
        "settings": plain(settings),
        "assets": {
            "rendered": len(accounts),
            "kept": kept,
            "failed": len(outcomes) - len(accounts),
        },
        "images": {"composite": composites, "alone": alone},
        "seconds": {"run": wall, **_summed([account.seconds for account in accounts])},
        "cpu_seconds": cpu,
        "cpu_seconds_per_image": {
            "all": _share(sum(cpu.values()), images),
            "composite": _share(cpu.get("composite", 0.0), composites),
            "alone": _share(cpu.get("alone", 0.0), alone),
        },
        "effects": {name: _effect(name, accounts) for name in _names(accounts)},
        "sensor": {
            name: value
            for name, value in plain(settings.sensor).items()
            if value != getattr(SensorSettings(), name)
        },
        "failures": {o.asset_id: o.message for o in outcomes if o.account is None},
    }


def write_report(path: Path, report: Mapping[str, Any]) -> None:
    """render_report.json."""
    write_json(path, report)


def print_report(report: Mapping[str, Any], console: Console) -> None:
    """A table of what was rendered, and one of the effects that were on."""
    images, each = report["images"], report["cpu_seconds_per_image"]
    table = Table("images", "number", "CPU s each", title="rendered in this run")
    table.add_row("all parts together", str(images["composite"]), _told(each["composite"]))
    table.add_row("parts alone", str(images["alone"]), _told(each["alone"]))
    if each["composite"] == 0.0:  # A backend without these stages.
        table = Table("images", "number", "CPU s each", title="rendered in this run")
        table.add_row("all", str(images["composite"] + images["alone"]), _told(each["all"]))
    console.print(table)
    on = {name: effect for name, effect in report["effects"].items() if effect["assets"]}
    effects = Table("effect", "assets", "CPU s with", "CPU s without", "because")
    for name, effect in on.items():
        with_it, without = effect["composite_with"], effect["composite_without"]
        reasons = "; ".join(effect["reasons"][:2])
        effects.add_row(name, str(effect["assets"]), _told(with_it), _told(without), reasons)
    for name, value in report["sensor"].items():
        effects.add_row(
            f"sensor {name}", str(report["assets"]["rendered"]), "", "", f"up to {value}"
        )
    if effects.row_count:
        console.print(effects)


def _effect(name: str, accounts: Sequence[Account]) -> dict[str, Any]:
    on = [account for account in accounts if account.effects[name]["on"]]
    off = [account for account in accounts if not account.effects[name]["on"]]
    return {
        "assets": len(on),
        "reasons": sorted({str(account.effects[name]["why"]) for account in on or off}),
        "composite_with": _composite_seconds(on),
        "composite_without": _composite_seconds(off),
    }


def _composite_seconds(accounts: Sequence[Account]) -> float | None:
    """CPU seconds a composite image; None without any."""
    if not accounts or not all("composite" in account.cpu for account in accounts):
        return None
    seconds = sum(account.cpu["composite"] for account in accounts)
    return _share(seconds, sum(account.composites for account in accounts))


def _names(accounts: Sequence[Account]) -> list[str]:
    return sorted({name for account in accounts for name in account.effects})


def _summed(tables: Sequence[Mapping[str, float]]) -> dict[str, float]:
    names = sorted({name for table in tables for name in table})
    return {name: sum(table.get(name, 0.0) for table in tables) for name in names}


def _share(total: float, count: int) -> float:
    return total / count if count else 0.0


def _told(seconds: float | None) -> str:
    return "" if seconds is None else f"{seconds:.3f}"
