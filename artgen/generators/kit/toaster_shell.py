"""A toaster's body: shell or steel wrap with end caps, plinth, feet, top plate, lever channels."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from artgen.articulation.types import Body
from artgen.generators.kit.board import Stock
from artgen.generators.kit.bread_chamber import BreadChamber
from artgen.generators.kit.lofted_shell import crown_steps, plan, stacked
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cylinder, prism, slab, union

FACE = 0.004
"""m; thickness of the end face that the lever's stem passes through."""
POCKET = (0.003, 0.017)
"""m above the feet; the crumb tray's room."""
PLINTH = 0.021
"""m above the feet; top of the plinth."""
CHANNEL = 0.009
"""m; half of a channel's width."""
WRAP = 0.0012
"""m; by which a steel wrap lies behind its end caps."""


@dataclass(frozen=True, kw_only=True)
class LeverWay:
    """Where a lever's stem and the carriage's tongue run: a slit in the face, a channel behind.

    Attributes:
        y: of both.
        slit: z from and to.
        channel: z from and to.
    """

    y: float
    slit: tuple[float, float]
    channel: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class ToasterShell:
    """The fixed body; slots along x, levers on the +x face.

    Attributes:
        style: `one_piece`, or `wrap` for sheet metal between two end caps.
        length: along x, m.
        width: along y.
        foot: height of the feet.
        corner: radius of the upright edges.
        crown: radius of the upper edges.
        cap: length of an end cap along x.
    """

    style: str
    length: float
    width: float
    foot: float
    corner: float
    crown: float
    cap: float
    chamber: BreadChamber
    ways: tuple[LeverWay, ...]

    @property
    def end(self) -> float:
        """x of the face with the levers."""
        return self.length / 2.0

    @property
    def bottom(self) -> float:
        """z where the shell begins."""
        return self.foot + PLINTH

    @property
    def pocket_half(self) -> float:
        """Half of the crumb tray's room along y."""
        return self.chamber.half - 0.002

    def bodies(
        self,
        shell: Stock,
        caps: Stock,
        plinth: Stock,
        metal: Stock,
        rubber: str,
        cuts: Sequence[Solid],
    ) -> tuple[Body, ...]:
        """All fixed pieces but the chamber's inside; `cuts` are wells of the controls."""
        room = union([self.chamber.room(), *self._channels(), *cuts])
        touch = tuple(self._panels())
        outside = self._loft(0.0)
        if self.style == "wrap":
            a, b = -self.end + self.cap, self.end - self.cap
            ends = union([_from(-1.0, a - 0.0004), _from(b + 0.0004, 1.0)])
            covers = [
                shell.piece((self._loft(WRAP) & _from(a, b)) - room, grain="x"),
                *(caps.piece(piece, contact=()) for piece in ((outside & ends) - room).pieces()),
            ]
            covers[0] = shell.piece(covers[0].solid, contact=touch, grain="x")
        else:
            covers = [shell.piece(outside - room, contact=touch)]
        liner = Stock(surface=caps.surface, density=200.0, edge=0.0)
        covers += [liner.piece(tube) for tube in self._channel_liners()]
        return (*covers, self._plinth(plinth), self._top_plate(metal), *self._feet(rubber, plinth))

    def tray(self, pan: Stock, front: Stock) -> tuple[Body, ...]:
        """The crumb tray in its room: a shallow pan behind a front with a pull."""
        low, high = self.foot + POCKET[0] + 0.0015, self.foot + POCKET[1] - 0.0025
        x0, x1, half, wall = (
            -self.end + 0.006,
            self.chamber.front - 0.008,
            self.pocket_half - 0.0015,
            0.001,
        )
        boards = (
            ((x0, -half, low), (x1, half, low + wall)),
            ((x0, -half, low + wall), (x1, -half + wall, high)),
            ((x0, half - wall, low + wall), (x1, half, high)),
            ((x1 - wall, -half + wall, low + wall), (x1, half - wall, high)),
        )
        face = slab((-self.end + 0.002, -half, low - 0.0006), (x0 + 0.001, half, high + 0.001))
        pull = slab((-self.end - 0.008, -0.024, low), (-self.end + 0.003, 0.024, low + 0.003))
        lip = slab(
            (-self.end - 0.008, -0.024, low + 0.003), (-self.end - 0.0055, 0.024, low + 0.005)
        )
        return (
            *(pan.board(*corners) for corners in boards),
            front.piece(union([face, pull, lip]), contact=(face, pull, lip)),
        )

    def _loft(self, inset: float) -> Solid:
        y = self.width / 2.0 - inset
        top = self.chamber.top - inset
        crown = max(self.crown - inset, 0.001)
        return stacked(
            x=self.end,
            y=(-y, y),
            radii=(self.corner, self.corner),
            steps=crown_steps(self.bottom, top, crown, steps=3 if crown < 0.012 else 5),
        )

    def _coarse(self) -> Solid:
        """The shell for contact: its upper edge never runs into its corners, where short edges
        would leave hulls that rounding makes hollow."""
        crown = min(self.crown, 0.6 * self.corner)
        y = self.width / 2.0
        steps = crown_steps(self.bottom, self.chamber.top, crown, steps=2)
        return stacked(x=self.end, y=(-y, y), radii=(self.corner, self.corner), steps=steps)

    def _channels(self) -> list[Solid]:
        room = []
        for way in self.ways:
            inner = self.end - FACE
            room.append(
                slab(
                    (self.chamber.front - 0.002, way.y - CHANNEL, way.channel[0]),
                    (inner, way.y + CHANNEL, way.channel[1]),
                )
            )
            room.append(
                slab(
                    (inner - 0.001, way.y - 0.0037, way.slit[0]),
                    (self.end + 0.01, way.y + 0.0037, way.slit[1]),
                )
            )
        return room

    def _channel_liners(self) -> list[Solid]:
        """Dark walls of the channels, so that the slits do not show the shell's color."""
        x0, x1, wall = self.chamber.front + 0.001, self.end - FACE + 0.001, 0.0012
        return [
            slab((x0, way.y - CHANNEL, way.channel[0]), (x1, way.y + CHANNEL, way.channel[1]))
            - slab(
                (x0 - 1.0, way.y - CHANNEL + wall, way.channel[0] + wall),
                (x1 - wall, way.y + CHANNEL - wall, way.channel[1] - wall),
            )
            - slab((x0, way.y - 0.0037, way.slit[0]), (x1 + 1.0, way.y + 0.0037, way.slit[1]))
            for way in self.ways
        ]

    def _plinth(self, stock: Stock) -> Body:
        outline = plan(
            self.end, -self.width / 2.0, self.width / 2.0, (self.corner,) * 2, inset=0.003
        )
        solid = prism(outline, PLINTH).at(z=self.foot)
        low, high = (self.foot + h for h in POCKET)
        half, far = self.pocket_half, self.chamber.front - 0.004
        pocket = slab((-1.0, -half, low), (far, half, high))
        end, side = self.end - 0.003, self.width / 2.0 - 0.003
        inner = self.end - max(self.corner, 0.006)
        touch = (
            slab((-inner, -side, self.foot), (inner, side, low)),
            slab((-inner, -side, low), (inner, -half, self.bottom)),
            slab((-inner, half, low), (inner, side, self.bottom)),
            slab((far, -half, low), (end, half, self.bottom)),
        )
        return stock.piece(solid - pocket - self.chamber.room(), contact=touch)

    def _top_plate(self, metal: Stock) -> Body:
        """A thin plate around the slots with a raised rim at each."""
        c = self.chamber
        x0, x1 = c.slot_x
        half = c.middles[-1] + c.slot_width / 2.0
        outline = rounded_rectangle(x1 - x0 + 0.016, 2.0 * half + 0.014, 0.006, segments=3)
        middle = (x0 + x1) / 2.0
        flat = prism(outline, 0.002).at(middle, 0.0, c.top - 0.0012)
        rims = [
            slab(
                (x0 - 0.0018, y - c.slot_width / 2.0 - 0.0018, c.top - 0.0012),
                (x1 + 0.0018, y + c.slot_width / 2.0 + 0.0018, c.top + 0.0022),
            )
            for y in c.middles
        ]
        return metal.piece(union([flat, *rims]) - union(c.openings(0.0008)))

    def _feet(self, rubber: str, plinth: Stock) -> list[Body]:
        x, y = self.end - self.corner - 0.016, self.width / 2.0 - max(self.corner, 0.012) - 0.006
        stock = Stock(surface=rubber, density=1150.0, edge=0.001)
        feet = []
        for a, b in ((-x, -y), (x, -y), (-x, y), (x, y)):
            round_ = cylinder(0.009, self.foot + 0.001, segments=16).at(a, b)
            feet.append(
                stock.piece(
                    round_,
                    contact=(
                        slab((a - 0.0063, b - 0.0063, 0.0), (a + 0.0063, b + 0.0063, self.foot)),
                    ),
                )
            )
        return feet

    def _panels(self) -> list[Solid]:
        """Convex pieces of the shell around chamber, channels and slits: hulls at the corners,
        boxes between."""
        c, low, top, side = self.chamber, self.bottom, self.chamber.top, self.width / 2.0
        hull = self._coarse()
        spared = spared_corner(self.crown)
        walls = []
        for outer, inner in ((top - spared, side), (top, side - spared)):
            walls += [
                slab((c.back, -inner, low), (c.front, -c.half, outer)),
                slab((c.back, c.half, low), (c.front, inner, outer)),
            ]
        rear = slab((-self.end, -side, low), (c.back, side, top))
        corners = [rear, *self._front_corners()]
        return [*(hull & cell for cell in corners), *walls, *c.strips(), *self._front_cells()]

    def _front_corners(self) -> list[Solid]:
        """Left and right of all channels."""
        x0, x1, side, low, top = (
            self.chamber.front,
            self.end,
            self.width / 2.0,
            self.bottom,
            self.chamber.top,
        )
        left, right = self.ways[0].y - CHANNEL, self.ways[-1].y + CHANNEL
        return [slab((x0, -side, low), (x1, left, top)), slab((x0, right, low), (x1, side, top))]

    def _front_cells(self) -> list[Solid]:
        """The end between chamber and face, around each channel and slit."""
        x0, x1 = self.chamber.front, self.end
        low, top, inner = self.bottom, self.chamber.top, self.end - FACE
        under = top - spared_corner(self.crown)
        cells = []
        left = self.ways[0].y - CHANNEL
        for way in self.ways:
            a, b, (s0, s1), (c0, c1) = way.y - CHANNEL, way.y + CHANNEL, way.slit, way.channel
            if a > left:
                cells.append(slab((x0, left, low), (x1, a, under)))
            cells += [
                slab((x0, a, low), (inner, b, c0)),
                slab((x0, a, c1), (inner, b, under)),
                slab((inner, a, low), (x1, b, s0)),
                slab((inner, a, s1), (x1, b, under)),
                slab((inner, a, s0), (x1, way.y - 0.0037, s1)),
                slab((inner, way.y + 0.0037, s0), (x1, b, s1)),
            ]
            left = b
        return cells


def _from(a: float, b: float) -> Solid:
    return slab((a, -1.0, -1.0), (b, 1.0, 1.0))


def spared_corner(radius: float) -> float:
    """How far from a corner rounded by `radius` a box may begin so that it sticks out by 3.5 mm at
    most: (radius - d)^2 + radius^2 = (radius + 3.5 mm)^2."""
    reach = math.sqrt(0.007 * radius + 0.0035**2)
    return max(0.0, radius - reach)
