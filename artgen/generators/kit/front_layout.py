"""How the face of a piece of furniture is divided: columns and rows of drawers, doors, niches.

A layout is a tree of splits; slicing it yields cells that tile the face exactly and the boards that
stand between their openings. The face is the x, z plane, seen from the front.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

import numpy as np

Kind = Literal["drawer", "door_left", "door_right", "pair", "open", "sliding", "flap"]
"""A drawer, a door hinged at its left or right edge, a pair of doors, an open niche, doors that
slide past each other, a flap that falls open."""


@dataclass(frozen=True, kw_only=True)
class Rect:
    """A rectangle of the face, m."""

    x0: float
    x1: float
    z0: float
    z1: float

    @property
    def width(self) -> float:
        """Along x."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Along z."""
        return self.z1 - self.z0

    @property
    def middle(self) -> tuple[float, float]:
        """(x, z)."""
        return (self.x0 + self.x1) / 2.0, (self.z0 + self.z1) / 2.0

    def shrunk(self, margin: float) -> "Rect":
        """With each side moved inwards."""
        return Rect(
            x0=self.x0 + margin, x1=self.x1 - margin, z0=self.z0 + margin, z1=self.z1 - margin
        )


@dataclass(frozen=True, kw_only=True)
class Leaf:
    """One cell: what closes it, and how many drawers wait behind its door."""

    kind: Kind
    inner: int = 0


@dataclass(frozen=True, kw_only=True)
class Split:
    """Nodes side by side along x (left to right) or z (bottom to top), sized by weight."""

    axis: Literal["x", "z"]
    weights: tuple[float, ...]
    nodes: "tuple[Node, ...]"


Node = Leaf | Split


@dataclass(frozen=True, kw_only=True)
class Cell:
    """A leaf with its place.

    Attributes:
        opening: clear room between the boards around it.
        cover: its share of the face; covers tile the face without gap or overlap.
        at_left: whether the cell ends at the face's left edge.
        at_right: whether the cell ends at its right edge.
    """

    leaf: Leaf
    opening: Rect
    cover: Rect
    at_left: bool
    at_right: bool


@dataclass(frozen=True, kw_only=True)
class Separator:
    """A board between cells: a standing divider, a full shelf, or a rail behind the front."""

    kind: Literal["divider", "shelf", "rail"]
    place: Rect


@dataclass(frozen=True, kw_only=True)
class Joinery:
    """Thickness of the boards between cells, m.

    Attributes:
        board: of dividers and shelves.
        rail: of the rail between two drawers; 0 where fronts cover the whole stack.
        by_cover: whether weights share out the face (fronts that cover the boards) or the clear
            openings (fronts set between the boards).
    """

    board: float
    rail: float
    by_cover: bool


def slice_face(
    node: Node, opening: Rect, cover: Rect, joinery: Joinery
) -> tuple[list[Cell], list[Separator]]:
    """Cells left to right and bottom to top within each split, and the boards between them."""
    return _slice(node, opening, cover, joinery, cover)


def _slice(
    node: Node, opening: Rect, cover: Rect, joinery: Joinery, face: Rect
) -> tuple[list[Cell], list[Separator]]:
    if isinstance(node, Leaf):
        left, right = cover.x0 == face.x0, cover.x1 == face.x1
        cell = Cell(leaf=node, opening=opening, cover=cover, at_left=left, at_right=right)
        return [cell], []
    kinds = [_between(node.axis, below, above, joinery) for below, above in pairwise(node.nodes)]
    halves = [0.0 if kind is None else _thickness(kind, joinery) / 2.0 for kind in kinds]
    cuts = _cuts(node, opening, cover, halves, joinery)
    cells: list[Cell] = []
    boards: list[Separator] = []
    for kind, cut, half in zip(kinds, cuts, halves, strict=True):
        if kind is not None:
            boards.append(
                Separator(kind=kind, place=_part(opening, node.axis, cut - half, cut + half))
            )
    clear = pairwise([None, *zip(cuts, halves, strict=True), None])
    for child, (before, after) in zip(node.nodes, clear, strict=True):
        inside = _part(
            opening, node.axis, before and before[0] + before[1], after and after[0] - after[1]
        )
        share = _part(cover, node.axis, before and before[0], after and after[0])
        more_cells, more_boards = _slice(child, inside, share, joinery, face)
        cells += more_cells
        boards += more_boards
    return cells, boards


def _between(
    axis: Literal["x", "z"], below: Node, above: Node, joinery: Joinery
) -> Literal["divider", "shelf", "rail"] | None:
    """What stands between two nodes; drawers stacked behind covering fronts need nothing."""
    if axis == "x":
        return "divider"
    if _tops_out(below) and _tops_out(above):
        return "rail" if joinery.rail > 0.0 else None
    return "shelf"


def _tops_out(node: Node) -> bool:
    """Whether the node is one drawer, or a stack of drawers."""
    if isinstance(node, Leaf):
        return node.kind == "drawer"
    return node.axis == "z" and all(_tops_out(child) for child in node.nodes)


def _thickness(kind: Literal["divider", "shelf", "rail"], joinery: Joinery) -> float:
    return joinery.rail if kind == "rail" else joinery.board


def _cuts(
    node: Split, opening: Rect, cover: Rect, halves: list[float], joinery: Joinery
) -> list[float]:
    """Where the middles of the separators lie, m."""
    shares = np.asarray(node.weights) / sum(node.weights)
    rect = cover if joinery.by_cover else opening
    low, high = (rect.x0, rect.x1) if node.axis == "x" else (rect.z0, rect.z1)
    if joinery.by_cover:
        return [low + (high - low) * float(share) for share in np.cumsum(shares)[:-1]]
    clear = high - low - 2.0 * sum(halves)
    cuts, at = [], low
    for share, half in zip(shares[:-1], halves, strict=True):
        at += clear * float(share) + half
        cuts.append(at)
        at += half
    return cuts


def _part(rect: Rect, axis: Literal["x", "z"], low: float | None, high: float | None) -> Rect:
    """The part of a rectangle between two lines across an axis; None keeps its own side."""
    if axis == "x":
        return replace(
            rect, x0=rect.x0 if low is None else low, x1=rect.x1 if high is None else high
        )
    return replace(rect, z0=rect.z0 if low is None else low, z1=rect.z1 if high is None else high)
