"""Toasters: slots side by side or long ones, a lever that lowers the bread, a dial, buttons."""

from collections.abc import Callable, Mapping

from artgen.articulation.types import (
    Body,
    Draft,
    DraftPart,
)
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.board import Stock
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.cord import cord_stub
from artgen.generators.kit.density import ABS, STEEL
from artgen.generators.kit.dial import Dial
from artgen.generators.kit.printed import plate, printed, words
from artgen.generators.kit.push_button import PushButton
from artgen.generators.kit.quarter_turn import turned_joint, turned_part
from artgen.generators.kit.toaster_design import ToasterParams
from artgen.generators.kit.toaster_works import toaster_works
from artgen.textures.appliance_panel import BRANDS

PARAMS = ToasterParams
COVERS = {"one_piece": "plastic", "wrap": "sheet", "retro": "painted"}
"""Surface of the shell by style."""
WALLS: Mapping[str, float] = {"one_piece": 150.0, "wrap": 230.0, "retro": 260.0}
"""kg/m3 of the walls: shell, air and works together, so that masses come out as in the sheets."""
INK = ("#26282b", "#e9ebec")
BADGE = (0.050, 0.012)


def build(p: ToasterParams, surfaces: Mapping[str, SurfaceSpec]) -> Draft:
    """At rest the levers are up and the tray is in; the bread goes down with its lever."""
    face, trim = p.control_face, "metal" if p.style == "retro" else "trim"
    dials = face.make_dials(p.dial_radius, p.dial_height, p.dial)
    buttons = face.make_buttons(round_caps=p.round_caps, force=2.0)
    works, joints = toaster_works(p, trim)
    parts = [
        _base(p, dials, buttons),
        *works,
        *(dial.part(face.plane, trim, "mark", density=ABS) for dial in dials),
        *(button.part(face.plane, trim, density=ABS) for button in buttons),
    ]
    joints += [dial.joint(face.plane, parent="base") for dial in dials]
    joints += [button.joint(face.plane, parent="base") for button in buttons]
    if p.face != "broad":
        parts, joints = [turned_part(x) for x in parts], [turned_joint(x) for x in joints]
    specs = (*surfaces.values(), *_prints(p, surfaces, dials))
    worn = {body.surface for part in parts for body in part.bodies}
    return Draft(
        category="toaster",
        parts=tuple(parts),
        joints=tuple(joints),
        surfaces=tuple(spec for spec in specs if spec.name in worn),
    )


def _stock(surface: str, density: float, edge: float = 0.0008) -> Stock:
    return Stock(surface=surface, density=density, edge=edge)


def _base(p: ToasterParams, dials: list[Dial], buttons: list[PushButton]) -> DraftPart:
    shell, face, chamber = p.shell, p.control_face, p.chamber
    cuts = [
        face.plane.placed(c) for c in (*(d.hole() for d in dials), *(b.well() for b in buttons))
    ]
    cover = Stock(surface=COVERS[p.style], density=WALLS[p.style], edge=0.0012)
    caps = Stock(surface="trim", density=WALLS["one_piece"], edge=0.0015)
    plinth = Stock(surface="metal" if p.style == "retro" else "trim", density=180.0, edge=0.001)
    bodies = [
        *shell.bodies(cover, caps, plinth, _stock("metal", 3000.0, 0.0005), "rubber", cuts),
        *chamber.inside(_stock("mica", 1100.0, 0.0), "wound", _stock("inner", STEEL, 0.0),
                        rows=p.rows, guards=p.guards * (2 if p.form.startswith("long") else 1)),
        face.cover(dials, buttons, radius=0.006, sunk=0.003 if p.style == "wrap" else 0.0005),
        _badge(p),
        cord_stub((0.014 + shell.corner - shell.end, p.width / 2.0 - 0.001, shell.bottom + 0.012),
                  out=(0.0, 1.0, 0.0), surface="rubber", run=0.025),
    ]  # fmt: skip
    return DraftPart(name="base", label="base", bodies=tuple(bodies))


def _badge(p: ToasterParams) -> Body:
    """The brand on a broad side."""
    x, z = -BADGE[0] / 2.0, p.height - p.shell.crown - 0.045
    plane = PanelPlane(
        origin=(x, -p.width / 2.0, z), right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0), size=BADGE
    )
    return plate(plane, "badge", density=2700.0, thickness=0.003, radius=0.004, sunk=0.002)


def _prints(
    p: ToasterParams, surfaces: Mapping[str, SurfaceSpec], dials: list[Dial]
) -> tuple[SurfaceSpec, ...]:
    """Control plate, badge and the pointer of the dials."""
    tone = surfaces[{"body": COVERS[p.style], "dark": "trim", "metal": "metal"}[p.plate]]
    light = sum(tone.color) / 3.0 > 0.18
    brand = BRANDS[p.brand]
    panel = p.control_face.print(
        dials, background=srgb_hex(tone.color), ink=INK[0 if light else 1], brand=brand,
        metallic=tone.metallic,
    )  # fmt: skip
    name = [words((BADGE[0] / 2.0, BADGE[1] / 2.0), brand, cap=0.0058, ink=INK[0])]
    badge = printed("badge", BADGE, background="#c9cacb", marks=name, roughness=0.25, metallic=1.0)
    pale = sum(surfaces["trim"].color) / 3.0 > 0.18 or p.style == "retro"
    mark = SurfaceSpec(name="mark", recipe="plain", color=(0.5, 0.02, 0.01) if pale else (0.8,) * 3)
    return panel, badge, mark


def controls_fit_the_face(p: ToasterParams) -> bool:
    """Dial with its scale, buttons and slits do not meet."""
    return p.control_face.fits(p.dial_radius + 0.008)


def broad_faces_are_long(p: ToasterParams) -> bool:
    """Controls on the broad face need a long body; divided faces serve one lever."""
    if p.face == "broad":
        return p.form.startswith("long")
    return p.face != "divided" or p.form != "four"


INVARIANTS: Mapping[str, Callable[[ToasterParams], bool]] = {
    check.__name__: check for check in (controls_fit_the_face, broad_faces_are_long)
}
