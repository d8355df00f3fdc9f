from model.data.order import Permutations


def test_every_epoch_holds_every_position_once_in_an_order_of_its_own():
    row = Permutations(7, seed=3)
    epochs = [[row.at(7 * epoch + k) for k in range(7)] for epoch in range(3)]
    assert [sorted(epoch) for epoch in epochs] == [list(range(7))] * 3
    assert len({tuple(epoch) for epoch in epochs}) == 3


def test_a_place_does_not_depend_on_what_was_asked_before():
    row = Permutations(5, seed=1)
    forward = [row.at(place) for place in range(20)]
    assert [Permutations(5, seed=1).at(place) for place in (19, 0, 7)] == [
        forward[place] for place in (19, 0, 7)
    ]
    assert [row.at(place) for place in reversed(range(20))] == forward[::-1]
    assert [Permutations(5, seed=2).at(place) for place in range(20)] != forward
