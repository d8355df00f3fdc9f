"""What varies among faucets."""

from dataclasses import dataclass

from artgen.generators.kit.mixer_handle import LeverStyle
from artgen.generators.kit.valve_handle import ValveStyle


@dataclass(frozen=True, kw_only=True)
class FaucetParams:
    """Sampled by category_rules/faucet.toml; lengths in m, angles in degrees."""

    kind: str
    body_radius: float
    body_height: float
    flange: float
    square: bool
    reach: float
    basin_reach: float
    arch: float
    drop: float
    lean: float
    tube: float
    spout_rise: float
    curve: str
    swivel: float
    fixed: bool
    pull_out: bool
    pull: float
    head: float
    lever: LeverStyle
    lever_length: float
    lever_rise: float
    cap: float
    swing: float
    lift: float
    valve: ValveStyle
    valve_size: float
    valve_height: float
    valve_turn: float
    bonnet: float
    centers: float
    plate_width: float
    wall_lever: bool
    lift_rod: bool
    swivel_friction: float
