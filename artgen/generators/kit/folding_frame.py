"""Frames of folding chairs: front legs that carry the back, and rear legs that cross them."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.bent_strip import bent_strip
from artgen.generators.kit.board import Stock
from artgen.generators.kit.chair_member import FLOOR, Member
from artgen.generators.kit.cushion import COARSE, Warp, pad, plan, upholstered
from artgen.generators.kit.fold_linkage import FoldLinkage, Point
from artgen.generators.kit.wire_rack import bent
from artgen.geometry.solid import Solid, box, cylinder, loft, slab, union, wire

PIN = 0.0040
"""m; radius of the pins."""
PLAY = 0.0008
GROOVE = 0.0080
"""m; depth of the groove in a bar, or thickness of a tube's slotted strap and its pin's reach."""
STRAP = 0.0030
CAP = 0.0018
"""m; wall of the feet's caps."""
FOOT = 0.030
BackKind = Literal["slats", "panel", "padded", "plastic"]


@dataclass(frozen=True, kw_only=True)
class FoldingFrame:
    """Both frames of a chair; all in m.

    Attributes:
        linkage: where they turn.
        width: over the front legs.
        member: section of the front legs and the back's posts.
        leg: section of the rear legs, which stand inside.
        bend: how far up the line the posts kick upright.
        kick: by how much they do, rad.
        top: height of the posts.
        back: what spans the posts.
        back_height: of that.
        slats: how many, where it is slats.
        bow: how far the back is hollowed.
        hand_hole: whether there is a hole to carry it by.
        rungs: stretchers of the front legs and of the rear legs.
    """

    linkage: FoldLinkage
    width: float
    member: Member
    leg: Member
    bend: float
    kick: float
    top: float
    back: BackKind
    back_height: float
    slats: int
    bow: float
    hand_hole: bool
    rungs: tuple[int, int]

    @property
    def post_x(self) -> float:
        """x of the middle of the front leg at +x."""
        return (self.width - self.member.thick) / 2.0

    @property
    def inner(self) -> float:
        """x of the front leg's inner face."""
        return self.post_x - self.member.thick / 2.0

    @property
    def leg_x(self) -> float:
        """x of the middle of the rear leg at +x."""
        return self.inner - (0.0085 if self.member.round else 0.0055) - self.leg.thick / 2.0

    @property
    def seat_half(self) -> float:
        """Half the room between the rear legs, less play."""
        return self.leg_x - self.leg.thick / 2.0 - 0.003

    @property
    def pin_reach(self) -> float:
        """x to which the seat's sliding pin reaches into its guide."""
        return self.inner - 0.0006 if self.member.round else self.inner + GROOVE - 0.002

    @property
    def _upper_lean(self) -> float:
        return self.linkage.lean - self.kick

    @property
    def _upper_length(self) -> float:
        return (self.top - self.linkage.on_frame(self.bend)[1]) / math.cos(self._upper_lean)

    @property
    def back_low(self) -> float:
        """How far up the frame's line the back begins."""
        return self.bend + self._upper_length - self.back_height - 0.018

    def _path(self) -> list[Point]:
        """A front leg with its post, from below the floor to the top."""
        knee = self.linkage.on_frame(self.bend)
        rise = self._upper_length
        end = (knee[0] + rise * math.sin(self._upper_lean), self.top)
        return [self.linkage.on_frame(-self.linkage.frame_reach - 0.03), knee, end]

    @property
    def back_top(self) -> Point:
        """(y, z) of the middle of the back's upper edge."""
        y, z = self.linkage.on_frame(self.bend)
        lean, rise = self._upper_lean, self._upper_length - 0.018
        cos, sin = math.cos(lean), math.sin(lean)
        return y + rise * sin + self.bow * cos, z + rise * cos - self.bow * sin

    def base_bodies(
        self, stock: Stock, metal: Stock, rubber: Stock, back: Stock, soft: Stock
    ) -> list[Body]:
        """Front legs, posts, back, rungs, guides and rivets."""
        posts = self._posts(stock)
        link = self.linkage
        along = np.array((math.sin(link.lean), math.cos(link.lean)))
        bodies = [*self._back(back, soft), *posts]
        bodies += [self._rung(stock, link.on_frame(-share * link.frame_reach,
                                                   self._rung_offset), link.lean, self.post_x)
                   for share in _shares(self.rungs[0])]  # fmt: skip
        for side in (-1.0, 1.0):
            if self.member.round:
                bodies.append(metal.piece(self._strap(side)))
            cap = cylinder(0.0075, 0.0030, axis="x", segments=14)
            y, z = link.cross
            x = side * (self.post_x + self.member.thick / 2.0 - 0.0012) - (0.003 if side < 0 else 0)
            bodies.append(metal.piece(cap.at(x, y, z)))
            bodies.append(_capped(self.member, link.on_frame(-link.frame_reach), along,
                                  side * self.post_x, rubber))  # fmt: skip
        return bodies

    def _posts(self, stock: Stock) -> list[Body]:
        path, x = self._path(), self.post_x
        holes = self._holes()
        contact = [p for s in (-x, x) for p in self.member.contact(path, s)]
        if not self.member.round:
            right = self.member.solid(path, x, bend=0.05)
            return [
                stock.piece(union([right, right.mirrored("x")]) - holes, contact=tuple(contact))
            ]
        lower, knee, end = path
        corners = [(-x, *lower), (-x, *knee), (-x, *end), (x, *end), (x, *knee), (x, *lower)]
        tube = wire(bent(corners, 0.045), self.member.deep / 2.0, sides=12) & FLOOR
        across = slab((-x + 0.04, end[0] - 0.008, end[1] - 0.008),
                      (x - 0.04, end[0] + 0.008, end[1] + 0.008))  # fmt: skip
        return [stock.piece(tube - holes, contact=(*contact, across))]

    def _holes(self) -> Solid:
        """Bores for the rear legs' pins, and grooves for the seat's where the legs are bars."""
        y, z = self.linkage.cross
        reach = 0.6 * self.member.thick
        bore = cylinder(PIN + PLAY, reach + 0.01, axis="x", segments=16).at(self.inner - 0.01, y, z)
        cuts = (
            [bore] if self.member.round else [bore, self._slot(self.inner - 0.002, GROOVE + 0.002)]
        )
        both = union(cuts)
        return both | both.mirrored("x")

    def _slot(self, x: float, width: float, *, over: float = 0.0) -> Solid:
        """The seat's pin's way along the line, from x on; `over` m larger all around."""
        link = self.linkage
        (near, far), (behind, before) = link.slide, link.stray
        ease = PIN + PLAY + over
        middle = (behind + before) / 2.0
        ends = [link.on_frame(near - ease, middle), link.on_frame(far + ease, middle)]
        thick = before - behind + 2.0 * ease
        return bent_strip(ends, bend=0.01, thickness=thick, width=width, across="x").at(
            x=x + width / 2
        )

    def _strap(self, side: float) -> Solid:
        """A slotted strap welded to the inner side of a tube."""
        low = self.inner - STRAP + 0.0010
        strap = self._slot(low, STRAP, over=0.006) - self._slot(low - 0.01, 0.02)
        return strap if side > 0 else strap.mirrored("x")

    @property
    def _rung_offset(self) -> float:
        return self.member.deep / 2.0 + (0.0070 if self.member.round else 0.005)

    def _rung(self, stock: Stock, at: Point, lean: float, x: float) -> Body:
        """A stretcher across: a slat on the bars' faces, a thin tube beside the tubes."""
        y, z = at
        touch = slab((-x, y - 0.0045, z - 0.0045), (x, y + 0.0045, z + 0.0045))
        if self.member.round:
            tube = cylinder(0.0075, 2.0 * x, axis="x", segments=10).at(-x, y, z)
            return stock.piece(tube, contact=(touch,))
        width = 2.0 * x + (self.leg.thick if x < self.inner else self.member.thick) - 0.001
        reach = 0.019
        path = [(y - reach * math.sin(lean), z - reach * math.cos(lean)),
                (y + reach * math.sin(lean), z + reach * math.cos(lean))]  # fmt: skip
        slat = bent_strip(path, bend=0.01, thickness=0.012, width=width, across="x")
        return stock.piece(slat, contact=(touch,))

    def _place_back(self, local: Solid, rise: float) -> Solid:
        """From (across, front to rear, up the post) about a point `rise` m above the knee."""
        y, z = self.linkage.on_frame(self.bend)
        lean = self._upper_lean
        turned = local.turned("x", -lean)
        return turned.at(0.0, y + rise * math.sin(lean), z + rise * math.cos(lean))

    def _back(self, stock: Stock, soft: Stock) -> list[Body]:
        height, upper = self.back_height, self._upper_length
        if self.back == "slats":
            each = (height - 0.016 * (self.slats - 1)) / self.slats
            return [
                self._panel(stock, upper - 0.018 - each * (k + 0.5) - 0.016 * k, each, 0.013)
                for k in range(self.slats)
            ]
        rise = upper - 0.018 - height / 2.0
        panel = self._panel(stock, rise, height, 0.008 if self.back == "padded" else 0.010)
        if self.back != "padded":
            return [panel]
        outline = plan(2.0 * self.inner - 0.016, height - 0.006, 0.03, segments=3)
        steps = upholstered(
            0.020, roll=0.010, crown=0.006, reach=height / 2.0 - 0.003, rings=COARSE
        )
        return [panel, soft.piece(self._place_back(pad(outline, steps, self._hollow(0.004)), rise))]

    def _panel(self, stock: Stock, rise: float, height: float, thick: float) -> Body:
        """A hollowed board or sheet between the posts."""
        bow, half = self.bow, thick / 2.0
        ease = 0.3 * half
        section = np.array([(-half, ease), (-half + ease, 0.0), (half - ease, 0.0), (half, ease)])
        section = np.concatenate([section, (section * (1.0, -1.0) + (0.0, height))[::-1]])
        across = np.linspace(-self.post_x, self.post_x, 8)
        sag = bow * (1.0 - (across / self.post_x) ** 2)
        rings = [
            np.c_[np.full(8, x), section + np.array((y, -height / 2.0))]
            for x, y in zip(across, sag, strict=True)
        ]
        solid = loft(rings)
        if self.hand_hole and height > 0.09:
            hole = box((0.11, 0.2, 0.026), at=(0.0, 0.0, 0.5 * height - 0.052))
            solid = solid - hole
        y0, y1 = 0.30 * bow - half, 0.70 * bow + half
        x = self.inner - 0.002
        touch = slab((-x, y0, 0.004 - height / 2.0), (x, y1, height / 2.0 - 0.004))
        return stock.piece(self._place_back(solid, rise), contact=(self._place_back(touch, rise),))

    def _hollow(self, lift: float) -> Warp:
        """Bends a flat pad so that its middle lies behind its sides."""

        def bend(flat: Floats) -> Floats:
            sag = self.bow * (1.0 - (flat[:, 0] / self.post_x) ** 2)
            return np.c_[flat[:, 0], sag - flat[:, 2] - lift, flat[:, 1]]

        return bend

    def leg_bodies(self, stock: Stock, metal: Stock, rubber: Stock) -> list[Body]:
        """The rear legs with their pins, rungs and feet."""
        link, x = self.linkage, self.leg_x
        path = [link.on_legs(link.legs_reach + 0.03), link.on_legs(-link.arm - 0.017)]
        y, z = link.hinge
        bore = cylinder(PIN + PLAY, 0.2, axis="x", segments=16).at(x - 0.1, y, z)
        right = self.leg.solid(path, x, bend=0.01) - bore
        contact = [p for s in (-x, x) for p in self.leg.contact(path, s)]
        offset = self._rung_offset - (self.member.deep - self.leg.deep) / 2.0
        rungs = [self._rung(stock, link.on_legs(share * link.legs_reach, offset), -link.rake, x)
                 for share in _shares(self.rungs[1])]  # fmt: skip
        along = np.array((-math.sin(link.rake), math.cos(link.rake)))
        feet = [_capped(self.leg, link.on_legs(link.legs_reach), along, s, rubber) for s in (-x, x)]
        pins = self._cross_pin()
        return [
            stock.piece(union([right, right.mirrored("x")]), contact=tuple(contact)),
            *rungs,
            *feet,
            metal.piece(pins | pins.mirrored("x")),
        ]

    def _cross_pin(self) -> Solid:
        """From a head inside the rear leg into the front leg's bore."""
        y, z = self.linkage.cross
        start = self.leg_x - self.leg.thick / 2.0 - 0.0016
        end = self.inner + 0.45 * self.member.thick
        head = cylinder(0.0065, 0.0026, axis="x", segments=12).at(start, y, z)
        pin = cylinder(PIN, end - start, axis="x", segments=12).at(start, y, z)
        washer = cylinder(0.0075, 0.0015, axis="x", segments=12)
        return union([head, pin, washer.at(self.leg_x + self.leg.thick / 2.0 - 0.0003, y, z)])


def _capped(member: Member, end: Point, along: Floats, x: float, rubber: Stock) -> Body:
    """A rubber cap over a leg's end; `end` is where the leg's line meets the floor."""
    top = (float(end[0] + along[0] / along[1] * FOOT), FOOT)
    solid, touch = member.foot(top, along, x, wall=CAP)
    return rubber.piece(solid, contact=(touch,))


def _shares(count: int) -> tuple[float, ...]:
    """Places of rungs, as shares of the way down."""
    return ((), (0.72,), (0.50, 0.78))[count]
