"""Slicing a face: cells tile it, boards fill the rest, whatever the tree."""

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from artgen.generators.kit.front_layout import (
    Joinery,
    Leaf,
    Node,
    Rect,
    Split,
    slice_face,
)

FACE = Rect(x0=-0.7, x1=0.7, z0=0.1, z1=0.9)
OPENING = FACE.shrunk(0.018)
weights = st.floats(0.5, 2.0)
leaves = st.sampled_from(["drawer", "door_left", "pair", "open"]).map(lambda k: Leaf(kind=k))


def splits(nodes: st.SearchStrategy[Node]) -> st.SearchStrategy[Node]:
    return st.lists(st.tuples(weights, nodes), min_size=2, max_size=3).flatmap(
        lambda pairs: st.sampled_from(["x", "z"]).map(
            lambda axis: Split(
                axis=axis, weights=tuple(w for w, _ in pairs), nodes=tuple(n for _, n in pairs)
            )
        )
    )


trees = splits(splits(leaves) | leaves) | leaves
joineries = st.builds(
    Joinery, board=st.just(0.018), rail=st.sampled_from([0.0, 0.02]), by_cover=st.booleans()
)


@settings(deadline=None)
@given(trees, joineries)
def test_covers_tile_the_face_and_openings_with_boards_the_room(tree: Node, how: Joinery) -> None:
    cells, boards = slice_face(tree, OPENING, FACE, how)
    rooms = [cell.opening for cell in cells] + [board.place for board in boards]
    for rects, whole in (([cell.cover for cell in cells], FACE), (rooms, OPENING)):
        area = sum(rect.width * rect.height for rect in rects)
        assert area == pytest.approx(whole.width * whole.height, rel=1e-12)
        for a, b in itertools.combinations(rects, 2):
            wide, high = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.z1, b.z1) - max(a.z0, b.z0)
            assert min(wide, high) <= 1e-12


@settings(deadline=None)
@given(st.lists(weights, min_size=2, max_size=5))
def test_weights_share_out_what_is_seen(shares: list[float]) -> None:
    """Fronts that cover the boards are as the weights say; set between them, the openings are."""
    for by_cover in (True, False):
        how = Joinery(board=0.018, rail=0.02, by_cover=by_cover)
        leaf = Leaf(kind="drawer")
        node = Split(axis="z", weights=tuple(shares), nodes=(leaf,) * len(shares))
        cells, _ = slice_face(node, OPENING, FACE, how)
        heights = [(c.cover if by_cover else c.opening).height for c in cells]
        total = sum(heights)
        assert [h / total for h in heights] == pytest.approx([s / sum(shares) for s in shares])


def test_boards_stand_where_the_kinds_call_for_them() -> None:
    drawer, door = Leaf(kind="drawer"), Leaf(kind="door_left")
    node = Split(axis="z", weights=(1, 1, 1), nodes=(door, drawer, drawer))
    for rail, expected in ((0.02, ["shelf", "rail"]), (0.0, ["shelf"])):
        how = Joinery(board=0.018, rail=rail, by_cover=True)
        _, boards = slice_face(node, OPENING, FACE, how)
        assert [board.kind for board in boards] == expected
    columns = Split(axis="x", weights=(1, 1), nodes=(drawer, drawer))
    _, boards = slice_face(columns, OPENING, FACE, how)
    assert [board.kind for board in boards] == ["divider"]


def test_cells_know_whether_they_end_at_the_sides() -> None:
    node = Split(axis="x", weights=(1, 1, 1), nodes=(Leaf(kind="open"),) * 3)
    cells, _ = slice_face(node, OPENING, FACE, Joinery(board=0.018, rail=0.0, by_cover=True))
    assert [(cell.at_left, cell.at_right) for cell in cells] == [
        (True, False),
        (False, False),
        (False, True),
    ]
