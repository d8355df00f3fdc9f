"""What is etched into a pot: litres inside at the back, the maker's stamp outside at the front."""

from artgen.articulation.types import Body
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.pot_params import PotParams
from artgen.generators.kit.printed import line, printed, ring, words
from artgen.geometry.solid import slab
from artgen.textures.appliance_panel import BRANDS

FILM = 0.00035
"""m; how deep the marks' plates are let into the wall."""
Marked = tuple[Body, SurfaceSpec]


def litre_marks(p: PotParams, wall: SurfaceSpec) -> Marked:
    """Lines and numbers on the inside of the rear wall."""
    shell = p.shell
    wide, low, high = 0.034, shell.ground + 0.15 * shell.height, 0.86 * shell.height
    plane = PanelPlane(origin=(-wide / 2.0, 0.0, low), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0),
                       size=(wide, high - low))  # fmt: skip
    ink = "#30343a" if sum(wall.color) / 3.0 > 0.18 else "#b9bcbe"
    area = 3.1416 * shell.mouth**2
    step = 0.5 if area * shell.height < 0.0045 else 1.0
    marks = []
    for k in range(1, 2 * p.litres + 1):
        litres = 0.5 * k * step
        v = shell.ground + litres / 1000.0 / area - low
        if not 0.004 < v < high - low - 0.004:
            continue
        whole = k % 2 == 0
        marks.append(line([(0.006, v), (0.016 if whole else 0.012, v)], width=0.0009, ink=ink))
        if whole:
            marks.append(words((0.0185, v), f"{litres:g} L", cap=0.0045, ink=ink, anchor="left"))
    spec = printed("litres", plane.size, background=srgb_hex(wall.color), marks=marks,
                   roughness=wall.roughness, metallic=wall.metallic)  # fmt: skip
    film = shell.room() - shell.room(more=FILM)
    window = slab((-wide / 2.0, 0.0, low), (wide / 2.0, 1.0, high))
    body = Body(solid=film & window, surface="litres", density=p.shell.density, decal=plane.decal())
    return body, spec


def stamp(p: PotParams) -> Marked:
    """A small plate with the maker's name, on the wall at the front."""
    wide, tall = (0.034, 0.013)
    z = 0.22 * p.shell.height
    plane = PanelPlane(origin=(-wide / 2.0, 0.0, z), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0),
                       size=(wide, tall))  # fmt: skip
    middle = (wide / 2.0, tall / 2.0)
    marks = [
        words((middle[0], middle[1] + 0.0014), BRANDS[p.brand], cap=0.0042, ink="#24262a"),
        words((middle[0], 0.0030), "18/10  INDUCTION", cap=0.0017, ink="#3b3e43"),
        ring((0.0040, middle[1]), 0.0021, width=0.0004, ink="#24262a"),
    ]
    spec = printed("stamp", plane.size, background="#b9babb", marks=marks, roughness=0.35,
                   metallic=1.0)  # fmt: skip
    skin = p.shell.outside(more=FILM) - p.shell.outside()
    window = slab((-wide / 2.0, -1.0, z), (wide / 2.0, 0.0, z + tall))
    body = Body(solid=skin & window, surface="stamp", density=p.shell.density, decal=plane.decal())
    return body, spec
