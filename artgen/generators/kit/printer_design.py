"""What a printer's numbers mean: levels from the feet up, bays in plan."""

from dataclasses import dataclass
from functools import cached_property

GAP = 0.0014
"""m; between moving parts and what surrounds them."""
DECK = 0.004
"""m; thickness of the plates between the bays."""
SHELL = 0.018
"""m; thickness of the side walls, with the works in them."""
FRONT = 0.030
"""m; thickness of the front above the output bay."""
REAR_BLOCK = 0.058
"""m; depth of a rear paper feed behind the scanner."""


@dataclass(frozen=True, kw_only=True)
class PrinterParams:
    """Sampled by category_rules/printer.toml; lengths in m, angles in degrees."""

    feed: str
    output: str
    panel: str
    feeder: bool
    width: float
    depth: float
    corner: float
    foot: float
    cassette_height: float
    output_height: float
    works_height: float
    scanner: float
    lid: float
    paper_width: float
    cassette_travel: float
    tray_travel: float
    stop_length: float
    panel_share: float
    panel_tilt: float
    buttons: int
    cartridges: int
    unit_deg: float
    lid_deg: float
    stack: float
    vents: int
    cassette_friction: float
    lid_friction: float
    unit_friction: float
    brand: int
    two_tone: bool
    led: str

    @property
    def front(self) -> float:
        """y of the front."""
        return -self.depth / 2.0

    @property
    def rear(self) -> float:
        """y of the scanner's rear, where its hinges are."""
        return self.depth / 2.0

    @property
    def back(self) -> float:
        """y of the base's rear."""
        return self.rear + (REAR_BLOCK if self.feed == "rear" else 0.0)

    @property
    def side(self) -> float:
        """Half of the width."""
        return self.width / 2.0

    @cached_property
    def cassette(self) -> tuple[float, float]:
        """z of the cassette's bay; empty for a rear feed."""
        low = self.foot + DECK
        return low, low + (self.cassette_height if self.feed == "cassette" else 0.004)

    @cached_property
    def output_bay(self) -> tuple[float, float]:
        """z of the output bay."""
        low = self.cassette[1] + DECK
        return low, low + self.output_height

    @cached_property
    def works(self) -> tuple[float, float]:
        """z of the print works: from the platen's deck to the base's top."""
        low = self.output_bay[1] + DECK
        return low, low + self.works_height

    @property
    def top(self) -> float:
        """z of the base's top."""
        return self.works[1]

    @property
    def unit(self) -> tuple[float, float]:
        """z of the scanner unit."""
        return self.top + GAP, self.top + GAP + self.scanner

    @property
    def cover(self) -> tuple[float, float]:
        """z of the scanner's lid."""
        return self.unit[1] + GAP, self.unit[1] + GAP + self.lid

    @property
    def bay_half(self) -> float:
        """Half of the output bay's width."""
        return self.paper_width / 2.0 + 0.012

    @property
    def bay_rear(self) -> float:
        """y of the output bay's rear wall."""
        return self.front + 0.175

    @property
    def cassette_half(self) -> float:
        """Half of the cassette bay's width."""
        return self.paper_width / 2.0 + 0.022

    @property
    def cassette_rear(self) -> float:
        """y of the cassette bay's rear wall."""
        return self.rear - 0.016

    @property
    def works_half(self) -> float:
        """Half of the width inside the print works."""
        return self.side - SHELL

    @property
    def works_span(self) -> tuple[float, float]:
        """y from and to of the print works."""
        return self.front + FRONT, self.rear - 0.026

    @property
    def panel_size(self) -> tuple[float, float]:
        """Width and height of the control panel."""
        return self.panel_share * self.width, self.works_height - 0.010

    @property
    def feeds_documents(self) -> bool:
        """Whether the lid carries a document feeder: before a rear feed it has no room to open."""
        return self.feeder and self.feed == "cassette"

    @property
    def lid_opening(self) -> float:
        """Degrees; before a rear feed's cover unit and lid together stop upright."""
        return self.lid_deg if self.feed == "cassette" else min(self.lid_deg, 92.0 - self.unit_deg)

    @property
    def tilts(self) -> bool:
        """Whether the control panel tilts."""
        return self.panel == "tilting"
