"""How deep a collision can hide between the poses of a sweep.

A door's edge, 0.9 m from its hinge, passes a post that stands a little in its way. For every number
of poses the deepest intrusion is sought that goes unseen somewhere along the way; the closed form
says how deep it must be to be seen for sure.
"""

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from artgen.core.stream import Stream
from artgen.geometry.clearance import Mover, Shape, overlaps, shape_of_solids
from artgen.geometry.solid import cylinder, rotation_about, slab
from artgen.simulation_study.measured import Measured, timed

RADIUS = 0.9
"""m from the hinge to the edge."""
POST = 0.01
"""m, radius."""
HEIGHT = 0.1
TURN = math.pi / 2
SEEN = 1e-9
"""m3 of overlap from which validation reports one."""
POSES = (3, 5, 9, 21, 41, 81, 161)
DEPTHS = tuple(float(depth) for depth in np.geomspace(5e-5, 0.0195, 27))
"""m; the post is 20 mm thick."""
PLACES = 12


def sweep_rows() -> Iterator[Measured]:
    """Deepest unseen intrusion for each number of poses."""
    places = Stream(0, "study", "sweep").generator().uniform(0.1, 0.9, PLACES) * TURN
    leaf = shape_of_solids([slab((0.05, -0.01, 0), (RADIUS, 0.0, HEIGHT))])
    for poses in POSES:
        missed, cpu_ms = timed(partial(_deepest_missed, leaf, places.tolist(), poses), repeats=1)
        yield Measured(
            scene="door edge past a post",
            setting="poses",
            step=float(poses),
            error=missed,
            unit="m",
            cpu_ms=cpu_ms / (PLACES * len(DEPTHS)),
        )


def surely_seen(poses: int) -> float:
    """m of intrusion that some pose of a sweep meets wherever the post stands.

    The edge, at angle a from the post, is as far from the post's middle as the third side of a
    triangle with sides RADIUS and RADIUS + POST - depth. Half a step is the worst a.
    """
    half_step = TURN / (poses - 1) / 2.0
    # The edge still touches where |edge - middle| = POST; solve for the middle's distance.
    reach = RADIUS * math.cos(half_step)
    inside = POST**2 - (RADIUS * math.sin(half_step)) ** 2
    if inside <= 0.0:
        return math.inf
    return RADIUS + POST - (reach + math.sqrt(inside))


def _deepest_missed(leaf: Shape, places: list[float], poses: int) -> float:
    """m; 0 where every intrusion was seen everywhere."""
    missed = [
        depth
        for depth in DEPTHS
        for place in places
        if not _seen(leaf, place=place, depth=depth, poses=poses)
    ]
    return max(missed, default=0.0)


def _seen(leaf: Shape, *, place: float, depth: float, poses: int) -> bool:
    away = RADIUS + POST - depth
    post = cylinder(POST, HEIGHT, segments=64).at(
        away * math.cos(place), away * math.sin(place), 0.0
    )
    turns = np.stack(
        [rotation_about("z", angle, (0, 0, 0)) for angle in np.linspace(0, TURN, poses).tolist()]
    )
    movers = [
        Mover(
            name="post", shape=shape_of_solids([post]), poses=np.repeat(np.eye(4)[None], poses, 0)
        ),
        Mover(name="leaf", shape=leaf, poses=turns),
    ]
    return any(overlap.volume > SEEN for overlap in overlaps(movers))
