"""Mean layouts and nearest neighbors in closed form."""

import numpy as np
import pytest

from artgen.articulation.targets import PRISMATIC, REVOLUTE
from artgen.core.errors import ModelError
from model.evaluation.baselines import NearestNeighbor, mean_layouts, pixel_feature
from model.evaluation.reshape import placed, taken
from tests.unit.model.evaluation.layouts import cabinet


def test_the_mean_of_equals_is_the_same() -> None:
    mean = mean_layouts([cabinet("a"), cabinet("b")]).of("cabinet", 3)
    truth = cabinet()
    for key in ("boxes", "types", "axes", "origins", "limits", "parents", "states"):
        assert np.array_equal(getattr(mean, key), getattr(truth, key)), key


def test_numbers_are_averaged_and_words_voted() -> None:
    wide = cabinet(limits=np.array([(0.0, 0.0), (0.0, 0.7), (0.0, 1.5)]))
    other = cabinet(
        types=np.array([0, REVOLUTE, REVOLUTE]),
        limits=np.array([(0.0, 0.0), (0.0, 3.0), (0.0, 0.9)]),
    )
    mean = mean_layouts([cabinet(), wide, other]).of("cabinet", 3)
    assert mean.types.tolist() == [0, PRISMATIC, REVOLUTE]
    # A drawer's range is the mean of the two drawers, not of the hinge.
    assert mean.limits[:, 1].tolist() == pytest.approx([0.0, 0.6, 1.3], abs=1e-15)
    assert mean.origins[1].tolist() == [0.0, 0.0, 0.0]


def test_an_unseen_pair_falls_back() -> None:
    two = taken(cabinet("x", category="oven"), [0, 1])
    mean = mean_layouts([cabinet(), two])
    assert len(mean.of("oven", 3)) == 3
    assert len(mean.of("boat", 2)) == 2
    assert len(mean.of("boat", 7)) == 3
    assert len(mean.of("boat", 1)) == 1


def test_parents_voted_for_stay_a_tree() -> None:
    chain = [cabinet(parents=np.array([-1, 2, 0])), cabinet(parents=np.array([-1, 2, 0]))]
    assert mean_layouts(chain).of("cabinet", 3).parents.tolist() == [-1, 0, 0]


def test_the_nearest_of_those_with_as_many_parts() -> None:
    layouts = [cabinet("a"), taken(cabinet("b"), [0, 1]), placed(cabinet("c"), shift=(1, 0, 0))]
    neighbor = NearestNeighbor(np.array([[0.0], [1.0], [3.0]]), layouts)
    assert neighbor.of(np.array([1.0]), 3).name == "a"
    assert neighbor.of(np.array([1.6]), 3).name == "c"
    assert neighbor.of(np.array([1.6]), 2).name == "b"
    assert neighbor.of(np.array([1.2]), 9).name == "b"


def test_thumbnails_are_means_of_blocks() -> None:
    images = np.random.Generator(np.random.PCG64(0)).random((2, 3, 24, 36))
    found = pixel_feature(images).reshape(2, 12, 12)
    expected = images.mean(axis=1).reshape(2, 12, 2, 12, 3).mean(axis=(2, 4))
    assert found == pytest.approx(expected, abs=1e-15)


def test_nothing_to_learn_from_is_told() -> None:
    with pytest.raises(ModelError, match="needs training objects"):
        mean_layouts([])
    with pytest.raises(ModelError, match="needs one each"):
        NearestNeighbor(np.zeros((1, 2)), [])
