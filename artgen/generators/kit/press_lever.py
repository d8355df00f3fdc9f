"""A lever that is pressed down along a slit: thumb piece outside, stem, flange behind the face."""

from dataclasses import dataclass

from artgen.articulation.types import DraftPart, Grip, Joint, Limit, Spring
from artgen.generators.kit.board import Stock
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, cone, prism, slab, union, upright

FLANGE = (0.0052, 0.0112)
"""m; from and to behind the face: 1.2 mm behind a face of 4 mm."""


@dataclass(frozen=True, kw_only=True)
class PressLever:
    """A lever on the face x = `face`, looking to +x.

    Attributes:
        name: of the part.
        y, z: of its stem at rest, m.
        travel: downwards, m.
        style: `paddle`, `bar` or `ball`.
        gap: from the face to the thumb piece.
        size: width of the thumb piece along y.
        preload: N by which its spring holds it up.
    """

    name: str
    face: float
    y: float
    z: float
    travel: float
    style: str
    gap: float
    size: float
    preload: float

    def part(self, thumb: Stock, stem: Stock) -> DraftPart:
        """Thumb piece and stem."""
        x0 = self.face + self.gap
        piece, touch = _THUMBS[self.style](self.size)
        pin = slab((self.face - FLANGE[0] - 0.001, -0.0025, -0.003), (x0 + 0.004, 0.0025, 0.003))
        flange = slab(
            (self.face - FLANGE[1], -0.0065, -0.006), (self.face - FLANGE[0], 0.0065, 0.006)
        )
        inner = union([pin, flange]).at(y=self.y, z=self.z)
        contact = tuple(s.at(y=self.y, z=self.z) for s in (pin, flange))
        return DraftPart(
            name=self.name,
            label="lever",
            bodies=(
                stem.piece(inner, contact=contact),
                thumb.piece(
                    piece.at(x0, self.y, self.z),
                    contact=tuple(s.at(x0, self.y, self.z) for s in touch),
                ),
            ),
            grips=(
                Grip(
                    name=f"{self.name}_thumb",
                    kind="lever",
                    position=(x0 + 0.009, self.y, self.z + 0.007),
                    outward=(0.0, 0.0, 1.0),
                    pull=(0.0, 0.0, -1.0),
                ),
            ),
        )

    def joint(self, *, parent: str) -> Joint:
        """Down by +q; the spring lifts it and the bread."""
        stiffness = 0.5 * self.preload / self.travel
        return Joint(
            name=f"{self.name}_press",
            type="prismatic",
            parent=parent,
            child=self.name,
            axis=(0.0, 0.0, -1.0),
            limit=Limit(lower=0.0, upper=self.travel),
            friction=1.2,
            damping=6.0,
            effort=60.0,
            velocity=1.0,
            spring=Spring(stiffness=stiffness, reference=-self.preload / stiffness),
        )


def _paddle(size: float) -> tuple[Solid, tuple[Solid, ...]]:
    """A flat piece with rounded corners, a little thicker at its front edge."""
    outline = rounded_rectangle(size, 0.020, 0.006, segments=4)
    flat = prism(outline, 0.009).at(0.0, 0.010, -0.005)
    nose = slab((-0.5 * size + 0.006, 0.015, -0.0065), (0.5 * size - 0.006, 0.0195, 0.0055))
    turned = union([flat, nose]).turned("z", -0.5 * 3.141592653589793)
    return turned, (slab((0.0, -0.5 * size, -0.005), (0.020, 0.5 * size, 0.004)),)


def _bar(size: float) -> tuple[Solid, tuple[Solid, ...]]:
    """A round bar across the slit."""
    bar = upright(prism(rounded_rectangle(0.011, 0.011, 0.0054, segments=4), size), "y")
    neck = slab((0.0, -0.004, -0.0035), (0.009, 0.004, 0.0035))
    solid = union([bar.at(0.0115, -0.5 * size, 0.0), neck])
    return solid, (slab((0.006, -0.5 * size, -0.0055), (0.017, 0.5 * size, 0.0055)),)


def _ball(size: float) -> tuple[Solid, tuple[Solid, ...]]:
    """A round knob that widens to the front."""
    r = 0.36 * size
    knob = union([cone(0.6 * r, r, 0.009, axis="x", segments=24),
                  cone(r, 0.78 * r, 0.008, axis="x", segments=24).at(x=0.009)])  # fmt: skip
    half = 0.74 * r
    return knob, (slab((0.004, -half, -half), (0.017, half, half)),)


_THUMBS = {"paddle": _paddle, "bar": _bar, "ball": _ball}
