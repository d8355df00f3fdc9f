"""A cover holds its part, and what is swept holds the part wherever it passes."""

import math

import manifold3d as m3
import numpy as np
import pytest

from artgen.articulation.kinematics import joint_motions
from artgen.geometry.solid import Solid, cylinder, slab
from model.reconstruct.assemble import _stated
from model.reconstruct.cover import MOST, coarse, convex_cover, grown, lacking, swept
from model.reconstruct.joints import clean_joint
from tests.unit.model.reconstruct.perfect import joint, open_box

TRAY = open_box(np.zeros(3), np.array([0.5, 0.4, 0.2]), 0.01, open_to=2, side=1)
SHAPES = {
    "box": slab((0.0, 0.0, 0.0), (0.3, 0.2, 0.1)),
    "tray": TRAY,
    "bar with knob": slab((0.0, 0.0, 0.0), (0.5, 0.02, 0.3))
    | cylinder(0.02, 0.06).at(0.4, 0.01, 0.3),
}


@pytest.mark.parametrize("name", SHAPES)
def test_a_cover_holds_its_part_and_little_else(name: str) -> None:
    """Hulls are merged within 1 mm, which a growth of 1 mm takes back; what is left over is
    rounding of the booleans, 1e-12 m3 on parts of 1e-3."""
    solid, tolerance = SHAPES[name], 1e-3
    cover = convex_cover(solid, tolerance=tolerance)
    left = solid
    for piece in grown(cover, tolerance):
        left = left - piece
    assert left.volume <= 1e-12
    assert len(cover) <= MOST
    assert sum(piece.volume for piece in cover) - solid.volume <= 0.05 * solid.hull().volume


@pytest.mark.parametrize("kind", ["two trays", "torn tray"])
def test_a_cover_holds_a_solid_that_crosses_itself(kind: str) -> None:
    """Merging triangles far lets surfaces pass through themselves, of which booleans lose pieces:
    split by planes, the torn tray is left out of its hulls by up to 7 cm. Every corner of two
    trays through each other as one surface, and of the torn one, lies in a piece."""
    tilted = TRAY.turned("x", 0.6, about=(0.25, 0.2, 0.1)).turned("y", 0.4)
    crossed = Solid(m3.Manifold(_joined(TRAY, tilted))) if kind == "two trays" else _torn_tray()
    pieces = grown(convex_cover(crossed, tolerance=1e-3), 1e-3)
    points = crossed.trimesh().vertices
    outside = [[lacking(piece, point[None]) for piece in pieces] for point in points]
    assert np.min(outside, axis=1).max() <= 1e-9


def _torn_tray() -> Solid:
    """A tray with wavy walls, as fields leave them, its triangles merged until few are left."""
    generator = np.random.default_rng(6)
    waves, phases = 14.0 * generator.normal(size=(6, 3)), generator.uniform(0.0, 6.28, 6)
    heights = 0.012 * generator.normal(size=6)

    def depth(x: float, y: float, z: float) -> float:
        block = max(abs(x) - 0.4, abs(y) - 0.3, abs(z) - 0.2)
        room = max(abs(x) - 0.37, abs(y) - 0.27, -z - 0.17)
        wave = float(heights @ np.sin(waves @ np.array([x, y, z]) + phases))
        return -max(block, -room) - wave

    box = [-0.5, -0.4, -0.3, 0.5, 0.4, 0.3]
    found = max(m3.Manifold.level_set(depth, box, 0.03).decompose(), key=m3.Manifold.volume)
    tolerance = 1e-3
    while found.num_tri() > 300:
        found, tolerance = found.simplify(tolerance), 1.5 * tolerance
    return Solid(found)


def _joined(one: Solid, other: Solid) -> m3.Mesh64:
    first, second = one.trimesh(), other.trimesh()
    faces = np.concatenate([first.faces, second.faces + len(first.vertices)])
    return m3.Mesh64(np.concatenate([first.vertices, second.vertices]), faces.astype(np.uint64))


def test_growing_a_box_adds_the_gap_on_every_side() -> None:
    (found,) = grown((SHAPES["box"],), 0.002)
    assert np.abs(found.bounds - [[-0.002] * 3, [0.302, 0.202, 0.102]]).max() <= 1e-12


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_what_is_swept_holds_the_part_at_every_pose(kind: str) -> None:
    names = {0: "base", 1: "part"}
    stated = _stated(
        clean_joint(joint(1, kind, axis=(0.0, 0.0, 1.0), origin=(0.1, 0.0, 0.0), upper=1.0)),  # type: ignore[arg-type]
        names,
    )
    course = joint_motions(stated, np.linspace(0.0, 1.0, 9))
    passed = swept((SHAPES["box"],), course)
    for pose in course:
        outside = SHAPES["box"].transformed(pose) - passed
        assert outside.is_empty or outside.volume <= 1e-12


def test_a_straight_way_is_exact() -> None:
    """Two hundred by a hundred mm pushed along x by 0.5 m."""
    course = np.tile(np.eye(4), (5, 1, 1))
    course[:, 0, 3] = np.linspace(0.0, 0.5, 5)
    passed = swept((SHAPES["box"],), course)
    assert math.isclose(passed.volume, 0.8 * 0.2 * 0.1, rel_tol=1e-9)


def test_a_coarse_copy_stays_near() -> None:
    """A fine cylinder loses triangles, and little of its volume."""
    fine: Solid = cylinder(0.1, 0.2, segments=2000)
    found = coarse(fine, 400)
    assert found.manifold.num_tri() <= 400
    assert abs(found.volume / fine.volume - 1.0) <= 0.05
