"""What a toaster's numbers mean: its chamber, shell, lever ways and control face."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from artgen.generators.kit.bread_chamber import BreadChamber
from artgen.generators.kit.toaster_face import (
    ToasterFace,
    broad_face,
    divided_face,
    stacked_face,
)
from artgen.generators.kit.toaster_shell import PLINTH, POCKET, LeverWay, ToasterShell

SLOTS = {"two": 2, "four": 4, "long": 1, "long_two": 2}
"""How many."""
LONG_MARGIN = 0.016
"""m; toasters with a single slot are not much narrower than others."""


@dataclass(frozen=True, kw_only=True)
class ToasterParams:
    """Sampled by category_rules/toaster.toml; lengths in m."""

    form: str
    face: str
    style: str
    slot_length: float
    long_factor: float
    slot_width: float
    slot_gap: float
    margin: float
    mechanism: float
    rear: float
    height: float
    foot: float
    corner: float
    crown: float
    roundness: float
    cap: float
    travel: float
    lift_ratio: float
    lever: str
    lever_size: float
    lever_drop: float
    preload: float
    dial: Literal["bar", "ribbed", "drum"]
    dial_radius: float
    dial_height: float
    buttons: int
    round_caps: bool
    full_plate: bool
    rows: int
    guards: int
    plate: str
    slices: int
    brand: int

    @cached_property
    def chamber(self) -> BreadChamber:
        """Placed so that the body's middle is at x = 0."""
        length = self.slot_length * (self.long_factor if self.form.startswith("long") else 1.0)
        chamber = BreadChamber(
            back=0.0,
            slot_length=length,
            slot_width=self.slot_width,
            gap=self.slot_gap,
            slots=SLOTS[self.form],
            floor=self.foot + POCKET[1],
            top=self.height,
            lip=0.005,
        )
        return replace(chamber, back=(self.rear - self.mechanism - chamber.front) / 2.0)

    @property
    def width(self) -> float:
        """Across the slots, m."""
        beside = self.margin + (LONG_MARGIN if self.form == "long" else 0.0)
        return 2.0 * (self.chamber.middles[-1] + self.slot_width / 2.0 + beside)

    @property
    def lifted(self) -> float:
        """z of the racks at rest."""
        return self.foot + PLINTH + self.travel * self.lift_ratio

    @cached_property
    def shell(self) -> ToasterShell:
        """The fixed body; retro ones have round edges as far as the slots let them."""
        retro = self.style == "retro"
        reach = self.roundness * (self.margin - 0.008)
        z = self.height - self.lever_drop
        ways = tuple(
            LeverWay(
                y=y,
                slit=(z - self.travel - 0.0042, z + 0.0042),
                channel=(z - self.travel - 0.0086, z + 0.0086),
            )
            for y in self.lever_places
        )
        return ToasterShell(
            style="wrap" if self.style == "wrap" else "one_piece",
            length=self.chamber.front - self.chamber.back + self.rear + self.mechanism,
            width=self.width,
            foot=self.foot,
            corner=0.014 + reach if retro else self.corner,
            crown=reach if retro else self.crown,
            cap=self.cap,
            chamber=self.chamber,
            ways=ways,
        )

    @property
    def served(self) -> tuple[tuple[float, ...], ...]:
        """The slots (y) that each lever serves."""
        middles = self.chamber.middles
        return (middles[:2], middles[2:]) if self.form == "four" else (middles,)

    @property
    def lever_places(self) -> tuple[float, ...]:
        """y of the levers."""
        if self.face == "divided" and self.form != "four":
            aside = 0.27 * (self.width - 2.0 * self.corner)
            return (min(aside, self.chamber.half - 0.0065),)
        return tuple(sum(group) / len(group) for group in self.served)

    @property
    def control_face(self) -> ToasterFace:
        """Where the controls sit."""
        shell = self.shell
        low, high = shell.bottom + 0.003, self.height - shell.crown - 0.002
        half = self.width / 2.0 - shell.corner
        levers = [(way.y, *way.slit) for way in shell.ways]
        full = self.full_plate
        if self.face == "broad":
            return broad_face(
                front=-self.width / 2.0,
                right=shell.end - max(shell.corner, self.cap + 0.002),
                low=low + 0.004,
                buttons=self.buttons,
                radius=self.dial_radius,
            )
        if self.face == "divided" and len(levers) == 1:
            return divided_face(
                end=shell.end,
                half=half,
                low=low,
                high=high,
                lever=levers[0],
                buttons=self.buttons,
                radius=self.dial_radius,
                full=full,
            )
        return stacked_face(
            end=shell.end,
            half=half,
            low=low,
            high=high,
            levers=levers,
            buttons=self.buttons,
            radius=self.dial_radius,
            full=full,
        )
