"""Layouts that the tests share."""

import numpy as np

from artgen.articulation.targets import FIXED, PRISMATIC, REVOLUTE
from model.evaluation.layout import Layout

BASE = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
DOOR = ((0.0, -0.1, 0.5), (1.0, 0.0, 1.0))
DRAWER = ((0.1, -0.1, 0.0), (0.9, 0.8, 0.4))


def cabinet(name: str = "cabinet", **changes: object) -> Layout:
    """A base, a drawer that comes out by 0.5, a door that turns about its left edge."""
    values: dict[str, object] = {
        "name": name,
        "category": "cabinet",
        "labels": ("base", "drawer", "door"),
        "boxes": np.array([BASE, DRAWER, DOOR]),
        "types": np.array([FIXED, PRISMATIC, REVOLUTE]),
        "axes": np.array([(0.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)]),
        "origins": np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]),
        "limits": np.array([(0.0, 0.0), (0.0, 0.5), (0.0, 1.5)]),
        "parents": np.array([-1, 0, 0]),
        "states": np.array([(0.0, 0.0, 0.0), (0.0, 0.25, 1.0)]),
    }
    return Layout(**{**values, **changes})  # type: ignore[arg-type]
