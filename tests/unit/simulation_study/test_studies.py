"""What the other studies of `artgen study simulate` rest on."""

import numpy as np
import pytest

from artgen.simulation_study.collision import (
    GAP,
    collision_model,
    distances,
    door,
    drawer,
    exact_gaps,
)
from artgen.simulation_study.inertia import MODES, by_mujoco, exact, shapes
from artgen.simulation_study.sweeping import DEPTHS, surely_seen, sweep_rows

FLOAT32 = 6e-8


def test_the_exact_gap_is_the_built_one() -> None:
    # Booleans of axis-aligned panels are exact to rounding: 1e-9 is a millionth of the gap.
    assert np.abs(exact_gaps(drawer()) - GAP).max() < 1e-9


@pytest.mark.parametrize("scene", [drawer(), door()], ids=lambda scene: scene.name)
def test_authored_pieces_measure_the_exact_gap(scene) -> None:
    pieces = [[solid.trimesh() for solid in part] for part in scene.parts]
    found = distances(collision_model(pieces), scene.poses)
    # MuJoCo keeps mesh vertices in float32: some ulp of 2 m.
    assert np.abs(found - exact_gaps(scene)).max() < 4 * 2.0 * FLOAT32


def test_one_hull_fills_the_drawer() -> None:
    scene = drawer()
    hulls = [[part[0].trimesh()] for part in ([whole(part)] for part in scene.parts)]
    assert distances(collision_model(hulls), scene.poses).min() < -0.1


def whole(part):
    solid = part[0]
    for other in part[1:]:
        solid = solid | other
    return solid.hull()


def test_only_the_exact_mode_weighs_hollow_shapes_right() -> None:
    carcass = shapes()["carcass"]
    mass, tensor = exact(carcass)
    found, principal = by_mujoco(carcass, MODES["exact"])
    assert found == pytest.approx(mass, rel=1e-5)  # float32 vertices over walls of 18 mm
    assert principal == pytest.approx(tensor, rel=1e-5)
    assert by_mujoco(carcass, MODES["legacy (MuJoCo's default)"])[0] > 2 * mass


def test_a_sweep_sees_what_the_closed_form_says_it_must() -> None:
    grid = DEPTHS[1] / DEPTHS[0]
    for row in sweep_rows():
        bound = min(surely_seen(int(row.step)), DEPTHS[-1])
        # The least overlap that is reported, 1 mm3, lets another 0.1 mm pass at this edge.
        assert row.error <= (bound + 1e-4) * grid
