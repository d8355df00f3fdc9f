"""What is printed on a part: marks for the recipe `printed_marks`, and thin plates that wear them.

marks = [words((0.03, 0.02), "DEFROST", cap=0.003, ink="#e8e8e8"), *dial_scale(...)]
surface = printed("panel", size, background="#202224", marks=marks)
"""

import math
from collections.abc import Sequence

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec, linear_color
from artgen.generators.kit.control_console import PanelPlane
from artgen.geometry.profile import rounded_rectangle
from artgen.geometry.solid import Solid, prism

Point = tuple[float, float]


def printed(
    name: str,
    size: Point,
    *,
    background: str,
    marks: Sequence[str],
    lit: Sequence[str] = (),
    roughness: float = 0.4,
    metallic: float = 0.0,
    emission: float = 1.2,
) -> SurfaceSpec:
    """The surface of a face of `size` m with those marks on it; lit ones glow."""
    detail: dict[str, float | str] = {"background": background, "marks": "\n".join(marks)}
    if lit:
        detail["lit"] = "\n".join(lit)
    return SurfaceSpec(
        name=name,
        recipe="printed_marks",
        color=linear_color(background),
        roughness=roughness,
        metallic=metallic,
        emission=emission if lit else 0.0,
        tile=size,
        detail=detail,
    )


def plate(
    plane: PanelPlane,
    surface: str,
    *,
    density: float,
    thickness: float,
    radius: float = 0.002,
    sunk: float = 0.0,
    holes: Sequence[Solid] = (),
) -> Body:
    """A thin printed plate over the whole plane, `sunk` m of its thickness inside the face.

    `holes` are cut out of it, in the plane's own frame.
    """
    width, height = plane.size
    outline = rounded_rectangle(width, height, min(radius, 0.49 * min(plane.size)), segments=4)
    solid = prism(outline, thickness).at(width / 2.0, height / 2.0, -sunk)
    for hole in holes:
        solid = solid - hole
    return Body(solid=plane.placed(solid), surface=surface, density=density, decal=plane.decal())


def words(at: Point, text: str, *, cap: float, ink: str, anchor: str = "middle") -> str:
    """A line of text with capitals `cap` m tall."""
    return f"text {_numbers(*at, cap)} {anchor} {ink} {text}"


def icon(at: Point, name: str, *, size: float, ink: str) -> str:
    """One of `artgen.textures.icons`."""
    return f"icon {_numbers(*at, size)} {ink} {name}"


def line(points: Sequence[Point], *, width: float, ink: str) -> str:
    """A polyline."""
    return f"line {_numbers(*(c for p in points for c in p), width)} {ink}"


def polygon(points: Sequence[Point], *, ink: str) -> str:
    """A filled outline."""
    return f"polygon {_numbers(*(c for p in points for c in p))} {ink}"


def area(lower: Point, upper: Point, *, ink: str, radius: float = 0.0) -> str:
    """A filled rectangle."""
    return f"box {_numbers(*lower, *upper, radius)} {ink}"


def disc(at: Point, radius: float, *, ink: str) -> str:
    """A filled circle."""
    return f"disc {_numbers(*at, radius)} {ink}"


def ring(at: Point, radius: float, *, width: float, ink: str) -> str:
    """A circle's line."""
    return f"ring {_numbers(*at, radius, width)} {ink}"


def digits(at: Point, text: str, *, height: float, ink: str) -> str:
    """Seven-segment digits with their lower left corner at `at`."""
    return f"digits {_numbers(*at, height)} {ink} {text}"


def dial_scale(
    at: Point,
    radius: float,
    numerals: Sequence[str],
    *,
    cap: float,
    ink: str,
    start: float,
    sweep: float,
) -> list[str]:
    """Ticks and numerals around a dial, clockwise from `start` over `sweep` rad.

    Angles count from +x counter-clockwise; `radius` is that of the inner ends of the ticks.
    """
    marks = []
    gaps = len(numerals) - 1
    for k in range(2 * gaps + 1):
        angle = start - sweep * k / (2 * gaps)
        cos, sin = math.cos(angle), math.sin(angle)
        reach = radius + (0.6 if k % 2 == 0 else 0.35) * cap
        ends = [(at[0] + r * cos, at[1] + r * sin) for r in (radius, reach)]
        marks.append(line(ends, width=0.16 * cap, ink=ink))
        if k % 2 == 0:
            far = radius + 1.5 * cap
            place = (at[0] + far * cos, at[1] + far * sin)
            marks.append(words(place, numerals[k // 2], cap=cap, ink=ink))
    return marks


def _numbers(*values: float) -> str:
    return " ".join(f"{value:.6f}" for value in values)
