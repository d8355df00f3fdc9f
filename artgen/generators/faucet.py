"""Faucets: single-lever mixers, high arcs with spray heads, bridges, center sets, wall mixers."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from artgen.articulation.types import Draft, DraftPart
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.faucet_kinds import KINDS
from artgen.generators.kit.faucet_params import FaucetParams
from artgen.generators.kit.faucet_works import used

PARAMS = FaucetParams
TWO_HANDLED = ("bridge", "center_set", "wall")


def build(p: FaucetParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest all is shut and the spout points to the user; +q opens a valve or lifts the lever."""
    works = KINDS[p.kind](p)
    looks = matched(p, surfaces)
    base = DraftPart(name="base", label="base", bodies=works.fixed)
    return Draft(
        category="faucet",
        parts=(base, *works.parts),
        joints=works.joints,
        surfaces=used(looks, works),
    )


def matched(p: FaucetParams, surfaces: Mapping[str, SurfaceSpec]) -> dict[str, SurfaceSpec]:
    """Levers of mixers wear the body's finish, as do handles but for white ceramic ones."""
    looks = dict(surfaces)
    ceramic = looks["trim"].metallic < 0.5 and p.kind in TWO_HANDLED and not p.wall_lever
    if not ceramic:
        looks["trim"] = replace(looks["metal"], name="trim")
    return looks


def legs_lean_on_arcs(p: FaucetParams) -> bool:
    """Only the leg of a round arc leans out; one with a spray head does so by little."""
    return p.lean == 0.0 or (p.curve == "arc" and not (p.pull_out and p.lean > 20.0))


def spouts_clear_the_handles(p: FaucetParams) -> bool:
    """A spout that swings over two handles passes above them; long levers do not meet it."""
    if p.kind == "center_set":
        return p.valve != "lever" or p.valve_size < 0.034
    return p.kind != "bridge" or p.curve != "swan"


INVARIANTS: Mapping[str, Callable[[FaucetParams], bool]] = {
    check.__name__: check for check in (legs_lean_on_arcs, spouts_clear_the_handles)
}
