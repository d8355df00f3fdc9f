"""Hobs: gas burners under iron grates, cast hotplates, ceramic glass with printed zones."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from artgen.articulation.types import Body, Decal
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.density import ALUMINIUM, GLASS, STEEL
from artgen.generators.kit.printed import icon, line, printed, ring
from artgen.generators.kit.round_contact import round_boxes
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cone, cylinder, prism, slab, tube, union

GLAZING = 0.006
"""m; ceramic glass."""
SHEET = 0.004
"""m; a pressed steel top as drawn."""
GRATE = 0.010
"""m; width and height of iron bars."""
RISE = 0.030
"""m; from the steel top to the bottom of the grate's bars."""


@dataclass(frozen=True, kw_only=True)
class Hob:
    """A hob whose lower side lies on the plane z = `bottom`.

    Attributes:
        kind: key of `KINDS`.
        low: (x, y) of its front left corner, m.
        high: (x, y) of its rear right corner.
        bottom: z.
        zones: radii of the zones, in the order front left, rear left, rear right, front right.
    """

    kind: str
    low: tuple[float, float]
    high: tuple[float, float]
    bottom: float
    zones: tuple[float, float, float, float]

    @property
    def top(self) -> float:
        """z of the plate's face."""
        return self.bottom + (GLAZING if self.kind == "ceramic" else SHEET)

    @property
    def size(self) -> tuple[float, float]:
        """Width and depth."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @cached_property
    def places(self) -> tuple[tuple[float, float], ...]:
        """(x, y) of the zones."""
        (w, d), (x0, y0) = self.size, self.low
        left, right = x0 + 0.27 * w, x0 + 0.73 * w
        front, rear = y0 + 0.27 * d, y0 + 0.74 * d
        return (left, front), (left, rear), (right, rear), (right, front)

    def bodies(self) -> tuple[Body, ...]:
        """The plate and what stands on it; they wear `hob`, `metal`, `burner` and `iron`."""
        w, d = self.size
        thick = self.top - self.bottom
        plate = prism(rounded_rectangle(w, d, 0.006, segments=3), thick).at(
            self.low[0] + w / 2.0, self.low[1] + d / 2.0, self.bottom
        )
        contact = slab((*self.low, self.bottom), (*self.high, self.top))
        glass = self.kind == "ceramic"
        body = Body(
            solid=plate,
            surface="hob",
            density=GLASS if glass else STEEL * 0.0009 / SHEET,
            edge=0.0012 if glass else 0.0015,
            collision=(contact,),
            decal=self._decal() if glass else None,
        )
        return body, *KINDS[self.kind](self)

    def print(self, *, style: int) -> SurfaceSpec:
        """The zones on ceramic glass: rings, crosses or dotted corners; touch signs in front."""
        (w, d), ink = self.size, "#9a9da1"
        marks = []
        for (x, y), radius in zip(self.places, self.zones, strict=True):
            u, v = x - self.low[0], y - self.low[1]
            marks.append(ring((u, v), radius, width=0.0012, ink=ink))
            if style == 1:
                marks.append(ring((u, v), 0.62 * radius, width=0.0010, ink=ink))
            if style == 2:
                for du, dv in ((0.012, 0.0), (0.0, 0.012)):
                    marks.append(line([(u - du, v - dv), (u + du, v + dv)], width=0.0012, ink=ink))
        glyphs = ("power", "lock", "clock", "star")
        for k, glyph in enumerate(glyphs):
            marks.append(icon((w / 2.0 + 0.022 * (k - 1.5), 0.022), glyph, size=0.009, ink=ink))
        return printed("hob", (w, d), background="#0b0c0d", marks=marks, roughness=0.07)

    def _decal(self) -> Decal:
        return Decal(
            origin=(*self.low, self.top), right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=self.size
        )


def _ceramic(hob: Hob) -> tuple[Body, ...]:
    """A steel trim around the glass."""
    w, d = hob.size
    frame = prism(
        rounded_rectangle(w + 0.006, d + 0.006, 0.008, segments=3), GLAZING - 0.001,
        holes=[rounded_rectangle(w, d, 0.006, segments=3)],
    )  # fmt: skip
    at = frame.at(hob.low[0] + w / 2.0, hob.low[1] + d / 2.0, hob.bottom)
    return (Body(solid=at, surface="metal", density=ALUMINIUM),)


def _plates(hob: Hob) -> tuple[Body, ...]:
    """Cast-iron hotplates in steel rims, each with its recessed middle."""
    rims, plates = [], []
    touch: list[Solid] = []
    for (x, y), radius in zip(hob.places, hob.zones, strict=True):
        r = 0.92 * radius
        rims.append(tube(r + 0.005, r, 0.007, segments=36).at(x, y, hob.top - 0.001))
        disc = cone(r, r - 0.003, 0.012, segments=36) - cylinder(0.24 * r, 0.01, segments=16).at(
            z=0.0105
        )
        plates.append(disc.at(x, y, hob.top - 0.001))
        touch += round_boxes(r, hob.top, hob.top + 0.011, at=(x, y))
    return (
        Body(solid=union(rims), surface="metal", density=STEEL),
        Body(solid=union(plates), surface="iron", density=7100.0 * 0.8, collision=tuple(touch)),
    )


def _gas(hob: Hob) -> tuple[Body, ...]:
    """Burner crowns with caps below two grates of iron bars."""
    crowns, caps = [], []
    for (x, y), radius in zip(hob.places, hob.zones, strict=True):
        r = 0.50 * radius
        well = cone(1.35 * r, 1.15 * r, 0.004, segments=20)
        crown = cylinder(r, 0.016, segments=20)
        crowns.append(union([well, crown]).at(x, y, hob.top - 0.0005))
        cap = cone(0.92 * r, 0.80 * r, 0.007, segments=20)
        caps.append(cap.at(x, y, hob.top + 0.0155))
    grates = [_grate(hob, side) for side in (0, 1)]
    return (
        Body(solid=union(crowns), surface="burner", density=ALUMINIUM * 0.7),
        Body(solid=union(caps), surface="iron", density=5000.0),
        Body(
            solid=union([bar for grate in grates for bar in grate]),
            surface="iron",
            density=7100.0,
            collision=tuple(bar for grate in grates for bar in grate[:4]),
        ),
    )


def _grate(hob: Hob, side: int) -> Sequence[Solid]:
    """Frame, feet, and fingers over two burners."""
    (w, _), inset, half = hob.size, 0.022, GRATE / 2.0
    middle = hob.low[0] + w / 2.0
    x0 = hob.low[0] + inset if side == 0 else middle + 0.003
    x1 = middle - 0.003 if side == 0 else hob.high[0] - inset
    y0, y1 = hob.low[1] + inset, hob.high[1] - inset
    low, high = hob.top + RISE, hob.top + RISE + GRATE
    frame = [
        slab((x0, y0, low), (x1, y0 + GRATE, high)),
        slab((x0, y1 - GRATE, low), (x1, y1, high)),
        slab((x0, y0, low), (x0 + GRATE, y1, high)),
        slab((x1 - GRATE, y0, low), (x1, y1, high)),
    ]
    feet = [
        slab((x, y, hob.top - 0.001), (x + GRATE, y + GRATE, high))
        for x in (x0, x1 - GRATE)
        for y in (y0, y1 - GRATE)
    ]
    y = (y0 + y1) / 2.0
    bars = [slab((x0, y - half, low), (x1, y + half, high))]
    for u, v in [hob.places[k] for k in ((0, 1) if side == 0 else (2, 3))]:
        reach = 0.024
        bars += [
            slab((x0, v - 0.7 * half, low), (u - reach, v + 0.7 * half, high)),
            slab((u + reach, v - 0.7 * half, low), (x1, v + 0.7 * half, high)),
            slab((u - 0.7 * half, v + reach, low), (u + 0.7 * half, y1 if v > y else y, high)),
            slab((u - 0.7 * half, y if v > y else y0, low), (u + 0.7 * half, v - reach, high)),
        ]
    return [*frame, *feet, *bars]


KINDS: Mapping[str, Callable[[Hob], tuple[Body, ...]]] = {
    "gas": _gas,
    "plates": _plates,
    "ceramic": _ceramic,
}


def zone_radii(scale: float, order: int) -> tuple[float, float, float, float]:
    """Radii of four zones for pans of 14.5 to 21 cm, scaled, dealt in one of four orders."""
    radii = [0.0725, 0.090, 0.0725, 0.105]
    turned = [scale * radii[(k + order) % 4] for k in range(4)]
    return turned[0], turned[1], turned[2], turned[3]
