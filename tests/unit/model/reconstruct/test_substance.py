"""Shreds become pieces of what carries them; thin parts that boxes fit into stay parts."""

import math

import numpy as np

from artgen.core.conventions import VERTEX_DECIMALS
from artgen.core.mesh import TriMesh
from artgen.geometry.solid import Solid, hull, slab, union
from model.reconstruct.proof import first_meetings, proven
from model.reconstruct.substance import LIGHT, is_thin, settled, substantial
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


def smallest_rounded(mesh: TriMesh) -> float:
    """m2 of the smallest triangle of a mesh that is rounded as files are."""
    a, b, c = np.round(mesh.triangles, VERTEX_DECIMALS).transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).min()) / 2.0


def test_what_joining_leaves_has_area_once_rounded() -> None:
    """A block that cannot be parted from the floor, past whose slanted side the floor's corner at
    (1, 1) pokes by 1e-7 m: a triangle of 0.5e-14 m2, where validators ask for 1e-14."""
    corners = np.array([[0.0, 2.0], [10.0, -8.000001], [0.0, -8.0]])
    ends = [np.column_stack([corners, np.full(3, z)]) for z in (-0.05, 0.2)]
    block = hull(np.concatenate(ends))
    scene = scene_of(TURN, base=FLOOR, block=block)
    joined = proven(scene)
    assert joined.joints == ()
    assert smallest_rounded(joined.solids["base"].trimesh()) < 1e-14
    found = settled(scene)
    assert smallest_rounded(found.solids["base"].trimesh()) >= 1e-14
    assert first_meetings(found) == []


def test_what_is_sound_and_meets_nothing_stays() -> None:
    block = slab((-0.1, -0.1, 0.001), (0.1, 0.1, 0.2))
    found = settled(scene_of(TURN, base=FLOOR, block=block))
    assert (found.joints, found.changes) == ((TURN,), ())
    assert abs(found.solids["block"].volume - block.volume) <= 1e-12
