"""What a kettle's numbers mean: places of rim, lid, handle, spout and stand."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from artgen.generators.kit.vessel import Ring, Vessel

STOVE = ("dome", "enamel")
"""Forms that stand on a stove; the others are electric and stand on a power base."""
FEET = 0.0020
"""m; rubber under a power base."""
AFLOAT = 0.0008
"""m; between a jug and its base, a lid and its rim."""
FLANGE = 0.0032
"""m; thickness of a lid's flange."""
PROFILES: Mapping[str, tuple[tuple[float, float], ...]] = {
    "steel": ((0.0, 1.0), (0.35, 0.97), (0.7, 0.90), (1.0, 0.80)),
    "plastic": ((0.0, 0.97), (0.2, 1.0), (0.55, 0.99), (0.8, 0.93), (1.0, 0.86)),
    "glass": ((0.0, 1.0), (0.5, 1.0), (0.8, 0.99), (1.0, 0.96)),
    "retro": ((0.0, 1.0), (0.25, 1.0), (0.5, 0.95), (0.8, 0.83), (1.0, 0.74)),
}
"""Height along the wall and radius there, as shares; `taper` exaggerates them."""


@dataclass(frozen=True, kw_only=True)
class KettleParams:
    """Sampled by category_rules/kettle.toml; lengths in m, angles in degrees."""

    form: str
    height: float
    radius: float
    taper: float
    wall: float
    skirt: float
    lip: float
    lip_start: float
    stand_height: float
    stand_margin: float
    handle: str
    handle_gap: float
    handle_width: float
    handle_thickness: float
    handle_end: float
    crown: float
    lid: str
    opening_deg: float
    lift: float
    switch: str
    switch_deg: float
    gauge: bool
    gauge_share: float
    belly: float
    spout_deg: float
    spout_radius: float
    bail: str
    fold_deg: float
    flap_deg: float
    brand: int

    @property
    def electric(self) -> bool:
        """Whether it stands on a power base."""
        return self.form not in STOVE

    @property
    def ground(self) -> float:
        """z of an electric jug's underside."""
        return FEET + self.stand_height + AFLOAT

    @property
    def rim(self) -> float:
        """z of an electric jug's upper edge."""
        return self.ground + self.height

    @cached_property
    def jug(self) -> Vessel:
        """The wall above the skirt, with the pouring lip towards -y."""
        low = self.ground + self.skirt
        tall = self.rim - low
        shape = PROFILES[self.form]
        rings = []
        for k in range(9):
            share = k / 8.0
            radius = self.radius * self._share(shape, share)
            rise = max(0.0, (share - self.lip_start) / (1.0 - self.lip_start))
            z, lip = low + share * tall, self.lip * rise**1.6
            rings.append(Ring(z=z, half=(radius, radius), lip=lip))
        return Vessel(rings=tuple(rings), wall=self.wall, floor=0.003, segments=56)

    def _share(self, shape: tuple[tuple[float, float], ...], at: float) -> float:
        for (a, ra), (b, rb) in pairwise(shape):
            if at <= b:
                part = (at - a) / (b - a)
                smooth = part * part * (3.0 - 2.0 * part)
                return 1.0 - (1.0 - (ra + smooth * (rb - ra))) * self.taper
        return 1.0 - (1.0 - shape[-1][1]) * self.taper

    @property
    def mouth(self) -> float:
        """Radius of the jug's wall at its rim, outside."""
        return self.jug.mouth.half[0]

    def wall_at(self, z: float) -> float:
        """Radius of the jug's outside at `z`."""
        return self.jug.at_height(z).half[0]

    @property
    def hinge(self) -> tuple[float, float]:
        """(y, z) of the lid's axis."""
        return self.mouth + 0.0046, self.rim + AFLOAT + FLANGE

    @property
    def handle_path(self) -> tuple[tuple[float, float], ...]:
        """(y, z) corners of the middle line of an electric jug's handle."""
        top = self.rim - 0.0018 - self.handle_thickness / 2.0
        away = self.handle_gap + self.handle_thickness / 2.0
        low = self.ground + self.skirt + 0.018 + self.handle_end * 0.3 * self.height
        root = self.wall_at(top) - 0.004
        if self.handle == "open":
            low = self.ground + self.skirt + (0.10 + 0.15 * self.handle_end) * self.height
            return (root, top), (self.mouth + away, top), (self.wall_at(low) + away, low)
        if self.handle == "arch":
            return (
                (root, top), (self.mouth + 0.5 * away, top), (self.wall_at(low) + 1.25 * away,
                0.62 * top + 0.38 * low), (self.wall_at(low) + 0.55 * away, low),
                (self.wall_at(low) - 0.004, low),
            )  # fmt: skip
        return (
            (root, top), (self.mouth + away, top), (self.wall_at(low) + away, low),
            (self.wall_at(low) - 0.004, low),
        )  # fmt: skip


def parts_suit_form(p: KettleParams) -> bool:
    """Lids that are lifted off have no button; glass and slim jugs have room for their gauge."""
    if p.form == "glass" and p.gauge:
        return False
    return p.skirt > 0.024 or p.switch != "foot"


def mouth_takes_a_hand(p: KettleParams) -> bool:
    """The rim stays wide enough to be filled and cleaned."""
    return not p.electric or p.mouth > 0.047


INVARIANTS: Mapping[str, Callable[[KettleParams], bool]] = {
    check.__name__: check for check in (parts_suit_form, mouth_takes_a_hand)
}
