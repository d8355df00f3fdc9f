import numpy as np
import pytest

from artgen.articulation.targets import swept_sphere
from artgen.core.errors import ModelError, RuleError
from artgen.geometry.measure import open_edges
from artgen.rules import rule_names
from model.data.soup import KEPT_VOLUME, Soup, seed_soup
from tests.made import drafted
from tests.unit.model.data.small import COARSE, soup


@pytest.mark.parametrize("category", rule_names())
def test_every_category_makes_a_soup_whose_bodies_are_closed(category):
    made = soup(category)
    assert made.asset_id == f"{category}_000000"
    assert [joint.child in made.parts for joint in made.joints] == [True] * len(made.joints)
    for body in np.unique(made.body):
        assert open_edges(made.faces[made.body == body]) == 0


@pytest.mark.parametrize("category", ["cabinet", "laptop", "kettle"])
def test_triangles_stay_within_the_tolerance_of_the_exact_boxes(category):
    made = soup(category)
    for p in range(len(made.parts)):
        used = made.vertices[np.unique(made.faces[made.part == p])]
        found = np.stack([used.min(axis=0), used.max(axis=0)])
        # 1e-6: vertices are float32 of coordinates of a meter.
        assert np.abs(found - made.bounds[p]).max() <= COARSE * made.radius + 1e-6


def test_zero_tolerance_keeps_every_triangle():
    draft = drafted("cabinet", 0)
    exact = sum(body.solid.manifold.num_tri() for part in draft.parts for body in part.bodies)
    assert len(seed_soup("cabinet", 101, 0, tolerance=0.0).faces) == exact


def test_a_thin_pane_is_not_simplified_away():
    made = seed_soup("window", 23, 0, tolerance=0.05)
    exact = seed_soup("window", 23, 0, tolerance=0.0)
    for body in np.unique(exact.body):
        left, whole = _volume(made, body), _volume(exact, body)
        assert left >= 0.999 * KEPT_VOLUME * whole


def test_the_sphere_is_that_of_the_targets():
    made = soup("laptop")
    center, radius = swept_sphere(made.parts, list(made.bounds), made.joints)
    assert np.array_equal(center, made.center)
    assert radius == made.radius


def test_an_unknown_category_is_refused():
    with pytest.raises(RuleError, match="lapto"):
        seed_soup("lapto", 0, 0)


def test_arrays_of_different_lengths_are_refused():
    made = soup("laptop")
    fields = {name: getattr(made, name) for name in Soup.__dataclass_fields__}
    with pytest.raises(ModelError, match="each triangle has one of each"):
        Soup(**{**fields, "part": made.part[1:]})


def _volume(made: Soup, body: int) -> float:
    a, b, c = made.vertices[made.faces[made.body == body]].astype(float).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)
