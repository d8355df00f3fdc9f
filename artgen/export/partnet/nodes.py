"""Motion nodes: what `mobility_v2.json` says, as values."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from artgen.articulation.types import Vector

KINDS = ("hinge", "slider", "static", "heavy", "free", "junk")
MOVING = ("hinge", "slider")
ROOT = -1
"""The parent of a node that hangs on nothing."""


@dataclass(frozen=True, kw_only=True)
class Leaf:
    """A leaf of the part tree: the fragments of its meshes move together."""

    id: int
    name: str


@dataclass(frozen=True, kw_only=True)
class Motion:
    """`jointData` of a hinge or slider; mesh frame (y up), absolute.

    Attributes:
        origin: a point on the axis, mesh units.
        direction: along the axis, as stated: not quite of length 1, of either sign.
        a: start pose; degrees of a hinge, mesh units of a slider.
        b: end pose, which may be less than `a`.
        free: `noLimit`: `a` and `b` mean nothing.
        rotates: a slider that turns as well: a cap, a screw.
        turn: degrees that such a slider turns from `a` to `b`; None where it turns freely.
    """

    origin: Vector
    direction: Vector
    a: float
    b: float
    free: bool = False
    rotates: bool = False
    turn: float | None = None

    @property
    def sign(self) -> float:
        """-1 where the URDF turns the axis around, so that its lower limit is not above its
        upper."""
        return -1.0 if not self.free and self.a > self.b else 1.0


@dataclass(frozen=True, kw_only=True)
class Node:
    """One entry of `mobility_v2.json`: leaves that move together, and how.

    Attributes:
        id: number of the URDF's link, unless junk nodes come before it.
        parent: id of the node it hangs on, `ROOT` for none.
        kind: one of `KINDS`.
        name: of its first leaf; no label.
        motion: None unless it is a hinge or a slider.
    """

    id: int
    parent: int
    kind: str
    name: str
    leaves: tuple[Leaf, ...]
    motion: Motion | None = None


def mobility_json(nodes: Sequence[Node]) -> list[dict[str, Any]]:
    """The list that the file holds."""
    return [
        {
            "id": node.id,
            "parent": node.parent,
            "joint": node.kind,
            "name": node.name,
            "parts": [{"id": leaf.id, "name": leaf.name, "children": []} for leaf in node.leaves],
            "jointData": {} if node.motion is None else _motion_json(node.motion),
        }
        for node in nodes
    ]


def _motion_json(motion: Motion) -> dict[str, Any]:
    limit: dict[str, Any] = {"a": motion.a, "b": motion.b, "noLimit": motion.free}
    if motion.rotates:
        limit |= {"rotates": True, "noRotationLimit": motion.turn is None}
        limit |= {} if motion.turn is None else {"rotationLimit": motion.turn}
    return {
        "axis": {"origin": list(motion.origin), "direction": list(motion.direction)},
        "limit": limit,
    }
