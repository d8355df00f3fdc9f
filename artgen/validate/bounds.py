"""Every bound of the validators with its reason, as a TOML file states them."""

import tomllib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import Any

from artgen.core.errors import UsageError
from artgen.core.jsonio import content_hash

SHIPPED = Path(__file__).with_name("bounds.toml")


@dataclass(frozen=True)
class Bound:
    """A limit of a check, its unit, and why it is where it is."""

    value: float
    unit: str
    reason: str

    def at_most(self) -> str:
        """`<= value unit`."""
        return f"<= {self.value:g} {self.unit}".rstrip()

    def at_least(self) -> str:
        """`>= value unit`."""
        return f">= {self.value:g} {self.unit}".rstrip()


@dataclass(frozen=True, kw_only=True)
class Bounds:
    """All bounds by name; docs/validation.md shows the shipped ones in this order."""

    max_files: Bound
    max_bytes: Bound
    axis_norm: Bound
    full_turn: Bound
    least_turn: Bound
    smallest: Bound
    largest: Bound
    min_area: Bound
    uv_edge: Bound
    bounds_match: Bound
    glb_bounds: Bound
    hull_gap: Bound
    collision_reach: Bound
    density_low: Bound
    density_high: Bound
    triangle: Bound
    inertia_ratio: Bound
    integral: Bound
    agreement: Bound
    kinematics: Bound
    contact: Bound
    overlap: Bound
    settle_factor: Bound
    settle_floor: Bound
    ground: Bound
    hinge_share: Bound
    hinge_slack: Bound
    travel: Bound
    grip_near: Bound
    grip_pull: Bound
    closed_play: Bound
    apart: Bound
    axis_norm_foreign: Bound
    mass_ratio: Bound
    uniform_ratio: Bound
    pinocchio: Bound
    gap_slack: Bound
    rest_play: Bound
    axis_slip: Bound
    axis_slant: Bound
    hollow_least: Bound
    open_interior: Bound
    open_interior_foreign: Bound
    opened: Bound
    closed: Bound
    drive_time: Bound
    energy_drift: Bound
    overshoot: Bound
    speed: Bound
    hold_margin: Bound
    tilt: Bound
    drop: Bound

    @property
    def digest(self) -> str:
        """sha256 of all values, units and reasons."""
        return content_hash(asdict(self))


@cache
def shipped_bounds() -> Bounds:
    """The bounds that come with the package."""
    return Bounds(**_entries(SHIPPED))


def load_bounds(path: Path | None) -> Bounds:
    """The shipped bounds, with those that a TOML file states in their place.

    Raises:
        UsageError: the file cannot be read, or holds a bound that is unknown or lacks a reason.
    """
    return shipped_bounds() if path is None else replace(shipped_bounds(), **_entries(path))


def _entries(path: Path) -> dict[str, Bound]:
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise UsageError(f"{path}: cannot be read as TOML: {error}") from error
    known = [field.name for field in fields(Bounds)]
    for name in tables:
        if name not in known:
            raise UsageError(f"{path}: [{name}] is no bound; known: {', '.join(known)}")
    return {name: _bound(path, name, table) for name, table in tables.items()}


def _bound(path: Path, name: str, table: object) -> Bound:
    entry: Mapping[str, Any] = table if isinstance(table, dict) else {}
    value, unit, reason = (entry.get(key) for key in ("value", "unit", "reason"))
    number = isinstance(value, int | float) and not isinstance(value, bool) and value == value
    if set(entry) != {"value", "unit", "reason"} or not number:
        raise UsageError(
            f"{path}: [{name}] holds {sorted(entry)}; expected value (a number), unit, and reason"
        )
    if not (isinstance(unit, str) and isinstance(reason, str) and reason.strip()):
        raise UsageError(f"{path}: [{name}] needs a unit and a reason in words")
    return Bound(float(entry["value"]), unit, reason)
