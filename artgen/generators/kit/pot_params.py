"""What a cooking pot's numbers mean: its shell, its lid, and how it is made."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

from artgen.generators.kit.density import ALUMINIUM, STAINLESS
from artgen.generators.kit.pot_lid import PotLid
from artgen.generators.kit.pot_shell import PotShell

CAST_IRON = 7200.0
"""kg/m3."""
FORMS: Mapping[str, tuple[tuple[float, float], tuple[float, float]]] = {
    "stock": ((0.100, 0.140), (0.80, 1.00)),
    "sauce": ((0.070, 0.100), (0.48, 0.66)),
    "casserole": ((0.090, 0.140), (0.40, 0.52)),
    "dutch": ((0.095, 0.135), (0.42, 0.54)),
}
"""Radius, m, and height in diameters, from and to."""


@dataclass(frozen=True, kw_only=True)
class Make:
    """How pots of a kind are made.

    Attributes:
        outer: surface outside.
        inner: surface inside.
        wall: as drawn, m.
        real: what the wall's mass is that of, m.
        density: of its metal, kg/m3.
        disc: whether it has a sandwich bottom.
    """

    outer: str
    inner: str
    wall: float
    real: float
    density: float
    disc: bool


MAKES: Mapping[str, Make] = {
    "steel": Make(outer="sheet", inner="inside", wall=0.0018, real=0.0009, density=STAINLESS,
                  disc=True),
    "coated": Make(outer="paint", inner="coat", wall=0.0030, real=0.0026, density=ALUMINIUM,
                   disc=False),
    "enamel": Make(outer="enamel", inner="porcelain", wall=0.0016, real=0.0009, density=STAINLESS,
                   disc=False),
    "cast": Make(outer="enamel", inner="porcelain", wall=0.0044, real=0.0038, density=CAST_IRON,
                 disc=False),
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class PotParams:
    """Sampled by category_rules/cooking_pot.toml; lengths in m, angles in degrees."""

    form: str
    make: str
    size: float
    slenderness: float
    corner: float
    flare: float
    taper: float
    bottom: float
    handle: str
    handle_place: float
    loop_half: float
    loop_reach: float
    bar_width: float
    bar_thickness: float
    wire: float
    handle_length: float
    handle_rise: float
    ferrule: float
    helper: bool
    lid: str
    crown: float
    knob_radius: float
    knob_height: float
    arched: bool
    vent: bool
    opening_deg: float
    litres: int
    brand: int

    @property
    def made(self) -> Make:
        """Its metal and its surfaces."""
        return MAKES[self.make]

    @cached_property
    def shell(self) -> PotShell:
        """The body of the pot."""
        (small, large), (low, tall) = FORMS[self.form]
        radius = small + (large - small) * self.size
        make = self.made
        return PotShell(
            radius=radius,
            height=2.0 * radius * (low + (tall - low) * self.slenderness),
            wall=make.wall,
            corner=self.corner * (0.7 if self.form == "stock" else 1.0),
            flare=0.0 if self.make == "cast" else self.flare,
            disc=self.bottom if make.disc else 0.0,
            taper=self.taper if self.make in ("cast", "coated") else 0.0,
            density=make.density * make.real / make.wall,
        )

    @cached_property
    def cover(self) -> PotLid:
        """Its lid; cast pots have cast ones."""
        cast, make = self.make == "cast", self.made
        kind = "cast" if cast else self.lid.removeprefix("hinged_")
        thick = 0.0048 if cast else (0.0038 if kind == "glass" else 0.0016)
        share = 0.75 if cast else 0.55
        return PotLid(
            shell=self.shell,
            kind=kind,
            hinged=self.lid == "hinged_glass" and not cast,
            crown=self.crown * self.shell.radius,
            collar=0.007 if self.form != "dutch" else 0.005,
            knob=(self.knob_radius, self.knob_height),
            arched=self.arched and not cast,
            thick=thick,
            density=make.density * share,
            vent=self.vent and kind == "glass",
            opening=math.radians(self.opening_deg),
        )

    @property
    def handle_z(self) -> float:
        """Height of the handles' middle."""
        span = self.shell.height
        if self.handle == "folding":
            return span - 0.030
        return span - 0.022 - self.handle_place * 0.14 * span

    @property
    def skin(self) -> str:
        """Surface of the lid's dome."""
        return "glass" if self.cover.kind == "glass" else self.made.outer


def makes_suit_forms(p: PotParams) -> bool:
    """Dutch ovens are cast and nothing else is; stock pots are of sheet."""
    if (p.form == "dutch") != (p.make == "cast"):
        return False
    return p.form != "stock" or p.make in ("steel", "enamel")


def handles_suit_forms(p: PotParams) -> bool:
    """Saucepans have a long handle, and they alone; cast pots have cast lugs."""
    if (p.form == "sauce") != (p.handle == "long"):
        return False
    return (p.handle == "lug") == (p.make == "cast")


def folded_loops_clear_the_floor(p: PotParams) -> bool:
    """Loops that hang down end above the ground."""
    return p.handle != "folding" or p.handle_z - p.loop_reach - 0.012 > 0.012


INVARIANTS: Mapping[str, Callable[[PotParams], bool]] = {
    check.__name__: check
    for check in (makes_suit_forms, handles_suit_forms, folded_loops_clear_the_floor)
}
