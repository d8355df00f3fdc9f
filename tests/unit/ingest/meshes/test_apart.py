"""Pieces of different parts keep out of each other's way wherever their bodies do, and only there.

The judge is MuJoCo, as in validation; the law is the validator's: no contact deeper than 1e-4 m.
"""

import itertools

import numpy as np
import pytest

from artgen.core.mesh import Floats, TriMesh
from artgen.core.rotation import axis_angle_matrix
from artgen.core.transform import rigid
from artgen.geometry.convex import convexity_gap
from artgen.geometry.distance import inside_bodies
from artgen.geometry.solid import Solid, box, cylinder, union
from artgen.ingest.meshes.meeting import meetings
from artgen.ingest.meshes.pieces import convex_pieces
from tests.unit.ingest.meshes.made import bodies_from

REST = np.eye(4)


def slid(*ways: float) -> list[dict[str, Floats]]:
    return [{"still": REST, "moves": rigid(np.eye(3), (0.0, -way, 0.0))} for way in ways]


def turned(*angles: float) -> list[dict[str, Floats]]:
    return [
        {"still": REST, "moves": rigid(axis_angle_matrix((0.0, 0.0, 1.0), q), (0.0, 0.0, 0.0))}
        for q in angles
    ]


def channel() -> Solid:
    """A runner of 2 mm sheet, open to +x, 0.3 m long."""
    return box((0.014, 0.3, 0.04)) - box((0.012, 0.4, 0.036), at=(0.002, 0.0, 0.002))


def hook() -> Solid:
    """The drawer's half of it: a bar inside the channel on a web that comes in from +x."""
    bar = box((0.008, 0.3, 0.030), at=(0.002, 0.0, 0.005))
    return union([bar, box((0.02, 0.3, 0.004), at=(0.014, 0.0, 0.018))])


def ring() -> Solid:
    """An eye of 10 mm around a pin of 9.6 mm."""
    outer, hole = cylinder(0.012, 0.01, segments=32), cylinder(0.005, 0.03, segments=32)
    return outer - hole.at(z=-0.01)


def pin() -> Solid:
    return cylinder(0.0048, 0.03, segments=32).at(z=-0.01)


NESTED = {
    "runner": (channel(), hook(), slid(*np.linspace(0.0, 0.25, 6))),
    "eye": (ring(), pin(), turned(*np.linspace(0.0, 1.5, 6))),
    "eye that turns": (pin(), ring(), turned(*np.linspace(0.0, 1.5, 6))),
}


@pytest.mark.parametrize("name", NESTED)
def test_nested_parts_get_pieces_that_do_not_meet_on_their_way(name: str) -> None:
    still, moves, poses = NESTED[name]
    parts = {
        "still": bodies_from(still.trimesh().triangles),
        "moves": bodies_from(moves.trimesh().triangles),
    }
    found = convex_pieces(parts, most=4, poses=poses)
    assert not meetings(found, [dict.fromkeys(parts, REST), *poses])
    assert max(convexity_gap(piece) for own in found.values() for piece in own) <= 1e-5


@pytest.mark.parametrize("name", NESTED)
def test_what_is_cut_free_still_covers_the_body(name: str) -> None:
    """Of points inside a body, all but those in a film between the two are in one of its pieces:
    a ring's share between circle and polygon is 4 % of its area at eight sides."""
    still, moves, poses = NESTED[name]
    solids = {"still": still, "moves": moves}
    parts = {key: bodies_from(solid.trimesh().triangles) for key, solid in solids.items()}
    found = convex_pieces(parts, most=4, poses=poses)
    for key, solid in solids.items():
        low, high = solid.bounds
        axes = [np.linspace(a, b, 14)[1:-1] for a, b in zip(low, high, strict=True)]
        points = np.array(list(itertools.product(*axes)))
        points = points[inside_bodies(solid.trimesh(), points)]
        covered = np.zeros(len(points), bool)
        for piece in found[key]:
            covered |= inside_bodies(piece, points)
        assert covered.mean() >= 0.9


def test_a_door_is_not_cut_for_the_drawer_that_is_pulled_through_it() -> None:
    """Else the drawer would pass the shut door, and nobody would find that it has to wait."""
    parts = {
        "still": bodies_from(box((0.4, 0.02, 0.3)).trimesh().triangles),
        "moves": bodies_from(box((0.3, 0.4, 0.2), at=(0.0, 0.3, 0.05)).trimesh().triangles),
    }
    found = convex_pieces(parts, most=8, poses=slid(0.05, 0.15, 0.3))
    assert [len(own) for own in found.values()] == [1, 1]
    assert meetings(found, slid(0.3))


def test_pieces_meet_as_deep_as_boxes_do() -> None:
    """Boxes that overlap by 1 mm meet, by 0.01 mm they do not; poses that repeat count once."""
    one = box((0.1, 0.1, 0.1)).trimesh()

    def met(shift: float) -> int:
        other = TriMesh(vertices=np.add(one.vertices, (shift, 0.0, 0.0)), faces=one.faces)
        found = meetings({"still": [one], "moves": [other]}, slid(0.0, 0.0, 0.01))
        return sum(len(ways) for ways in found.values())

    assert met(0.099) == 2
    assert met(0.09999) == 0
    assert met(0.2) == 0
