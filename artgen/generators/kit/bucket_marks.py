"""Marks on a vessel: liters inside at the back, a sticker outside at the front."""

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import POLYPROPYLENE
from artgen.generators.kit.printed import area, icon, line, printed, words
from artgen.generators.kit.vessel import Vessel
from artgen.geometry.solid import Solid, slab

FILM = 0.0003
"""m; thickness of a mark on the wall."""
BRANDS = ("HALDOR", "Rivona", "KORVA", "Brunnen", "AQUALI", "Tolke")
"""Invented; none is a maker of buckets known to us."""
Marked = tuple[Body, SurfaceSpec]


def scale_mark(vessel: Vessel) -> Marked:
    """Lines and liters on the inside of the rear wall, seen from the front."""
    low, high = vessel.ground, vessel.mouth.z
    wide, tall = 0.05, 0.72 * (high - low)
    bottom = low + 0.10 * (high - low)
    plane = PanelPlane(
        origin=(-wide / 2.0, 0.0, bottom), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0),
        size=(wide, tall),
    )  # fmt: skip
    marks = []
    for k in range(1, 11):
        v = tall * k / 10.5
        whole = k % 2 == 0
        marks.append(
            line([(0.004, v), (0.024 if whole else 0.014, v)], width=0.0012, ink="#20242a")
        )
        if whole:
            marks.append(words((0.028, v), f"{k} L", cap=0.006, ink="#20242a", anchor="left"))
    surface = printed("liters", plane.size, background="#e9e9e4", marks=marks, roughness=0.5)
    film = vessel.inside() - vessel.inside(more=FILM)
    window = slab((-wide / 2.0, 0.0, bottom), (wide / 2.0, 1.0, bottom + tall))
    return _applied(film & window, plane, surface), surface


def sticker(vessel: Vessel, brand: int) -> Marked:
    """A paper label on the outside of the front."""
    wide, tall = 0.075, 0.055
    bottom = vessel.rings[0].z + 0.30 * (vessel.mouth.z - vessel.rings[0].z)
    plane = PanelPlane(
        origin=(-wide / 2.0, 0.0, bottom), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0),
        size=(wide, tall),
    )  # fmt: skip
    marks = [
        area((0.0, 0.036), (wide, tall), ink="#1f4f8f"),
        words((wide / 2.0, 0.0455), BRANDS[brand], cap=0.009, ink="#ffffff"),
        words((0.004, 0.029), "Household bucket", cap=0.0042, ink="#20242a", anchor="left"),
        words((0.004, 0.021), "Food safe  -20 / +80 C", cap=0.0032, ink="#555a60", anchor="left"),
        icon((0.062, 0.020), "drop", size=0.012, ink="#1f4f8f"),
        *(line([(0.005 + 0.0022 * k, 0.004), (0.005 + 0.0022 * k, 0.013)],
               width=0.0005 + 0.0004 * (k * 7 % 3), ink="#111111") for k in range(14)),
    ]  # fmt: skip
    surface = printed("sticker", plane.size, background="#f3f1ea", marks=marks, roughness=0.45)
    grown = vessel.outside().transformed(_grown(FILM / vessel.mouth.half[0]))
    window = slab((-wide / 2.0, -1.0, bottom), (wide / 2.0, 0.0, bottom + tall))
    return _applied((grown - vessel.outside()) & window, plane, surface), surface


def _grown(share: float) -> list[list[float]]:
    """Widening in x and y."""
    return [[1.0 + share, 0, 0, 0], [0, 1.0 + share, 0, 0], [0, 0, 1.0, 0], [0, 0, 0, 1.0]]


def _applied(solid: Solid, plane: PanelPlane, surface: SurfaceSpec) -> Body:
    return Body(solid=solid, surface=surface.name, density=POLYPROPYLENE, decal=plane.decal())
