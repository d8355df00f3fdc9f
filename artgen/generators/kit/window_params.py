"""The numbers of a window and what they must obey."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from artgen.generators.kit.board import Stock
from artgen.generators.kit.density import ALUMINIUM, GLASS, RUBBER, ZINC
from artgen.generators.kit.front_layout import Rect
from artgen.generators.kit.glazed_sash import SashMaker
from artgen.generators.kit.window_frame import WindowFrame
from artgen.generators.kit.window_handle import Style

BOARD = 0.022
"""m; below the frame, for the window board."""


@dataclass(frozen=True, kw_only=True)
class WindowParams:
    """See category_rules/window.toml."""

    kind: str
    width: float
    height: float
    frame_member: float
    frame_depth: float
    sash_member: float
    sash_depth: float
    lip: float
    unit: float
    standing_bars: int
    lying_bars: int
    fanlight: bool
    fanlight_share: float
    mullion: bool
    rear_slides: bool
    hinge_left: bool
    handle: Style
    handle_length: float
    handle_share: float
    opening_deg: float
    tilt_deg: float
    travel: float
    trim: bool
    trim_width: float
    board_reach: float
    ears: float
    drip: bool
    profile_density: float
    friction: float
    slide_friction: float
    handle_friction: float

    @property
    def sashes(self) -> int:
        """Side by side."""
        return 2 if self.kind in ("casement_pair", "sliding") else 1


def _proportions(p: WindowParams) -> bool:
    """Sashes that swing are not much wider than tall; those that slide have room for two."""
    if p.kind == "sliding":
        return p.width > 1.0 and p.width / p.height > 0.9
    if p.kind == "double_hung":
        return p.height > 0.95 and p.height / p.width > 1.15
    if p.kind == "casement_pair":
        return p.width > 0.95 and p.height / p.width > 0.65
    if p.kind == "tilt":
        return p.width < 1.3 and p.height < 1.1
    return p.width < 0.95 and p.height / p.width > 0.9


def _fanlight_fits(p: WindowParams) -> bool:
    """Only turning sashes have a fixed light above, and stay tall enough below it."""
    if not p.fanlight:
        return True
    return p.kind in ("casement", "casement_pair") and p.height > 1.15


def _sash_clears_jamb(p: WindowParams) -> bool:
    """The rear corner of the free edge swings out by depth^2 / (2 width) into the air gap."""
    deep = p.sash_depth + 0.010
    wide = (p.width - 2.0 * p.frame_member) / p.sashes - 0.02
    return deep * deep / (2.0 * wide) < 0.008


INVARIANTS: Mapping[str, Callable[[WindowParams], bool]] = {
    "proportions_suit_the_kind": _proportions,
    "fanlight_fits": _fanlight_fits,
    "sash_clears_jamb": _sash_clears_jamb,
}

SILL = Stock(surface="sill", density=700.0, edge=0.003)
METAL = Stock(surface="metal", density=ZINC, edge=0.0006)
SHEET = Stock(surface="sheet", density=ALUMINIUM, edge=0.0)
SEAL = Stock(surface="seal", density=RUBBER, edge=0.0)


def profile(p: WindowParams) -> Stock:
    """What frame and sashes are made of."""
    return Stock(surface="frame", density=p.profile_density, edge=0.002)


def frame_of(p: WindowParams, depth: float) -> WindowFrame:
    """The frame stands on the window board."""
    half = p.width / 2.0
    return WindowFrame(
        outer=Rect(x0=-half, x1=half, z0=BOARD + 0.02, z1=BOARD + 0.02 + p.height),
        member=p.frame_member,
        depth=depth,
        stock=profile(p),
        seal=SEAL,
    )


def sash_maker(p: WindowParams) -> SashMaker:
    """Sashes of the window; the pane fits their depth."""
    return SashMaker(
        stock=replace(profile(p), edge=0.0025),
        pane=Stock(surface="glass", density=GLASS, edge=0.0),
        seal=SEAL,
        spacer=SHEET,
        member=p.sash_member,
        bars=(p.standing_bars, p.lying_bars),
        unit=p.unit,
    )
