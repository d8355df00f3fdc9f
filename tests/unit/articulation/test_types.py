"""Invalid joints, limits and trees cannot exist."""

import dataclasses

import numpy as np
import pytest

from artgen.articulation.types import Joint, Limit, Mass, Precondition, check_tree
from artgen.core.errors import GeometryError, KinematicError

HINGE = Joint(
    name="hinge", type="revolute", parent="base", child="lid", axis=(1.0, 0.0, 0.0),
    limit=Limit(lower=0.0, upper=1.0), friction=0.5, damping=0.1, effort=5.0,
)  # fmt: skip


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"axis": (1.0, 1e-5, 0.0)}, "expected 1 within 1e-12"),
        ({"limit": None}, "needs a limit"),
        ({"type": "continuous"}, "has no limit"),
        ({"friction": -1.0}, "must be >= 0"),
        ({"effort": 0.0}, "> 0"),
    ],
)
def test_a_wrong_joint_is_refused(change, message) -> None:
    with pytest.raises(KinematicError, match=message):
        dataclasses.replace(HINGE, **change)


@pytest.mark.parametrize(("lower", "upper"), [(0.1, 1.0), (-1.0, -0.5), (0.0, 0.0), (1.0, 0.0)])
def test_rest_lies_within_every_limit(lower, upper) -> None:
    with pytest.raises(KinematicError, match="lower <= 0 <= upper"):
        Limit(lower=lower, upper=upper)


def renamed(**change: str) -> Joint:
    return dataclasses.replace(HINGE, **change)


@pytest.mark.parametrize(
    ("names", "joints", "message"),
    [
        (["base", "base"], (), "part names repeat"),
        (["base", "lid"], (), "hang on no joint"),
        (["base", "lid"], (renamed(parent="lid", child="base"),), "does not extend the tree"),
        (["base", "lid"], (HINGE, HINGE), "does not extend the tree"),
        (["base", "lid", "pin"], (HINGE, renamed(child="pin")), "joint names repeat"),
    ],
)
def test_anything_but_a_tree_is_refused(names, joints, message) -> None:
    with pytest.raises(KinematicError, match=message):
        check_tree(names, joints, ())


def test_a_precondition_on_nothing_is_refused() -> None:
    rule = Precondition(joint="rack", requires="hinge", at_least=1.0)
    with pytest.raises(KinematicError, match=r"unknown joints \['rack'\]"):
        check_tree(["base", "lid"], (HINGE,), (rule,))


@pytest.mark.parametrize(
    "inertia", [np.diag([1.0, 1.0, 2.1]), np.diag([1.0, 1.0, -1.0]), np.diag([1.0, 0.0, 1.0])]
)
def test_inertia_that_no_body_has_is_refused(inertia) -> None:
    """2.1 > 1 + 1 breaks A + B >= C; zero and negative moments are no body either."""
    with pytest.raises(GeometryError, match="not a"):
        Mass(mass=1.0, center=np.zeros(3), inertia=inertia)
