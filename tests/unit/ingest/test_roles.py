"""Their words to our roles, and forces that move what they have to."""

import pytest

from artgen.articulation.roles import ROLES
from artgen.ingest.roles import FLIPPED, FOREIGN_HELD, WORDS, dynamics, held_roles, role_label


@pytest.mark.parametrize(
    ("word", "joint", "role"),
    [
        ("rotation_door", "revolute", "door"),
        ("translation_tray", "prismatic", "tray"),
        ("drawer", "prismatic", "drawer"),
        ("key", "prismatic", "button"),
        ("cap", "prismatic", "lid"),
        ("left_door_link", "revolute", "door"),
        ("drawer", "revolute", "door"),
        ("furniture_body", None, "base"),
        ("foot_pad", "revolute", "part"),
        ("base_link", "revolute", "part"),
        ("", "prismatic", "part"),
    ],
)
def test_words_become_roles(word: str, joint: str | None, role: str) -> None:
    assert role_label(word, joint) == role


def test_every_word_stands_for_a_role_that_is_there() -> None:
    assert {*WORDS.values(), *FLIPPED.values()} <= set(ROLES)


@pytest.mark.parametrize("label", sorted(set(ROLES) - {"base"}))
@pytest.mark.parametrize("joint", ["revolute", "prismatic"])
@pytest.mark.parametrize("load", [0.0, 0.01, 5.0, 500.0])
def test_effort_overcomes_friction_and_load(label: str, joint: str, load: float) -> None:
    found = dynamics(label, joint, load=load, inertia=1.0)
    assert found.friction > 0.0
    assert found.effort >= 2.0 * (found.friction + load)


@pytest.mark.parametrize("label", sorted(set(ROLES) - {"base", "part"}))
def test_friction_lies_in_the_span_of_the_role(label: str) -> None:
    role = ROLES[label]
    for joint, (low, high) in (("revolute", role.turning), ("prismatic", role.sliding)):
        assert low <= dynamics(label, joint, load=3.0, inertia=1.0).friction <= high


def test_what_stays_where_it_is_put_has_friction_for_its_load() -> None:
    """A laptop's lid of 0.34 N m used to get half of that, and fell shut."""
    assert "lid" in held_roles("laptop")
    assert held_roles("keyboard") == ()
    assert dynamics("lid", "revolute", load=0.34, inertia=1.0, held=True).friction >= 0.34
    assert dynamics("lid", "revolute", load=0.34, inertia=1.0).friction < 0.34


def test_roles_that_hold_elsewhere_are_there() -> None:
    assert {role for roles in FOREIGN_HELD.values() for role in roles} <= set(ROLES)


def test_light_parts_are_damped_lightly() -> None:
    """A refrigerator's dial of 1.2e-7 kg m2 was damped so that it went 0.33 rad past its stop."""
    assert dynamics("dial", "revolute", load=0.0, inertia=1.2e-7).damping <= 1e-4
    assert dynamics("door", "revolute", load=0.0, inertia=1.0).damping == pytest.approx(0.05)
