"""Shreds become pieces of what carries them; thin parts that boxes fit into stay parts."""

import math

from artgen.geometry.solid import Solid, slab, union
from model.reconstruct.substance import LIGHT, is_thin, substantial
from tests.unit.model.reconstruct.scenes import scene_of, stated

FLOOR = slab((-1.0, -1.0, -0.1), (1.0, 1.0, 0.0))
TURN = stated("block", "revolute", axis=(0.0, 0.0, 1.0), upper=math.pi)
SHEET = slab((-0.1, -0.1, 0.01), (0.1, 0.1, 0.0102))


def tilted(solid: Solid) -> Solid:
    """Across all axes, so that no box along them, nor along its own faces, holds much."""
    return solid.turned("x", 0.6).turned("z", 0.4)


def shards() -> Solid:
    """Sheets of 0.2 mm that stand every way, as what cutting leaves of a torn surface."""
    turned = [tilted(SHEET.turned("y", 0.5 * k, about=(0.0, 0.0, 0.01))) for k in range(6)]
    return union(turned).at(z=0.5)


def test_what_weighs_nothing_becomes_a_piece() -> None:
    side = (0.5 * LIGHT * FLOOR.volume) ** (1.0 / 3.0)
    crumb = slab((0.0, 0.0, 0.1), (side, side, 0.1 + side))
    scene = substantial(scene_of(TURN, base=FLOOR, block=crumb))
    assert scene.joints == ()
    assert scene.piece_of("block") == "base"
    twice = slab((0.0, 0.0, 0.1), (2.0 * side, side, 0.1 + 1.5 * side))
    kept = scene_of(TURN, base=FLOOR, block=twice)
    assert substantial(kept) is kept


def test_what_no_box_fits_into_becomes_a_piece() -> None:
    assert is_thin(shards())
    scene = substantial(scene_of(TURN, base=FLOOR, block=shards()))
    assert scene.joints == ()
    assert any("no contact box fits" in change for change in scene.changes)


def test_a_wire_along_an_axis_stays() -> None:
    """A bail fills little of its hull, but boxes fit into it."""
    frame = slab((-0.2, -0.2, 0.1), (0.2, 0.2, 0.104)) - slab(
        (-0.19, -0.19, 0.0), (0.19, 0.19, 0.2)
    )
    thin = frame | slab((-0.2, -0.2, 0.1), (-0.196, -0.196, 0.5))
    assert thin.volume < 0.05 * thin.hull().volume
    assert not is_thin(thin)
