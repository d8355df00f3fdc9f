"""What a dishwasher's numbers say about where everything is."""

import math
from dataclasses import dataclass

from artgen.generators.kit.appliance_cabinet import Cabinet
from artgen.generators.kit.drop_door import DropDoor
from artgen.generators.kit.washing_tub import Tub

GAP = 0.004
"""m; between the closed door's inner face and the cabinet's front, bridged by the seal."""
SEAL = 0.0025
"""m; what the seal fills of it (a real one is pressed together, ours stops short)."""
INSET = 0.012
"""m; the pin lies this far in front of the door's inner face."""
SINK = 0.008
"""m; the door's inner body reaches this far below the pin, so that it turns in front of y = 0."""
HOLD = math.radians(0.5)
"""The lower rack asks for a door within this angle of fully open: it rolls on the door."""
RACK_GAP = 0.001
"""m; under the wheels."""
UNDERCOUNTER = 0.030
"""m; what built-in machines are lower than those with a worktop."""
ENTRY = math.radians(80.0)
"""Upper racks need the door open this far."""


@dataclass(frozen=True, kw_only=True)
class DishwasherParams:
    """Numbers of one dishwasher; lengths in m.

    Attributes:
        form: `freestanding`; or without worktop: `built_under`, `top_control` (a sheet front
            without fascia), `semi_integrated` (furniture below a fascia), `integrated`
            (furniture alone).
        slim: 0.45 m class; else 0.60 m.
        play: what the class width is undercut by.
        height: floor to worktop; built-in forms are UNDERCOUNTER lower.
        depth: cabinet back to door front, without handle.
        door: thickness of the door without furniture panel.
        foot: clear height under the cabinet.
        toe_height: floor to the wheel track in the tub, less the lip.
        toe_depth: setback of the kick plate.
        drop: how far the door's outer panel hangs below the pin.
        worktop: thickness.
        fascia: height of the control panel.
        plain_fascia: whether a painted front's control panel has the same paint.
        wall: between the cabinet's outside and the tub.
        corner: radius of the tub's upper corners.
        beads: embossed in each side wall.
        beads_upright: whether they stand.
        equipment: kg of pump, motor, softener, ballast in the 0.60 m class.
        handle: `bar`, `flat_bar`, `pocket` or `groove`.
        handle_share: its length as a share of the door's width.
        handle_size: thickness of bars, m.
        console: `buttons`, `knob` or `touch`.
        buttons: how many.
        display: whether there is a lit window.
        brand: which word.
        led: color of the display.
        program: which time the display shows.
        cutlery: `basket` in the lower rack, `tray` above the upper one, or `both`.
        wire: radius of the racks' wires.
        pitch: distance of wires in the racks' floors.
        tine_rows: rows of plate pins in the lower rack.
        tine_height: m.
        shelves: cup shelves of the upper rack.
        wheels: pairs of rollers of the lower rack.
        blades: of the lower spray arm.
        travel: of racks, as a share of their length.
        opening_deg: of the door.
        slots: air slots in the kick plate.
    """

    form: str
    slim: bool
    play: float
    height: float
    depth: float
    door: float
    foot: float
    toe_height: float
    toe_depth: float
    drop: float
    worktop: float
    fascia: float
    plain_fascia: bool
    wall: float
    corner: float
    beads: int
    beads_upright: bool
    equipment: float
    handle: str
    handle_share: float
    handle_size: float
    console: str
    buttons: int
    display: bool
    brand: int
    led: str
    program: int
    cutlery: str
    wire: float
    pitch: float
    tine_rows: int
    tine_height: float
    shelves: int
    wheels: int
    blades: int
    travel: float
    opening_deg: float
    slots: int

    @property
    def width(self) -> float:
        """Outside, m."""
        return (0.45 if self.slim else 0.60) - self.play

    @property
    def has_worktop(self) -> bool:
        """Only machines that stand free."""
        return self.form == "freestanding"

    @property
    def has_furniture_panel(self) -> bool:
        """A kitchen front on the door."""
        return self.form in ("semi_integrated", "integrated")

    @property
    def hidden_console(self) -> bool:
        """Controls on the door's upper edge."""
        return self.form in ("integrated", "top_control")


@dataclass(frozen=True, kw_only=True)
class Rack:
    """The room of one rack at rest: half width of its wires, y of front and back, m."""

    half_width: float
    front: float
    back: float
    travel: float


@dataclass(frozen=True, kw_only=True)
class Layout:
    """Places of everything; y = 0 is the cabinet's front, z = 0 the floor, x = 0 the middle."""

    cabinet: Cabinet
    tub: Tub
    door: DropDoor
    upper: float
    """rad; the door's range."""
    top: float
    """z of the machine's highest point."""
    fascia_bottom: float
    """z below which the door's panel begins."""
    rack: Rack
    upper_floor: float
    """z of the upper rack's floor wires."""
    tray_floor: float
    """z of the cutlery tray's floor wires."""

    @property
    def track(self) -> float:
        """z on which the lower rack's wheels run."""
        return self.tub.floor


def layout(p: DishwasherParams) -> Layout:
    """Everything's place, from the floor up and from the front back."""
    skin = 0.016 if p.has_furniture_panel else 0.012
    thick = p.door + (skin if p.has_furniture_panel else 0.0)
    half, back = p.width / 2.0, p.depth - thick - GAP
    top = p.height - (0.0 if p.has_worktop else UNDERCOUNTER)
    crown = top - (p.worktop if p.has_worktop else 0.0)
    upper = math.radians(p.opening_deg)
    track = p.foot + p.toe_height + 0.035
    depth = back - 0.036
    length = depth - 0.046
    travel = p.travel * length
    rise = travel * math.tan(math.pi / 2.0 - upper + HOLD)
    pin = track - INSET - rise - 0.0005
    tub = Tub(
        half_width=half - p.wall,
        floor=track,
        ceiling=crown - 0.030,
        depth=depth,
        wall=0.0025,
        corner=p.corner,
        beads=p.beads,
        beads_upright=p.beads_upright,
    )
    door = DropDoor(
        half_width=half - 0.002,
        inner=-GAP,
        outer=-GAP - thick,
        skin=skin,
        bottom=pin - SINK,
        skin_bottom=pin - p.drop,
        top=crown - 0.004,
        pivot=(-GAP - INSET, pin),
    )
    cabinet = Cabinet(
        half_width=half,
        depth=back,
        foot=p.foot,
        top=crown,
        toe_height=pin - 0.022,
        toe_depth=p.toe_depth,
    )
    room = tub.ceiling - track
    return Layout(
        cabinet=cabinet,
        tub=tub,
        door=door,
        upper=upper,
        top=top,
        fascia_bottom=door.top - (0.0 if p.hidden_console else p.fascia),
        rack=Rack(
            half_width=tub.half_width - 0.024, front=0.024, back=depth - 0.022, travel=travel
        ),
        upper_floor=track + (0.49 if p.cutlery != "basket" else 0.54) * room,
        tray_floor=tub.ceiling - 0.098,
    )
