"""A blocked joint finds the edge, or the direction, that lets it go; a free one stays."""

import math

from artgen.geometry.solid import slab
from model.reconstruct.freedom import free_share
from model.reconstruct.rescue import unblocked
from tests.unit.model.reconstruct.scenes import scene_of, stated

BASE = slab((-0.2, -0.15, 0.0), (0.2, 0.15, 0.02))
LID = slab((-0.2, -0.15, 0.0225), (0.2, 0.15, 0.04))


def lid(depth: float, height: float):  # type: ignore[no-untyped-def]
    """A lid that turns up about an axis at some place before its rear edge."""
    return stated(
        "lid", "revolute", axis=(-1.0, 0.0, 0.0), origin=(0.0, depth, height), upper=math.pi / 2.0
    )


def test_a_hinge_within_its_lid_moves_to_the_edge() -> None:
    """Turned about a line 8 cm before the rear edge the rim would dive into the base."""
    scene = scene_of(lid(0.07, 0.03), base=BASE, lid=LID)
    assert free_share(scene, "lid_joint") < 0.5
    found = unblocked(scene)
    assert free_share(found, "lid_joint") == 1.0
    assert abs(found.joint("lid_joint").origin[1] - 0.15) <= 1e-12
    assert any("an edge of lid" in change for change in found.changes)


def test_a_free_hinge_stays_where_it_is() -> None:
    scene = scene_of(lid(0.15, 0.0225), base=BASE, lid=LID)
    assert unblocked(scene) is scene


def test_a_slide_into_the_wall_is_turned_around() -> None:
    """A drawer that is predicted to slide into its back wall comes out at the front."""
    shell = slab((-0.3, -0.25, 0.0), (0.3, 0.25, 0.4)) - slab(
        (-0.28, -0.3, 0.02), (0.28, 0.2, 0.38)
    )
    drawer = slab((-0.27, -0.25, 0.03), (0.27, 0.19, 0.37))
    slide = stated("drawer", "prismatic", axis=(0.0, 1.0, 0.0), upper=0.3)
    found = unblocked(scene_of(slide, base=shell, drawer=drawer))
    assert found.joint("drawer_joint").axis == (0.0, -1.0, 0.0)
    assert free_share(found, "drawer_joint") == 1.0
