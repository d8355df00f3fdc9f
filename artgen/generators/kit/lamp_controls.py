"""What is on the plate of a desk lamp: a switch or dimmer, and the maker's name."""

from artgen.articulation.types import Body, DraftPart, Joint
from artgen.core.surface import SurfaceSpec, srgb_hex
from artgen.generators.kit.control_console import PanelPlane
from artgen.generators.kit.density import ABS
from artgen.generators.kit.desk_lamp_design import DeskLampParams
from artgen.generators.kit.dial import Dial
from artgen.generators.kit.printed import plate, printed, words
from artgen.generators.kit.push_button import PushButton
from artgen.geometry.solid import Solid
from artgen.textures.appliance_panel import BRANDS


def badge(p: DeskLampParams, coat: SurfaceSpec) -> tuple[Body, SurfaceSpec]:
    """The maker's name on the plate, in a tone that reads on its coat."""
    size = (0.034, 0.009)
    light = sum(coat.color) / 3.0 > 0.18
    at = (0.30 * p.plate_size, -0.55 * p.base.half_depth, p.plate_height)
    plane = PanelPlane(origin=at, right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), size=size)
    name = words(
        (size[0] / 2.0, size[1] / 2.0), BRANDS[p.brand], cap=0.0042,
        ink="#26282b" if light else "#e9ebec",
    )  # fmt: skip
    surface = printed("badge", size, background=srgb_hex(coat.color), marks=[name],
                      roughness=coat.roughness, metallic=coat.metallic)  # fmt: skip
    return plate(
        plane, "badge", density=2700.0, thickness=0.0012, radius=0.002, sunk=0.0009
    ), surface


def lamp_switch(p: DeskLampParams) -> tuple[DraftPart, Joint, list[Solid]]:
    """A button or a dimmer on the plate."""
    face, size = p.base.face(), p.switch_size
    if p.switch == "dial":
        dial = Dial(
            name="dimmer",
            center=(0.0, 0.0),
            radius=size,
            height=0.016,
            style="ribbed",
            label="knob",
        )
        part = dial.part(face, "knob", "light", density=ABS)
        return part, dial.joint(face, parent="base"), [face.placed(dial.hole())]
    wide, high = (2.4, 1.2) if p.switch == "long_button" else (1.5, 1.5)
    button = PushButton(
        name="switch",
        center=(0.0, 0.0),
        size=(wide * size, high * size),
        round_cap=wide == high,
        force=2.0,
    )
    part = button.part(face, "knob", density=ABS)
    return part, button.joint(face, parent="base"), [face.placed(button.well())]
