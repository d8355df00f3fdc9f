"""A button that a finger presses into its well."""

from dataclasses import dataclass

from artgen.articulation.types import Body, DraftPart, Grip, Joint, Limit, Spring
from artgen.generators.kit.control_console import PanelPlane
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, prism, slab

PLAY = 0.0004
"""m; between the cap and the wall of its well."""


@dataclass(frozen=True, kw_only=True)
class PushButton:
    """A cap over a spring, drawn in the frame of the face that it is pressed into.

    Attributes:
        name: of the part.
        center: (u, v) on the face, m.
        size: width and height; equal ones make a round cap if `round_cap`.
        proud: how far it stands out at rest.
        travel: how far it goes in; less than `proud`.
        depth: of the cap below the face at rest.
        force: N to start it; half as much again at the end.
    """

    name: str
    center: tuple[float, float]
    size: tuple[float, float]
    round_cap: bool = False
    proud: float = 0.0030
    travel: float = 0.0020
    depth: float = 0.0030
    force: float = 1.5

    def well(self) -> Solid:
        """What the face must leave free, in the face's frame."""
        deep = self.depth + self.travel + 0.0012
        return self._column(PLAY, deep + 0.004).at(0.0, 0.0, -deep)

    def part(self, plane: PanelPlane, surface: str, *, density: float) -> DraftPart:
        """The cap; its collision piece is what stays outside the face when it is pressed."""
        cap = self._column(0.0, self.depth + self.proud).at(0.0, 0.0, -self.depth)
        (u, v), (w, h) = self.center, self.size
        inset = 0.15 * min(w, h) if self.round_cap else 0.0
        half = (w / 2.0 - inset, h / 2.0 - inset)
        low = self.travel + PLAY
        touch = slab((u - half[0], v - half[1], low), (u + half[0], v + half[1], self.proud))
        body = Body(
            solid=plane.placed(cap),
            surface=surface,
            density=density,
            edge=0.0005,
            collision=(plane.placed(touch),),
        )
        return DraftPart(name=self.name, label="button", bodies=(body,), grips=(self._grip(plane),))

    def joint(self, plane: PanelPlane, *, parent: str) -> Joint:
        """Pressed in by +q; a spring brings it back."""
        x, y, z = (-c + 0.0 for c in plane.outward)
        return Joint(
            name=f"{self.name}_press",
            type="prismatic",
            parent=parent,
            child=self.name,
            axis=(x, y, z),
            limit=Limit(lower=0.0, upper=self.travel),
            friction=0.3,
            damping=1.5,
            effort=20.0,
            velocity=0.3,
            spring=Spring(stiffness=self.force / (2.0 * self.travel), reference=-2.0 * self.travel),
        )

    def _grip(self, plane: PanelPlane) -> Grip:
        x, y, z = (-c + 0.0 for c in plane.outward)
        return Grip(
            name=f"{self.name}_cap",
            kind="button",
            position=plane.point(*self.center, self.proud),
            outward=plane.outward,
            pull=(x, y, z),
        )

    def _column(self, more: float, height: float) -> Solid:
        w, h = self.size[0] + 2.0 * more, self.size[1] + 2.0 * more
        if self.round_cap:
            outline = circle(w / 2.0, segments=20)
        else:
            outline = rounded_rectangle(w, h, 0.25 * min(w, h), segments=3)
        return prism(outline, height).at(*self.center, 0.0)
