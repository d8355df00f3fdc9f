"""Slots filled: the fronts of one object have their grain as those of its template had."""

from collections.abc import Sequence

import numpy as np
import pytest

from artgen.articulation.types import Joint, Limit
from artgen.assembly.fill import filled, grains, main_board
from artgen.assembly.piece import Piece, joined
from artgen.assembly.source import Member
from artgen.core.mesh import TriMesh
from artgen.core.surface import SurfaceSpec
from artgen.geometry.solid import slab
from artgen.geometry.unwrap import metric_uv

WOOD = SurfaceSpec(name="front", recipe="wood")
PAINT = SurfaceSpec(name="front", recipe="paint")
GLASS = SurfaceSpec(name="pane", recipe="plain", transmission=1.0)


def board(low: Sequence[float], high: Sequence[float], grain: int) -> Piece:
    mesh = slab(np.array(low, float), np.array(high, float)).trimesh()
    count = len(mesh.faces)
    return Piece(
        mesh=TriMesh(
            vertices=mesh.vertices,
            faces=mesh.faces,
            uv=metric_uv(mesh.vertices, mesh.faces, grain=grain, place=1),
            slot=np.zeros(count, np.int16),
            body=np.zeros(count, np.int32),
        ),
        densities=(600.0,),
        collision=(mesh,),
    )


def front(width: float, height: float, grain: int) -> Piece:
    return board((0.0, 0.0, 0.0), (width, 0.02, height), grain)


def frame() -> Piece:
    """Stiles and rails; no board makes up its face."""
    boxes = [((0, 0, 0), (0.1, 0.02, 0.6), 2), ((0.3, 0, 0), (0.4, 0.02, 0.6), 2),
             ((0.1, 0, 0), (0.3, 0.02, 0.3), 0), ((0.1, 0, 0.3), (0.3, 0.02, 0.6), 0)]  # fmt: skip
    return joined([board(low, high, grain) for low, high, grain in boxes])


def member(body: Piece, name: str = "drawer") -> Member:
    joint = Joint(
        name=f"{name}_slide",
        type="prismatic",
        parent="base",
        child=name,
        axis=(0.0, -1.0, 0.0),
        limit=Limit(lower=0.0, upper=0.3),
        friction=1.0,
        damping=1.0,
        effort=20.0,
    )
    return Member(name=name, label="drawer", joint=joint, kind="front", side="out", body=body)


def grain_of(piece: Piece) -> int:
    found = main_board(piece, [0])
    assert found is not None
    return found[1]


@pytest.mark.parametrize("surface", [WOOD, PAINT])
@pytest.mark.parametrize("slot", [(0.5, 0.2), (0.3, 0.6)])
@pytest.mark.parametrize("donor", [(0.4, 0.15), (0.4, 0.5)])
@pytest.mark.parametrize("there", [0, 2])
@pytest.mark.parametrize("brought", [0, 2])
def test_grain_runs_as_that_of_the_front_which_was_there(
    surface: SurfaceSpec,
    slot: tuple[float, float],
    donor: tuple[float, float],
    there: int,
    brought: int,
) -> None:
    """Found: a drawer with its grain across above one with it upright, as each had it at its
    donor's. Of paint too, which becomes wood with the object's new looks."""
    place, gift = member(front(*slot, there)), member(front(*donor, brought))
    axis = grains([place], [WOOD])[place.name]
    fill = filled(place, gift, [surface], grain=axis)
    assert grain_of(fill.body) == there
    assert np.abs(fill.body.bounds - place.body.bounds).max() <= 1.1e-7


def test_a_front_without_a_board_takes_the_grain_of_the_others() -> None:
    members = [member(front(0.4, 0.6, 2), "a"), member(front(0.4, 0.6, 2), "b"),
               member(front(0.4, 0.6, 0), "c"), member(frame(), "d")]  # fmt: skip
    assert grains(members, [WOOD]) == {"a": 2, "b": 2, "c": 0, "d": 2}
    assert grains(members[3:], [WOOD]) == {"d": None}
    assert grains(members[:1], [GLASS]) == {"a": None}, "panes have no grain"


@pytest.mark.parametrize(("slot", "wanted"), [((0.5, 0.2), 0), ((0.3, 0.6), 2)])
def test_where_a_template_tells_nothing_grain_stays_along_the_longer_side(
    slot: tuple[float, float], wanted: int
) -> None:
    gift = member(front(0.3, 0.5, 2))
    fill = filled(member(front(*slot, 0)), gift, [WOOD], grain=None)
    assert grain_of(fill.body) == wanted


def test_glass_is_not_turned() -> None:
    gift = member(front(0.4, 0.15, 0))
    fill = filled(member(front(0.5, 0.2, 2)), gift, [GLASS], grain=2)
    assert grain_of(fill.body) == 0
