"""Frames of house doors: lining, stops, seal, architraves, threshold, a piece of wall."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from artgen.articulation.types import Body
from artgen.core.mesh import Floats
from artgen.generators.kit.board import Stock
from artgen.generators.kit.front_layout import Rect
from artgen.geometry.solid import Solid, loft, prism, slab, upright

Casing = Literal["flat", "bevel", "ogee", "stepped", "square_head"]
Profile = Sequence[tuple[float, float]]
PROFILES: Mapping[Casing, Profile] = {
    "flat": ((0, 0), (1, 0), (1, 1), (0, 1)),
    "bevel": ((0, 0), (1, 0), (1, 1), (0.16, 1), (0, 0.55)),
    "ogee": (
        (0, 0), (1, 0), (1, 1), (0.72, 1), (0.64, 0.72), (0.45, 0.62), (0.25, 0.58), (0.12, 0.52),
        (0.06, 0.42), (0, 0.4),
    ),
    "stepped": ((0, 0), (1, 0), (1, 1), (0.7, 1), (0.7, 0.72), (0.2, 0.72), (0.2, 0.5), (0, 0.5)),
    "square_head": ((0, 0), (1, 0), (1, 1), (0, 1)),
}  # fmt: skip
"""Section of an architrave: shares of its width, from the opening outwards, and thickness."""
REVEAL = 0.008
"""m; of the lining's edge that the architrave leaves bare, where hinges turn."""


@dataclass(frozen=True, kw_only=True)
class DoorFrame:
    """A lining around an opening, its face in the plane y = 0; lengths in m.

    Attributes:
        opening: clear opening between the linings, from the floor.
        depth: of the lining, along y.
        lining: its thickness.
        stop: y of the face that the leaf closes against; None without stops.
        casing: kind of architrave.
        casing_size: its width and thickness.
    """

    opening: Rect
    depth: float
    lining: float
    stop: float | None
    casing: Casing
    casing_size: tuple[float, float]

    def bodies(self, wood: Stock, seal: Stock) -> tuple[Body, ...]:
        """Lining, stops, seal and architraves of both faces."""
        return (*self._lining(wood), *self._stops(wood, seal), *self.trims(wood))

    def trims(self, wood: Stock) -> tuple[Body, ...]:
        """Architraves of both faces."""
        return (*self._casing(wood, front=True), *self._casing(wood, front=False))

    def _lining(self, wood: Stock) -> list[Body]:
        o, t = self.opening, self.lining
        jambs = [slab((x, 0.0, 0.0), (x + t, self.depth, o.z1)) for x in (o.x0 - t, o.x1)]
        head = slab((o.x0 - t, 0.0, o.z1), (o.x1 + t, self.depth, o.z1 + t))
        return [wood.piece(s, contact=(s,)) for s in (*jambs, head)]

    def _stops(self, wood: Stock, seal: Stock) -> list[Body]:
        """Strips that the leaf closes against, a bead of rubber in their front edge."""
        if self.stop is None:
            return []
        o, w, y0, y1 = self.opening, 0.013, self.stop, min(self.stop + 0.035, self.depth)
        strips = [
            slab((o.x0, y0, 0.0), (o.x0 + w, y1, o.z1)),
            slab((o.x1 - w, y0, 0.0), (o.x1, y1, o.z1)),
            slab((o.x0 + w, y0, o.z1 - w), (o.x1 - w, y1, o.z1)),
        ]
        inset, y = 0.003, y0 + 0.0005
        beads = [
            slab((o.x0 + inset, y - 0.0014, 0.0), (o.x0 + 0.010, y, o.z1 - inset)),
            slab((o.x1 - 0.010, y - 0.0014, 0.0), (o.x1 - inset, y, o.z1 - inset)),
            slab((o.x0 + 0.010, y - 0.0014, o.z1 - 0.010), (o.x1 - 0.010, y, o.z1 - inset)),
        ]
        rubber = [seal.piece(bead) for bead in beads]
        return [*rubber, *(wood.piece(strip, contact=(strip,)) for strip in strips)]

    def _casing(self, wood: Stock, *, front: bool) -> list[Body]:
        """Two standing architraves and one across, mitred or with a square head."""
        o, (w, t) = self.opening, self.casing_size
        inner = Rect(x0=o.x0 - REVEAL, x1=o.x1 + REVEAL, z0=0.0, z1=o.z1 + REVEAL)
        mitred = self.casing != "square_head"
        section = np.array(PROFILES[self.casing]) * (w, t)
        left = _standing(inner, section, mitred=mitred)
        left_box = slab((inner.x0 - w, -0.8 * t, 0.0), (inner.x0, 0.0, inner.z1))
        top_box = slab((inner.x0 - w, -0.8 * t, inner.z1), (inner.x1 + w, 0.0, inner.z1 + w))
        if mitred:
            rows = [(_across(inner, section), (top_box,))]
        else:
            rows = [(head, (head,)) for head in _square_head(inner, w, t)]
        middle = -(inner.x0 + inner.x1)
        rows += [
            (left, (left_box,)),
            (left.at(middle).mirrored("x"), (left_box.at(middle).mirrored("x"),)),
        ]
        plain = replace(wood, edge=0.0012)
        if front:
            return [plain.piece(solid, contact=contact) for solid, contact in rows]
        return [
            plain.piece(
                solid.mirrored("y").at(0.0, self.depth, 0.0),
                contact=tuple(piece.mirrored("y").at(0.0, self.depth, 0.0) for piece in contact),
            )
            for solid, contact in rows
        ]


