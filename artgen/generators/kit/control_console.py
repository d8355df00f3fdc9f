"""Control panels of appliances as solids: printed fascia, buttons, knob, lit display."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Body, Decal, Vector
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.density import ABS, GLASS
from artgen.geometry.profile import circle, rounded_rectangle
from artgen.geometry.solid import Solid, cone, prism, slab, union
from artgen.textures.appliance_panel import PanelLayout, Spot, panel_layout


@dataclass(frozen=True, kw_only=True)
class PanelPlane:
    """Where a panel's face lies: its lower left corner and the two directions along it."""

    origin: Vector
    right: Vector
    up: Vector
    size: tuple[float, float]

    def placed(self, solid: Solid) -> Solid:
        """What was drawn in (right, up, outwards) put in its place."""
        matrix = np.eye(4)
        matrix[:3, 0], matrix[:3, 1] = self.right, self.up
        matrix[:3, 2] = np.cross(self.right, self.up)
        matrix[:3, 3] = self.origin
        return solid.transformed(matrix)

    def point(self, u: float, v: float, w: float = 0.0) -> Vector:
        """A place `u` right, `v` up and `w` out of the lower left corner, in the object frame."""
        x, y, z = (
            float(o + u * r + v * s + w * n)
            for o, r, s, n in zip(self.origin, self.right, self.up, self.outward, strict=True)
        )
        return x, y, z

    @property
    def outward(self) -> Vector:
        """Unit vector away from the object."""
        x, y, z = (float(c) + 0.0 for c in np.cross(self.right, self.up))
        return x, y, z

    def decal(self) -> Decal:
        """An image over the whole panel."""
        return Decal(origin=self.origin, right=self.right, up=self.up, size=self.size)

    def window(self, spot: Spot) -> Decal:
        """An image over one spot of it."""
        (u, v), (w, h) = spot.center, spot.size
        corner = np.asarray(self.origin) + np.multiply(u - w / 2.0, self.right)
        x, y, z = (float(c) for c in corner + np.multiply(v - h / 2.0, self.up))
        return Decal(origin=(x, y, z), right=self.right, up=self.up, size=spot.size)


@dataclass(frozen=True, kw_only=True)
class ConsoleStyle:
    """What is on a panel.

    Attributes:
        style: `buttons`, `knob` or `touch`.
        buttons: how many on the right.
        display: whether there is a lit window.
        brand: index of the brand's word.
        words: shown by the display.
        led: color of the display.
    """

    style: str
    buttons: int
    display: bool
    brand: int
    words: str
    led: str

    def layout(self, size: tuple[float, float]) -> PanelLayout:
        """Places on a panel of that size, m."""
        return panel_layout(*size, style=self.style, buttons=self.buttons, display=self.display)


def printed(face: SurfaceSpec, style: ConsoleStyle, size: tuple[float, float]) -> SurfaceSpec:
    """The surface `face` with the panel's print on it."""
    background = hex_color(face.color)
    light = sum(face.color) / 3.0 > 0.18
    return dataclasses.replace(
        face,
        name="console",
        recipe="appliance_panel",
        tile=size,
        detail={
            "style": style.style,
            "buttons": float(style.buttons),
            "display": float(style.display and style.style != "knob"),
            "brand": float(style.brand),
            "brushed": float(face.metallic > 0.5),
            "background": background,
            "ink": "#26282b" if light else "#e6e8ea",
        },
    )


def lit(style: ConsoleStyle, size: tuple[float, float]) -> SurfaceSpec:
    """The display's surface."""
    return SurfaceSpec(
        name="display",
        recipe="appliance_display",
        color=(0.02, 0.025, 0.03),
        roughness=0.08,
        emission=1.2,
        tile=size,
        detail={"words": style.words, "led": style.led},
    )


def console_controls(
    plane: PanelPlane, style: ConsoleStyle, *, trim: SurfaceSpec
) -> tuple[tuple[Body, ...], tuple[SurfaceSpec, ...]]:
    """(bodies that stand on the panel, surfaces that only they use)."""
    layout = style.layout(plane.size)
    bodies: list[Body] = []
    surfaces: list[SurfaceSpec] = []
    if style.style != "touch":
        round_one = prism(circle(0.5 * layout.power.size[0], segments=16), 0.0022)
        keys = [_at(round_one, layout.power), *(_key(spot) for spot in layout.buttons)]
        bodies += [_control(plane, key, trim, edge=0.0) for key in keys]
    if layout.knob is not None:
        bodies.append(_control(plane, _knob(layout.knob), trim, edge=0.0005))
    if layout.display is not None:
        spot = layout.display
        low = np.subtract(spot.center, np.multiply(0.5, spot.size))
        pane = slab((*low, 0.0), (*(low + spot.size), 0.0008))
        window = lit(style, spot.size)
        surfaces.append(window)
        bodies.append(
            Body(
                solid=plane.placed(pane),
                surface=window.name,
                density=GLASS,
                decal=plane.window(spot),
            )
        )
    return tuple(bodies), tuple(surfaces)


def _control(plane: PanelPlane, solid: Solid, trim: SurfaceSpec, *, edge: float) -> Body:
    return Body(solid=plane.placed(solid), surface=trim.name, density=ABS, edge=edge)


def _at(solid: Solid, spot: Spot) -> Solid:
    return solid.at(*spot.center)


def _key(spot: Spot) -> Solid:
    outline = rounded_rectangle(*spot.size, 0.3 * min(spot.size), segments=2)
    return _at(prism(outline, 0.0022), spot)


def _knob(spot: Spot) -> Solid:
    """A dial with a grip bar that points at the program."""
    radius = 0.5 * spot.size[0]
    dial = cone(radius, 0.9 * radius, 0.010, segments=28)
    grip = slab((-0.12 * radius, -0.86 * radius, 0.009), (0.12 * radius, 0.86 * radius, 0.020))
    return _at(union([dial, grip]), spot)


def hex_color(linear: Sequence[float]) -> str:
    """Linear RGB to sRGB `#rrggbb` (IEC 61966-2-1)."""
    channels = []
    for value in linear:
        encoded = 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1.0 / 2.4) - 0.055
        channels.append(round(255.0 * min(1.0, max(0.0, encoded))))
    return "#{:02x}{:02x}{:02x}".format(*channels)