def _standing(inner: Rect, section: Floats, *, mitred: bool) -> Solid:
    """The architrave left of an opening, in front of y = 0, its top cut at 45 degrees."""
    w, x, z = float(section[:, 0].max()), inner.x0, inner.z1
    bar = prism(np.array((x, 0.0)) - section, z + w)
    return bar & _mitre([(0.0, x - w), (0.0, x), (z, x), (z + (w if mitred else 0.0), x - w)])


def _across(inner: Rect, section: Floats) -> Solid:
    """The architrave over an opening, both ends cut at 45 degrees."""
    w, z = float(section[:, 0].max()), inner.z1
    length = inner.width + 2.0 * w
    bar = upright(prism(section[:, ::-1] * (-1.0, 1.0) + (0.0, z), length), "x")
    ends = [(z, inner.x0), (z, inner.x1), (z + w, inner.x1 + w), (z + w, inner.x0 - w)]
    return bar.at(inner.x0 - w) & _mitre(ends)


def _mitre(outline: Sequence[tuple[float, float]]) -> Solid:
    """An outline in (z, x), clockwise or not, through all depths."""
    points = np.array(outline)
    ahead = np.roll(points, -1, axis=0)
    area = float((points[:, 0] * ahead[:, 1] - ahead[:, 0] * points[:, 1]).sum())
    return upright(prism(points if area > 0.0 else points[::-1], 2.0), "y").at(0.0, -1.0, 0.0)


def _square_head(inner: Rect, width: float, thickness: float) -> tuple[Solid, ...]:
    """A head board between a thin fillet below and a cap above that stands out."""
    x0, x1, z = inner.x0 - width, inner.x1 + width, inner.z1
    return (
        slab((x0 - 0.008, -thickness - 0.008, z), (x1 + 0.008, 0.0, z + 0.012)),
        slab((x0, -thickness - 0.002, z + 0.012), (x1, 0.0, z + 1.35 * width)),
        slab(
            (x0 - 0.014, -thickness - 0.016, z + 1.35 * width),
            (x1 + 0.014, 0.0, z + 1.35 * width + 0.020),
        ),
    )


def threshold(opening: Rect, *, depth: float, height: float, stock: Stock) -> Body:
    """A sill between the linings, its edges sloped."""
    y = [(0.0, 0.0), (depth, 0.0), (depth, 0.4 * height), (depth - 0.02, height)]
    outline = np.array([*y, (0.02, height), (0.0, 0.4 * height)])
    rings = [np.c_[np.full(6, x), outline] for x in (opening.x0, opening.x1)]
    solid = loft(rings)
    return stock.piece(solid, contact=(solid,))


def wall(
    hole: Rect, *, side: tuple[float, float], above: float, front: float, back: float, stock: Stock
) -> Body:
    """A piece of wall around a hole that stands on the floor; `side`: its width left and right."""
    x0, x1, top = hole.x0 - side[0], hole.x1 + side[1], hole.z1 + above
    pieces = (
        slab((x0, front, 0.0), (hole.x0, back, top)),
        slab((hole.x1, front, 0.0), (x1, back, top)),
        slab((hole.x0, front, hole.z1), (hole.x1, back, top)),
    )
    solid = slab((x0, front, 0.0), (x1, back, top)) - slab(
        (hole.x0, front - 1.0, -1.0), (hole.x1, back + 1.0, hole.z1)
    )
    return stock.piece(solid, contact=pieces, grain="x")


def skirting(
    hole: Rect,
    *,
    side: tuple[float, float],
    inset: float,
    height: float,
    front: float,
    stock: Stock,
) -> list[Body]:
    """Boards along the foot of a wall, from its ends to the architraves, `inset` from the hole."""
    spans = ((hole.x0 - side[0], hole.x0 - inset), (hole.x1 + inset, hole.x1 + side[1]))
    return [
        stock.board((x0, front - 0.012, 0.0), (x1, front, height))
        for x0, x1 in spans
        if x1 - x0 > 0.01
    ]
